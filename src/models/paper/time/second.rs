//! The second run that tells the step error of a run; the idea is in [`crate::run::rules`].

use crate::models::paper::{case::PaperCase, rules::RULES};
use crate::models::pulse::Pulse;
use crate::run::{model::EyeModel, plan::Plan, rules::LONGEST_SHARE};

/// The smallest ratio, over all segments, of the steps of `more` to those of `fewer`.
fn least_ratio(more: &Plan, fewer: &Plan, pulse: &Pulse) -> f64 {
    pulse
        .segments(more.window)
        .iter()
        .map(|s| more.steps_in(s) as f64 / fewer.steps_in(s) as f64)
        .fold(f64::INFINITY, f64::min)
}

/// The run whose difference from that of `plan` tells the step error, and the factor from the
/// difference to the error.
pub(crate) fn plan(case: &PaperCase, plan: &Plan) -> (Plan, f64) {
    let limit = case.step_limit(plan.integrator);
    let order = case.order(plan.integrator);
    let (ratio, safety) = (RULES.estimate.ratio, RULES.estimate.safety);
    let pulse = &case.system.load().pulse;
    let coarser = Plan { step: plan.step * ratio, ..*plan };
    let finer = Plan {
        multiple: plan.multiple * ratio,
        local_tolerance: plan.local_tolerance * 0.1,
        ..*plan
    };
    // A coarser run is cheaper, but tells nothing if the load or short segments take the same
    // steps.
    let telling = |steps: usize, fewer: usize| steps as f64 > 0.5 * (1.0 + ratio) * fewer as f64;
    let coarser_tells = coarser.step <= LONGEST_SHARE * limit * (1.0 + 1e-9)
        && !pulse.segments(plan.window).iter().any(|s| coarser.at_least_steps(s))
        && telling(plan.steps_under_load(pulse), coarser.steps_under_load(pulse))
        && telling(plan.steps(pulse), coarser.steps(pulse));
    if plan.integrator.method().adaptive() {
        // Its error follows the tolerance, unless the longest step binds; a finer run shows both.
        (finer, safety)
    } else if coarser_tells {
        (coarser, safety / (ratio.powi(order) - 1.0))
    } else {
        let ratio = least_ratio(&finer, plan, pulse);
        (finer, safety / (1.0 - ratio.powi(-order)))
    }
}
