//! The results of a blow, or their errors, and what is computed over all of them.

use crate::run::quantity::{Family, Leads, Quantity};
use crate::run::readings::PerQuantity;

/// Values in the unit of each result, or errors in % of it; `None` of what the scene has not.
pub type Results = PerQuantity<Option<f64>>;

impl Results {
    /// The results that there are.
    pub fn present(&self) -> impl Iterator<Item = (Quantity, f64)> {
        self.iter().filter_map(|(quantity, value)| Some((quantity, (*value)?)))
    }

    /// The results that the one stated error covers in this scene, which is known by its results.
    pub fn leading(&self) -> impl Iterator<Item = (Quantity, f64)> {
        let projectile = self[Quantity::Contact].is_some();
        self.watched().filter(move |(of, _)| match of.row().leads {
            Leads::Always => true,
            Leads::WithoutProjectile => !projectile,
            Leads::Watched | Leads::Never => false,
        })
    }

    /// The results that lead in some scene, and those whose own errors are watched.
    pub(crate) fn watched(&self) -> impl Iterator<Item = (Quantity, f64)> {
        self.present().filter(|(quantity, _)| quantity.row().leads != Leads::Never)
    }

    /// The leading result with the largest error, for `self` as errors; NaN counts as the largest.
    pub fn worst(&self) -> Option<(Quantity, f64)> {
        largest(self.leading())
    }

    /// The largest error of a leading result, for `self` as errors in %; 0 without any.
    pub fn headline(&self) -> f64 {
        self.worst().map_or(0.0, |(_, error)| error)
    }

    /// |self - b| in % of b, of what both have with a stated error; 0 where both are rounding.
    #[must_use]
    pub fn difference_percent(&self, b: &Self) -> Self {
        self.apart_percent(b, b)
    }

    /// As [`Self::difference_percent`], but in % of `whole`.
    #[must_use]
    pub(crate) fn apart_percent(&self, b: &Self, whole: &Self) -> Self {
        self.map(|quantity, a| {
            let (a, b, whole) = ((*a)?, b[quantity]?, whole[quantity]?);
            let row = quantity.row();
            let difference = (a - b).abs();
            let nothing = difference == 0.0 || whole == 0.0 && difference < row.rounding;
            let percent = if nothing { 0.0 } else { 100.0 * difference / whole.abs() };
            (row.family != Family::Unstated).then_some(percent)
        })
    }

    /// Raises errors of `results`, in %, to what rounding alone may do.
    #[must_use]
    pub(crate) fn no_finer_than_rounding(self, results: &Self) -> Self {
        self.map(|quantity, error| {
            let value = results[quantity].filter(|value| *value != 0.0);
            let least = value.map_or(0.0, |value| 100.0 * quantity.row().rounding / value.abs());
            // Unlike the maximum of the two, this keeps what is no number.
            error.map(|error| if error < least { least } else { error })
        })
    }

    /// The largest error among watched `results` that are more than rounding, with its result.
    /// Where tissues are read no node's force counts: no injury is read from it.
    pub(crate) fn worst_listed(&self, results: &Results) -> Option<(Quantity, f64)> {
        let tissues = results[Quantity::EquatorStretch].is_some();
        let counts = |(of, _): &(Quantity, f64)| {
            let aside = tissues && of.row().leads == Leads::WithoutProjectile;
            !aside && !results[*of].is_some_and(|v| of.is_rounding(v))
        };
        largest(self.watched().filter(counts))
    }

    /// Raises errors of `family` to `share` of the largest of that family; NaN stays NaN.
    #[must_use]
    pub(crate) fn raised(self, family: Family, share: f64) -> Self {
        let member = |quantity: Quantity| quantity.row().family == family;
        let members = self.present().filter(|(quantity, _)| member(*quantity));
        let least = share * members.map(|(_, error)| error).fold(0.0, f64::max);
        self.map(|of, error| error.map(|e| if member(of) && e < least { least } else { e }))
    }
}

/// The largest error with its result; NaN counts as the largest.
fn largest(errors: impl Iterator<Item = (Quantity, f64)>) -> Option<(Quantity, f64)> {
    let keeps = |worst: f64, next: f64| next <= worst || worst.is_nan();
    errors.reduce(|worst, next| if keeps(worst.1, next.1) { worst } else { next })
}

/// What a result tends to as the mesh gets finer.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Limit {
    /// In the unit of the result.
    pub value: f64,
    /// How far it may be off, in the same unit.
    pub error: f64,
}

/// The limits that are known.
pub type Limits = PerQuantity<Option<Limit>>;

#[cfg(test)]
mod tests {
    use super::*;
    use Quantity::{Apex, Contact, Damage, ForceRight, ForceTop, GlobeRupture, Pressure};

    fn with(known: &[(Quantity, f64)]) -> Results {
        Results::from_fn(|q| known.iter().find(|(of, _)| *of == q).map(|(_, v)| *v))
    }

    #[test]
    fn node_forces_lead_unless_a_projectile_hits_even_where_its_error_is_zero() {
        let mut errors = with(&[(Damage, 1.0), (Apex, 2.0), (ForceTop, 5.0)]);
        assert_eq!(errors.worst(), Some((ForceTop, 5.0)));
        errors[Contact] = Some(0.0);
        assert_eq!(errors.worst(), Some((Apex, 2.0)));
        errors[Pressure] = Some(3.0);
        assert_eq!(errors.headline(), 3.0);
        errors[Damage] = Some(f64::NAN);
        assert!(errors.headline().is_nan());
    }

    #[test]
    fn differences_are_of_what_both_have_and_not_of_risks() {
        let a = with(&[(Damage, 11.0), (Pressure, 1.0), (GlobeRupture, 4.0)]);
        let b = with(&[(Damage, 10.0), (Contact, 1.0), (GlobeRupture, 8.0)]);
        let difference = a.difference_percent(&b);
        let found: Vec<(Quantity, f64)> = difference.present().collect();
        assert_eq!(found, [(Damage, 10.0)]);
        let rest = with(&[(ForceTop, 1e-10), (Damage, 0.0)]);
        let nothing = with(&[(ForceTop, 0.0), (Damage, 0.0)]);
        assert_eq!(rest.difference_percent(&nothing), nothing);
    }

    #[test]
    fn a_family_is_raised_to_a_share_of_its_worst_and_others_stay() {
        let errors = with(&[(Damage, 0.1), (ForceTop, 0.1), (ForceRight, 10.0)]);
        let raised = errors.raised(Family::ShellForces, 0.03);
        assert_eq!(raised, with(&[(Damage, 0.1), (ForceTop, 0.3), (ForceRight, 10.0)]));
    }
}
