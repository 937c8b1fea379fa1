//! The risk of an injury by the curve that is believed first: a result like any other, and the
//! range of an input over which what is believed may reach a value.
//!
//! Which curve that is says [`crate::injury::verdicts`] by the rule of the guide. Where the run
//! left the model's validity it is another than where it did not, so the result may jump there.

use crate::injury::{
    Computed, FlyingObject, Injury, Measures, Risk, Validity, Verdict, assess, verdict,
};
use crate::scenario::{Scenario, Species};

/// The inputs of a risk that the scenario gives; the rest are readings of the run.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct RiskInputs {
    /// The object that hits, if there is one.
    pub blow: Option<FlyingObject>,
    /// Whether the eye is a pig's.
    pub pig: bool,
    /// Whether the blow comes at a larger angle than the model trusts.
    pub aslant: bool,
}

impl RiskInputs {
    /// The inputs that `scenario` gives.
    pub fn of(scenario: &Scenario) -> Self {
        let model = &scenario.model;
        let angle = scenario.impact.angle_deg().abs();
        Self {
            blow: FlyingObject::of(scenario),
            pig: model.species() == Species::Pig,
            aslant: model
                .trusted_angle_deg()
                .is_some_and(|trusted| angle > trusted),
        }
    }

    /// The measures of the curves after a run with this peak pressure and stress, in Pa.
    pub(crate) fn measures(&self, pressure: Option<f64>, stress: Option<f64>) -> Measures {
        let sure = |value| Computed { value, error: 0.0 };
        Measures {
            blow: self.blow,
            pressure: pressure.map(sure),
            stress: stress.map(sure),
        }
    }

    /// The risk of `injury` by the curve that is believed first; `spoiled` says whether the run
    /// left the model's validity.
    pub(crate) fn believed(
        &self,
        injury: Injury,
        measures: &Measures,
        spoiled: bool,
    ) -> Option<Risk> {
        let validity = Validity {
            spoiled: (spoiled || self.aslant).then(String::new),
            aslant: self.aslant,
            pig: self.pig,
            ..Validity::default()
        };
        let verdict = verdict(injury, &assess(measures), &validity);
        verdict.believed().next().copied()
    }
}

/// An end of the range of a crossing is looked for up to this ratio away from it.
const FARTHEST: f64 = 100.0;
/// Halvings of the logarithm of that ratio in the search for an end.
const HALVINGS: usize = 40;

/// From which to which value of an input what is believed may have the risk `target`, 0 to 1; an
/// end is none where there is no such value within a ratio of [`FARTHEST`] to `at`, near which
/// each believed measure goes with the power of the input that `power` says.
pub(crate) fn reaches(
    verdict: &Verdict,
    at: f64,
    target: f64,
    power: impl Fn(&Risk) -> f64,
) -> (Option<f64>, Option<f64>) {
    let range = |ratio: f64| verdict.range_with(|risk| risk.value * libm::pow(ratio, power(risk)));
    // Least and greatest ratio at which an end of the range, which rises with the measures, has
    // the target.
    let ratio = |end: fn((f64, f64)) -> f64| {
        let above = |log: f64| end(range(libm::exp(log))) >= target;
        let (mut low, mut high) = (-libm::log(FARTHEST), libm::log(FARTHEST));
        let rises = above(high);
        if above(low) == rises {
            return None;
        }
        for _ in 0..HALVINGS {
            let middle = 0.5 * (low + high);
            if above(middle) == rises {
                high = middle;
            } else {
                low = middle;
            }
        }
        Some(at * libm::exp(0.5 * (low + high)))
    };
    let ends = [ratio(|range| range.1), ratio(|range| range.0)];
    // What falls as the input grows is reached from above.
    let falls = verdict.believed().next().is_some_and(|r| power(r) < 0.0);
    match ends {
        [first, last] if falls != (at < 0.0) => (last, first),
        [first, last] => (first, last),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const BB: FlyingObject = FlyingObject {
        mass: 0.345e-3,
        diameter: 4.5e-3,
        speed: 56.0,
    };

    #[test]
    fn the_curve_that_is_believed_first_depends_on_what_the_run_is_worth() {
        let bb = RiskInputs {
            blow: Some(BB),
            ..RiskInputs::default()
        };
        let measures = bb.measures(Some(0.6e6), Some(17e6));
        let of = |risk_inputs: &RiskInputs, spoiled| {
            let risk = risk_inputs.believed(Injury::GlobeRupture, &measures, spoiled);
            risk.unwrap().curve.measure.key()
        };
        assert_eq!(of(&bb, false), "scleral_stress");
        assert_eq!(of(&bb, true), "normalized_energy");
        let aslant = RiskInputs { aslant: true, ..bb };
        assert_eq!(of(&aslant, false), "normalized_energy");
        let none = RiskInputs::default();
        let measures = none.measures(Some(0.6e6), Some(17e6));
        let lens = none.believed(Injury::LensDislocation, &measures, false);
        assert!(
            lens.is_none(),
            "no curve of it runs against what the eye felt"
        );
    }

    #[test]
    fn the_range_of_an_input_is_where_either_end_of_the_verdict_has_the_value() {
        let measures = Measures {
            stress: Some(Computed {
                value: 17.21e6,
                error: 0.05,
            }),
            ..Measures::default()
        };
        let validity = Validity::default();
        let verdict = verdict(Injury::GlobeRupture, &assess(&measures), &validity);
        // Half the people at the point of 50 %, which is 15 % and the error off: with the square
        // of the input.
        let (from, to) = reaches(&verdict, 60.0, 0.5, |_| 2.0);
        let (from, to) = (from.unwrap(), to.unwrap());
        assert!(
            (from / 60.0 - libm::sqrt(0.85 / 1.05)).abs() < 1e-3,
            "{from}"
        );
        assert!((to / 60.0 - libm::sqrt(1.15 / 0.95)).abs() < 1e-3, "{to}");
        let falling = reaches(&verdict, 60.0, 0.5, |_| -2.0);
        assert!(falling.0.unwrap() < 60.0 && falling.1.unwrap() > 60.0);
        let below = reaches(&verdict, -60.0, 0.5, |_| 2.0);
        assert_eq!((below.0, below.1), (Some(-to), Some(-from)));
        // The lower end never gets to 99.9 %: beyond its data the curve only rises.
        let (from, to) = reaches(&verdict, 60.0, 0.999, |_| 2.0);
        assert!(from.is_some() && to.is_none());
    }
}
