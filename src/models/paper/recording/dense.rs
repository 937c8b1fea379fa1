//! Dense output: the motion between two step ends, by quintic Hermite interpolation.
//!
//! Position, velocity and acceleration at both ends fix a polynomial of degree five, whose error
//! is of sixth order in the step. Forces in between are evaluated afresh at interpolated
//! positions, which keeps the peak of a force far more accurate than the largest sample.
//!
//! An interval never spans a break of the load, where the acceleration jumps.

use crate::models::paper::forces::system::System;
use crate::models::paper::{eye::Eye, eye::springs::Spring, forces::state::State};
use crate::models::pulse::Piece;
use crate::run::kept::Peak;
use nalgebra::{Point2, Vector2};

/// The path of one node through one step.
#[derive(Debug, Clone, Copy)]
pub struct Path {
    origin: Point2<f64>,
    coefficients: [Vector2<f64>; 5],
    duration: f64,
}

impl Path {
    /// The path of node `node` from `before` to `after`.
    pub fn between(system: &System, before: &State, after: &State, node: usize) -> Self {
        Self::of(system, before, after, &[(node, 1.0)])
    }

    /// The path of the sum of some nodes, each times its weight: of their mean, if the weights add
    /// up to 1.
    pub fn of(system: &System, before: &State, after: &State, nodes: &[(usize, f64)]) -> Self {
        let h = after.time - before.time;
        let mut ends = [[Vector2::zeros(); 3]; 2];
        for &(node, weight) in nodes {
            let place = system.place(node);
            for (end, state) in ends.iter_mut().zip([before, after]) {
                end[0] += state.position(place).coords * weight;
                end[1] += state.velocity(place) * weight;
                end[2] += state.acceleration(system, place) * weight;
            }
        }
        let [[p0, v0, a0], [p1, v1, a1]] = ends;
        let (v0, v1) = (v0 * h, v1 * h);
        let (a0, a1) = (a0 * (h * h), a1 * (h * h));
        let p = p1 - p0 - v0 - a0 * 0.5;
        let v = v1 - v0 - a0;
        let a = a1 - a0;
        Self {
            origin: Point2::from(p0),
            coefficients: [
                v0,
                a0 * 0.5,
                p * 10.0 - v * 4.0 + a * 0.5,
                p * -15.0 + v * 7.0 - a,
                p * 6.0 - v * 3.0 + a * 0.5,
            ],
            duration: h,
        }
    }

    /// The path as seen from a node on `other`, over the same step.
    fn relative_to(self, other: &Self) -> Self {
        Self {
            origin: Point2::from(self.origin - other.origin),
            coefficients: std::array::from_fn(|i| self.coefficients[i] - other.coefficients[i]),
            duration: self.duration,
        }
    }

    /// Position at share `s` of the step, in m.
    pub fn position(&self, s: f64) -> Point2<f64> {
        let [c1, c2, c3, c4, c5] = self.coefficients;
        self.origin + (c1 + (c2 + (c3 + (c4 + c5 * s) * s) * s) * s) * s
    }

    /// Velocity at share `s` of the step, in m/s.
    pub fn velocity(&self, s: f64) -> Vector2<f64> {
        let [c1, c2, c3, c4, c5] = self.coefficients;
        (c1 + (c2 * 2.0 + (c3 * 3.0 + (c4 * 4.0 + c5 * (5.0 * s)) * s) * s) * s) / self.duration
    }

    /// Acceleration at share `s` of the step, in m/s^2: two orders less accurate than position.
    pub fn acceleration(&self, s: f64) -> Vector2<f64> {
        let [_, c2, c3, c4, c5] = self.coefficients;
        (c2 * 2.0 + (c3 * 6.0 + (c4 * 12.0 + c5 * (20.0 * s)) * s) * s)
            / (self.duration * self.duration)
    }
}

/// Refinement ends when a parabola gains less than an eighth of this share.
const GAIN_LEFT: f64 = 1e-7;

/// Most intervals of a scan.
pub const MAX_POINTS: usize = 24;

/// Largest value of `f` over shares 0 to 1 of a step, and the share: a scan of `points` intervals,
/// at most [`MAX_POINTS`], then parabolas through the best three points, unless these stay at or
/// below `floor`.
pub fn maximum(points: usize, floor: f64, mut f: impl FnMut(f64) -> f64) -> (f64, f64) {
    let points = points.min(MAX_POINTS);
    let spacing = 1.0 / points as f64;
    let mut samples = [f64::NEG_INFINITY; MAX_POINTS + 1];
    let mut best = 0;
    for i in 0..=points {
        samples[i] = f(i as f64 * spacing);
        if samples[i] >= samples[best] {
            best = i;
        }
    }
    let mut top = (samples[best], best as f64 * spacing);
    if top.0 <= floor {
        return top;
    }
    // The top may lie between an end and its neighbour; then three points bend to it.
    let middle = best.clamp(1, points - 1);
    let (mut left, mut mid, mut right) =
        (samples[middle - 1], samples[middle], samples[middle + 1]);
    let bend = left - 2.0 * mid + right;
    if middle != best && (bend >= 0.0 || (0.5 * (left - right) / bend).abs() >= 1.0) {
        return top;
    }
    let (mut centre, mut reach) = (middle as f64 * spacing, spacing);
    for _ in 0..3 {
        let bend = left - 2.0 * mid + right;
        if bend >= 0.0 {
            break;
        }
        let slope = left - right;
        let shift = (0.5 * slope / bend).clamp(-1.0, 1.0) * reach;
        centre = (centre + shift).clamp(0.0, 1.0);
        reach *= 0.25;
        mid = f(centre);
        if mid > top.0 {
            top = (mid, centre);
        }
        // What the last parabola promised to gain is what the next may be wrong by.
        if slope * slope < -GAIN_LEFT * bend * top.0.abs() {
            break;
        }
        left = f((centre - reach).max(0.0));
        right = f((centre + reach).min(1.0));
    }
    top
}

/// The resultant of everything that acts on the tissue around a node: the sum of w m a over its
/// hat.
///
/// Only springs that leave the hat or change the weight within it count; at level 1 these are
/// those of the node.
#[derive(Debug, Clone)]
pub struct NodeForce {
    /// Mass of the node in the middle, in kg.
    mass: f64,
    /// Each node's weight times its mass, as a share of `mass`.
    nodes: Vec<(usize, f64)>,
    /// Drag on a node, with the nodes that it acts on and their weights.
    drags: Vec<(f64, Vec<(usize, f64)>)>,
    /// Every node at an end of a spring.
    ends: Vec<usize>,
    /// Places in `ends`, the heavier first; stiffness times difference of weights; rest length.
    springs: Vec<((usize, usize), f64, f64)>,
    /// Paths of the drags' nodes, of all ends, and of the springs from end to end; kept so that no
    /// step allocates.
    dragged: Vec<(f64, Path)>,
    paths: Vec<Path>,
    spans: Vec<Path>,
    /// Force per N of load.
    load: Vector2<f64>,
}

impl NodeForce {
    /// Everything that acts on `hat`, around node `middle` of `eye`; `load` is its share of the
    /// load's unit force.
    pub fn new(eye: &Eye, middle: usize, hat: &[(usize, f64)], load: Vector2<f64>) -> Self {
        let mass = eye.nodes[middle].mass;
        let mut drags: Vec<(f64, Vec<(usize, f64)>)> = Vec::new();
        for &(node, weight) in hat {
            let drag = eye.nodes[node].drag;
            match drags.iter_mut().find(|(d, _)| *d == drag) {
                Some((_, nodes)) => nodes.push((node, weight)),
                None => drags.push((drag, vec![(node, weight)])),
            }
        }
        let mut ends: Vec<usize> = hat.iter().map(|(node, _)| *node).collect();
        let mut place = |node| {
            ends.iter().position(|&n| n == node).unwrap_or_else(|| {
                ends.push(node);
                ends.len() - 1
            })
        };
        let springs: Vec<_> = tugs(eye, hat)
            .into_iter()
            .map(|tug| {
                let ends = (place(tug.ends.0), place(tug.ends.1));
                (ends, tug.stiffness, tug.rest_length)
            })
            .collect();
        Self {
            mass,
            nodes: hat
                .iter()
                .map(|&(node, weight)| (node, weight * eye.nodes[node].mass / mass))
                .collect(),
            dragged: Vec::with_capacity(drags.len()),
            drags,
            paths: Vec::with_capacity(ends.len()),
            ends,
            spans: Vec::with_capacity(springs.len()),
            springs,
            load,
        }
    }

    /// |sum w m a| at a step end, in N.
    pub fn at(&self, system: &System, state: &State) -> f64 {
        let mut sum = Vector2::zeros();
        for &(node, share) in &self.nodes {
            sum += state.acceleration(system, system.place(node)) * share;
        }
        self.mass * sum.norm()
    }

    /// A guess at the largest force within a step, from the interpolated acceleration.
    pub fn guess(&self, system: &System, before: &State, after: &State) -> f64 {
        let path = Path::of(system, before, after, &self.nodes);
        [0.25, 0.5, 0.75]
            .iter()
            .map(|&s| self.mass * path.acceleration(s).norm())
            .fold(0.0, f64::max)
    }

    /// Largest force within a step by the load law `piece`, in N, and when, in s: a scan of
    /// `points` intervals, refined if it finds more than `floor`.
    pub fn largest(
        &mut self,
        system: &System,
        (before, after): (&State, &State),
        piece: Piece,
        (points, floor): (usize, f64),
    ) -> Peak {
        let path = |nodes: &[(usize, f64)]| Path::of(system, before, after, nodes);
        self.dragged.clear();
        let drags = self.drags.iter().map(|(drag, nodes)| (*drag, path(nodes)));
        self.dragged.extend(drags);
        self.paths.clear();
        self.paths.extend(self.ends.iter().map(|&n| path(&[(n, 1.0)])));
        self.spans.clear();
        let paths = &self.paths;
        let spans = self.springs.iter().map(|((a, b), ..)| paths[*b].relative_to(&paths[*a]));
        self.spans.extend(spans);
        let pulse = &system.load().pulse;
        let h = after.time - before.time;
        let (value, share) = maximum(points, floor, |s| {
            let force = pulse.force(piece, before.time + s * h);
            let mut sum = self.load * force;
            for (drag, path) in &self.dragged {
                sum -= path.velocity(s) * *drag;
            }
            for ((_, k, rest), span) in self.springs.iter().zip(&self.spans) {
                let d = span.position(s).coords;
                let length = d.norm();
                if length > 0.0 {
                    sum += d * (k * (1.0 - rest / length));
                }
            }
            sum.norm()
        });
        Peak { value, time: before.time + share * h }
    }
}

/// A spring that pulls on a hat.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Tug {
    /// The end of larger weight and the other.
    pub ends: (usize, usize),
    /// Stiffness times the difference of weights, in N/m.
    pub stiffness: f64,
    /// Stiffness times the square of that difference, in N/m.
    pub squared: f64,
    /// Length at rest, in m.
    pub rest_length: f64,
}

/// The springs whose pull does not cancel in the sum over `hat`.
pub(crate) fn tugs(eye: &Eye, hat: &[(usize, f64)]) -> Vec<Tug> {
    let mut weights = vec![0.0; eye.nodes.len()];
    for &(node, weight) in hat {
        weights[node] = weight;
    }
    let tug = |s: &Spring| {
        let difference: f64 = weights[s.a] - weights[s.b];
        (difference != 0.0).then(|| Tug {
            ends: if difference > 0.0 { (s.a, s.b) } else { (s.b, s.a) },
            stiffness: s.stiffness * difference.abs(),
            squared: s.stiffness * (difference * difference),
            rest_length: s.rest_length,
        })
    };
    eye.springs.iter().filter_map(tug).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_maximum_of_a_smooth_curve_is_found_between_samples() {
        for top in [0.03, 0.13, 0.5, 0.81, 0.98] {
            let (value, share) =
                maximum(8, 0.0, |s| 2.0 - (s - top) * (s - top) + 0.3 * (s - top).powi(3));
            assert!((share - top).abs() < 1e-4, "{share}");
            assert!((value - 2.0).abs() < 1e-8);
        }
    }

    #[test]
    fn a_monotonic_curve_has_its_maximum_at_an_end() {
        assert_eq!(maximum(8, 0.0, |s| s), (1.0, 1.0));
        assert_eq!(maximum(8, 0.0, |s| -s), (0.0, 0.0));
    }
}
