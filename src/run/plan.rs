//! How a run is stepped, and what it cost.

use crate::run::{model::EyeModel, refusal::Refusal, rules::Automatic};
use crate::scenario::{Integrator, Scenario, problem::plain};

/// The integrator and the steps of a run.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Plan {
    /// The method.
    pub integrator: Integrator,
    /// Longest step, in s.
    pub step: f64,
    /// Simulated time, in s.
    pub window: f64,
    /// Multiplies the number of steps of every segment, 1 or more.
    pub multiple: f64,
    /// Local error allowed a step in the energy norm, for integrators that choose their steps.
    pub local_tolerance: f64,
}

/// The local tolerance unless another is asked for.
pub const LOCAL_TOLERANCE: f64 = 1e-5;

/// What a run cost.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Cost {
    /// Steps taken.
    pub steps: usize,
    /// Force evaluations.
    pub evaluations: usize,
}

/// More than this takes longer than half an hour.
const MAX_SPRING_EVALUATIONS: f64 = 1e12;

/// The plan of a run of `eye` by what `scenario` asks, or `automatic` where it leaves that open.
pub(crate) fn plan_by<E: EyeModel + ?Sized>(
    eye: &E,
    scenario: &Scenario,
    automatic: &Automatic,
) -> Result<Plan, Refusal> {
    let rules = eye.rules();
    let integrator = scenario.numerics.integrator.unwrap_or(automatic.integrator);
    if !rules.integrators.contains(&integrator) {
        return Err(rules.unfit(integrator));
    }
    let (window, limit) = (eye.window(), eye.step_limit(integrator));
    let step = match scenario.numerics.step_us {
        Some(step_us) if step_us * 1e-6 > limit => {
            return Err(Refusal::StepAboveLimit {
                step_us,
                integrator: integrator.name(),
                limit_us: limit * 1e6,
            });
        }
        Some(step_us) => step_us * 1e-6,
        None => automatic.share * limit,
    };
    let springs = eye.elements_per_evaluation() as f64 * rules.springs_an_element;
    let evaluations = integrator.evaluations() as f64;
    let work = springs * evaluations * (window / step + 1.0);
    if work > MAX_SPRING_EVALUATIONS {
        let (steps, share) = (window / step, work / MAX_SPRING_EVALUATIONS);
        return Err(match scenario.numerics.step_us {
            Some(step_us) => Refusal::StepTooShort { step_us, steps, least_us: step_us * share },
            None => Refusal::WindowTooLong {
                asked: match scenario.window_ms {
                    Some(window_ms) => plain(window_ms),
                    None => format!("Auto, here {} at most,", plain((window * 1e9).round() / 1e6)),
                },
                steps,
                integrator: integrator.name(),
                step_us: step * 1e6,
                longest_ms: window * 1e3 / share,
            },
        });
    }
    Ok(Plan { integrator, step, window, multiple: 1.0, local_tolerance: LOCAL_TOLERANCE })
}
