//! What the published curves say of one blow.
//!
//! Normalized energy is the kinetic energy over the object's projected area, m v^2 / 2 / (pi d^2 /
//! 4): it needs no simulation, and means something only while the object can enter the orbit. Peak
//! pressure and stress come from the simulation, each with its own error, which widens the range
//! of the risk. Where measures disagree, the reader sees all, and [`crate::injury::verdict`] says
//! which to believe.

use crate::injury::curve::{CurveForm, Injury, InjuryCurve, Measure, Range, Standing};
use crate::injury::published::CURVES;
use crate::scenario::{Impact, Scenario};
use std::f64::consts::FRAC_PI_4;

/// Height of the orbit's opening, in m (anatomy texts: 35 mm, and 40 mm wide).
const ORBIT: f64 = 0.035;
/// Diameter of the eye across, in m.
const EYE: f64 = 0.0242;
/// Normalized energy of a BB at 122 m/s, the fastest object of the pooled tests, in J/m^2.
const MAX_TESTED_ENERGY: f64 = 161e3;

/// Below this share of its point of 50 % a curve of an assumed slope shows that slope only: its
/// risk of nothing is 1 %.
const LITTLE: f64 = 0.1;

/// The object that flies at the eye: what risks by energy are computed from.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FlyingObject {
    /// Mass, in kg.
    pub mass: f64,
    /// Diameter, in m.
    pub diameter: f64,
    /// Speed at first contact, in m/s.
    pub speed: f64,
}

impl FlyingObject {
    /// The object of a scenario; none if it has only a force.
    pub fn of(scenario: &Scenario) -> Option<Self> {
        match &scenario.impact {
            Impact::ForcePulse(_) => None,
            Impact::Projectile(object) => Some(Self {
                mass: object.mass_kg(),
                diameter: object.diameter_m(),
                speed: object.speed_m_s,
            }),
        }
    }

    /// Kinetic energy, in J.
    pub fn kinetic_energy(&self) -> f64 {
        0.5 * self.mass * self.speed * self.speed
    }

    /// Kinetic energy in J/m^2, over the object's own projected area as the curves define it.
    pub fn normalized_energy(&self) -> f64 {
        self.kinetic_energy() / (FRAC_PI_4 * self.diameter * self.diameter)
    }

    /// What speaks against normalized energy for this object.
    pub(super) fn caution(&self) -> Option<Caution> {
        if self.diameter > ORBIT {
            Some(Caution::LargerThanOrbit)
        } else if self.diameter > EYE {
            Some(Caution::LargerThanEye)
        } else {
            None
        }
    }
}

/// Why a measure should be doubted.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Caution {
    /// The object's area is not what meets the eye: the measure is invalid.
    LargerThanOrbit,
    /// The object is larger than the eye: beyond the objects that the curves were made with.
    LargerThanEye,
}

impl Caution {
    /// What speaks against risks by energy of the object of a scenario; none without an object.
    pub fn of(scenario: &Scenario) -> Option<Self> {
        FlyingObject::of(scenario)?.caution()
    }

    /// Its name in JSON.
    pub fn key(self) -> &'static str {
        match self {
            Self::LargerThanOrbit => "invalid_larger_than_orbit",
            Self::LargerThanEye => "larger_than_eye",
        }
    }

    /// The doubt in words.
    pub fn text(self) -> &'static str {
        match self {
            Self::LargerThanOrbit => {
                "the object is larger than the orbit's opening: normalized energy is not valid"
            }
            Self::LargerThanEye => {
                "the object is larger than the eye, beyond the data of normalized energy"
            }
        }
    }
}

/// A result of a simulation that curves run against.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Computed {
    /// The value, in SI.
    pub value: f64,
    /// The share of it by which it may be off, by step and mesh as far as they are known.
    pub error: f64,
}

/// All that the curves can run against.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Measures {
    /// The object.
    pub blow: Option<FlyingObject>,
    /// Peak pressure in the globe, Pa.
    pub pressure: Option<Computed>,
    /// Peak stress of the sclera, Pa.
    pub stress: Option<Computed>,
}

impl Measures {
    /// The value of a measure; `None` where there is nothing to measure.
    pub fn get(&self, measure: Measure) -> Option<Computed> {
        let of_blow = |value: fn(&FlyingObject) -> f64| {
            let value = value(&self.blow?);
            Some(Computed { value, error: 0.0 })
        };
        match measure {
            Measure::NormalizedEnergy => of_blow(FlyingObject::normalized_energy),
            Measure::KineticEnergy => of_blow(FlyingObject::kinetic_energy),
            Measure::Pressure => self.pressure,
            Measure::Stress => self.stress,
        }
    }
}

/// What one curve says.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Risk {
    /// The curve, with its source.
    pub curve: &'static InjuryCurve,
    /// The measure's value, SI.
    pub value: f64,
    /// The share of it by which the value may be off.
    pub error: f64,
    /// Probability of the injury, 0 to 1.
    pub risk: f64,
    /// Least and greatest risk over the range of the curve and the error of the value, 0 to 1;
    /// beyond the data everything that a rising curve allows.
    pub band: (f64, f64),
    /// Whether the blow lies outside the curve's data.
    pub extrapolated: bool,
    /// Whether the measure itself is doubtful here.
    pub caution: Option<Caution>,
}

/// What the letters of [`Risk::marks`] mean.
pub const MARKS: &str =
    "s slope assumed  r reconstructed  u unverified  x extrapolated  ! invalid here";

impl Risk {
    /// A letter for everything that a reader must know before believing it, see [`MARKS`].
    pub fn marks(&self) -> String {
        let mut marks = match self.curve.standing {
            Standing::Published => "",
            Standing::SlopeAssumed => "s",
            Standing::Reconstructed => "r",
            Standing::Unverified => "us",
        }
        .to_owned();
        if self.extrapolated {
            marks.push('x');
        }
        if self.caution == Some(Caution::LargerThanOrbit) {
            marks.push('!');
        }
        marks
    }

    /// The band if the value were known within a `factor` only.
    pub fn band_within(&self, factor: f64) -> (f64, f64) {
        let at = |value| band(self.curve, value, self.error);
        (at(self.value / factor).0, at(self.value * factor).1)
    }
}

/// The first curve of an injury against a measure.
pub fn curve_of(injury: Injury, measure: Measure) -> Option<&'static InjuryCurve> {
    let of = |curve: &&InjuryCurve| (curve.injury, curve.measure) == (injury, measure);
    CURVES.iter().find(of)
}

/// The least and the greatest value of its measure that a curve has data of.
fn reach(curve: &InjuryCurve) -> (f64, f64) {
    let (first, last) = match curve.range {
        Range::Measure(first, last) => (first, last),
        Range::Speed(..) => (0.0, MAX_TESTED_ENERGY),
        Range::Unknown => (0.0, f64::INFINITY),
    };
    match curve.form {
        CurveForm::Logistic { half, .. } => (first.max(LITTLE * half), last),
        CurveForm::Normal { .. } => (first, last),
    }
}

/// Least and greatest risk at a value that may be off by a share of it.
fn band(curve: &InjuryCurve, value: f64, error: f64) -> (f64, f64) {
    let (first, last) = reach(curve);
    let least = curve.band(value * (1.0 - error)).0;
    // Beyond its data a curve tells only that the risk rises; and since nothing brings no risk and
    // the curve is convex at first, below them the chord from there bounds it.
    if value > last {
        (least.min(curve.band(last).0), 1.0)
    } else if value < first {
        (0.0, curve.band(first).1 * value / first)
    } else {
        (least, curve.band(value * (1.0 + error)).1)
    }
}

/// What every curve that applies says of the measures of a blow.
pub fn assess(measures: &Measures) -> Vec<Risk> {
    let one = |curve: &'static InjuryCurve| {
        let Computed { value, error } = measures.get(curve.measure)?;
        let caution = match curve.measure {
            Measure::Pressure | Measure::Stress => None,
            Measure::NormalizedEnergy | Measure::KineticEnergy => measures.blow?.caution(),
        };
        let untested = match curve.range {
            Range::Measure(..) => false,
            Range::Speed(low, high) => {
                !(low..=high).contains(&measures.blow?.speed)
                    || caution == Some(Caution::LargerThanEye)
            }
            Range::Unknown => true,
        };
        let (first, last) = reach(curve);
        let extrapolated = untested || !(first..=last).contains(&value);
        Some(Risk {
            curve,
            value,
            error,
            risk: curve.risk(value),
            band: band(curve, value, error),
            extrapolated,
            caution,
        })
    };
    CURVES.iter().filter_map(one).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    const BB: FlyingObject = FlyingObject {
        mass: 0.345e-3,
        diameter: 4.5e-3,
        speed: 56.0,
    };

    fn of(blow: Option<FlyingObject>, pressure: f64) -> Measures {
        Measures {
            blow,
            pressure: Some(Computed {
                value: pressure,
                error: 0.0,
            }),
            stress: None,
        }
    }

    #[test]
    fn beyond_the_data_an_error_that_reaches_back_among_them_widens_the_range() {
        let stressed = |error| {
            let stress = Some(Computed { value: 36e6, error });
            let risks = assess(&Measures {
                stress,
                ..Measures::default()
            });
            risks[0].band
        };
        let (sure, unsure) = (stressed(0.0), stressed(1.2));
        assert!(unsure.0 < 0.05 && sure.0 > 0.5, "{sure:?} {unsure:?}");
        assert_eq!((sure.1, unsure.1), (1.0, 1.0));
    }

    #[test]
    fn a_bb_has_its_known_normalized_energy() {
        assert!((BB.kinetic_energy() - 0.541).abs() < 1e-3);
        assert!((BB.normalized_energy() / 34.0e3 - 1.0).abs() < 1e-2);
    }

    #[test]
    fn without_an_object_only_pressure_speaks_and_without_either_nothing() {
        assert!(assess(&Measures::default()).is_empty());
        let risks = assess(&of(None, 1e6));
        assert!(!risks.is_empty());
        assert!(risks.iter().all(|r| r.curve.measure == Measure::Pressure));
    }

    #[test]
    fn beyond_its_data_a_curve_says_so() {
        let slow = FlyingObject { speed: 1.0, ..BB };
        let fast = FlyingObject { speed: 123.0, ..BB };
        let extrapolated = |blow| {
            assess(&of(Some(blow), 1e6))
                .into_iter()
                .filter(|r| r.curve.measure == Measure::NormalizedEnergy)
                .all(|r| r.extrapolated)
        };
        assert!(extrapolated(slow) && extrapolated(fast) && !extrapolated(BB));
        let burst = |p| {
            assess(&of(None, p))
                .into_iter()
                .find(|r| r.curve.injury == Injury::GlobeRupture)
                .unwrap()
        };
        assert!(burst(0.2e6).extrapolated && !burst(0.9e6).extrapolated);
        assert!(burst(2e6).extrapolated);
    }

    #[test]
    fn the_error_of_a_pressure_widens_the_range_of_its_risk() {
        let burst = |error| {
            let value = 0.9e6;
            let pressure = Some(Computed { value, error });
            let measures = Measures {
                pressure,
                ..Measures::default()
            };
            let mut risks = assess(&measures).into_iter();
            let risk = risks.find(|r| r.curve.injury == Injury::GlobeRupture);
            risk.unwrap()
        };
        let (sure, unsure) = (burst(0.0), burst(0.2));
        assert_eq!(sure.risk, unsure.risk);
        assert!(unsure.band.0 < sure.band.0 && sure.band.1 < unsure.band.1);
        // 0.72 and 1.08 MPa, with 0.127 MPa for the mean of twenty tests.
        assert!((unsure.band.0 - 0.122).abs() < 2e-3, "{:?}", unsure.band);
        assert!((unsure.band.1 - 0.831).abs() < 2e-3, "{:?}", unsure.band);
    }

    #[test]
    fn beyond_its_data_a_curve_only_rises() {
        let burst = |p| {
            let risks = assess(&of(None, p));
            risks
                .into_iter()
                .find(|r| r.curve.injury == Injury::Hyphema)
        };
        let (inside, above) = (burst(0.9e6).unwrap(), burst(1.4e6).unwrap());
        assert!(inside.band.0 <= above.band.0 && above.band.0 < above.risk);
        assert_eq!(above.band.1, 1.0);
        let below = burst(0.2e6).unwrap();
        assert!(
            below.band.0 == 0.0 && below.band.1 < 0.06,
            "{:?}",
            below.band
        );
        assert!(burst(1e3).unwrap().band.1 < 1e-3);
    }

    #[test]
    fn an_object_that_cannot_enter_the_orbit_makes_normalized_energy_invalid() {
        let ball = FlyingObject {
            mass: 0.43,
            diameter: 0.22,
            speed: 18.0,
        };
        for risk in assess(&of(Some(ball), 1e6)) {
            let pressure = risk.curve.measure == Measure::Pressure;
            assert_eq!(
                risk.caution,
                (!pressure).then_some(Caution::LargerThanOrbit)
            );
        }
        let golf = FlyingObject {
            diameter: 0.0427,
            ..ball
        };
        assert_eq!(golf.caution(), Some(Caution::LargerThanOrbit));
        let cork = FlyingObject {
            diameter: 0.031,
            ..ball
        };
        assert_eq!(cork.caution(), Some(Caution::LargerThanEye));
        assert_eq!(BB.caution(), None);
    }
}
