//! One scenario with the axisymmetric model answered: results, their errors, and what limits them.
//!
//! The step error of each result comes from a second run with two thirds of the step: viscous forces lag
//! half a step, so the error is taken to fall with the first order, e = C h, of which C h - 2/3 C h is a
//! third. It is doubled, since peaks of contact are less regular than that. Results are not smooth to the last digit, since each step is chosen by
//! the state, so no error below [`FLOOR_PERCENT`] is stated.
//!
//! The mesh error is that of grid convergence of the first order from the next finer mesh: with M = 2k + 2 cells across at level k, C/M - C/M' of the next is
//! (M' - M)/M' of C/M. It is a bound with room rather than a correction.

use super::case::RevolutionCase;
use super::flags;
use crate::dynamics::revolution::{self as engine, Run, STEP_SHARE, run};
use crate::eye::revolution::RevolutionEye;
use crate::injury::{Computed, DamageIndex, Measures, Risk, Verdict, assess, verdicts};
use crate::recording::{Keep, Peak};
use crate::study::case::{Refusal, Watch};
use crate::study::flags::{Flag, FlagKind};
use crate::study::quantity::{Family, Quantity};
use crate::study::results::Results;
use crate::study::solve::Errors;
use crate::study::validity::validity;
use std::ops::ControlFlow;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread;
use std::time::{Duration, Instant};

/// Step of the second run over that of the first.
const SECOND: f64 = 2.0 / 3.0;
/// Multiplies the estimate of the step error.
const SAFETY: f64 = 2.0;
/// The least step error that is stated, in %.
const FLOOR_PERCENT: f64 = 0.05;
/// Share of the worst step error below which no other one is stated.
const FAMILY_SHARE: f64 = 0.1;

/// The answer to a scenario with the axisymmetric model.
#[derive(Debug, Clone)]
pub struct RevolutionAnswer {
    /// What was moved.
    pub case: RevolutionCase,
    /// What that left.
    pub run: Run,
    /// The paper's index by this eye's own S, M and E.
    pub index: DamageIndex,
    /// How far the results may be off.
    pub errors: Errors,
    /// What limits them.
    pub flags: Vec<Flag>,
    /// Time the run took, the mesh and the second run left out.
    pub solve_time: Duration,
    /// Time that everything took.
    pub total_time: Duration,
}

impl RevolutionAnswer {
    /// Every result.
    pub fn results(&self) -> Results {
        results(&self.case, &self.run)
    }

    /// What the published injury curves say, beside the paper's index.
    pub fn risks(&self) -> Vec<Risk> {
        let extremes = &self.run.extremes;
        let computed = |peak: Peak, of| Computed {
            value: peak.value,
            error: self.errors.share(of),
        };
        assess(&Measures {
            blow: self.case.blow,
            pressure: Some(computed(extremes.pressure, Quantity::Pressure)),
            stress: Some(computed(extremes.scleral_stress, Quantity::ScleralStress)),
        })
    }

    /// What to believe of them: one verdict an injury.
    pub fn verdicts(&self) -> Vec<Verdict> {
        let extremes = &self.run.extremes;
        let last = extremes.pressure.time.max(extremes.scleral_stress.time);
        let late = last > flags::END * self.run.simulated;
        let validity = validity(&self.flags, Some(late), self.case.pig);
        verdicts(&self.risks(), &validity)
    }

    /// Estimates the mesh error from a neighbouring level and adds it, with a flag if that one folds.
    ///
    /// # Errors
    /// As for any run.
    pub fn add_mesh_error(&mut self, watch: Watch) -> Result<(), Refusal> {
        let level = self.case.eye.level;
        let finest = level == RevolutionEye::FINEST;
        let neighbour = if finest { level - 1 } else { level + 1 };
        let other = self.case.at_level(neighbour);
        let run = march(&other, 1.0, Keep::default(), watch)?;
        let factor = f64::from(neighbour + 1);
        let difference = results(&other, &run).difference_percent(&self.results());
        self.errors.mesh = Some(difference.map(|_, d| d.map(|d| factor * d)));
        let folded = run.extremes.folded_at;
        if let Some(time) = folded.filter(|_| self.run.extremes.folded_at.is_none()) {
            self.flags.push(Flag {
                kind: FlagKind::FinerMeshFolds,
                message: format!(
                    "the mesh of level {neighbour} folds at {:.3} ms",
                    time * 1e3
                ),
                time: Some(time),
            });
        }
        Ok(())
    }
}

fn results(case: &RevolutionCase, run: &Run) -> Results {
    Results::of_revolution(&run.extremes, case.blow)
}

/// One run with `share` of the usual step.
fn march(case: &RevolutionCase, share: f64, keep: Keep, watch: Watch) -> Result<Run, Refusal> {
    let share = share * STEP_SHARE;
    match run(&case.eye, &case.load, case.window, share, keep, watch) {
        Err(engine::Refusal::Stopped(_)) => Err(Refusal::Cancelled),
        other => Ok(other?),
    }
}

/// Answers `case` under the eyes of `watch`.
pub(super) fn solve(
    case: RevolutionCase,
    keep: Keep,
    watch: Watch,
) -> Result<RevolutionAnswer, Refusal> {
    let started = Instant::now();
    let abandoned = AtomicBool::new(false);
    // The second run needs nothing of the first, so both go side by side.
    let (first, second, solve_time) = thread::scope(|scope| {
        let other = scope.spawn(|| {
            march(&case, SECOND, Keep::default(), &mut |_| {
                if abandoned.load(Ordering::Relaxed) {
                    ControlFlow::Break(())
                } else {
                    ControlFlow::Continue(())
                }
            })
        });
        let first = march(&case, 1.0, keep, watch);
        let time = started.elapsed();
        if first.is_err() {
            abandoned.store(true, Ordering::Relaxed);
        }
        let second = other.join().unwrap_or(Err(Refusal::Cancelled));
        (first, second, time)
    });
    let run = first?;
    let factor = SAFETY / (1.0 - SECOND);
    let difference = results(&case, &second?).difference_percent(&results(&case, &run));
    let time_step = difference
        .map(|_, d| d.map(|d| factor * d + FLOOR_PERCENT))
        .raised(Family::Motion, FAMILY_SHARE);
    let errors = Errors {
        time_step,
        mesh: None,
        limits: None,
        energy_balance: 100.0 * run.extremes.energy_residual,
    };
    Ok(RevolutionAnswer {
        flags: flags::raise(&case, &run, errors.time_step_percent()),
        index: DamageIndex::of_revolution(&run.extremes),
        case,
        run,
        errors,
        solve_time,
        total_time: started.elapsed(),
    })
}
