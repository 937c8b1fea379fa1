//! A force curve of one's own: read from the CSV file of a load cell, put on the eye, and compared
//! with the smooth pulse of the same peak and duration.
//!
//! `cargo run --release --example measured_pulse -- FILE.csv` takes another file of two columns:
//! time in ms from the start of the blow, and force in N.

use contrecoup::Error;
use contrecoup::answer::solve::solve;
use contrecoup::run::kept::Keep;
use contrecoup::run::quantity::Quantity;
use contrecoup::run::watch::unwatched;
use contrecoup::scenario::{Curve, ForcePulse, Impact, Scenario};

const OWN: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/examples/measured_pulse.csv");

fn main() -> Result<(), Error> {
    let path = std::env::args().nth(1).unwrap_or(OWN.to_owned());
    let mut table = csv::ReaderBuilder::new().comment(Some(b'#')).from_path(path)?;
    let knots: Vec<(f64, f64)> = table.deserialize().collect::<Result<_, _>>()?;

    // A curve holds shares of the scenario's force; of a force of 1 N they are newtons. Times must
    // rise, and a refusal names the knot that is wrong.
    let mut measured = ForcePulse { force_n: 1.0, ..ForcePulse::default() };
    measured.follow(Curve::new(knots)?);
    let smooth = ForcePulse {
        force_n: measured.peak_n(),
        duration_ms: measured.duration_ms,
        ..ForcePulse::default()
    };

    for (name, pulse) in [("as measured", measured), ("as a smooth pulse", smooth)] {
        let peak = pulse.peak_n();
        let duration = pulse.duration_ms;
        let scenario = Scenario {
            name: name.to_owned(),
            impact: Impact::ForcePulse(pulse),
            ..Scenario::default()
        };
        let answer = solve(&scenario.check()?, Keep::default(), &mut unwatched)?;
        println!("{name}: {peak} N at most, {duration} ms");
        for quantity in [Quantity::Damage, Quantity::Apex] {
            let row = quantity.row();
            let value = answer.results()[quantity];
            let error = answer.errors.time_step[quantity];
            if let (Some(value), Some(error)) = (value, error) {
                println!("  {:<14}{value:8.3} {}, step error {error:.1e} %", row.label, row.unit);
            }
        }
    }
    Ok(())
}
