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
//! Left out: loss (a real ball gives back a half to three quarters of its energy), and a wall that
//! buckles and so softens before it stiffens (Cross 1999 for tennis balls).

/// Share of the diameter up to which the spring is linear.
const LINEAR: f64 = 0.5;
/// Share of the diameter that is left when no force is enough.
const LEAST: f64 = 0.1;

/// The spring.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ObjectSpring {
    /// Stiffness while it is linear, in N/m.
    pub stiffness: f64,
    /// Compression at which it ceases to be linear, in m.
    linear: f64,
    /// Compression that is left from there, in m.
    room: f64,
}

/// What the spring gives at one compression.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Squeezed {
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

#[cfg(test)]
mod tests {
    use super::*;

    const SPRING: ObjectSpring = ObjectSpring { stiffness: 2e4, linear: 0.02, room: 0.016 };

    #[test]
    fn the_force_is_the_slope_of_the_energy_and_its_slope_the_slope_of_the_force() {
        for compression in [-0.01, 0.01, 0.0199, 0.021, 0.03, 0.0355] {
            let h = 1e-8;
            let (before, after) = (SPRING.at(compression - h), SPRING.at(compression + h));
            let here = SPRING.at(compression);
            let force = (after.energy - before.energy) / (2.0 * h);
            let slope = (after.force - before.force) / (2.0 * h);
            assert!((force / here.force - 1.0).abs() < 1e-5, "{compression}");
            assert!((slope / here.slope - 1.0).abs() < 1e-5, "{compression}");
        }
    }

    #[test]
    fn no_energy_presses_it_flat() {
        assert_eq!(SPRING.at(0.0361).energy, f64::INFINITY);
    }
}
