//! How the eye as a whole has changed its shape, its place and its direction.
//!
//! Along and across are those of the way of the blow, as at the axisymmetric eye: the distance of
//! the two poles where its line through the middle meets the shell, the largest width of the shell
//! across it, the length of the shell in the plane of the way and the eye's axis. Straight on that
//! is the same as there.

use crate::models::axisymmetric::recording::account::Shape;
use crate::models::spatial::eye::point::{Nodes, Point};
use crate::models::spatial::{eye::SpatialEye, forces::object::towards};
use nalgebra::{Matrix3, Vector3};
use std::f64::consts::{PI, TAU};

/// Points of a meridian.
const MERIDIAN: usize = 96;
/// Directions across the blow.
const DIRECTIONS: usize = 8;
/// Steps of an iteration that leave nothing to be found.
const STEPS: usize = 12;

/// What the shape is read with.
#[derive(Debug, Clone)]
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
    rest: Rest,
    at: Vec<Vector3<f64>>,
}

/// At rest.
#[derive(Debug, Clone, Copy, Default)]
struct Rest {
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
            rest: Rest::default(),
            at: eye.mesh.at.clone(),
        };
        shapes.rest = Rest {
            length: shapes.length(at),
            meridian: shapes.meridian(at),
            width: shapes.width(at),
            apex: shapes.apex(at),
            lens: shapes.lens(at),
            middle: shapes.middle(at),
        };
        shapes
    }

    fn length(&self, at: &Nodes) -> f64 {
        match &self.poles {
            [Some(front), Some(back)] => (back.of(at) - front.of(at)).dot(&self.way),
            _ => 0.0,
        }
    }

    fn meridian(&self, at: &Nodes) -> f64 {
        let mut sum = 0.0;
        let mut before = self.meridian.last().map_or(Vector3::zeros(), |p| p.of(at));
        for point in &self.meridian {
            let here = point.of(at);
            sum += (here - before).norm();
            before = here;
        }
        sum
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

    fn apex(&self, at: &Nodes) -> Vector3<f64> {
        self.apex.as_ref().map_or(Vector3::zeros(), |p| p.of(at))
    }

    fn lens(&self, at: &Nodes) -> Vector3<f64> {
        let of = |&(node, share): &(usize, f64)| {
            Vector3::new(at[0][node], at[1][node], at[2][node]) * share
        };
        self.lens.iter().map(of).sum()
    }

    /// Middle of the shell's mass.
    pub fn middle(&self, at: &Nodes) -> Vector3<f64> {
        let (mut sum, mut whole) = (Vector3::zeros(), 0.0);
        for &(node, mass) in &self.shell {
            sum += Vector3::new(at[0][node], at[1][node], at[2][node]) * mass;
            whole += mass;
        }
        if self.mirrored {
            sum.z = 0.0;
        }
        sum / whole
    }

    /// How the shape is now.
    pub fn read(&self, at: &Nodes) -> Shape {
        // No part of an eye that nothing holds feels how it flies as a whole.
        let way = if self.free { self.middle(at) - self.rest.middle } else { Vector3::zeros() };
        Shape {
            shortening: 1.0 - self.length(at) / self.rest.length,
            width_growth: self.width(at) / self.rest.width - 1.0,
            shell_growth: self.meridian(at) / self.rest.meridian - 1.0,
            apex: (self.apex(at) - self.rest.apex - way).dot(&self.way),
            lens: (self.lens(at) - self.rest.lens - way).dot(&self.way),
        }
    }

    /// Way of the globe's middle, m, and the angle by which it has turned, rad: that of the turn
    /// nearest to how the shell's places have changed.
    pub fn moved(&self, at: &Nodes) -> (Vector3<f64>, f64) {
        let middle = self.middle(at);
        let mut sum = Matrix3::zeros();
        for &(node, mass) in &self.shell {
            let now = Vector3::new(at[0][node], at[1][node], at[2][node]) - middle;
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
            match turn.transpose().try_inverse() {
                Some(inverse) => turn = (turn + inverse) * 0.5,
                None => break,
            }
        }
        let cosine = 0.5 * (turn.trace() - 1.0);
        let sine = 0.5
            * Vector3::new(
                turn[(2, 1)] - turn[(1, 2)],
                turn[(0, 2)] - turn[(2, 0)],
                turn[(1, 0)] - turn[(0, 1)],
            )
            .norm();
        (middle - self.rest.middle, libm::atan2(sine, cosine))
    }

    /// The nodes of the shell.
    pub fn shell(&self) -> &[(usize, f64)] {
        &self.shell
    }
}
