//! One scenario answered: results, their errors, and what limits them.
//!
//! The step error of each result comes from a second run whose step differs by a factor r. For an
//! integrator of order p the difference d between the two is about (r^p - 1) times the error of the
//! finer run, and (1 - r^-p) times that of the coarser. Peaks do not always follow the order, so the
//! estimate is multiplied by a safety factor.

use super::case::{Case, Refusal, Solution, Watch};
use super::flags::{self, Flag};
use super::quantity::{PerQuantity, difference_percent, headline, values};
use crate::dynamics::{Cost, Plan, stability};
use crate::injury::DamageIndex;
use crate::recording::{Keep, Recording};
use crate::scenario::Scenario;
use std::time::{Duration, Instant};

/// Ratio of the two steps.
const RATIO: f64 = 1.5;
/// Multiplies the estimate, because peaks do not always follow the order.
const SAFETY: f64 = 4.0;

/// How far each result may be off.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Errors {
    /// By the time step, in % of each result.
    pub time_step: PerQuantity,
    /// By the mesh, in % of each result, once it has been estimated.
    pub mesh: Option<PerQuantity>,
    /// Energy residual, in % of the work in.
    pub energy_balance: f64,
}

impl Errors {
    /// Step error of damage, apex displacement and peak forces, whichever is largest, in %.
    pub fn time_step_percent(&self) -> f64 {
        headline(&self.time_step)
    }

    /// The same for the mesh.
    pub fn mesh_percent(&self) -> Option<f64> {
        self.mesh.as_ref().map(headline)
    }
}

/// A scenario's answer.
#[derive(Debug, Clone)]
pub struct Answer {
    /// What was moved.
    pub case: Case,
    /// How.
    pub plan: Plan,
    /// Largest stable step of the integrator, in s.
    pub step_limit: f64,
    /// The paper's index and its parts.
    pub index: DamageIndex,
    /// Extremes, and traces and frames if they were asked for.
    pub recording: Recording,
    /// How far the results may be off.
    pub errors: Errors,
    /// What limits them.
    pub flags: Vec<Flag>,
    /// What the run cost.
    pub cost: Cost,
    /// Springs computed in the run.
    pub spring_evaluations: usize,
    /// Time the run took, the mesh and the second run left out.
    pub solve_time: Duration,
    /// Time that everything took.
    pub total_time: Duration,
}

/// Answers `scenario`, which must have been checked, under the eyes of `watch`.
///
/// # Errors
/// Refuses a step above the stability limit, motion that leaves the finite numbers, and what the
/// watch stops.
pub fn solve(scenario: &Scenario, keep: Keep, watch: Watch) -> Result<Answer, Refusal> {
    let begun = Instant::now();
    let case = Case::new(scenario);
    let plan = case.plan(scenario)?;
    let step_limit = case.step_limit(plan.integrator);

    let started = Instant::now();
    let Solution { recording, cost } = case.run(&plan, keep, watch)?;
    let solve_time = started.elapsed();

    let time_step = step_error(
        &case,
        &plan,
        step_limit,
        &values(&recording.extremes),
        watch,
    )?;
    let errors = Errors {
        time_step,
        mesh: None,
        energy_balance: 100.0 * recording.extremes.energy_residual,
    };
    let flags = flags::raise(
        &recording.extremes,
        errors.time_step_percent(),
        case.window,
        case.system.load().pulse.duration(),
        case.load.shielded,
    );
    Ok(Answer {
        step_limit,
        index: DamageIndex::of(&recording.extremes),
        errors,
        flags,
        spring_evaluations: cost.evaluations * case.system.springs_per_evaluation(),
        cost,
        solve_time,
        total_time: begun.elapsed(),
        recording,
        plan,
        case,
    })
}

fn step_error(
    case: &Case,
    plan: &Plan,
    limit: f64,
    results: &PerQuantity,
    watch: Watch,
) -> Result<PerQuantity, Refusal> {
    let order = plan.integrator.order();
    let coarser = plan.step * RATIO <= stability::SAFETY * limit * (1.0 + 1e-9);
    let (step, share) = if coarser {
        (plan.step * RATIO, 1.0 / (RATIO.powi(order) - 1.0))
    } else {
        (plan.step / RATIO, 1.0 / (1.0 - RATIO.powi(-order)))
    };
    let second = case.run(&Plan { step, ..*plan }, Keep::default(), watch)?;
    let difference = difference_percent(&values(&second.recording.extremes), results);
    Ok(difference.map(|d| SAFETY * share * d))
}
