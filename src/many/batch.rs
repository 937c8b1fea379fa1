//! Many scenarios at once: results only, on all cores.
//!
//! A batch keeps no traces and no frames, and makes no second run for the step error: whoever needs
//! it checks some of the scenarios with [`crate::answer::solve::solve()`]. Each scenario is solved alone and in
//! order, so the results are the same bits for any number of threads.

use crate::answer::results::Results;
use crate::models::compiled::Compiled;
use crate::models::paper::case::{Refusal, unwatched};
use crate::run::kept::Keep;
use crate::scenario::CheckedScenario;
use rayon::prelude::*;

/// What a batch gives for one scenario.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Outcome {
    /// All results.
    pub results: Results,
    /// When the mesh folded, in s.
    pub folded_at: Option<f64>,
}

/// Solves one scenario as a batch does.
///
/// # Errors
/// As for any run.
pub fn solve_one(scenario: &CheckedScenario) -> Result<Outcome, Refusal> {
    let case = Compiled::new(scenario);
    let plan = case.plan_alone(scenario)?;
    let left = case.run(&plan, Keep::default(), &mut unwatched)?.left;
    Ok(Outcome {
        results: case.results(&left),
        folded_at: left.folded_at(),
    })
}

/// Solves all scenarios on all cores of the current thread pool.
pub fn solve_all(scenarios: &[CheckedScenario]) -> Vec<Result<Outcome, Refusal>> {
    scenarios.par_iter().map(solve_one).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::verify::scenes::Scenes;

    #[test]
    fn a_batch_gives_the_same_bits_on_any_number_of_threads() {
        let scenarios: Vec<CheckedScenario> = (0..12)
            .map(|i| Scenes::Pulses.scene(i, 3).check().unwrap())
            .collect();
        let on = |threads| {
            let pool = rayon::ThreadPoolBuilder::new()
                .num_threads(threads)
                .build()
                .unwrap();
            pool.install(|| solve_all(&scenarios))
        };
        let one = on(1);
        assert_eq!(one, on(2));
        assert_eq!(one, on(5));
        assert!(one.iter().all(Result::is_ok));
    }
}
