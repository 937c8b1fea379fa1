//! What of a scenario decides how its risks are read: the object's energy over its area, and how
//! much the blow is like those that were tested.
//!
//! Tested were hard objects up to 11.2 mm wide, straight on. Such a blow at a human eye is what the
//! published energy curves were measured with, so there they count (see [`crate::injury::risk`]).
//! Their weight falls linearly to nothing up to 16 mm, 20 degrees from straight on, and between
//! 100 and 10 `MPa` of the surface's modulus in its logarithm, so that no answer jumps.

use crate::scenario::{Geometry, Scenario, Species, Support, Surface, direction::GLOBE_MM};
use std::f64::consts::FRAC_PI_4;

/// Diameters up to which objects were tested, and from which they count as unlike, in mm.
const WIDTH_MM: (f64, f64) = (11.2, 16.0);
/// The same of the angle from straight on, in degrees.
const ANGLE_DEG: (f64, f64) = (10.0, 20.0);
/// Decimal logarithms of the surface's modulus in `MPa`, from as hard as those tested to unlike.
const HARDNESS: (f64, f64) = (2.0, 1.0);
/// Energy over area from which small hard objects went into pigs' eyes, J/m2 (Marshall 2011).
const GOES_IN: f64 = 43e3;
/// Width of the orbit's opening, in mm.
const ORBIT_MM: f64 = 40.0;
/// Diameters up to which bone's shape does not matter straight on (a cork), and from which, in mm.
const MEETS_BONE_MM: (f64, f64) = (32.0, 40.0);

/// What of a scenario its risks are read with.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Blow {
    /// Kinetic energy over the object's area, J/m2; none of a pulse.
    pub energy: Option<f64>,
    /// How much it is like the blows that were tested, 0 to 1.
    pub tested: f64,
    /// Why it is none of them, where it is not like them at all.
    pub untested: &'static str,
    /// How much wider the object is than any that was tested, 0 to 1.
    pub wider: f64,
    /// How far from straight on, 0 (to 10 degrees) to 1 (from 20), where places turn with the blow.
    pub aslant: f64,
    /// How much its injuries hang on bone that is taken as a round rim, 0 to 1.
    pub round_rim: f64,
    /// Whether such an object was seen to go into the eye.
    pub goes_in: bool,
    /// Whether it is an inflated ball wider than the orbit, which sucks as it leaves.
    pub sucks: bool,
}

/// From 0 at `from` linearly to 1 at `to`.
fn ramp(value: f64, (from, to): (f64, f64)) -> f64 {
    ((value - from) / (to - from)).clamp(0.0, 1.0)
}

impl Blow {
    /// What `scenario` says.
    pub fn of(scenario: &Scenario) -> Self {
        // Both its angle and where on the globe it lands.
        let offset_mm = scenario.projectile().map_or(0.0, |object| object.offset_mm);
        let beside = libm::asin((offset_mm / GLOBE_MM).min(1.0));
        let off_axis = scenario.impact.angle_deg().abs() + beside.to_degrees();
        let off_axis = ramp(off_axis, ANGLE_DEG);
        let spatial = scenario.is_spatial();
        let aslant = if spatial { 0.0 } else { off_axis };
        let Some(object) = scenario.projectile() else {
            // Nobody has pushed an eye with a given force.
            return Self { wider: 1.0, aslant, ..Self::default() };
        };
        let (diameter, speed) = (object.diameter_m(), object.speed_m_s);
        let energy = 0.5 * object.mass_kg() * speed * speed / (FRAC_PI_4 * diameter * diameter);
        let wider = ramp(object.diameter_mm, WIDTH_MM);
        let softness = match object.surface {
            Surface::Hard => 0.0,
            Surface::Elastic { modulus_mpa } => ramp(libm::log10(modulus_mpa), HARDNESS),
            Surface::Inflated { .. } | Surface::Splashing => 1.0,
        };
        let round = scenario.geometry() == Some(Geometry::Axisymmetric)
            && scenario.physiological().is_some_and(|model| model.support == Support::Orbit);
        let human = scenario.model.species() == Species::Human;
        let untested = match (human, off_axis < 1.0) {
            (false, _) => "those count for human eyes alone",
            (true, false) => "no such direction was tested",
            (true, true) => "no such object was tested",
        };
        let inflated = matches!(object.surface, Surface::Inflated { .. });
        Self {
            energy: Some(energy),
            tested: if human { (1.0 - wider) * (1.0 - off_axis) * (1.0 - softness) } else { 0.0 },
            untested,
            wider,
            aslant,
            round_rim: if round { ramp(object.diameter_mm, MEETS_BONE_MM) } else { 0.0 },
            goes_in: wider == 0.0 && softness == 0.0 && energy >= GOES_IN,
            sucks: inflated && object.diameter_mm > ORBIT_MM,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scenario::library::tests::preset;

    fn of(name: &str, changes: &[(&str, &str)]) -> Blow {
        Blow::of(&preset(name, changes))
    }

    #[test]
    fn a_bb_has_its_known_energy_and_is_what_was_tested() {
        let bb = of("bb-56", &[]);
        assert!((bb.energy.unwrap() / 34.0e3 - 1.0).abs() < 1e-2);
        assert_eq!((bb.tested, bb.wider, bb.aslant), (1.0, 0.0, 0.0));
        assert!(!bb.goes_in && of("bb-92", &[]).goes_in);
        assert_eq!(of("bb-56", &[("model.species", "Pig")]).tested, 0.0);
    }

    #[test]
    fn what_is_wide_soft_or_from_the_side_is_not() {
        let squash = of("squash-ball", &[]);
        assert_eq!((squash.tested, squash.wider), (0.0, 1.0));
        assert!(!squash.sucks && of("soccer-ball", &[]).sucks);
        let turned = ("numerics.geometry", "Axisymmetric");
        let half = of("bb-56", &[("impact.angle_deg", "15"), turned]);
        assert_eq!((half.tested, half.aslant), (0.5, 0.5));
        let wide = of("bb-56", &[("impact.diameter_mm", "13.6")]);
        assert!((wide.tested - 0.5).abs() < 1e-12);
    }
}
