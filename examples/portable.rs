//! A blow by the portable kernel, which rounds alike on every machine and at every vector width.
//!
//! `cargo run --release --example portable -- paper-300n` prints ten digits of each result. What is left of a
//! difference between two machines is how their C libraries round sines; `.ci/elsewhere` compares.

use contrecoup::Error;
use contrecoup::models::paper::case::Case;
use contrecoup::run::kept::Keep;
use contrecoup::run::watch::unwatched;
use contrecoup::scenario::library;

fn main() -> Result<(), Error> {
    let asked = std::env::args().nth(1);
    let blow = library::resolve(asked.as_deref().unwrap_or("paper-300n"))?.check()?;
    let case = Case::with(&blow, false, true);
    let plan = case.plan(&blow)?;
    let solution = case.run(&plan, Keep::default(), &mut unwatched)?;
    for (quantity, value) in case.results(&solution.recording.extremes).present() {
        println!("{:<20} {value:.9e}", quantity.row().label);
    }
    Ok(())
}
