//! Bone around the opening, as an object and the globe meet it.
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
//! What keeps the globe in its orbit when a blow throws it against the rim: a node of the shell in
//! the sphere that is nearest to its azimuth is pushed out of it, by a foundation over the area
//! that the node stands for at rest.
//!
//! Left out: skin and muscle on the bone, friction, that bone breaks, and that a squeezed ball gets
//! wider.

use crate::models::axisymmetric::forces::object::{Object, ObjectOutline};
use crate::models::axisymmetric::forces::object_spring::hysteresis;
use crate::models::spatial::eye::orbit::{EDGE, RimSphere};
use crate::models::spatial::eye::{SpatialEye, area};
use crate::models::spatial::forces::contact::depth;
use crate::models::spatial::forces::object::{Line, MovingObject, touches};
use crate::models::spatial::forces::state::{NodeState, vector};
use nalgebra::Vector3;
use std::f64::consts::TAU;

/// Power of the mean depth.
const POWER: i32 = 8;
/// Points over which the energy of a flattened body is integrated.
const POINTS: usize = 8;
/// Courant number of what is on bone.
const COURANT: f64 = 0.67;
/// Stiffness of the foundation, in Pa/m: a globe thrown against bone comes less than 0.1 mm in.
const FOUNDATION: f64 = 3e10;
/// Stiffness of the whole rim against what is hard, in N/m. Bone is meant to be rigid: with 3e7 N/m
/// a ball of 24 g comes millimetres into it, and a stiffness ten times as large takes 10 to 34 % of
/// the pressure; beyond 1e9 hardly anything changes.
/// How it compares with the bone of the axisymmetric eye: see [`crate::models`].
const STIFFNESS: f64 = 1e9;

/// The edge of bone.
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

impl Rim {
    pub fn new(eye: &SpatialEye) -> Option<Self> {
        Some(Self { spheres: eye.rim?.spheres(eye.parameters.radius) })
    }

    /// How far along its way an object comes before it touches bone.
    pub fn first_touch(&self, outline: ObjectOutline, line: Line) -> Option<f64> {
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
        let mut push = Push { limit: f64::INFINITY, ..Push::default() };
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
        let mut push = Push { limit: f64::INFINITY, ..Push::default() };
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

/// The edge of bone as the globe meets it.
pub(crate) struct Bone {
    spheres: Vec<RimSphere>,
    /// Nearer to the axis than this there is none, m.
    least: f64,
    /// Nodes of the shell with the area that each stands for, m2, and its mass, kg.
    nodes: Vec<(usize, f64, f64)>,
}

/// What it does at some instant.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Held {
    /// Sum of the sizes of its forces, N.
    pub force: f64,
    /// Stored, J.
    pub energy: f64,
    /// Longest stable step, s.
    pub limit: f64,
}

impl Bone {
    pub fn new(eye: &SpatialEye) -> Option<Self> {
        let spheres = eye.rim?.spheres(eye.parameters.radius);
        let mut areas = std::collections::BTreeMap::<usize, f64>::new();
        for quad in &eye.quads {
            let quarter = 0.25 * area(&quad.corners.map(|node| eye.mesh.at[node]));
            for node in quad.corners {
                *areas.entry(node).or_default() += quarter;
            }
        }
        let across = |sphere: &RimSphere| libm::hypot(sphere.middle.y, sphere.middle.z);
        let nearest = spheres.iter().map(across).fold(f64::INFINITY, f64::min);
        let node = |(node, area): (usize, f64)| (node, area, eye.mass[node]);
        Some(Self { least: nearest - EDGE, spheres, nodes: areas.into_iter().map(node).collect() })
    }

    /// Adds its forces to those of nodes.
    pub fn forces(&self, state: &mut NodeState) -> Held {
        let mut held = Held { force: 0.0, energy: 0.0, limit: f64::INFINITY };
        let count = self.spheres.len();
        for &(node, area, mass) in &self.nodes {
            let at = vector(&state.at, node);
            if at.y * at.y + at.z * at.z < self.least * self.least {
                continue;
            }
            let turns = libm::atan2(at.z, at.y) / TAU;
            let nearest = (turns.rem_euclid(1.0) * count as f64).round() as usize;
            let deepest = (nearest + count - 1..=nearest + count + 1)
                .map(|i| at - self.spheres[i % count].middle)
                .fold(Vector3::repeat(f64::MAX.sqrt()), |a, b| {
                    if b.norm_squared() < a.norm_squared() { b } else { a }
                });
            let apart = deepest.norm();
            let gap = EDGE - apart;
            if gap <= 0.0 {
                continue;
            }
            let stiffness = FOUNDATION * area;
            state.push(node, deepest * (stiffness * gap / apart));
            held.force += stiffness * gap;
            held.energy += 0.5 * stiffness * gap * gap;
            held.limit = held.limit.min(2.0 * COURANT * (mass / stiffness).sqrt());
        }
        held
    }
}
