//! Bone beyond the opening: what stops an object that is larger than the orbit.
//!
//! A rigid plane across the blow from the wall's front edge outward, in rings. A body without a
//! spring is pressed there as the eye presses it, by its own foundation. A ball on a spring comes
//! to rest on bone with its surface, and loses what that had of its energy, while its core goes
//! on.
//!
//! A ball that is squeezed by c gets wider: a = R + (pi/2 - 1) c/2, so that its wall, pressed
//! flat, has kept the length of its meridian. So what fits the opening as it arrives (a squash
//! ball) is caught by bone once it is flat. Left out: skin and muscle on the bone, and that a face
//! is no plane.

use crate::models::axisymmetric::forces::object::{
    MovingObject, Object, ObjectOutline, ObjectSurface,
};
use std::f64::consts::{FRAC_PI_2, PI};

/// Radius of each ring over that of the one within.
const SPACING: f64 = 1.1;
/// No object reaches farther than this, in m.
const FARTHEST: f64 = 0.3;
/// Growth of a ball's radius over its squeeze.
const WIDENING: f64 = 0.5 * (FRAC_PI_2 - 1.0);
/// Stiffness of some 75 mm of cortical bone of 15e9 Pa, in Pa/m. How it compares with the bone of
/// the eye in three dimensions: see [`crate::models`].
const BONE: f64 = 2e11;
/// Courant number of the object on bone over that of the cells.
const COURANT: f64 = 0.4 / 0.6;

/// A plane of rings.
pub(crate) struct Face {
    /// Place of the face along the line of the blow, m.
    x: f64,
    /// Radius (m) and area (m2) of each ring, from the innermost outward.
    rings: Vec<(f64, f64)>,
}

/// What it does to an object.
pub(crate) struct Push {
    /// Force against the way of the projectile, N.
    pub force: f64,
    /// Energy stored in the contact, J.
    pub energy: f64,
    /// Longest stable step, s.
    pub limit: f64,
}

impl Face {
    /// What lies at `x` beyond an opening of radius `inner`, m.
    pub fn beyond((x, inner): (f64, f64)) -> Self {
        let radii = std::iter::successors(Some(inner), |r| Some(r * SPACING));
        let ring = |r: f64| {
            let (from, to) = (r / SPACING.sqrt(), r * SPACING.sqrt());
            (r, PI * (to * to - from.max(inner).powi(2)))
        };
        Self { x, rings: radii.take_while(|r| *r < FARTHEST).map(ring).collect() }
    }

    /// A plane without an opening, in `count` rings of the same width up to `outer` m.
    #[cfg(test)]
    pub fn wall(x: f64, outer: f64, count: usize) -> Self {
        let width = outer / count as f64;
        let ring = |i: usize| {
            let r = (i as f64 + 0.5) * width;
            (r, 2.0 * PI * r * width)
        };
        Self { x, rings: (0..count).map(ring).collect() }
    }

    /// Whether an object that arrives with its centre or face at `centre` overlaps it.
    pub fn overlaps(&self, object: &Object, centre: f64) -> bool {
        self.rings.iter().any(|&(r, _)| self.gap(object, [centre; 2], r).0 > 0.0)
    }

    /// Depth of a ring below an object's surface, and how it grows as surface and core move.
    fn gap(&self, object: &Object, centres: [f64; 2], r: f64) -> (f64, [f64; 2]) {
        let squeeze = (centres[1] - centres[0]).max(0.0);
        let ObjectOutline::Sphere(radius) = object.outline else {
            let (gap, nx, _) = object.gap(self.x - centres[0], r);
            return (gap, [nx, 0.0]);
        };
        // The sphere's own depth, at the place that comes to lie at r.
        let wide = radius + WIDENING * squeeze;
        let stretch = radius / wide;
        let (gap, nx, nr) = object.gap(self.x - centres[0], r * stretch);
        let widening = if squeeze > 0.0 { nr * r * stretch / wide * WIDENING } else { 0.0 };
        (gap, [nx - widening, widening])
    }

    /// Pushes the object back, and adds what its surface loses to the projectile's.
    pub fn push(&self, object: &Object, projectile: &mut MovingObject) -> Push {
        let mut push = Push { force: 0.0, energy: 0.0, limit: f64::INFINITY };
        let surface = match (object.spring, object.surface.cap) {
            (None, _) => object.surface,
            (Some(_), None) => ObjectSurface::foundation(BONE, object.outline.radius()).losing(0.0),
            (Some(_), Some(_)) => ObjectSurface { cap: None, ..object.surface },
        };
        let (mut slope, mut damping) = (0.0, 0.0);
        for &(r, area) in &self.rings {
            let (gap, ways) = self.gap(object, projectile.x, r);
            // What is pressed shrinks outward.
            if gap <= -object.near() {
                break;
            }
            let pressed = surface.at(gap.max(0.0));
            let closing = ways[0] * projectile.v[0] + ways[1] * projectile.v[1];
            slope += area * surface.steepest(gap, pressed.slope, closing);
            if gap <= 0.0 {
                continue;
            }
            let (left, change) = surface.hysteresis(object.speed, closing);
            let force = area * pressed.traction;
            for (i, way) in ways.into_iter().enumerate() {
                push.force += force * left * way;
                projectile.force[i] -= force * left * way;
                projectile.lossy[i] += force * (1.0 - left) * way;
            }
            push.energy += area * pressed.energy;
            damping += force * change;
        }
        if slope > 0.0 {
            let stable = (projectile.mass[0] / slope).sqrt();
            let damped = projectile.mass[0] / damping.max(f64::MIN_POSITIVE);
            push.limit = COURANT * stable.min(damped);
        }
        push
    }
}
