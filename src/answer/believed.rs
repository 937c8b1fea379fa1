//! The risk of an injury by the curve that is believed first: a result like any other, and the range of an
//! input over which what is believed may reach a value.
//!
//! Which curve that is says [`crate::injury::verdicts`] by the rule of the guide. Where the run left the
//! model's validity it is another than where it did not, so the result may jump there.

use crate::injury::{Blow, Computed, Injury, Measures, Risk, Validity, Verdict, assess, verdict};
use crate::scenario::{Impact, Model, Scenario, Species, TRUSTED_ANGLE_DEG};

/// What risks rest on beside what a run left.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Scene {
    /// The object that hits, if there is one.
    pub blow: Option<Blow>,
    /// Whether the eye is a pig's.
    pub pig: bool,
    /// Whether the eye of revolution is hit beyond the trusted angle.
    pub aslant: bool,
}

impl Scene {
    /// That of a scenario.
    pub fn of(scenario: &Scenario) -> Self {
        let Model::Physiological(model) = &scenario.model else {
            return Self::default();
        };
        let angle = match &scenario.impact {
            Impact::ForcePulse(pulse) => pulse.angle_deg,
            Impact::Projectile(object) => object.angle_deg,
        };
        Self {
            blow: Blow::of(scenario),
            pig: model.species == Species::Pig,
            aslant: angle.abs() > TRUSTED_ANGLE_DEG,
        }
    }

    /// What the curves run against after a run that left this peak pressure and stress, in Pa.
    pub(crate) fn measures(&self, pressure: Option<f64>, stress: Option<f64>) -> Measures {
        let sure = |value| Computed { value, error: 0.0 };
        Measures {
            blow: self.blow,
            pressure: pressure.map(sure),
            stress: stress.map(sure),
        }
    }

    /// The risk of `injury` by the curve that is believed first; `spoiled` says whether the run left the
    /// model's validity.
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

/// How far from a crossing an end of its range is looked for, as a ratio.
const FARTHEST: f64 = 100.0;
/// Halvings of that, in the logarithm.
const HALVINGS: usize = 40;

/// From which to which value of an input what is believed may have the risk `target`, 0 to 1; an end is none where
/// there is no such value within a ratio of [`FARTHEST`] to `at`, near which each believed measure goes with the power
/// of the input that `power` says.
pub(crate) fn reaches(
    verdict: &Verdict,
    at: f64,
    target: f64,
    power: impl Fn(&Risk) -> f64,
) -> (Option<f64>, Option<f64>) {
    let range = |ratio: f64| verdict.range_with(|risk| risk.value * libm::pow(ratio, power(risk)));
    // Least and greatest ratio at which an end of the range, which rises with the measures, has the target.
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

    const BB: Blow = Blow {
        mass: 0.345e-3,
        diameter: 4.5e-3,
        speed: 56.0,
    };

    #[test]
    fn the_curve_that_is_believed_first_depends_on_what_the_run_is_worth() {
        let bb = Scene {
            blow: Some(BB),
            ..Scene::default()
        };
        let measures = bb.measures(Some(0.6e6), Some(17e6));
        let of = |scene: &Scene, spoiled| {
            let risk = scene.believed(Injury::GlobeRupture, &measures, spoiled);
            risk.unwrap().curve.measure.key()
        };
        assert_eq!(of(&bb, false), "scleral_stress");
        assert_eq!(of(&bb, true), "normalized_energy");
        let aslant = Scene { aslant: true, ..bb };
        assert_eq!(of(&aslant, false), "normalized_energy");
        let none = Scene::default();
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
        // Half the people at the point of 50 %, which is 15 % and the error off: with the square of the input.
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
