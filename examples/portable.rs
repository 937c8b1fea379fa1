//! A blow by the portable kernel, which rounds alike on every machine and at every vector width.
//!
//! `cargo run --release --example portable -- paper-300n` prints ten digits of each result. What
//! is left of a difference between two machines is how their C libraries round sines;
//! `.ci/elsewhere` compares.

use contrecoup::Error;
use contrecoup::answer::compiled::Compiled;
use contrecoup::models::paper::case::PaperCase;
use contrecoup::run::kept::Keep;
use contrecoup::run::watch::unwatched;
use contrecoup::scenario::library;
use std::sync::Arc;

fn main() -> Result<(), Error> {
    let asked = std::env::args().nth(1);
    let blow = library::resolve(asked.as_deref().unwrap_or("paper-300n"))?.check()?;
    let case = Compiled::with(Arc::new(PaperCase::with(&blow, false, true)), &blow);
    let run = case.run(&case.plan(&blow)?, Keep::default(), &mut unwatched)?;
    for (quantity, value) in case.results(&run).present() {
        println!("{:<20} {value:.9e}", quantity.row().label);
    }
    Ok(())
}
