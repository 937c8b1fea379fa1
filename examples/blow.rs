//! One blow: what it does to the eye, and how far each number may be off.
//!
//! `cargo run --release --example blow` takes 300 N for 0.2 ms; `... --example blow -- bb-62`
//! another preset or the path of a scenario file.

use contrecoup::Error;
use contrecoup::answer::mesh_error::add_mesh_error;
use contrecoup::answer::solve::solve;
use contrecoup::run::kept::Keep;
use contrecoup::run::watch::unwatched;
use contrecoup::scenario::library;

fn main() -> Result<(), Error> {
    let asked = std::env::args().nth(1);
    let blow = library::resolve(asked.as_deref().unwrap_or("paper-300n"))?.check()?;

    // Two runs by different steps, side by side: the second gives the error of the step.
    let mut answer = solve(&blow, Keep::default(), &mut unwatched)?;
    // A third on the next finer mesh gives the error of the mesh.
    add_mesh_error(&blow, &mut answer, &mut unwatched)?;

    println!("{}", blow.name);
    println!("result                   value        step error  mesh error");
    let percent = |error: Option<f64>| error.map_or("-".to_owned(), |e| format!("{e:.2} %"));
    // Only what this scene has: no pressure without a fluid, no contact without an object.
    for (quantity, value) in answer.results().present() {
        let row = quantity.row();
        let step = percent(answer.errors.time_step[quantity]);
        let mesh = percent(answer.errors.mesh.and_then(|errors| errors[quantity]));
        println!("{:<20}{value:>10.4} {:<6}{step:>16}{mesh:>12}", row.label, row.unit);
    }
    // What a reader must know before trusting them, such as a mesh that folded.
    for flag in &answer.flags {
        println!("{}: {}", flag.kind.name(), flag.message);
    }
    Ok(())
}
