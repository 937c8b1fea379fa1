//! Smooth quantities of the whole shape: shell length, vertical diameter, apex displacement.
//!
//! Each is a function of positions whose rate of change is known at step ends, so a maximum inside
//! a step shows as a rate that turns from positive to negative.

use crate::models::paper::eye::hats::{self, Hat};
use crate::models::paper::forces::{state::State, system::System};
use crate::models::paper::recording::dense::{Interval, Path, maximum};
use crate::models::paper::{eye::Eye, recording::settling::Bend};
use crate::run::kept::Peak;
use nalgebra::Vector2;

/// Points tried within a step before parabolas take over.
const SCAN: usize = 4;
/// A step is searched if one of its ends comes this close to the largest growth so far.
const NEAR: f64 = 0.9;

/// What is measured of points.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum LengthKind {
    /// Length of the closed line through them.
    Ring,
    /// Distance between two.
    Span,
    /// Mean x of all.
    MeanX,
}

/// A point that moves with some nodes.
#[derive(Debug, Clone)]
pub(crate) struct LinePoint {
    /// Where it is when the weighted sum of the nodes' positions is 0, in m.
    pub base: Vector2<f64>,
    /// Nodes with weights that add up to 1.
    pub nodes: Hat,
}

impl LinePoint {
    /// The place of `middle`, moved by the mean displacement of the nodes.
    pub fn displaced(eye: &Eye, middle: usize, nodes: Hat) -> Self {
        let at = |node: usize| eye.nodes[node].position.coords;
        Self { base: at(middle) - hats::sum(&nodes, at), nodes }
    }

    fn position(&self, system: &System, state: &State) -> Vector2<f64> {
        self.base + hats::sum(&self.nodes, |n| state.position(system.place(n)).coords)
    }

    fn velocity(&self, system: &System, state: &State) -> Vector2<f64> {
        hats::sum(&self.nodes, |n| state.velocity(system.place(n)))
    }
}

/// A measure of points: the mean of `x`, or what `between` tells of each two neighbours, summed.
fn measured<P: Copy>(
    kind: LengthKind,
    mut points: impl ExactSizeIterator<Item = P>,
    x: impl Fn(P) -> f64,
    between: impl Fn(P, P) -> f64,
) -> f64 {
    let count = points.len();
    if kind == LengthKind::MeanX {
        return points.map(x).sum::<f64>() / count as f64;
    }
    let Some(first) = points.next() else { return 0.0 };
    let (mut before, mut sum) = (first, 0.0);
    for point in points {
        sum += between(before, point);
        before = point;
    }
    if kind == LengthKind::Ring {
        sum += between(before, first);
    }
    sum
}

/// The measure of points at `point`, in order.
fn value(kind: LengthKind, points: impl ExactSizeIterator<Item = Vector2<f64>>) -> f64 {
    measured(kind, points, |p| p.x, |a, b| (b - a).norm())
}

/// Follows one measure and keeps its largest growth over the value at rest.
#[derive(Debug, Clone)]
pub(crate) struct Growth {
    kind: LengthKind,
    points: Vec<LinePoint>,
    /// Value at rest, in m.
    rest: f64,
    /// Growth at the last step end, in m.
    pub last: f64,
    /// Largest growth, in m; 0 if it never grows.
    pub peak: Peak,
    /// Whether that was the last one seen.
    pub rising: bool,
    /// Rate of change at the last step end, if it was needed.
    last_rate: Option<f64>,
}

impl Growth {
    /// Follows `kind` of `points` from the shape that `state` has.
    pub fn new(kind: LengthKind, points: Vec<LinePoint>, system: &System, state: &State) -> Self {
        let rest = value(kind, points.iter().map(|point| point.position(system, state)));
        let (peak, last_rate) = (Peak::default(), None);
        Self { kind, points, rest, last: 0.0, peak, rising: false, last_rate }
    }

    /// The largest growth as a share of the value at rest.
    pub fn largest_share(&self) -> Peak {
        Peak { value: self.peak.value / self.rest, ..self.peak }
    }

    /// The last growth as a share of the value at rest.
    pub fn last_share(&self) -> f64 {
        self.last / self.rest
    }

    /// Looks at a step, at whose end the measure is `value`, if that is known already.
    pub fn step(&mut self, step: Interval, value: Option<f64>) {
        let Interval { system, before, after } = step;
        let value = value.unwrap_or_else(|| self.value(system, after));
        let now = value - self.rest;
        let earlier = std::mem::replace(&mut self.last, now);
        self.rising = now > self.peak.value;
        self.peak.offer(now, after.time);
        let near = NEAR * self.peak.value;
        let earlier_rate = self.last_rate.take();
        if self.peak.value > 0.0 && earlier.max(now) >= near {
            let rate = self.rate(system, after);
            self.last_rate = Some(rate);
            let was_rising = || earlier_rate.unwrap_or_else(|| self.rate(system, before)) > 0.0;
            if rate < 0.0 && was_rising() {
                self.search(step);
            }
        }
    }

    fn value(&self, system: &System, state: &State) -> f64 {
        value(self.kind, self.points.iter().map(|point| point.position(system, state)))
    }

    /// How sharply the closed line bends in `state`.
    pub fn bend(&self, system: &System, state: &State) -> Bend {
        let mut bend = Bend { sharpest: 0.0, shortest: f64::INFINITY };
        let corner = |i: usize| self.points[i % self.points.len()].position(system, state);
        let mut from = corner(0);
        let mut before: Option<Vector2<f64>> = None;
        // Twice the first side, so that every corner is between two.
        for i in 1..self.points.len() + 2 {
            let to = corner(i);
            let side = to - from;
            bend.shortest = bend.shortest.min(side.norm());
            let direction = side / side.norm();
            let turn = before.map_or(0.0, |before| (direction - before).norm());
            bend.sharpest = if turn >= 0.0 { bend.sharpest.max(turn) } else { 2.0 };
            (from, before) = (to, Some(direction));
        }
        bend
    }

    /// The rate of change.
    fn rate(&self, system: &System, state: &State) -> f64 {
        let moving = |p: &LinePoint| (p.position(system, state), p.velocity(system, state));
        let points = self.points.iter().map(moving);
        measured(
            self.kind,
            points,
            |(_, v)| v.x,
            |(a, va), (b, vb)| {
                let d = b - a;
                let length = d.norm();
                // Two points in one place have no direction; their length cannot shrink.
                if length > 0.0 { d.dot(&(vb - va)) / length } else { 0.0 }
            },
        )
    }

    fn search(&mut self, step: Interval) {
        let path = |p: &LinePoint| (p.base, step.path(&p.nodes));
        let paths: Vec<(Vector2<f64>, Path)> = self.points.iter().map(path).collect();
        let (found, share) = maximum(SCAN, f64::NEG_INFINITY, |s| {
            value(self.kind, paths.iter().map(|(base, path)| base + path.position(s)))
        });
        self.peak.offer(found - self.rest, step.time(share));
    }
}
