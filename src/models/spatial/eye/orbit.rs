//! What holds the globe: the bony orbit with a rim that is not round, or a round holder.
//!
//! The rim of the orbit is a closed curve (x, r) = (-R + depth, R + gap) over the azimuth, with its
//! depth behind the foremost point of the cornea and its gap from the globe measured in four
//! directions (computed tomography of 15 orbits, Arch Facial Plast Surg 2011;13:51; the same depths
//! in 141 others, Anat Cell Biol 2017;50:41). Between them runs a periodic Hermite curve whose
//! slopes are the harmonic means of the two secants, 0 where these differ in sign: it has no
//! extreme beyond those that were measured, as a sum of sines has.
//!
//! Behind the rim the wall comes to that of the mean cone, r = a - s (x + b), over a length of
//! 10 mm. In front of the rim there is none: what is left of fat there lies free.
//!
//! The rim's edge is rounded: spheres of radius re around the curve, their middles re/sqrt 2 behind
//! it and re/sqrt 2 outside of it, so that the measured point, where callipers find the bone, lies
//! on the middle of the rounding. Bone is rigid. Left out: the surface of the face beyond the edge
//! and the nose, which shield more, and that bone breaks.

use crate::models::axisymmetric::eye::front_angle;
use crate::models::axisymmetric::eye::parameters::{Parameters, Surround, Wall};
use crate::models::axisymmetric::forces::contact::last;
use crate::scenario::{Around, Rim};
use nalgebra::Vector3;
use std::f64::consts::{FRAC_1_SQRT_2, FRAC_PI_2, PI, TAU};

/// Radius of the edge of bone, in m: an assumption. From 3 to 8 mm pressures change by 2 to 5 %.
pub(crate) const EDGE: f64 = 5e-3;
/// Over which length the wall comes from the rim to its cone, in m.
const RELAXES: f64 = 10e-3;
/// Spheres around the rim.
const SPHERES: usize = 192;

/// The rim of an orbit at 12 o'clock, at the nose, at 6 o'clock and at the temple.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct OrbitRim {
    /// How far it lies behind the foremost point of the cornea, in m.
    pub depth: [f64; 4],
    /// How far it lies outside of the globe, in m.
    pub gap: [f64; 4],
}

impl From<&Rim> for OrbitRim {
    fn from(rim: &Rim) -> Self {
        let around = |of: Around| [of.above, of.nose, of.below, of.temple].map(|mm| mm * 1e-3);
        Self { depth: around(rim.depth_mm), gap: around(rim.gap_mm) }
    }
}

impl OrbitRim {
    /// A round rim through (x, r), in m, around a globe of `radius` m.
    pub fn round((x, r): (f64, f64), radius: f64) -> Self {
        Self { depth: [x + radius; 4], gap: [r - radius; 4] }
    }

    /// Whether it is the same in every direction.
    pub fn is_round(&self) -> bool {
        let same = |of: [f64; 4]| of.iter().all(|value| *value == of[0]);
        same(self.depth) && same(self.gap)
    }

    /// x and distance from the axis at an azimuth, of a globe of `radius` m.
    pub fn at(&self, azimuth: f64, radius: f64) -> (f64, f64) {
        (periodic(&self.depth, azimuth) - radius, periodic(&self.gap, azimuth) + radius)
    }

    /// The spheres of the rounded edge.
    pub(crate) fn spheres(&self, radius: f64) -> Vec<RimSphere> {
        let azimuth = |i: usize| TAU * i as f64 / SPHERES as f64;
        let edge = |i: usize| {
            let azimuth = azimuth(i % SPHERES);
            let (x, r) = self.at(azimuth, radius);
            Vector3::new(x, r * libm::cos(azimuth), r * libm::sin(azimuth))
        };
        let length = |i: usize| (edge(i + 1) - edge(i)).norm();
        let whole: f64 = (0..SPHERES).map(length).sum();
        let away = FRAC_1_SQRT_2 * EDGE;
        (0..SPHERES)
            .map(|i| {
                let outward = Vector3::new(0.0, libm::cos(azimuth(i)), libm::sin(azimuth(i)));
                RimSphere {
                    middle: edge(i) + Vector3::x() * away + outward * away,
                    share: 0.5 * (length(i) + length((i + SPHERES - 1) % SPHERES)) / whole,
                }
            })
            .collect()
    }
}

/// A sphere of the rim's edge.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct RimSphere {
    /// m.
    pub middle: Vector3<f64>,
    /// Share of the rim's length.
    pub share: f64,
}

/// A closed curve through values at four azimuths, without extremes between them.
fn periodic(of: &[f64; 4], azimuth: f64) -> f64 {
    let turns = azimuth / FRAC_PI_2;
    let before = turns.floor();
    let s = turns - before;
    let i = before.rem_euclid(4.0) as usize % 4;
    let secant = |i: usize| of[(i + 1) % 4] - of[i % 4];
    let slope = |i: usize| {
        let (a, b) = (secant(i + 3), secant(i));
        if a * b > 0.0 { 2.0 * a * b / (a + b) } else { 0.0 }
    };
    let (from, to) = (of[i], of[(i + 1) % 4]);
    let (s2, s3) = (s * s, s * s * s);
    from + (to - from) * (3.0 * s2 - 2.0 * s3)
        + slope(i) * (s3 - 2.0 * s2 + s)
        + slope(i + 1) * (s3 - s2)
}

/// Front angle and azimuth of a place.
pub(crate) fn seen_from_the_middle(at: Vector3<f64>) -> (f64, f64) {
    let across = libm::hypot(at.y, at.z);
    (libm::atan2(across, -at.x), libm::atan2(at.z, at.y))
}

/// What holds the globe: a wall alike all around, or an orbit with a rim that was measured.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Cavity {
    pub wall: Wall,
    /// Front angle of a wall without a rim, rad.
    pub opening: f64,
    pub rim: Option<OrbitRim>,
    /// Of the globe, m.
    pub radius: f64,
}

impl Cavity {
    pub fn new(parameters: &Parameters, rim: Option<OrbitRim>) -> Option<Self> {
        let Surround { wall, opening, .. } = parameters.surround?;
        Some(Self { wall, opening, rim, radius: parameters.radius })
    }

    /// Distance of the wall from the axis at `x`, behind a rim at some azimuth.
    fn wall_at(&self, x: f64, (rim_x, rim_r): (f64, f64)) -> f64 {
        let cone = |x: f64| match self.wall {
            Wall::Cone { radius, slope, behind, .. } => radius - slope * (x + behind),
            Wall::Sphere(radius) => (radius * radius - x * x).max(0.0).sqrt(),
        };
        cone(x) + (rim_r - cone(rim_x)) * libm::exp(-(x - rim_x) / RELAXES)
    }

    /// How far behind the opening a place lies, as a difference of front angles, rad.
    pub fn behind(&self, at: Vector3<f64>) -> f64 {
        let (front, azimuth) = seen_from_the_middle(at);
        let edge = |rim: OrbitRim| front_angle(rim.at(azimuth, self.radius));
        front - self.rim.map_or(self.opening, edge)
    }

    /// Distance of the wall from the middle of the globe in a direction, in m; in front of the
    /// opening of what is free there.
    pub fn distance(&self, direction: Vector3<f64>) -> f64 {
        let (front, azimuth) = seen_from_the_middle(direction);
        let Some(rim) = self.rim else { return self.wall.distance(PI - front.max(self.opening)) };
        let rim = rim.at(azimuth, self.radius);
        let edge = libm::hypot(rim.0, rim.1);
        if front <= front_angle(rim) {
            return edge;
        }
        let (Wall::Cone { farthest, .. } | Wall::Sphere(farthest)) = self.wall;
        let (along, across) = (-libm::cos(front), libm::sin(front));
        let within = |at: f64| at * across < self.wall_at(at * along, rim);
        let beyond = farthest.max(edge);
        if within(beyond) { beyond } else { last(self.radius, beyond, within) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_rim_goes_through_what_was_measured_and_has_no_extremes_between() {
        for rim in [Rim::CAUCASIAN, Rim::EAST_ASIAN] {
            let rim = OrbitRim::from(&rim);
            for (i, (depth, gap)) in rim.depth.into_iter().zip(rim.gap).enumerate() {
                let (x, r) = rim.at(i as f64 * FRAC_PI_2, 12e-3);
                assert!((x + 12e-3 - depth).abs() < 1e-12 && (r - 12e-3 - gap).abs() < 1e-12);
            }
            for of in [rim.depth, rim.gap] {
                let least = of.into_iter().fold(f64::INFINITY, f64::min);
                let most = of.into_iter().fold(0.0, f64::max);
                for i in 0..720 {
                    let value = periodic(&of, f64::from(i) * 0.02 - 7.0);
                    assert!(value >= least - 1e-12 && value <= most + 1e-12);
                }
            }
        }
    }

    #[test]
    fn the_wall_starts_at_the_rim_and_the_shares_of_its_edge_add_up() {
        let rim = OrbitRim::from(&Rim::CAUCASIAN);
        let orbit = Cavity::new(&Parameters::default(), Some(rim)).unwrap();
        for i in 0..48 {
            let azimuth = f64::from(i) * TAU / 48.0;
            let (x, r) = rim.at(azimuth, 12e-3);
            let edge = Vector3::new(x, r * azimuth.cos(), r * azimuth.sin());
            let behind = edge + Vector3::x() * 1e-7;
            assert!((orbit.distance(behind) - edge.norm()).abs() < 1e-5);
            assert!(orbit.behind(behind) > 0.0 && orbit.behind(edge - Vector3::x() * 1e-6) < 0.0);
        }
        let whole: f64 = rim.spheres(12e-3).iter().map(|s| s.share).sum();
        assert!((whole - 1.0).abs() < 1e-12);
    }
}
