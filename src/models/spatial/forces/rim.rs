//! Bone around the opening, as an object meets it.
//!
//! The rounded edge is spheres ([`OrbitRim`](crate::models::spatial::eye::orbit::OrbitRim)); a body
//! presses each by how deep it lies in it, along the line between them. Three kinds of bodies:
//!
//! * what is hard is pushed back by the bone's stiffness, which its spheres share by length of arc;
//! * the surface of a ball on a spring, a twentieth of its mass, comes to rest on bone the same way
//!   and loses what it had, while its core goes on: a rigid edge on a rigid ball would stop a ball
//!   of 24 g with 10 kN;
//! * a body without a spring whose own surface gives way is flattened. Points of bone that are
//!   pressed by its surface's law alone would be too narrow to hold it: bone gives way to nothing,
//!   and it would pass. As a whole, a sphere pressed flat by c on a foundation of that law takes
//!   2 pi R w(c), where w is what a unit of its surface stores; c is here the mean of the depths to
//!   the eighth power by length of arc, near the deepest of them but smooth. So one force holds a
//!   ball that rests on one place of the rim or on all of it.
//!
//! Left out: skin and muscle on the bone, friction, that bone breaks, and that a squeezed ball gets
//! wider.

use crate::models::axisymmetric::forces::object::{Object, ObjectOutline};
use crate::models::axisymmetric::forces::object_spring::hysteresis;
use crate::models::spatial::eye::SpatialEye;
use crate::models::spatial::eye::orbit::{EDGE, RimSphere};
use crate::models::spatial::forces::contact::depth;
use crate::models::spatial::forces::object::{MovingObject, touches};
use nalgebra::Vector3;
use std::f64::consts::TAU;

/// Power of the mean depth.
const POWER: i32 = 8;
/// Points over which the energy of a flattened body is integrated.
const POINTS: usize = 8;
/// Courant number of what is on bone.
pub(crate) const COURANT: f64 = 0.67;
/// Stiffness of all of the rim against a hard object, in N/m. Bone is meant to be rigid: with 3e7 N/m
/// a ball of 24 g comes millimetres into it, and a stiffness ten times as large takes 10 to 34 % of
/// the pressure; beyond 1e9 hardly anything changes.
const STIFFNESS: f64 = 1e9;

/// The edge of bone.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Rim {
    spheres: Vec<RimSphere>,
}

/// What bone does to an object.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct Push {
    /// On the object, N.
    pub force: Vector3<f64>,
    /// Stored between them, J.
    pub energy: f64,
    /// Longest stable step, s.
    pub limit: f64,
    /// Share of what gives way of the object's surface that is used up.
    pub used_up: f64,
}

impl Push {
    fn none() -> Self {
        Self { limit: f64::INFINITY, ..Self::default() }
    }
}

impl Rim {
    pub fn new(eye: &SpatialEye) -> Option<Self> {
        Some(Self { spheres: eye.rim?.spheres(eye.parameters.radius) })
    }

    /// How far along its way an object comes before it touches bone.
    pub fn first_touch(
        &self,
        outline: ObjectOutline,
        line: (Vector3<f64>, Vector3<f64>),
    ) -> Option<f64> {
        let touch = |sphere: &RimSphere| touches(outline, line, sphere.middle, EDGE);
        self.spheres.iter().filter_map(touch).reduce(f64::min)
    }

    /// Depth of a sphere of the edge in an object, and the way that it decreases.
    fn depth(object: &Object, moving: &MovingObject, sphere: &RimSphere) -> (f64, Vector3<f64>) {
        if let ObjectOutline::Sphere(radius) = object.outline {
            let from = sphere.middle - moving.at[0];
            let apart = from.norm();
            return (radius + EDGE - apart, from / apart);
        }
        let (gap, normal) = depth(object, moving, sphere.middle);
        (gap + EDGE, normal)
    }

    /// Pushes the object back, and adds what its surface loses to the projectile's.
    pub fn push(&self, object: &Object, projectile: &mut MovingObject) -> Push {
        if object.spring.is_none() && object.surface.depth.is_some() {
            self.flatten(object, projectile)
        } else {
            self.stop(object, projectile)
        }
    }

    fn stop(&self, object: &Object, projectile: &mut MovingObject) -> Push {
        let mut push = Push::none();
        let kept = if object.spring.is_some() { 0.0 } else { 1.0 };
        let (mut slope, mut damping) = (0.0, 0.0);
        for sphere in &self.spheres {
            let (gap, normal) = Self::depth(object, projectile, sphere);
            if gap <= -object.near() {
                continue;
            }
            let stiffness = STIFFNESS * sphere.share;
            slope += stiffness;
            if gap <= 0.0 {
                continue;
            }
            let closing = projectile.speed[0].dot(&normal);
            let (left, change) = hysteresis(kept, object.speed, closing);
            let force = normal * (-stiffness * gap);
            push.force += force * left;
            projectile.lossy[0] += force * (left - 1.0);
            push.energy += 0.5 * stiffness * gap * gap;
            damping += stiffness * gap * change;
        }
        projectile.force[0] += push.force;
        if slope > 0.0 {
            let stable = (projectile.mass[0] / slope).sqrt();
            let damped = projectile.mass[0] / damping.max(f64::MIN_POSITIVE);
            push.limit = COURANT * (2.0 * stable).min(damped);
        }
        push
    }

    fn flatten(&self, object: &Object, projectile: &mut MovingObject) -> Push {
        let mut push = Push::none();
        let (mut sum, mut way, mut near) = (0.0, Vector3::zeros(), false);
        for sphere in &self.spheres {
            let (gap, normal) = Self::depth(object, projectile, sphere);
            near |= gap > -object.near();
            if gap > 0.0 {
                let part = sphere.share * gap.powi(POWER - 1);
                sum += part * gap;
                way += normal * part;
            }
        }
        if !near {
            return push;
        }
        let radius = object.outline.radius();
        let of_depth = |depth: f64| {
            let pressed = object.surface.at(depth);
            (TAU * radius * pressed.energy, TAU * radius * pressed.traction)
        };
        let mut slope = TAU * radius * object.surface.at(object.near()).traction;
        if sum > 0.0 {
            let depth = libm::pow(sum, 1.0 / f64::from(POWER));
            // How the mean depth decreases.
            let normal = way * (depth / sum);
            let (flat, stiffness) = of_depth(depth);
            let closing = projectile.speed[0].dot(&normal);
            let (left, change) = object.surface.hysteresis(object.speed, closing);
            let force = normal * -flat;
            push.force = force * left;
            projectile.lossy[0] += force * (left - 1.0);
            let part = depth / POINTS as f64;
            let middle = |i: usize| of_depth((i as f64 + 0.5) * part).0;
            push.energy = (0..POINTS).map(middle).sum::<f64>() * part;
            push.used_up = object.surface.used_up(depth);
            let soon =
                TAU * radius * object.surface.steepest(depth, stiffness / TAU / radius, closing);
            slope = slope.max(soon) + f64::from(POWER) * flat / depth;
            let damped = projectile.mass[0] / (flat * change).max(f64::MIN_POSITIVE);
            push.limit = COURANT * damped;
        }
        projectile.force[0] += push.force;
        let stable = (projectile.mass[0] / slope.max(f64::MIN_POSITIVE)).sqrt();
        push.limit = push.limit.min(2.0 * COURANT * stable);
        push
    }
}
