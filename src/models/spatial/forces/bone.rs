//! The globe on bone: what keeps it in its orbit when a blow throws it against the rim.
//!
//! A node of the shell within the sphere of the edge that is nearest to its azimuth is pushed out
//! of it, by a foundation over the area that the node stands for at rest.

use crate::models::spatial::eye::orbit::{EDGE, RimSphere};
use crate::models::spatial::eye::{SpatialEye, area};
use crate::models::spatial::forces::rim::COURANT;
use crate::models::spatial::forces::state::{NodeState, vector};
use nalgebra::Vector3;
use std::f64::consts::TAU;

/// Stiffness of the foundation, in Pa/m: a globe thrown against bone comes less than 0.1 mm in.
const STIFFNESS: f64 = 3e10;

/// The edge of bone as the globe meets it.
#[derive(Debug, Clone, PartialEq)]
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
            let stiffness = STIFFNESS * area;
            state.push(node, deepest * (stiffness * gap / apart));
            held.force += stiffness * gap;
            held.energy += 0.5 * stiffness * gap * gap;
            held.limit = held.limit.min(2.0 * COURANT * (mass / stiffness).sqrt());
        }
        held
    }
}
