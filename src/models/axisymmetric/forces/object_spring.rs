//! The spring of a soft object, between its mass and its surface.
//!
//! It is linear, F = k c, up to a compression of half the diameter. Beyond that the walls of a
//! real ball come to meet, and with u = c - D/2 and the room W that is left
//!
//! F = k D/2 + k u / (1 - u/W)^2,
//!
//! which grows without end as u comes to W, so that the object stays [`LEAST`] of its diameter
//! thick at least, whatever its speed. Force and slope have no jump.
//!
//! Left out: a wall that buckles and so softens before it stiffens (Cross 1999 for tennis balls).

use crate::models::axisymmetric::forces::object::Object;

/// Share of the diameter up to which the spring is linear.
const LINEAR: f64 = 0.5;
/// Share of the diameter that is left when no force is enough.
const LEAST: f64 = 0.1;
/// Share of the mass that is the surface of an object on a spring.
const SURFACE_SHARE: f64 = 0.05;
/// Speed of opening over the speed of arrival at which all of the loss is felt.
const FULL_LOSS: f64 = 0.1;

/// How much of a force is left at a speed of `closing`, m/s, of something that gives back the
/// share `kept` of its energy and came at `speed`; and how fast that changes with closing, in s/m.
#[inline]
pub(crate) fn hysteresis(kept: f64, speed: f64, closing: f64) -> (f64, f64) {
    let full = FULL_LOSS * speed;
    if kept >= 1.0 || full <= 0.0 {
        (1.0, 0.0)
    } else {
        let opening = (-closing / full).clamp(0.0, 1.0);
        (1.0 - (1.0 - kept) * opening, (1.0 - kept) / full)
    }
}

/// The spring.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct ObjectSpring {
    /// Stiffness while it is linear, in N/m.
    stiffness: f64,
    /// Compression at which it ceases to be linear, in m.
    linear: f64,
    /// Compression that is left from there, in m.
    room: f64,
}

/// What the spring gives at one compression.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Squeezed {
    /// J; infinite beyond what is possible.
    pub energy: f64,
    /// N, against the compression.
    pub force: f64,
    /// Slope of the force, in N/m.
    pub slope: f64,
}

impl ObjectSpring {
    /// A spring of `stiffness` N/m in an object of `diameter` m.
    pub fn new(stiffness: f64, diameter: f64) -> Self {
        Self { stiffness, linear: LINEAR * diameter, room: (1.0 - LEAST - LINEAR) * diameter }
    }

    /// How far in front of where it is its surface may yet swing, in m: both ends, of `mass` kg,
    /// move apart at `apart` m/s and squeeze the spring by `squeezed` m now. It is softest while it
    /// is linear.
    pub fn swing(&self, mass: [f64; 2], apart: f64, squeezed: f64) -> f64 {
        let whole = mass[0] + mass[1];
        let energy = self.at(squeezed).energy + 0.5 * mass[0] * mass[1] / whole * apart * apart;
        mass[1] / whole * ((2.0 * energy / self.stiffness).sqrt() + squeezed)
    }

    /// Energy, force and slope at a compression in m; negative where it is drawn out.
    pub fn at(&self, compression: f64) -> Squeezed {
        let k = self.stiffness;
        let beyond = compression - self.linear;
        if beyond <= 0.0 {
            return Squeezed {
                energy: 0.5 * k * compression * compression,
                force: k * compression,
                slope: k,
            };
        }
        let left = 1.0 - beyond / self.room;
        if left <= 0.0 {
            return Squeezed { energy: f64::INFINITY, force: f64::INFINITY, slope: f64::INFINITY };
        }
        // The integral of u / (1 - u/W)^2 is W^2 (r / (1 - r) + ln(1 - r)) with r = u/W.
        let barrier = self.room * self.room * ((1.0 - left) / left + libm::log(left));
        Squeezed {
            energy: k * (self.linear * (0.5 * self.linear + beyond) + barrier),
            force: k * (self.linear + beyond / (left * left)),
            slope: k * (2.0 - left) / left.powi(3),
        }
    }
}

/// The spring between surface and core, and what the two weigh.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Core {
    /// Its law and the share of its energy that it gives back; none of a body that is all surface.
    pub spring: Option<(ObjectSpring, f64)>,
    /// Of surface and core, kg.
    pub mass: [f64; 2],
}

impl Core {
    pub fn new(object: &Object) -> Self {
        let spring = object.spring.map(|spring| {
            let law = ObjectSpring::new(spring.stiffness, 2.0 * object.outline.radius());
            (law, spring.restitution * spring.restitution)
        });
        let surface = if spring.is_some() { SURFACE_SHARE * object.mass } else { object.mass };
        Self { spring, mass: [surface, object.mass - surface] }
    }

    /// Energy of the spring, J, squeezed by so many m.
    pub fn stored(&self, squeezed: f64) -> f64 {
        self.spring.map_or(0.0, |(law, _)| law.at(squeezed).energy)
    }

    /// See [`ObjectSpring::swing`]; none of a body that is all surface.
    pub fn swing(&self, apart: f64, squeezed: f64) -> f64 {
        self.spring.map_or(0.0, |(law, _)| law.swing(self.mass, apart, squeezed))
    }

    /// The longest stable step, s, of the squeezed spring, whose loss changes by `slope` per m/s.
    pub fn limit(&self, squeezed: &Squeezed, slope: f64) -> f64 {
        // An oscillator of frequency w with a damping ratio z: (2/w)(sqrt(1 + z^2) - z).
        let reduced = self.mass[0] * self.mass[1] / (self.mass[0] + self.mass[1]);
        let w = (squeezed.slope / reduced).sqrt();
        let z = 0.5 * squeezed.force.abs() * slope / (w * reduced);
        2.0 / w * ((1.0 + z * z).sqrt() - z)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SPRING: ObjectSpring = ObjectSpring { stiffness: 2e4, linear: 0.02, room: 0.016 };

    #[test]
    fn the_force_is_the_slope_of_an_energy_that_never_presses_it_flat() {
        for compression in [-0.01, 0.01, 0.0199, 0.021, 0.03, 0.0355] {
            let h = 1e-8;
            let (before, after) = (SPRING.at(compression - h), SPRING.at(compression + h));
            let here = SPRING.at(compression);
            let force = (after.energy - before.energy) / (2.0 * h);
            let slope = (after.force - before.force) / (2.0 * h);
            assert!((force / here.force - 1.0).abs() < 1e-5, "{compression}");
            assert!((slope / here.slope - 1.0).abs() < 1e-5, "{compression}");
        }
        // No energy presses it flat.
        assert_eq!(SPRING.at(0.0361).energy, f64::INFINITY);
    }
}
