//! Points that move with the eye: a weighted mean of nodes.

use crate::models::spatial::eye::mesh::{Extent, Place};
use crate::models::spatial::eye::{SpatialEye, share_of, shares, upon, within};
use crate::models::spatial::forces::state::vector;
use nalgebra::{Matrix2, Matrix3, Vector2, Vector3};

/// Places or velocities of all nodes, by component.
pub(crate) type Nodes = [Vec<f64>; 3];

/// Steps of Newton's method that leave nothing to be found.
const STEPS: usize = 12;
/// By how much more than its own a cell may take, as a share of it.
const SLACK: f64 = 1e-9;

/// Cosine of the angle from the middle of a quad within which all of it lies.
const NEAR: f64 = 0.8;

/// A point of the eye.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Point {
    shares: Vec<(usize, f64)>,
    /// Whether it lies on the side of the mirror that is not computed.
    mirrored: bool,
}

impl Point {
    /// What it has of a vector of each node.
    pub fn of(&self, nodes: &Nodes) -> Vector3<f64> {
        let each = self.shares.iter().map(|&(node, share)| vector(nodes, node) * share);
        let mut sum: Vector3<f64> = each.sum();
        if self.mirrored {
            sum.z = -sum.z;
        }
        sum
    }
}

impl SpatialEye {
    /// A place as the side that is computed has it.
    fn computed(&self, mut at: Vector3<f64>) -> (Vector3<f64>, bool) {
        let mirrored = self.extent == Extent::Half && at.z < 0.0;
        if mirrored {
            at.z = -at.z;
        }
        (at, mirrored)
    }

    /// The point of the shell in a direction from the middle.
    pub(crate) fn on_shell(&self, direction: Vector3<f64>) -> Option<Point> {
        let (direction, mirrored) = self.computed(direction);
        let mut side = direction.cross(&Vector3::x());
        if side.norm() <= 1e-3 * direction.norm() {
            side = direction.cross(&Vector3::y());
        }
        let up = direction.cross(&side);
        let (side, up) = (side.normalize(), up.normalize());
        self.quads.iter().find_map(|quad| {
            let p = quad.corners.map(|node| self.mesh.at[node]);
            let middle = upon(&p, 0.5, 0.5);
            if middle.dot(&direction) < NEAR * middle.norm() * direction.norm() {
                return None;
            }
            let (mut s, mut t) = (0.5, 0.5);
            for _ in 0..STEPS {
                let at = upon(&p, s, t);
                let ds = upon(&p, 1.0, t) - upon(&p, 0.0, t);
                let dt = upon(&p, s, 1.0) - upon(&p, s, 0.0);
                let slope = Matrix2::new(side.dot(&ds), side.dot(&dt), up.dot(&ds), up.dot(&dt));
                let step = slope.try_inverse()? * Vector2::new(side.dot(&at), up.dot(&at));
                (s, t) = (s - step.x, t - step.y);
            }
            let inside = -SLACK..=1.0 + SLACK;
            let at = upon(&p, s, t);
            let aside = side.dot(&at).abs().max(up.dot(&at).abs());
            let found = aside < SLACK * at.norm() && at.dot(&direction) > 0.0;
            if !(found && inside.contains(&s) && inside.contains(&t)) {
                return None;
            }
            Some(Point { shares: quad.corners.into_iter().zip(shares(s, t)).collect(), mirrored })
        })
    }

    /// The point at a place, and its cell, if some cell is there; of the globe alone if asked for.
    pub(crate) fn at(&self, place: Vector3<f64>, only: Option<Place>) -> Option<(Point, usize)> {
        let (place, mirrored) = self.computed(place);
        self.cells.iter().enumerate().find_map(|(number, cell)| {
            if only.is_some_and(|only| cell.region != only) {
                return None;
            }
            let p = cell.corners.map(|node| self.mesh.at[node]);
            let middle = within(&p, [0.5; 3]);
            let reach = p.iter().map(|p| (p - middle).norm()).fold(0.0, f64::max);
            if (place - middle).norm() > 1.01 * reach {
                return None;
            }
            let mut s = Vector3::repeat(0.5);
            for _ in 0..STEPS {
                let at = |s: Vector3<f64>| within(&p, s.into());
                let along = |bit: usize| {
                    let (mut low, mut high) = (s, s);
                    (low[bit], high[bit]) = (0.0, 1.0);
                    at(high) - at(low)
                };
                let slope = Matrix3::from_columns(&[along(0), along(1), along(2)]);
                s -= slope.try_inverse()? * (at(s) - place);
            }
            let inside = |s: &f64| (-SLACK..=1.0 + SLACK).contains(s);
            let off = (within(&p, s.into()) - place).norm();
            let shares = (0..8).map(|i| (cell.corners[i], share_of(i, s.into()))).collect();
            let found = off <= SLACK * reach && s.iter().all(inside);
            found.then_some((Point { shares, mirrored }, number))
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::models::axisymmetric::eye::parameters::Parameters;

    #[test]
    fn points_lie_where_they_were_asked_for_on_either_side_of_a_mirror() {
        for extent in [Extent::Half, Extent::Full] {
            let eye = SpatialEye::new(&Parameters::default(), None, extent, 1);
            let nodes: Nodes = std::array::from_fn(|k| eye.mesh.at.iter().map(|p| p[k]).collect());
            for i in 0..200 {
                let a = f64::from(i);
                let direction = Vector3::new((1.1 * a).cos(), (0.7 * a).sin(), (1.9 * a).cos());
                let point = eye.on_shell(direction).unwrap();
                let at = point.of(&nodes);
                assert!(at.normalize().cross(&direction.normalize()).norm() < 1e-9);
                assert!(at.norm() > 11.5e-3 && at.norm() <= 12.000_001e-3);
                let place = direction.normalize() * 5e-5 * a;
                let (point, _) = eye.at(place, None).unwrap();
                assert!((point.of(&nodes) - place).norm() < 1e-9, "{i}");
            }
        }
    }
}
