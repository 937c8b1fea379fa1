//! Smooth quantities of the whole shape: shell length, vertical diameter, apex displacement.
//!
//! Each is a function of positions whose rate of change is known at step ends, so a maximum inside
//! a step shows as a rate that turns from positive to negative.

use crate::models::paper::recording::dense::{Path, maximum};
use crate::models::paper::recording::settling::Bend;
use crate::models::paper::{
    eye::Eye, eye::hats::Hat, forces::state::State, forces::system::System,
};
use crate::run::kept::Peak;
use nalgebra::Vector2;

/// Points tried within a step before parabolas take over.
const SCAN: usize = 4;
/// A step is searched if one of its ends comes this close to the largest growth so far.
const NEAR: f64 = 0.9;

/// What is measured of points.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum LengthKind {
    /// Length of the closed line through them.
    Ring,
    /// Distance between two.
    Span,
    /// Mean x of all.
    MeanX,
}

/// A point that moves with some nodes.
#[derive(Debug, Clone)]
pub struct LinePoint {
    /// Where it is when the weighted sum of the nodes' positions is 0, in m.
    base: Vector2<f64>,
    /// Nodes with weights that add up to 1.
    nodes: Hat,
}

impl LinePoint {
    /// The mean position of the nodes.
    pub fn mean(nodes: Hat) -> Self {
        Self { base: Vector2::zeros(), nodes }
    }

    /// The place of `middle`, moved by the mean displacement of the nodes.
    pub fn displaced(eye: &Eye, middle: usize, nodes: Hat) -> Self {
        let at = |node: usize| eye.nodes[node].position.coords;
        Self { base: at(middle) - sum(&nodes, at), nodes }
    }
}

/// The weighted sum of something of each node.
fn sum(nodes: &[(usize, f64)], of: impl Fn(usize) -> Vector2<f64>) -> Vector2<f64> {
    let mut sum = Vector2::zeros();
    for &(node, weight) in nodes {
        sum += of(node) * weight;
    }
    sum
}

/// The measure of points at `point`, in order.
fn value(kind: LengthKind, mut points: impl ExactSizeIterator<Item = Vector2<f64>>) -> f64 {
    let count = points.len();
    match kind {
        LengthKind::MeanX => points.map(|p| p.x).sum::<f64>() / count as f64,
        LengthKind::Ring | LengthKind::Span => {
            let Some(first) = points.next() else {
                return 0.0;
            };
            let (mut before, mut length) = (first, 0.0);
            for point in points {
                length += (point - before).norm();
                before = point;
            }
            if kind == LengthKind::Ring {
                length += (first - before).norm();
            }
            length
        }
    }
}

/// Its rate of change, from positions and velocities.
fn rate(
    kind: LengthKind,
    mut points: impl ExactSizeIterator<Item = (Vector2<f64>, Vector2<f64>)>,
) -> f64 {
    let count = points.len();
    let between = |(a, va): (Vector2<f64>, Vector2<f64>), (b, vb): (Vector2<f64>, Vector2<f64>)| {
        let d = b - a;
        let length = d.norm();
        if length > 0.0 {
            d.dot(&(vb - va)) / length
        } else {
            // Two points in one place have no direction; their length cannot shrink.
            0.0
        }
    };
    match kind {
        LengthKind::MeanX => points.map(|(_, v)| v.x).sum::<f64>() / count as f64,
        LengthKind::Ring | LengthKind::Span => {
            let Some(first) = points.next() else {
                return 0.0;
            };
            let (mut before, mut rate) = (first, 0.0);
            for point in points {
                rate += between(before, point);
                before = point;
            }
            if kind == LengthKind::Ring {
                rate += between(before, first);
            }
            rate
        }
    }
}

/// Follows one measure and keeps its largest growth over the value at rest.
#[derive(Debug, Clone)]
pub struct Growth {
    kind: LengthKind,
    points: Vec<LinePoint>,
    rest: f64,
    last: f64,
    /// Largest growth, in m; 0 if it never grows.
    pub peak: Peak,
    rising: bool,
    /// Rate of change at the last step end, if it was needed.
    last_rate: Option<f64>,
}

impl Growth {
    /// Follows `kind` of `points` from the shape that `state` has.
    pub fn new(kind: LengthKind, points: Vec<LinePoint>, system: &System, state: &State) -> Self {
        let mut growth = Self {
            kind,
            points,
            rest: 0.0,
            last: 0.0,
            peak: Peak::floor(0.0),
            rising: false,
            last_rate: None,
        };
        growth.rest = growth.value(system, state);
        growth
    }

    /// Value at rest, in m.
    pub fn rest(&self) -> f64 {
        self.rest
    }

    /// Growth at the last step end, in m.
    pub fn last(&self) -> f64 {
        self.last
    }

    /// Whether the largest growth was the last one seen.
    pub fn still_rising(&self) -> bool {
        self.rising
    }

    /// Looks at the step from `before` to `after`, at whose end the measure is `value`, if that is
    /// known already.
    pub fn step(&mut self, system: &System, before: &State, after: &State, value: Option<f64>) {
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
                self.search(system, before, after);
            }
        }
    }

    fn value(&self, system: &System, state: &State) -> f64 {
        let position = |n| state.position(system.place(n)).coords;
        let points = self.points.iter();
        value(self.kind, points.map(|p| p.base + sum(&p.nodes, position)))
    }

    /// How sharply the closed line bends in `state`.
    pub(crate) fn bend(&self, system: &System, state: &State) -> Bend {
        let mut bend = Bend { sharpest: 0.0, shortest: f64::INFINITY };
        let position = |n| state.position(system.place(n)).coords;
        let corner = |i: usize| {
            let point = &self.points[i % self.points.len()];
            point.base + sum(&point.nodes, position)
        };
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

    fn rate(&self, system: &System, state: &State) -> f64 {
        let position = |n| state.position(system.place(n)).coords;
        let velocity = |n| state.velocity(system.place(n));
        let moving = |p: &LinePoint| (p.base + sum(&p.nodes, position), sum(&p.nodes, velocity));
        rate(self.kind, self.points.iter().map(moving))
    }

    fn search(&mut self, system: &System, before: &State, after: &State) {
        let path = |p: &LinePoint| (p.base, Path::of(system, before, after, &p.nodes));
        let paths: Vec<(Vector2<f64>, Path)> = self.points.iter().map(path).collect();
        let (found, share) = maximum(SCAN, f64::NEG_INFINITY, |s| {
            let points = paths.iter().map(|(base, p)| base + p.position(s).coords);
            value(self.kind, points)
        });
        let time = before.time + share * (after.time - before.time);
        self.peak.offer(found - self.rest, time);
    }
}
