//! The fluid in the globe: one pressure, from the area that the shell encloses.
//!
//! p = p0 - B (A/A0 - 1), with A the area of the polygon of shell nodes and B an effective bulk
//! modulus. The force on a node is (p - p0) h dA/dx with h the depth of the section: at rest the
//! tension that p0 keeps in the shell balances p0, so both are left out together and the eye at rest
//! stays at rest to the last bit. What that neglects is how this tension (p0 r h, 0.4 N at 15 mmHg)
//! turns with the shell; against the tensions of a blow, hundreds of N, that is nothing.
//!
//! The energy is B h (A - A0)^2 / (2 A0).
//!
//! Left out: waves in the fluid, which cross the globe within 16 us, and cavitation: p may fall below 0.

use nalgebra::{Point2, Vector2};

/// Pascals in a millimetre of mercury.
pub const PA_PER_MMHG: f64 = 133.322_387_415;
/// Changes of shape that the bound of the frequency covers: growth of each shell segment and of the
/// enclosed area.
const COVERED: (f64, f64) = (1.5, 0.1);

/// The fluid of one eye.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Fluid {
    /// p0, in Pa.
    pub rest_pressure: f64,
    /// B, in Pa.
    pub bulk_modulus: f64,
    /// A0, in m^2.
    pub rest_area: f64,
    /// h, in m.
    pub depth: f64,
}

/// Area of a polygon, positive if it turns anticlockwise.
pub fn area(ring: &[Point2<f64>]) -> f64 {
    let mut sum = 0.0;
    let mut before = ring[ring.len() - 1];
    for &p in ring {
        sum += before.x * p.y - p.x * before.y;
        before = p;
    }
    0.5 * sum
}

impl Fluid {
    /// A fluid that fills `ring`.
    pub fn new(rest_pressure: f64, bulk_modulus: f64, depth: f64, ring: &[Point2<f64>]) -> Self {
        Self {
            rest_pressure,
            bulk_modulus,
            rest_area: area(ring),
            depth,
        }
    }

    /// Pressure at a ratio of areas, in Pa.
    pub fn pressure(&self, ratio: f64) -> f64 {
        self.rest_pressure - self.bulk_modulus * (ratio - 1.0)
    }

    /// Energy stored at a ratio of areas, in J.
    pub fn energy(&self, ratio: f64) -> f64 {
        0.5 * self.bulk_modulus * self.depth * self.rest_area * (ratio - 1.0).powi(2)
    }

    /// Adds the forces on the nodes of the ring; returns the ratio of areas.
    pub fn apply(&self, ring: &[Point2<f64>], forces: &mut [Vector2<f64>]) -> f64 {
        let ratio = area(ring) / self.rest_area;
        let half = -0.5 * self.bulk_modulus * (ratio - 1.0) * self.depth;
        let count = ring.len();
        for (i, force) in forces.iter_mut().enumerate() {
            let before = ring[if i == 0 { count - 1 } else { i - 1 }];
            let after = ring[if i + 1 == count { 0 } else { i + 1 }];
            force.x += half * (after.y - before.y);
            force.y += half * (before.x - after.x);
        }
        ratio
    }

    /// Bound of the square of the angular frequency that the fluid adds, in 1/s^2.
    ///
    /// The stiffness is B h g g'/A0 with g = dA/dx, whose square is at most the sum of the squared
    /// segments, and (p - p0) h times the curvature of A, whose norm is at most 1. It holds while no
    /// segment has grown to more than 1.5 times its length and the area has changed by less than
    /// 10 %, which is estimated, not enforced.
    pub fn omega_squared(&self, ring: &[Point2<f64>], node_mass: f64) -> f64 {
        let mut squares = 0.0;
        let mut before = ring[ring.len() - 1];
        for &p in ring {
            squares += (p - before).norm_squared();
            before = p;
        }
        let (growth, change) = COVERED;
        let stiffness = self.bulk_modulus * self.depth / node_mass;
        stiffness * (growth * growth * squares / self.rest_area + change)
    }
}
