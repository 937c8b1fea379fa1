//! Whether a small hard object goes into the eye: an open globe, as a rupture is.
//!
//! Such objects went in at 43 to 48 kJ/m2 of kinetic energy over cross section (Marshall 2011, eyes
//! of pigs); what counts of an oblique one is the energy of its speed along the surface's normal.
//! The chance is Phi(log10(E cos^2 /(A 45 kJ/m2))/0.12). Between what is as hard and as small as
//! those tested and what is neither it fades, so that no answer jumps.
//!
//! Left out: edges and points, which go in at far less.

use crate::normal;
use crate::scenario::{Projectile, Surface, direction::GLOBE_MM};
use libm::{asin, cos, log10};
use std::f64::consts::FRAC_PI_4;

/// Energy over area at which half go in, J/m2.
const HALF: f64 = 45e3;
/// Spread of log10 of it.
pub const SPREAD: f64 = 0.12;
/// Widest of those that were tested, and from where on nothing goes in so, in mm.
const WIDTH_MM: (f64, f64) = (11.2, 16.0);
/// log10 of the modulus in `MPa` from which on a surface is hard, and of what is soft.
const HARDNESS: (f64, f64) = (2.9, 2.0);

/// A way in that an object may find.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WayIn {
    /// How many spreads log10 of its energy lies above where half go in.
    pub z: f64,
    /// How much the object is like those that went in, 0 to 1.
    pub like: f64,
}

impl WayIn {
    /// That of an object as it comes; none of what is wide or soft.
    pub fn of(object: &Projectile) -> Option<Self> {
        let hardness = match object.surface {
            Surface::Hard => 1.0,
            Surface::Elastic { modulus_mpa } => share(log10(modulus_mpa), HARDNESS),
            Surface::Inflated { .. } | Surface::Splashing => 0.0,
        };
        let like = hardness * share(-object.diameter_mm, (-WIDTH_MM.0, -WIDTH_MM.1));
        let energy = object.energy_j() / (FRAC_PI_4 * object.diameter_m() * object.diameter_m());
        let z = z(log10(energy), object.angle_deg, object.offset_mm);
        (like > 0.0).then_some(Self { z, like })
    }

    /// The chance that it goes in, with log10 of its energy `more` spreads larger.
    pub fn chance(&self, more: f64) -> f64 {
        self.like * normal::below(self.z + more)
    }
}

/// From 1 at the first to 0 at the second.
fn share(value: f64, (whole, none): (f64, f64)) -> f64 {
    ((value - none) / (whole - none)).clamp(0.0, 1.0)
}

/// How many spreads log10 of an energy over area lies above where half go in.
pub fn z(log_energy: f64, angle_deg: f64, offset_mm: f64) -> f64 {
    let beside = asin((offset_mm / GLOBE_MM).min(1.0));
    let along = cos(angle_deg.to_radians() + beside).max(0.01);
    (log_energy + 2.0 * log10(along) - log10(HALF)) / SPREAD
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scenario::library::tests::preset;

    fn chance(name: &str, changes: &[(&str, &str)]) -> f64 {
        let scenario = preset(name, changes);
        WayIn::of(scenario.projectile().unwrap()).map_or(0.0, |way| way.chance(0.0))
    }

    #[test]
    fn what_is_small_hard_and_fast_goes_in_and_a_ball_does_not() {
        assert!(chance("bb-92", &[]) > 0.99 && chance("bb-56", &[]) < 0.2);
        assert!(chance("airsoft-75", &[]) < 0.01);
        assert!(chance("bb-92", &[("impact.angle_deg", "60")]) < 0.05);
        for name in ["squash-ball", "paintball", "golf-ball"] {
            assert_eq!(chance(name, &[]), 0.0);
        }
    }
}
