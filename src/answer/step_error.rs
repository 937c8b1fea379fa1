//! From the difference of two runs to the step error that is stated.
//!
//! The idea is in [`crate::run::rules`], the second run and all numbers with each model.

use crate::answer::{compiled::Compiled, results::Results};

/// The step error of each of `results`, in %: `factor` times the `difference` of the second run,
/// in %, but at least the model's floor and rounding, and raised where it is small by chance.
pub(crate) fn stated(
    case: &Compiled,
    results: &Results,
    (difference, factor): (&Results, f64),
) -> Results {
    let estimate = &case.rules().estimate;
    let (family, share) = estimate.family;
    difference
        .map(|_, difference| difference.map(|d| factor * d + estimate.floor_percent))
        .raised(family, share)
        .no_finer_than_rounding(results)
}
