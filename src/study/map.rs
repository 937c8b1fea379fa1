//! The results over two inputs: a square grid that is refined without losing what is known.
//!
//! Grids have 2^k + 1 points a side, so every point of one is a point of the next. Each point holds
//! every result of its run; between points one is interpolated linearly in both directions.
//!
//! Left out: a step error for each point. They are single runs by the automatic step.

use super::case::Refusal;
use super::ordered;
use super::point::single;
use super::quantity::Quantity;
use super::results::Results;
use super::sweep::spaced;
use crate::scenario::fields::Field;
use crate::scenario::{Scenario, set};
use std::ops::ControlFlow;
use std::sync::atomic::{AtomicBool, Ordering};

/// Points a side of the grids, from the first to the finest.
pub const SIDES: [usize; 3] = [9, 17, 33];

/// One input and its range.
#[derive(Clone, Copy)]
pub struct Span {
    /// The field; it holds a number.
    pub field: &'static Field,
    /// Its least value.
    pub from: f64,
    /// Its greatest.
    pub to: f64,
}

impl PartialEq for Span {
    fn eq(&self, other: &Self) -> bool {
        (self.field.path, self.from, self.to) == (other.field.path, other.from, other.to)
    }
}

impl std::fmt::Debug for Span {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{}={}:{}", self.field.path, self.from, self.to)
    }
}

/// What is known at one point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Spot {
    /// Every result.
    Known(Results),
    /// The same beyond the model's validity: the mesh folded.
    Folded(Results),
    /// The inputs are not allowed, or the run failed.
    Refused,
}

impl Spot {
    /// A result in its unit, if there is one.
    pub fn value(&self, quantity: Quantity) -> Option<f64> {
        match self {
            Self::Known(results) | Self::Folded(results) => results[quantity],
            Self::Refused => None,
        }
    }

    /// Whether the mesh folded.
    pub fn folded(&self) -> bool {
        matches!(self, Self::Folded(_))
    }
}

/// A grid over two inputs.
#[derive(Debug, Clone, PartialEq)]
pub struct Grid {
    /// Points a side.
    pub side: usize,
    /// By rows: x fastest.
    pub spots: Vec<Spot>,
}

impl Grid {
    /// What is known at a point.
    pub fn at(&self, x: usize, y: usize) -> &Spot {
        &self.spots[y * self.side + x]
    }

    /// The largest of a result over all points, in its unit; none where no point has it.
    pub fn largest(&self, quantity: Quantity) -> Option<f64> {
        let values = self.spots.iter().filter_map(|spot| spot.value(quantity));
        values.reduce(f64::max)
    }

    /// A result at a place between points, both from 0 to 1; none next to a point that has none.
    pub fn between(&self, quantity: Quantity, x: f64, y: f64) -> Option<f64> {
        let last = (self.side - 1) as f64;
        let place = |share: f64| {
            let at = (share.clamp(0.0, 1.0) * last).min(last - 1e-9);
            (at.floor() as usize, at.fract())
        };
        let ((i, u), (j, v)) = (place(x), place(y));
        let value = |i, j| self.at(i, j).value(quantity);
        let low = value(i, j)? * (1.0 - u) + value(i + 1, j)? * u;
        let high = value(i, j + 1)? * (1.0 - u) + value(i + 1, j + 1)? * u;
        Some(low * (1.0 - v) + high * v)
    }

    /// The nearest point to a place.
    pub fn nearest(&self, x: f64, y: f64) -> &Spot {
        let last = (self.side - 1) as f64;
        let place = |share: f64| (share.clamp(0.0, 1.0) * last).round() as usize;
        self.at(place(x), place(y))
    }
}

/// The scenario at a point of a grid of so many points a side.
pub fn scenario_at(
    scenario: &Scenario,
    (x, y): (Span, Span),
    (i, j): (usize, usize),
    side: usize,
) -> Scenario {
    let mut changed = scenario.clone();
    for (span, at) in [(x, i), (y, j)] {
        let value = spaced(span.from, span.to, side)[at];
        set::put_number(&mut changed, span.field, value);
    }
    changed
}

fn spot(scenario: &Scenario, stop: &AtomicBool) -> Option<Spot> {
    let Ok(scenario) = scenario.check() else {
        return Some(Spot::Refused);
    };
    let mut watch = |_: f64| {
        if stop.load(Ordering::Relaxed) {
            ControlFlow::Break(())
        } else {
            ControlFlow::Continue(())
        }
    };
    match single(&scenario, None, &mut watch) {
        Ok(point) if point.folded() => Some(Spot::Folded(point.values)),
        Ok(point) => Some(Spot::Known(point.values)),
        Err(Refusal::Cancelled) => None,
        Err(_) => Some(Spot::Refused),
    }
}

/// The grid of so many points a side; points of a coarser one that is known are taken from it.
///
/// # Errors
/// [`Refusal::Cancelled`] if it was stopped.
pub fn fill(
    scenario: &Scenario,
    spans: (Span, Span),
    side: usize,
    known: Option<&Grid>,
    stop: &AtomicBool,
    watch: super::ensemble::SharedWatch,
) -> Result<Grid, Refusal> {
    let total = side * side;
    let mut spots = Vec::with_capacity(total);
    let job = |index: usize| {
        let (i, j) = (index % side, index / side);
        if let Some(grid) = known {
            let every = (side - 1) / (grid.side - 1);
            if i % every == 0 && j % every == 0 {
                return Some(*grid.at(i / every, j / every));
            }
        }
        spot(&scenario_at(scenario, spans, (i, j), side), stop)
    };
    ordered::run((0, total), stop, job, |index, spot| {
        spots.push(spot);
        watch((index + 1) as f64 / total as f64)
    });
    if spots.len() == total {
        Ok(Grid { side, spots })
    } else {
        Err(Refusal::Cancelled)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scenario::fields::find;

    fn go(_: f64) -> ControlFlow<()> {
        ControlFlow::Continue(())
    }

    #[test]
    fn a_refined_grid_keeps_what_is_known_and_rises_with_the_force() {
        let scenario = Scenario {
            window_ms: 0.3,
            ..Scenario::default()
        };
        let span = |path, from, to| Span {
            field: find(path).unwrap(),
            from,
            to,
        };
        let spans = (
            span("impact.force_n", 50.0, 250.0),
            span("impact.angle_deg", 0.0, 60.0),
        );
        let stop = AtomicBool::new(false);
        let coarse = fill(&scenario, spans, 3, None, &stop, &go).unwrap();
        let fine = fill(&scenario, spans, 5, Some(&coarse), &stop, &go).unwrap();
        assert_eq!(fine, fill(&scenario, spans, 5, None, &stop, &go).unwrap());
        assert_eq!(fine.at(2, 2), coarse.at(1, 1));
        assert_eq!(*fine.at(0, 4), Spot::Refused, "60 deg lies behind bone");
        for of in [Quantity::Damage, Quantity::ForceFront] {
            let row: Vec<f64> = (0..5).map(|i| fine.at(i, 0).value(of).unwrap()).collect();
            assert!(row.is_sorted());
            let middle = fine.between(of, 0.125, 0.0).unwrap();
            assert!((middle / (0.5 * (row[0] + row[1])) - 1.0).abs() < 1e-9);
            assert_eq!(fine.between(of, 0.5, 0.9), None);
            assert!(fine.largest(of).unwrap() >= row[4]);
        }
        assert_eq!(fine.largest(Quantity::Pressure), None);
        assert!(fill(&scenario, spans, 3, None, &AtomicBool::new(true), &go).is_err());
    }
}
