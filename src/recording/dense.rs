//! Dense output: the motion between two step ends, by quintic Hermite interpolation.
//!
//! Position, velocity and acceleration at both ends fix a polynomial of degree five, whose error is
//! of sixth order in the step. Forces in between are evaluated afresh at interpolated positions,
//! which keeps the peak of a force far more accurate than the largest sample.
//!
//! An interval never spans a break of the load, where the acceleration jumps.

use crate::dynamics::{Piece, State, System};
use crate::eye::Eye;
use nalgebra::{Point2, Vector2};

/// The largest value of something and when it was reached.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Peak {
    /// The value.
    pub value: f64,
    /// When, in s.
    pub time: f64,
}

impl Peak {
    /// A peak that anything at or above `floor` replaces.
    pub fn floor(floor: f64) -> Self {
        Self {
            value: floor,
            time: 0.0,
        }
    }

    /// Takes `value` if it is larger.
    pub fn offer(&mut self, value: f64, time: f64) {
        if value > self.value {
            *self = Self { value, time };
        }
    }
}

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
        let place = system.place(node);
        let h = after.time - before.time;
        let (p0, p1) = (before.position(place), after.position(place));
        let (v0, v1) = (before.velocity(place) * h, after.velocity(place) * h);
        let a0 = before.acceleration(system, place) * (h * h);
        let a1 = after.acceleration(system, place) * (h * h);
        let p = p1 - p0 - v0 - a0 * 0.5;
        let v = v1 - v0 - a0;
        let a = a1 - a0;
        Self {
            origin: p0,
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
pub const MOST_POINTS: usize = 24;

/// Largest value of `f` over shares 0 to 1 of a step, and the share: a scan of `points` intervals,
/// at most [`MOST_POINTS`], then parabolas through the best three points, unless these stay at or
/// below `floor`.
pub fn maximum(points: usize, floor: f64, mut f: impl FnMut(f64) -> f64) -> (f64, f64) {
    let points = points.min(MOST_POINTS);
    let spacing = 1.0 / points as f64;
    let mut samples = [f64::NEG_INFINITY; MOST_POINTS + 1];
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

/// The resultant of everything that acts on one node.
#[derive(Debug, Clone)]
pub struct NodeForce {
    node: usize,
    mass: f64,
    drag: f64,
    /// Other end, stiffness, rest length.
    springs: Vec<(usize, f64, f64)>,
    /// The other ends' paths relative to the node's own; kept so that no step allocates.
    others: Vec<Path>,
    /// Force per N of load.
    load: Vector2<f64>,
}

impl NodeForce {
    /// Everything that acts on node `node` of `eye`; `load` is its share of the load's unit force.
    pub fn new(eye: &Eye, node: usize, load: Vector2<f64>) -> Self {
        let springs: Vec<_> = eye
            .springs
            .iter()
            .filter(|s| s.a == node || s.b == node)
            .map(|s| (s.a + s.b - node, s.stiffness, s.rest_length))
            .collect();
        Self {
            node,
            mass: eye.nodes[node].mass,
            drag: eye.nodes[node].drag,
            others: Vec::with_capacity(springs.len()),
            springs,
            load,
        }
    }

    /// |m a| at a step end, in N.
    pub fn at(&self, system: &System, state: &State) -> f64 {
        self.mass * state.acceleration(system, system.place(self.node)).norm()
    }

    /// A guess at the largest force within a step, from the interpolated acceleration.
    pub fn guess(&self, system: &System, before: &State, after: &State) -> f64 {
        let path = Path::between(system, before, after, self.node);
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
        let path = |node| Path::between(system, before, after, node);
        let own = path(self.node);
        self.others.clear();
        self.others
            .extend(self.springs.iter().map(|s| path(s.0).relative_to(&own)));
        let pulse = &system.load().pulse;
        let h = after.time - before.time;
        let (value, share) = maximum(points, floor, |s| {
            let force = pulse.force(piece, before.time + s * h);
            let mut sum = self.load * force - own.velocity(s) * self.drag;
            for ((_, k, rest), other) in self.springs.iter().zip(&self.others) {
                let d = other.position(s).coords;
                let length = d.norm();
                if length > 0.0 {
                    sum += d * (k * (1.0 - rest / length));
                }
            }
            sum.norm()
        });
        Peak {
            value,
            time: before.time + share * h,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_maximum_of_a_smooth_curve_is_found_between_samples() {
        for top in [0.03, 0.13, 0.5, 0.81, 0.98] {
            let (value, share) = maximum(8, 0.0, |s| {
                2.0 - (s - top) * (s - top) + 0.3 * (s - top).powi(3)
            });
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
