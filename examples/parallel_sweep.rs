//! A sweep on all cores: damage over force and duration, as CSV.
//!
//! Every run is deterministic, so the table is the same on any number of threads.

use contrecoup::Error;
use contrecoup::answer::solve::solve;
use contrecoup::run::kept::Keep;
use contrecoup::run::quantity::Quantity;
use contrecoup::run::watch::unwatched;
use contrecoup::scenario::{ForcePulse, Impact, Scenario};
use rayon::prelude::*;

/// Damage index and its step error, both in % and `None` where a scene has no such result, and
/// whether the mesh folded.
type Row = (Option<f64>, Option<f64>, bool);

fn damage(force_n: f64, duration_ms: f64) -> Result<Row, Error> {
    let scenario = Scenario {
        impact: Impact::ForcePulse(ForcePulse { force_n, duration_ms, ..ForcePulse::default() }),
        ..Scenario::default()
    };
    let answer = solve(&scenario.check()?, Keep::default(), &mut unwatched)?;
    Ok((
        answer.results()[Quantity::Damage],
        answer.errors.time_step[Quantity::Damage],
        answer.run.folded_at().is_some(),
    ))
}

fn main() -> Result<(), Error> {
    let forces = [50.0, 100.0, 200.0, 400.0];
    let durations = [0.1, 0.2, 0.4];
    let grid: Vec<(f64, f64)> =
        forces.iter().flat_map(|&force| durations.map(|duration| (force, duration))).collect();
    // The order of the grid is kept, whichever run ends first; the first refusal ends the sweep.
    let rows: Vec<Row> = grid
        .par_iter()
        .map(|&(force, duration)| damage(force, duration))
        .collect::<Result<_, _>>()?;

    println!("force_n,duration_ms,damage_percent,step_error_percent,mesh_folded");
    for ((force, duration), (damage, error, folded)) in grid.iter().zip(rows) {
        let damage = damage.map_or(String::new(), |value| format!("{value:.3}"));
        let error = error.map_or(String::new(), |value| format!("{value:.2e}"));
        println!("{force},{duration},{damage},{error},{folded}");
    }
    Ok(())
}
