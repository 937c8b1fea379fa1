//! How the eye as a whole has changed its shape, its place and its direction.
//!
//! Along and across are those of the way of the blow, as at the axisymmetric eye: the distance of
//! the two poles where its line through the middle meets the shell, the largest width of the shell
//! across it, the length of the shell in the plane of the way and the eye's axis. Straight on that
//! is the same as there.

use crate::models::axisymmetric::recording::account::Shape;
use crate::models::spatial::eye::SpatialEye;
use crate::models::spatial::eye::point::{Nodes, Point};
use crate::models::spatial::forces::{object::towards, state::vector};
use nalgebra::{Matrix3, Vector3};
use std::f64::consts::{PI, TAU};

/// Points of a meridian.
const MERIDIAN: usize = 96;
/// Directions across the blow.
const DIRECTIONS: usize = 8;
/// Steps of an iteration that leave nothing to be found.
const STEPS: usize = 12;

/// What the shape is read with.
pub(crate) struct Shapes {
    way: Vector3<f64>,
    /// Front pole of the eye, and both poles along the way.
    apex: Option<Point>,
    poles: [Option<Point>; 2],
    meridian: Vec<Point>,
    /// Nodes of the shell, with their mass.
    shell: Vec<(usize, f64)>,
    directions: Vec<Vector3<f64>>,
    /// Node and share of the lens's mass.
    lens: Vec<(usize, f64)>,
    /// Whether nothing holds the eye.
    free: bool,
    mirrored: bool,
    rest: Measures,
    at: Vec<Vector3<f64>>,
}

/// What a shape is told by: lengths and places, in m.
#[derive(Debug, Clone, Copy, Default)]
struct Measures {
    length: f64,
    meridian: f64,
    width: f64,
    apex: Vector3<f64>,
    lens: Vector3<f64>,
    middle: Vector3<f64>,
}

impl Shapes {
    pub fn new(eye: &SpatialEye, at: &Nodes, way: Vector3<f64>, plane: f64) -> Self {
        let aside = towards(plane);
        let meridian = (0..MERIDIAN).filter_map(|i| {
            let angle = TAU * i as f64 / MERIDIAN as f64;
            eye.on_shell(Vector3::x() * libm::cos(angle) + aside * libm::sin(angle))
        });
        let across = aside - way * way.dot(&aside);
        let across =
            if across.norm() > 1e-9 { across.normalize() } else { Vector3::x().cross(&aside) };
        let other = way.cross(&across);
        let directions = (0..DIRECTIONS).map(|i| {
            let angle = PI * i as f64 / DIRECTIONS as f64;
            across * libm::cos(angle) + other * libm::sin(angle)
        });
        let mut lens = std::collections::BTreeMap::<usize, f64>::new();
        for cell in eye.cells.iter().filter(|cell| cell.lens > 0.0) {
            for node in cell.corners {
                *lens.entry(node).or_default() += cell.lens * eye.mass[node];
            }
        }
        let total: f64 = lens.values().sum();
        let mut shell: Vec<usize> = eye.quads.iter().flat_map(|quad| quad.corners).collect();
        shell.sort_unstable();
        shell.dedup();
        let mut shapes = Self {
            way,
            apex: eye.on_shell(-Vector3::x()),
            poles: [eye.on_shell(-way), eye.on_shell(way)],
            meridian: meridian.collect(),
            shell: shell.into_iter().map(|node| (node, eye.mass[node])).collect(),
            directions: directions.collect(),
            lens: lens.into_iter().map(|(node, m)| (node, m / total)).collect(),
            free: eye.parameters.surround.is_none(),
            mirrored: eye.copies() > 1.0,
            rest: Measures::default(),
            at: eye.mesh.at.clone(),
        };
        shapes.rest = shapes.measures(at);
        shapes
    }

    fn measures(&self, at: &Nodes) -> Measures {
        let mut meridian = 0.0;
        let mut before = self.meridian.last().map_or(Vector3::zeros(), |p| p.of(at));
        for point in &self.meridian {
            let here = point.of(at);
            meridian += (here - before).norm();
            before = here;
        }
        Measures {
            length: match &self.poles {
                [Some(front), Some(back)] => (back.of(at) - front.of(at)).dot(&self.way),
                _ => 0.0,
            },
            meridian,
            width: self.width(at),
            apex: self.apex.as_ref().map_or(Vector3::zeros(), |p| p.of(at)),
            lens: self.lens.iter().map(|&(node, share)| vector(at, node) * share).sum(),
            middle: self.middle(at),
        }
    }

    fn width(&self, at: &Nodes) -> f64 {
        let mut widest = 0.0_f64;
        for e in &self.directions {
            let (mut least, mut most) = (f64::INFINITY, f64::NEG_INFINITY);
            for &(node, _) in &self.shell {
                let plane = at[0][node] * e.x + at[1][node] * e.y;
                let aside = at[2][node] * e.z;
                let (low, high) = if self.mirrored {
                    (plane - aside.abs(), plane + aside.abs())
                } else {
                    (plane + aside, plane + aside)
                };
                least = least.min(low);
                most = most.max(high);
            }
            widest = widest.max(most - least);
        }
        widest
    }

    /// Middle of the shell's mass.
    pub fn middle(&self, at: &Nodes) -> Vector3<f64> {
        let (mut sum, mut whole) = (Vector3::zeros(), 0.0);
        for &(node, mass) in &self.shell {
            sum += vector(at, node) * mass;
            whole += mass;
        }
        if self.mirrored {
            sum.z = 0.0;
        }
        sum / whole
    }

    /// How the shape is now.
    pub fn read(&self, at: &Nodes) -> Shape {
        let (now, rest) = (self.measures(at), &self.rest);
        // No part of an eye that nothing holds feels how it flies as a whole.
        let way = if self.free { now.middle - rest.middle } else { Vector3::zeros() };
        Shape {
            shortening: 1.0 - now.length / rest.length,
            width_growth: now.width / rest.width - 1.0,
            shell_growth: now.meridian / rest.meridian - 1.0,
            apex: (now.apex - rest.apex - way).dot(&self.way),
            lens: (now.lens - rest.lens - way).dot(&self.way),
        }
    }

    /// Way of the globe's middle, m, and the angle of the turn nearest to how its shell moved, rad.
    pub fn moved(&self, at: &Nodes) -> (Vector3<f64>, f64) {
        let middle = self.middle(at);
        let mut sum = Matrix3::zeros();
        for &(node, mass) in &self.shell {
            let now = vector(at, node) - middle;
            sum += (now * mass) * (self.at[node] - self.rest.middle).transpose();
        }
        if self.mirrored {
            for i in 0..2 {
                (sum[(i, 2)], sum[(2, i)]) = (0.0, 0.0);
            }
        }
        // The mean of a matrix and the inverse of its transpose comes to its turn.
        let mut turn = sum * (3.0 / sum.trace().abs().max(f64::MIN_POSITIVE));
        for _ in 0..STEPS {
            let Some(inverse) = turn.transpose().try_inverse() else { break };
            turn = (turn + inverse) * 0.5;
        }
        let cosine = 0.5 * (turn.trace() - 1.0);
        let twice = [(2, 1), (0, 2), (1, 0)].map(|(i, k)| turn[(i, k)] - turn[(k, i)]);
        let sine = 0.5 * Vector3::from(twice).norm();
        (middle - self.rest.middle, libm::atan2(sine, cosine))
    }

    pub fn shell(&self) -> &[(usize, f64)] {
        &self.shell
    }
}
