//! Smooth quantities of the whole shape: shell length, vertical diameter, apex displacement.
//!
//! Each is a function of positions whose rate of change is known at step ends, so a maximum inside
//! a step shows as a rate that turns from positive to negative.

use super::dense::{Path, Peak, maximum};
use crate::dynamics::{State, System};
use nalgebra::{Point2, Vector2};

/// Points tried within a step before parabolas take over.
const SCAN: usize = 4;
/// A step is searched if one of its ends comes this close to the largest growth so far.
const NEAR: f64 = 0.9;

/// What is measured.
#[derive(Debug, Clone)]
pub enum Measure {
    /// Summed distance over pairs of nodes.
    Length(Vec<(usize, usize)>),
    /// Mean x of some nodes.
    MeanX(Vec<usize>),
}

impl Measure {
    fn value(&self, position: impl Fn(usize) -> Point2<f64>) -> f64 {
        match self {
            Self::Length(pairs) => pairs
                .iter()
                .map(|&(a, b)| (position(b) - position(a)).norm())
                .sum(),
            Self::MeanX(nodes) => {
                nodes.iter().map(|&n| position(n).x).sum::<f64>() / nodes.len() as f64
            }
        }
    }

    fn rate(
        &self,
        position: impl Fn(usize) -> Point2<f64>,
        velocity: impl Fn(usize) -> Vector2<f64>,
    ) -> f64 {
        match self {
            Self::Length(pairs) => pairs
                .iter()
                .map(|&(a, b)| {
                    let d = position(b) - position(a);
                    let length = d.norm();
                    if length > 0.0 {
                        d.dot(&(velocity(b) - velocity(a))) / length
                    } else {
                        // Two nodes in one place have no direction; their length cannot shrink.
                        0.0
                    }
                })
                .sum(),
            Self::MeanX(nodes) => {
                nodes.iter().map(|&n| velocity(n).x).sum::<f64>() / nodes.len() as f64
            }
        }
    }
}

/// Follows one measure and keeps its largest growth over the value at rest.
#[derive(Debug, Clone)]
pub struct Growth {
    measure: Measure,
    rest: f64,
    last: f64,
    /// Largest growth, in m; 0 if it never grows.
    pub peak: Peak,
    rising: bool,
    /// Rate of change at the last step end, if it was needed.
    last_rate: Option<f64>,
}

impl Growth {
    /// Follows `measure` from the shape that `state` has.
    pub fn new(measure: Measure, system: &System, state: &State) -> Self {
        let rest = measure.value(|n| state.position(system.place(n)));
        Self {
            measure,
            rest,
            last: 0.0,
            peak: Peak::floor(0.0),
            rising: false,
            last_rate: None,
        }
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
        let value =
            value.unwrap_or_else(|| self.measure.value(|n| after.position(system.place(n))));
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

    fn rate(&self, system: &System, state: &State) -> f64 {
        self.measure.rate(
            |n| state.position(system.place(n)),
            |n| state.velocity(system.place(n)),
        )
    }

    fn search(&mut self, system: &System, before: &State, after: &State) {
        let mut paths: Vec<Option<Path>> = Vec::new();
        let mut want = |n: usize| {
            if paths.len() <= n {
                paths.resize(n + 1, None);
            }
            paths[n].get_or_insert_with(|| Path::between(system, before, after, n));
        };
        match &self.measure {
            Measure::Length(pairs) => pairs.iter().for_each(|&(a, b)| {
                want(a);
                want(b);
            }),
            Measure::MeanX(nodes) => nodes.iter().copied().for_each(want),
        }
        let (value, share) = maximum(SCAN, f64::NEG_INFINITY, |s| {
            self.measure
                .value(|n| paths[n].map_or_else(Point2::origin, |p| p.position(s)))
        });
        let time = before.time + share * (after.time - before.time);
        self.peak.offer(value - self.rest, time);
    }
}
