//! How an error is said, on every page and screen alike: that of the damage index, and the largest
//! of a leading result with the name of that result.

use crate::answer::results::Results;
use crate::report::format::percent;
use crate::run::quantity::Quantity;

/// The error of the damage index, in words.
pub fn of_damage(errors: &Results) -> String {
    errors[Quantity::Damage].map_or_else(|| "unknown".to_owned(), percent)
}

/// The largest error of a leading result, with its name, in words.
pub fn worst(errors: &Results) -> String {
    errors.worst().map_or_else(
        || "unknown".to_owned(),
        |(of, error)| format!("{} ({})", percent(error), of.label()),
    )
}

/// The largest error of a result that does not lead, with its name; none if a leading one is
/// larger.
pub fn largest_other(errors: &Results) -> Option<String> {
    let larger = |a: &(Quantity, f64), b: &(Quantity, f64)| a.1.total_cmp(&b.1);
    let (of, error) = errors.present().max_by(larger)?;
    let lead = errors.worst()?.1;
    (error > lead).then(|| format!("{} ({})", percent(error), of.label()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_worst_of_the_leading_results_is_named() {
        let mut errors = Results::from_fn(|_| None);
        assert_eq!(worst(&errors), "unknown");
        errors[Quantity::Damage] = Some(0.5);
        errors[Quantity::ForceTop] = Some(2.0);
        assert_eq!(worst(&errors), "2.0 % (peak force, top)");
        errors[Quantity::Contact] = Some(1.0);
        assert_eq!(worst(&errors), "1.0 % (contact force)");
        assert_eq!(largest_other(&errors).unwrap(), "2.0 % (peak force, top)");
        errors[Quantity::Contact] = Some(3.0);
        assert_eq!(largest_other(&errors), None);
        assert_eq!(of_damage(&errors), "0.50 %");
    }
}
