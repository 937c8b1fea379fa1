//! Why a scenario cannot be run, or gave no result.

use crate::scenario::problem::{ScenarioError, plain};

/// Why a scenario cannot be run.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum Refusal {
    /// What was made of the scenario, as on a finer mesh, is not allowed.
    #[error(transparent)]
    Scenario(#[from] ScenarioError),
    /// The asked step could blow up.
    #[error(
        "numerics.step_us: {} is above the stability limit of {integrator} on this mesh: \
         allowed up to {}", plain(*step_us), limit(*limit_us, f64::floor)
    )]
    StepAboveLimit {
        /// What was asked, in us.
        step_us: f64,
        /// Name of the integrator.
        integrator: &'static str,
        /// The largest step allowed, in us.
        limit_us: f64,
    },
    /// The asked integrator cannot solve such a scene.
    #[error(
        "numerics.integrator: {integrator} does not solve the {model} model: \
         allowed Auto, {allowed}"
    )]
    IntegratorUnfit {
        /// What was asked.
        integrator: &'static str,
        /// What the model is called.
        model: &'static str,
        /// Those that can, with a comma between two.
        allowed: String,
    },
    /// The motion left the finite numbers.
    #[error("the motion is no longer finite at {:.6} ms (step {step}): the step is unstable", time * 1e3)]
    NotFinite {
        /// Simulated time, in s.
        time: f64,
        /// Number of the step.
        step: usize,
    },
    /// With the step that was asked the run would take hours.
    #[error(
        "numerics.step_us: {} would take {steps:.3e} steps, too many for half an hour: allowed from \
         {} for this window and mesh", plain(*step_us), limit(*least_us, f64::ceil)
    )]
    StepTooShort {
        /// What was asked, in us.
        step_us: f64,
        /// How many steps.
        steps: f64,
        /// The smallest step allowed, in us.
        least_us: f64,
    },
    /// Even by the longest safe step the run would take hours.
    #[error(
        "window_ms: {asked} would take {steps:.3e} steps, too many for half an hour: stiff springs and small \
         masses keep {integrator} on this mesh to steps of {} us: allowed up to {}, \
         more on a coarser mesh or with softer tissue", limit(*step_us, f64::floor), limit(*longest_ms, f64::floor)
    )]
    WindowTooLong {
        /// What was asked, in ms or in words.
        asked: String,
        /// How many steps.
        steps: f64,
        /// Name of the integrator.
        integrator: &'static str,
        /// Its longest safe step, in us.
        step_us: f64,
        /// The longest window allowed, in ms.
        longest_ms: f64,
    },
    /// The object went through the front of the eye, for what it is.
    #[error(transparent)]
    WentThrough(ScenarioError),
    /// Nothing that was tried is accurate enough.
    #[error("no result within {percent} %: {reason}")]
    ToleranceNotMet {
        /// What was asked, in %.
        percent: f64,
        /// Why not.
        reason: String,
    },
    /// Whoever watched wanted no more of it.
    #[error("cancelled")]
    Cancelled,
}

/// What came of work that nobody stopped.
pub fn unstopped<T>(outcome: Result<T, Refusal>) -> Option<Result<T, Refusal>> {
    (!matches!(outcome, Err(Refusal::Cancelled))).then_some(outcome)
}

impl Refusal {
    /// Whether another input would help.
    pub fn is_of_input(&self) -> bool {
        !matches!(self, Self::NotFinite { .. } | Self::ToleranceNotMet { .. } | Self::Cancelled)
    }
}

/// A limit with seven digits, rounded to the side where it may be typed.
fn limit(exact: f64, round: fn(f64) -> f64) -> String {
    let places = (6.0 - libm::log10(exact).floor()).max(0.0);
    let digit = 10_f64.powi(places as i32);
    format!("{:.*}", places as usize, round(exact * digit) / digit)
}
