//! The results over two inputs: a square grid that is filled in from coarse to fine.
//!
//! It has 2^k + 1 points a side. First come its corners, then the middles between them, and so on,
//! so that what is known spreads over the whole range at once. Each point holds every result of
//! its run, and the range of each risk; a place is read off the nearest four points of the finest
//! grid that is known round it, linearly in both directions.
//!
//! Left out: a step error for each point. They are single runs by the automatic step.

use crate::answer::{brief::BriefAnswer, brief::single, results::Results};
use crate::injury::{Injury, PerInjury};
use crate::many::sweep::spaced;
use crate::run::{ordered, ordered::until, quantity::Quantity};
use crate::run::{refusal::Refusal, refusal::unstopped};
use crate::scenario::{Scenario, fields::Field, set};
use std::cmp::Reverse;
use std::ops::ControlFlow;
use std::sync::atomic::AtomicBool;

/// Points a side of a grid that is filled in while somebody looks on.
pub const SIDE: usize = 33;

/// One input and its range.
#[derive(Clone, Copy)]
pub struct Span {
    /// The field, which is a number.
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

/// What a run gave at one point of the grid.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct PointResults {
    /// Every result.
    pub values: Results,
    /// The 80 % range of each risk, 0 to 1.
    pub ranges: Option<PerInjury<(f64, f64)>>,
}

impl From<BriefAnswer> for PointResults {
    fn from(answer: BriefAnswer) -> Self {
        Self { values: answer.values, ranges: answer.ranges }
    }
}

/// The state of one point of the grid.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Spot {
    /// What its run gave.
    Known(PointResults),
    /// Simulated, but beyond the model's validity: the mesh folded.
    Folded(PointResults),
    /// The inputs are not allowed, or the run failed.
    Refused,
}

impl Spot {
    /// A result in its unit, if there is one.
    pub fn value(&self, quantity: Quantity) -> Option<f64> {
        self.results()?.values[quantity]
    }

    fn results(&self) -> Option<&PointResults> {
        let (Self::Known(results) | Self::Folded(results)) = self else { return None };
        Some(results)
    }

    /// An end of the range of a risk, in its unit; none of any other result.
    fn end(&self, quantity: Quantity, end: fn((f64, f64)) -> f64) -> Option<f64> {
        let ranges = self.results()?.ranges?;
        let factor = quantity.row().factor;
        Some(factor * end(ranges[Injury::of(quantity)? as usize]))
    }

    /// Whether the mesh folded.
    pub fn folded(&self) -> bool {
        matches!(self, Self::Folded(_))
    }
}

/// A result at a place of the map, with how it is known.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MapReading {
    /// The result in its unit; none where the inputs are not allowed.
    pub value: Option<f64>,
    /// The range of a risk, in its unit.
    pub range: Option<(f64, f64)>,
    /// Whether the mesh folded at the nearest point.
    pub folded: bool,
    /// Whether it was simulated there, not read off between points.
    pub exact: bool,
}

/// A grid over two inputs.
#[derive(Debug, Clone, PartialEq)]
pub struct Grid {
    side: usize,
    /// By rows: x fastest.
    spots: Vec<Option<Spot>>,
}

impl Grid {
    /// An empty grid of `side` points a side, which is 2^k + 1.
    pub fn new(side: usize) -> Self {
        Self { side, spots: vec![None; side * side] }
    }

    /// The state of a point; none until it was simulated.
    pub fn at(&self, (x, y): (usize, usize)) -> Option<&Spot> {
        self.spots[y * self.side + x].as_ref()
    }

    /// Takes in what came of a point.
    pub fn put(&mut self, (x, y): (usize, usize), spot: Spot) {
        self.spots[y * self.side + x] = Some(spot);
    }

    /// Points that are known, and all.
    pub fn known(&self) -> (usize, usize) {
        (self.spots.iter().flatten().count(), self.spots.len())
    }

    /// The points, from coarse to fine.
    pub fn order(&self) -> Vec<(usize, usize)> {
        let rows = (0..self.side).flat_map(|y| (0..self.side).map(move |x| (x, y)));
        let mut order: Vec<_> = rows.collect();
        // A point lies on the grids of all widths, powers of 2, that divide both its numbers.
        order.sort_by_key(|(x, y)| Reverse((x | y).trailing_zeros()));
        order
    }

    /// The largest of a result over all points, in its unit; none where no point has it.
    pub fn largest(&self, quantity: Quantity) -> Option<f64> {
        self.spots.iter().flatten().filter_map(|spot| spot.value(quantity)).reduce(f64::max)
    }

    /// A result at a place, both from 0 to 1; nothing where too little is known to say anything.
    pub fn read(&self, quantity: Quantity, (x, y): (f64, f64)) -> Option<MapReading> {
        let last = (self.side - 1) as f64;
        let (x, y) = (x.clamp(0.0, 1.0) * last, y.clamp(0.0, 1.0) * last);
        let widths = std::iter::successors(Some(1), |width| Some(2 * width));
        for every in widths.take_while(|width| *width < self.side) {
            // The cell of that width round the place: its lower corner, and the share from there.
            let place = |at: f64| {
                let cell =
                    ((at / every as f64).floor() as usize * every).min(self.side - 1 - every);
                (cell, (at - cell as f64) / every as f64)
            };
            let ((i, u), (j, v)) = (place(x), place(y));
            let near = |share: f64| if share < 0.5 { 0 } else { every };
            let here = self.at((i + near(u), j + near(v)));
            let folded = here.is_some_and(Spot::folded);
            let is_point = |share: f64| share == 0.0 || share == 1.0;
            if let Some(spot) = here.filter(|_| is_point(u) && is_point(v)) {
                let range = spot.end(quantity, |r| r.0).zip(spot.end(quantity, |r| r.1));
                return Some(MapReading {
                    value: spot.value(quantity),
                    range,
                    folded,
                    exact: true,
                });
            }
            let corners = [(0, 0), (every, 0), (0, every), (every, every)];
            if let [Some(a), Some(b), Some(c), Some(d)] =
                corners.map(|(a, b)| self.at((i + a, j + b)))
            {
                let between = |of: &dyn Fn(&Spot) -> Option<f64>| {
                    let low = of(a)? * (1.0 - u) + of(b)? * u;
                    let high = of(c)? * (1.0 - u) + of(d)? * u;
                    Some(low * (1.0 - v) + high * v)
                };
                let end = |end| between(&|spot| spot.end(quantity, end));
                let range = end(|r| r.0).zip(end(|r| r.1));
                let value = between(&|spot| spot.value(quantity));
                return Some(MapReading { value, range, folded, exact: false });
            }
        }
        None
    }
}

/// Fills in what the grid lacks, from coarse to fine; what is stopped gives what it has. `on_point`
/// is called with the grid so far after each point, on any thread; `Break` stops the rest.
pub fn fill(
    scenario: &Scenario,
    spans: (Span, Span),
    mut grid: Grid,
    stop: &AtomicBool,
    on_point: &(dyn Fn(&Grid) -> ControlFlow<()> + Sync),
) -> Grid {
    let mut lacking = grid.order();
    lacking.retain(|at| grid.at(*at).is_none());
    let side = grid.side;
    let job = |index: usize| {
        let (i, j) = lacking[index];
        let mut scenario = scenario.clone();
        let put = [(spans.0, i), (spans.1, j)];
        let put = put.map(|(span, at)| (span.field, spaced(span.from, span.to, side)[at]));
        set::put_numbers(&mut scenario, put);
        let checked = scenario.check().map_err(Refusal::from);
        let run = checked.and_then(|scenario| single(&scenario, None, &mut until(stop)));
        Some(match unstopped(run)? {
            Ok(point) if point.folded() => Spot::Folded(point.into()),
            Ok(point) => Spot::Known(point.into()),
            Err(_) => Spot::Refused,
        })
    };
    ordered::run((0, lacking.len()), stop, job, |index, spot| {
        grid.put(lacking[index], spot);
        on_point(&grid)
    });
    grid
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::run::watch::stop_if;
    use crate::scenario::fields::find;
    use std::collections::BTreeSet;

    fn spans() -> (Span, Span) {
        let span = |path, from, to| Span { field: find(path).unwrap(), from, to };
        (span("impact.force_n", 50.0, 250.0), span("impact.angle_deg", 0.0, 60.0))
    }

    #[test]
    fn a_grid_is_filled_in_from_its_corners_and_goes_on_where_it_was_stopped() {
        let scenario = Scenario { window_ms: Some(0.3), ..Scenario::default() };
        let of = Quantity::Damage;
        let coarse = |grid: &Grid| {
            // Nothing is said of a place before its corners are known.
            let (known, _) = grid.known();
            assert_eq!(grid.read(of, (0.3, 0.3)).is_some(), known >= 4);
            stop_if(known == 9)
        };
        let part = fill(&scenario, spans(), Grid::new(5), &AtomicBool::new(false), &coarse);
        assert_eq!(part.known(), (9, 25));
        let proceed = |_: &Grid| ControlFlow::Continue(());
        let filled = |grid| fill(&scenario, spans(), grid, &AtomicBool::new(false), &proceed);
        let whole = filled(part.clone());
        assert_eq!(whole, filled(Grid::new(5)));
        assert_eq!(whole.known(), (25, 25));
        assert!(part.order()[..9].iter().all(|at| part.at(*at) == whole.at(*at)));
        assert_eq!(whole.at((0, 4)), Some(&Spot::Refused), "60 deg lies behind bone");
        for of in [Quantity::Damage, Quantity::ForceFront] {
            let value = |x| whole.at((x, 0)).unwrap().value(of).unwrap();
            assert!((0..5).map(value).is_sorted());
            let middle = whole.read(of, (0.125, 0.0)).unwrap();
            assert!((middle.value.unwrap() / (0.5 * (value(0) + value(1))) - 1.0).abs() < 1e-9);
            assert!(!middle.exact && whole.read(of, (0.25, 0.0)).unwrap().exact);
            assert_eq!(whole.read(of, (0.5, 0.9)).unwrap().value, None);
            assert!(whole.largest(of).unwrap() >= value(4));
        }
        assert_eq!(whole.largest(Quantity::Pressure), None);
    }

    #[test]
    fn the_order_has_every_point_once_and_the_coarsest_first() {
        let grid = Grid::new(SIDE);
        let order = grid.order();
        let points: BTreeSet<_> = order.iter().collect();
        assert_eq!((points.len(), order.len()), (SIDE * SIDE, SIDE * SIDE));
        assert!(order[..25].iter().all(|(x, y)| x % 8 == 0 && y % 8 == 0));
    }
}
