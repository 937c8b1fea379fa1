//! Dense output: the motion between two step ends, by quintic Hermite interpolation.
//!
//! Position, velocity and acceleration at both ends fix a polynomial of degree five, whose error
//! is of sixth order in the step. Forces in between are evaluated afresh at interpolated
//! positions, which keeps the peak of a force far more accurate than the largest sample.
//!
//! An interval never spans a break of the load, where the acceleration jumps.

use crate::models::paper::eye::{Eye, hats, springs::Spring};
use crate::models::paper::forces::{state::State, system::System};
use crate::models::pulse::Piece;
use crate::run::kept::Peak;
use nalgebra::Vector2;

/// One step, from one state to another.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Interval<'a> {
    pub system: &'a System,
    pub before: &'a State,
    pub after: &'a State,
}

impl Interval<'_> {
    /// Its length, in s.
    pub fn length(self) -> f64 {
        self.after.time - self.before.time
    }

    /// The time at a share of it, in s.
    pub fn time(self, share: f64) -> f64 {
        self.before.time + share * self.length()
    }

    /// The path of the weighted sum of some nodes: of their mean, if the weights add up to 1.
    pub fn path(self, nodes: &[(usize, f64)]) -> Path {
        let (system, h) = (self.system, self.length());
        let [[p0, v0, a0], [p1, v1, a1]] = [self.before, self.after].map(|state| {
            [
                hats::sum(nodes, |n| state.position(system.place(n)).coords),
                hats::sum(nodes, |n| state.velocity(system.place(n))),
                hats::sum(nodes, |n| state.acceleration(system, system.place(n))),
            ]
        });
        let (v0, v1) = (v0 * h, v1 * h);
        let (a0, a1) = (a0 * (h * h), a1 * (h * h));
        let p = p1 - p0 - v0 - a0 * 0.5;
        let v = v1 - v0 - a0;
        let a = a1 - a0;
        Path {
            coefficients: [
                p0,
                v0,
                a0 * 0.5,
                p * 10.0 - v * 4.0 + a * 0.5,
                p * -15.0 + v * 7.0 - a,
                p * 6.0 - v * 3.0 + a * 0.5,
            ],
            duration: h,
        }
    }
}

/// The path of a node through one step: a polynomial of the share of the step.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Path {
    coefficients: [Vector2<f64>; 6],
    duration: f64,
}

impl Path {
    /// The path as seen from a node on `other`, over the same step.
    fn relative_to(self, other: &Self) -> Self {
        let coefficients = std::array::from_fn(|i| self.coefficients[i] - other.coefficients[i]);
        Self { coefficients, ..self }
    }

    /// Position at share `s` of the step, in m.
    pub fn position(&self, s: f64) -> Vector2<f64> {
        let [c0, c1, c2, c3, c4, c5] = self.coefficients;
        c0 + (c1 + (c2 + (c3 + (c4 + c5 * s) * s) * s) * s) * s
    }

    /// Velocity at share `s` of the step, in m/s.
    pub fn velocity(&self, s: f64) -> Vector2<f64> {
        let [_, c1, c2, c3, c4, c5] = self.coefficients;
        (c1 + (c2 * 2.0 + (c3 * 3.0 + (c4 * 4.0 + c5 * (5.0 * s)) * s) * s) * s) / self.duration
    }

    /// Acceleration at share `s` of the step, in m/s^2: two orders less accurate than position.
    fn acceleration(&self, s: f64) -> Vector2<f64> {
        let [_, _, c2, c3, c4, c5] = self.coefficients;
        (c2 * 2.0 + (c3 * 6.0 + (c4 * 12.0 + c5 * (20.0 * s)) * s) * s)
            / (self.duration * self.duration)
    }
}

/// Refinement ends when a parabola gains less than an eighth of this share.
const GAIN_LEFT: f64 = 1e-7;

/// Most intervals of a scan.
const MAX_POINTS: usize = 24;

/// Largest value of `f` over shares 0 to 1 of a step, and the share: of at most [`MAX_POINTS`]
/// intervals, then of parabolas through the best three points, unless at or below `floor`.
pub(crate) fn maximum(points: usize, floor: f64, mut f: impl FnMut(f64) -> f64) -> (f64, f64) {
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
pub(crate) struct NodeForce {
    /// Mass of the node in the middle, in kg.
    mass: f64,
    /// Each node's weight times its mass, as a share of `mass`.
    nodes: Vec<(usize, f64)>,
    /// Drag on a node, with the nodes that it acts on and their weights.
    drags: Vec<(f64, Vec<(usize, f64)>)>,
    /// Every node at an end of a spring.
    ends: Vec<usize>,
    /// The springs, with places in `ends`.
    tugs: Vec<Tug>,
    /// Force per N of load.
    load: Vector2<f64>,
}

impl NodeForce {
    /// What acts on `hat` around node `middle`; `load` is its share of the unit force of the load.
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
        let mut tugs = tugs(eye, hat);
        for end in tugs.iter_mut().flat_map(|tug| &mut tug.ends) {
            let place = ends.iter().position(|node| node == end);
            let node = std::mem::replace(end, place.unwrap_or(ends.len()));
            if place.is_none() {
                ends.push(node);
            }
        }
        let weighed = |&(node, weight): &(usize, f64)| (node, weight * eye.nodes[node].mass / mass);
        Self { mass, nodes: hat.iter().map(weighed).collect(), drags, ends, tugs, load }
    }

    /// |sum w m a| at a step end, in N.
    pub fn at(&self, system: &System, state: &State) -> f64 {
        let acceleration = |node| state.acceleration(system, system.place(node));
        self.mass * hats::sum(&self.nodes, acceleration).norm()
    }

    /// A guess at the largest force within a step, from the interpolated acceleration.
    pub fn guess(&self, step: Interval) -> f64 {
        let path = step.path(&self.nodes);
        let forces = [0.25, 0.5, 0.75].map(|s| self.mass * path.acceleration(s).norm());
        forces.into_iter().fold(0.0, f64::max)
    }

    /// Largest force within a step by the load law `piece`, in N, and when, in s: a scan of
    /// `points` intervals, refined if it finds more than `floor`.
    pub fn largest(&self, step: Interval, piece: Piece, points: usize, floor: f64) -> Peak {
        let dragged: Vec<_> = self.drags.iter().map(|(d, nodes)| (*d, step.path(nodes))).collect();
        let paths: Vec<_> = self.ends.iter().map(|&node| step.path(&[(node, 1.0)])).collect();
        let span = |tug: &Tug| paths[tug.ends[1]].relative_to(&paths[tug.ends[0]]);
        let spans: Vec<_> = self.tugs.iter().map(span).collect();
        let (value, share) = maximum(points, floor, |s| {
            let mut sum = self.load * step.system.pulse.force(piece, step.time(s));
            for (drag, path) in &dragged {
                sum -= path.velocity(s) * *drag;
            }
            for (tug, span) in self.tugs.iter().zip(&spans) {
                let d = span.position(s);
                let length = d.norm();
                if length > 0.0 {
                    sum += d * (tug.stiffness * (1.0 - tug.rest_length / length));
                }
            }
            sum.norm()
        });
        Peak { value, time: step.time(share) }
    }
}

/// A spring that pulls on a hat.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Tug {
    /// The end of larger weight and the other.
    pub ends: [usize; 2],
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
            ends: if difference > 0.0 { [s.a, s.b] } else { [s.b, s.a] },
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
    fn a_maximum_is_found_between_samples_and_of_a_monotonic_curve_at_an_end() {
        for top in [0.03, 0.13, 0.5, 0.81, 0.98] {
            let (value, share) =
                maximum(8, 0.0, |s| 2.0 - (s - top) * (s - top) + 0.3 * (s - top).powi(3));
            assert!((share - top).abs() < 1e-4, "{share}");
            assert!((value - 2.0).abs() < 1e-8);
        }
        assert_eq!(maximum(8, 0.0, |s| s), (1.0, 1.0));
        assert_eq!(maximum(8, 0.0, |s| -s), (0.0, 0.0));
    }
}
