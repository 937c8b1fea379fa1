//! How two runs tell the step error: the second run, and from their difference to what is stated.
//!
//! The idea and all its numbers are in [`crate::run::rules`].

use crate::answer::results::Results;
use crate::models::compiled::Compiled;
use crate::models::paper::case::Case;
use crate::models::paper::case::Moved;
use crate::models::paper::forces::load::Pulse;
use crate::models::paper::time::march::Plan;
use crate::run::rules::{Estimate, LONGEST_SHARE};

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
pub(crate) fn second_plan(case: &Compiled, plan: &Plan) -> (Plan, f64) {
    match case {
        Compiled::Section(case) => of_section(case, plan),
        Compiled::Revolution(_) => {
            let Estimate { ratio, safety, .. } = case.rules().estimate;
            let finer = Plan {
                multiple: plan.multiple * ratio,
                ..*plan
            };
            let share = 1.0 - ratio.powi(-case.order(plan.integrator));
            (finer, safety / share)
        }
    }
}

fn of_section(case: &Case, plan: &Plan) -> (Plan, f64) {
    let limit = case.step_limit(plan.integrator);
    let order = case.order(plan.integrator);
    let (ratio, safety) = (case.rules().estimate.ratio, case.rules().estimate.safety);
    let pulse = &case.system.load().pulse;
    let coarser = Plan {
        step: plan.step * ratio,
        ..*plan
    };
    let finer = Plan {
        multiple: plan.multiple * ratio,
        local_tolerance: plan.local_tolerance * 0.1,
        ..*plan
    };
    // A coarser run is cheaper, but tells nothing if the load or short segments take the same steps.
    let telling = |steps: usize, fewer: usize| steps as f64 > 0.5 * (1.0 + ratio) * fewer as f64;
    let coarser_tells = coarser.step <= LONGEST_SHARE * limit * (1.0 + 1e-9)
        && !pulse
            .segments(plan.window)
            .iter()
            .any(|s| coarser.at_least_steps(s))
        && telling(
            plan.steps_under_load(pulse),
            coarser.steps_under_load(pulse),
        )
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

/// What is stated of `results` of a run whose second run differs by `difference` %, of which `factor`
/// makes the estimate: no less than the floor and than rounding, and raised where it is small by chance.
pub(crate) fn stated(
    case: &Compiled,
    results: &Results,
    (difference, factor): (&Results, f64),
) -> Results {
    let estimate = &case.rules().estimate;
    let floor = estimate.floor_percent;
    let (family, share) = estimate.family;
    difference
        .map(|_, difference| difference.map(|d| factor * d + floor))
        .raised(family, share)
        .no_finer_than_rounding(results)
}
