//! How two runs tell the step error: the second run, the factor, and what no result is better than.
//!
//! The second run's step differs by a factor r. For an integrator of order p the difference d between
//! the two is about (r^p - 1) times the error of the finer run, and (1 - r^-p) times that of the
//! coarser. Peaks do not always follow the order, so the estimate is multiplied by a safety factor.

use super::case::{AUTO_SHARE, Case, LONE_SHARE};
use super::quantity::Family;
use super::results::Results;
use crate::dynamics::{Plan, Pulse};

/// For scenes with a projectile, a fluid or dashpots, for which first order is assumed where order
/// two is mostly seen. The worst stated error of a scene is then mostly several times the true one.
const COUPLED_SAFETY: f64 = 3.0;
/// No result of such a scene is claimed to be better than this share of the worst.
const COUPLED_KINSHIP: f64 = 0.2;
/// Ratio of the two steps: the longest that a run takes against the automatic one.
const RATIO: f64 = LONE_SHARE / AUTO_SHARE;
/// The same for scenes with a projectile, a fluid or dashpots, whose steps are far below the limit.
const COUPLED_RATIO: f64 = 2.0;
/// Multiplies the estimate, because peaks do not always follow the order. With 5, and [`KINSHIP`], the
/// stated errors hold in more than 95 % of random scenes for each result and are 5 to 9 times the
/// true ones in the median; see `coverage`.
const SAFETY: f64 = 5.5;
/// Two runs may give the same peak by chance though neither is right. The forces at the three nodes
/// of the shell come from the same waves, so none is claimed to be better than this share of the
/// worst of them. (The force at the centre is far smoother, and really is better.)
const KINSHIP: f64 = 0.03;

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
pub(super) fn second_plan(case: &Case, plan: &Plan) -> (Plan, f64) {
    let limit = case.step_limit(plan.integrator);
    let order = case.order(plan.integrator);
    let (ratio, safety) = if case.system.coupled().is_some() {
        (COUPLED_RATIO, COUPLED_SAFETY)
    } else {
        (RATIO, SAFETY)
    };
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
    let coarser_tells = coarser.step <= LONE_SHARE * limit * (1.0 + 1e-9)
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
        (finer, SAFETY)
    } else if coarser_tells {
        (coarser, safety / (ratio.powi(order) - 1.0))
    } else {
        let ratio = least_ratio(&finer, plan, pulse);
        (finer, safety / (1.0 - ratio.powi(-order)))
    }
}

/// Raises errors that are small by chance: where a projectile, a fluid or dashpots act, all results but
/// the node forces come from the same motion; else the forces on the shell from the same waves.
pub(super) fn hanging_together(errors: Results, coupled: bool) -> Results {
    if coupled {
        errors.raised(Family::Motion, COUPLED_KINSHIP)
    } else {
        errors.raised(Family::ShellForces, KINSHIP)
    }
}
