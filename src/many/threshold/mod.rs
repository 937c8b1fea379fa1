//! Where a result reaches a value as one number of the scenario goes through a range.
//!
//! The range is looked at on a grid, on all cores, coarsely at first where nobody narrowed it;
//! wherever two neighbours lie on two sides of the value, the crossing between them is bracketed
//! to a share of itself (see `crate::many::root`). With e the error of the result there, as
//! answers state it, and s its slope over a hundredth to both sides, the crossing may be off by
//! e / s: one figure for the step, one for the mesh. A risk carries what is said of it there, and
//! the range of the field over which its range, with all that is not known at the crossing, holds
//! the value.
//!
//! Left out: two crossings between neighbours of the grid, which leave no change of sign to be
//! seen, and of results that are no risks what the inputs that are not varied may be off by (see
//! [`crate::many::ensemble`]).

mod crossing;
#[cfg(test)]
mod tests;

use std::collections::BTreeMap;
use std::sync::atomic::AtomicBool;

pub use crossing::{Crossing, RiskThere};

use crate::answer::{brief::single, results::Results};
use crate::many::{root::Bracket, sweep::spaced};
use crate::run::{flags::PRESSED_FLAT, ordered, ordered::until, quantity::Quantity};
use crate::run::{refusal::Refusal, refusal::unstopped};
use crate::scenario::{CheckedScenario, Impact, Model, Scenario, doubt::number, fields};
use crate::scenario::{fields::Bounds, fields::Field, fields::Kind, problem::five_nearest};
use crate::scenario::{problem::Problem, problem::ScenarioError, problem::plain};
use crate::scenario::{problem::suggestion, set::full_path, set::set};

/// Intervals of the grid, at least, and the largest ratio of neighbours on it.
const INTERVALS: usize = 24;
const LARGEST_RATIO: f64 = 2.0;
/// The grid goes down to this share of the present value, then to the end of a given range.
const LEAST_SHARE: f64 = 1e-3;
/// To this share alone where nobody gave one: a blow so slow lasts for ever.
const SLOWEST_SHARE: f64 = 1e-2;
/// Of a range that nobody narrowed, one value of the grid in this many is looked at first.
const COARSE: usize = 4;
/// The share of the progress that stands for the grid.
const LOOKED: f64 = 0.6;

/// A search for the values of `field` at which a result reaches `target`.
#[derive(Clone)]
pub struct ThresholdSearch {
    scenario: Scenario,
    /// The field that is varied.
    pub field: &'static Field,
    bounds: Bounds,
    /// Least and greatest value of the field.
    pub range: (f64, f64),
    /// Whether the person gave that range; else it begins at [`SLOWEST_SHARE`] of the present one.
    narrow: bool,
    /// The result.
    pub quantity: Quantity,
    /// The value that it is to reach, in its unit.
    pub target: f64,
}

/// The crossings that a search found, and the grid that it looked at.
#[derive(Debug, Clone)]
pub struct Threshold {
    /// Values of the field on the grid, and the result there or why there is none.
    pub seen: Vec<(f64, Result<f64, String>)>,
    /// Every crossing, from below.
    pub crossings: Vec<Crossing>,
}

/// A result, if there is one, or why nothing could be computed.
type Looked = Result<Option<f64>, String>;

impl ThresholdSearch {
    /// Varies `FIELD` or `FIELD=FROM:TO` until a result has a value, see [`wanted`].
    ///
    /// # Errors
    /// Says why the field cannot be varied so, and what could.
    pub fn read(
        scenario: Scenario,
        vary: &str,
        (quantity, target): (Quantity, f64),
    ) -> Result<Self, ScenarioError> {
        let ends = vary.split_once('=');
        let (path, ends) = ends.map_or((vary, None), |(path, ends)| (path, Some(ends)));
        let (field, bounds) = bounds(&scenario, path.trim())?;
        let range = match ends {
            None => (bounds.min, bounds.max),
            Some(ends) => range(&scenario, field, &bounds, ends)?,
        };
        let mut search =
            Self { scenario, field, bounds, range, narrow: ends.is_some(), quantity, target };
        let (from, present) = (search.range.0, search.present());
        if !search.narrow && from > 0.0 && present > from {
            search.range.0 = from.max(SLOWEST_SHARE * present);
        }
        Ok(search)
    }

    fn at(&self, value: f64) -> Result<CheckedScenario, ScenarioError> {
        let mut scenario = self.scenario.clone();
        set(&mut scenario, self.field.path, &plain(value))?;
        scenario.check()
    }

    fn absent(&self, but: &str) -> Refusal {
        let message = format!("this scenario has no such result{but}");
        ScenarioError::from(Problem::new(self.quantity.key(), message)).into()
    }

    /// The value of the field now.
    pub fn present(&self) -> f64 {
        number(self.field, &self.scenario).map_or(f64::NAN, |(present, _)| present)
    }

    /// The values of the grid: by ratios from the present one on where the range is wide.
    fn grid(&self) -> Vec<f64> {
        let (from, to) = self.range;
        if from < 0.0 || to <= 4.0 * from || from == to {
            return spaced(from, to, if from == to { 1 } else { INTERVALS + 1 });
        }
        let present = self.present();
        let middle = if present > 0.0 { present } else { LEAST_SHARE * to };
        let middle = middle.clamp(from.max(LEAST_SHARE * to * LEAST_SHARE), to);
        let least = from.max(LEAST_SHARE * middle);
        let ratio = libm::pow(to / least, 1.0 / INTERVALS as f64).min(LARGEST_RATIO);
        let three_digits = |x: f64| format!("{x:.2e}").parse().unwrap_or(x);
        let ratios = |by: f64| (1..).map(move |k| three_digits(middle * by.powi(k)));
        let mut grid = vec![from, middle, to];
        grid.extend(ratios(ratio).take_while(|x| *x < to));
        grid.extend(ratios(1.0 / ratio).take_while(|x| *x > least));
        grid.sort_by(f64::total_cmp);
        grid.dedup();
        grid
    }

    /// Looks for every crossing. `progress` is told the share done.
    ///
    /// # Errors
    /// Where the scenario has no such result or was stopped.
    pub fn answer(
        &self,
        stop: &AtomicBool,
        mut progress: impl FnMut(f64) + Send,
    ) -> Result<Threshold, Refusal> {
        let seen = self.run_grid(stop, &mut progress)?;
        if seen.iter().all(|(_, result)| matches!(result, Ok(None))) {
            let there = self.results_at(seen[0].0, stop)?;
            let there = there.present().map(|(of, _)| of.key());
            let near = five_nearest(self.quantity.key(), there);
            return Err(self.absent(&format!("; the nearest that it has: {near}")));
        }
        let known = |looked: Looked| looked?.ok_or_else(|| "no such result there".to_owned());
        let seen: Vec<_> = seen.into_iter().map(|(at, result)| (at, known(result))).collect();
        // Neighbours on two sides of the target.
        let brackets = seen.windows(2).filter_map(|pair| {
            let [(a, Ok(low)), (b, Ok(high))] = pair else { return None };
            let bracket = Bracket { low: (*a, low - self.target), high: (*b, high - self.target) };
            ((bracket.low.1 < 0.0) != (bracket.high.1 < 0.0)).then_some(bracket)
        });
        let brackets: Vec<Bracket> = brackets.collect();
        let mut crossings = Vec::new();
        let values = || seen.iter().filter_map(|(_, result)| result.clone().ok());
        let spread = values().fold(f64::MIN, f64::max) - values().fold(f64::MAX, f64::min);
        for (i, bracket) in brackets.iter().enumerate() {
            let each = (1.0 - LOOKED) / brackets.len() as f64;
            let mut progress = |share: f64| progress(LOOKED + each * (i as f64 + share));
            crossings.push(self.crossing(*bracket, spread, stop, &mut progress)?);
        }
        Ok(Threshold { seen, crossings })
    }

    /// The result on the grid, in its order. Of a range that nobody narrowed every [`COARSE`]th
    /// value is looked at first, and others only between two of which one has no result, or where
    /// the target may lie. Each is one run: its error matters at a crossing, where it is stated.
    fn run_grid(
        &self,
        stop: &AtomicBool,
        progress: &mut (impl FnMut(f64) + Send),
    ) -> Result<Vec<(f64, Looked)>, Refusal> {
        let grid = self.grid();
        let last = grid.len() - 1;
        let coarse = if self.narrow { 1 } else { COARSE };
        let first: Vec<usize> = (0..=last).filter(|i| i % coarse == 0 || *i == last).collect();
        let mut seen = BTreeMap::new();
        let mut look = |at: &[usize], seen: &mut BTreeMap<usize, Looked>| {
            let run = |i: usize| {
                let results = unstopped(self.results_at(grid[at[i]], stop))?;
                Some(results.map(|all| all[self.quantity]).map_err(|error| error.to_string()))
            };
            let share =
                |part: f64| (seen.len() as f64 + part * at.len() as f64) / grid.len() as f64;
            let found = ordered::all(at.len(), stop, run, |part| progress(LOOKED * share(part)))?;
            seen.extend(at.iter().copied().zip(found));
            Ok::<_, Refusal>(())
        };
        look(&first, &mut seen)?;
        let value = |i: usize| seen[&i].clone().ok().flatten();
        let worth = |(a, b): (usize, usize)| match (value(a), value(b)) {
            (Some(a), Some(b)) => {
                let slack = (a - b).abs();
                (a.min(b) - slack..=a.max(b) + slack).contains(&self.target)
            }
            (a, b) => a.is_some() != b.is_some(),
        };
        let pairs = first.windows(2).map(|pair| (pair[0], pair[1]));
        let between = pairs.filter(|pair| worth(*pair)).flat_map(|(a, b)| a + 1..b);
        look(&between.collect::<Vec<_>>(), &mut seen)?;
        Ok(seen.into_iter().map(|(i, looked)| (grid[i], looked)).collect())
    }

    fn results_at(&self, value: f64, stop: &AtomicBool) -> Result<Results, Refusal> {
        Ok(single(&self.at(value)?, None, &mut until(stop))?.values)
    }
}

/// The field of a path and its bounds, where it holds a number.
fn bounds(scenario: &Scenario, path: &str) -> Result<(&'static Field, Bounds), ScenarioError> {
    let path = full_path(scenario, path);
    let Some(field) = fields::find(path) else {
        // The words for a field that is not there; a group has none that fit.
        let error = set(&mut scenario.clone(), path, "()").err();
        let error = error.filter(|e| e.problems.iter().any(|p| p.line.is_none()));
        let group = || Problem::new(path, "holds several fields: name one of them").into();
        return Err(error.unwrap_or_else(group));
    };
    let Some(present) = field.text(scenario) else {
        set(&mut scenario.clone(), path, "0")?;
        return Err(Problem::new(path, "there is no such field in this scenario").into());
    };
    let Some(bounds) = field.bounds_in(scenario) else {
        let message = match field.kind {
            Kind::Integer(..) => {
                format!("is a whole number, now {present}: `contrecoup sweep` lists its results")
            }
            _ => format!("is no number but {present}"),
        };
        return Err(Problem::new(path, message).into());
    };
    Ok((field, bounds))
}

/// Reads `FROM:TO` within the bounds of a field.
fn range(
    scenario: &Scenario,
    field: &Field,
    bounds: &Bounds,
    ends: &str,
) -> Result<(f64, f64), ScenarioError> {
    let allowed = || format!("FROM:TO within {}", field.allowed_in(scenario));
    let refused = |complaint| Problem::refused(field.path, ends.trim(), complaint, allowed());
    let (from, to) = ends.split_once(':').ok_or_else(|| refused("is no range"))?;
    let (Ok(from), Ok(to)) = (from.trim().parse::<f64>(), to.trim().parse::<f64>()) else {
        return Err(refused("is no range of numbers").into());
    };
    if from.partial_cmp(&to) != Some(std::cmp::Ordering::Less) {
        return Err(refused("goes from no lower to no higher value").into());
    }
    if from < bounds.min || to > bounds.max {
        return Err(refused("is out of range").into());
    }
    Ok((from, to))
}

/// The field that is varied, and the result with its value, unless a person asks for others.
pub fn usual(scenario: &Scenario) -> (&'static str, (Quantity, f64)) {
    let field = match scenario.impact {
        Impact::ForcePulse(_) => "impact.force_n",
        Impact::Projectile(_) => "impact.speed_m_s",
    };
    let result = match scenario.model {
        Model::Paper => Quantity::Damage,
        Model::Physiological(_) => Quantity::GlobeRupture,
    };
    (field, (result, 50.0))
}

/// A name of a result as in its key, however it is spelled.
fn bare(name: &str) -> String {
    name.to_lowercase().replace([' ', '-', '\''], "_")
}

/// The result that is called so: by its key, with or without the unit, or as people read it.
pub fn meant(name: &str) -> Option<Quantity> {
    let name = bare(name);
    let called = |quantity: &&Quantity| {
        let (key, label) = (quantity.key(), bare(quantity.label()));
        let unit = key.strip_prefix(name.as_str());
        let units = ["", "_percent", "_mm", "_n", "_j", "_mpa", "_m_s", "_kj_m2"];
        label == name || unit.is_some_and(|unit| units.contains(&unit))
    };
    Quantity::ALL.iter().find(called).copied()
}

/// Reads `RESULT = VALUE`; the unit may follow the value.
///
/// # Errors
/// Says what makes no sense, and what would.
pub fn wanted(text: &str) -> Result<(Quantity, f64), ScenarioError> {
    let refused = |value: &str, complaint: &str, allowed: &str| {
        ScenarioError::from(Problem::refused("", value, complaint, allowed.to_owned()))
    };
    let example = "RESULT = VALUE, as in damage_percent = 50";
    let (key, value) = text.split_once('=').ok_or_else(|| refused(text, "has no =", example))?;
    let (key, value) = (key.trim().trim_end_matches('='), value.trim_start_matches('=').trim());
    let Some(quantity) = meant(key) else {
        let near = suggestion(&bare(key), Quantity::ALL.iter().map(|q| q.key()));
        let allowed = "any of the results that contrecoup run --json lists";
        return Err(refused(key, &format!("is no result{near}"), allowed));
    };
    // The index is no percentage for a reader, but its key says so.
    let unit = quantity.row().unit;
    let unit = if unit.is_empty() { "%" } else { unit };
    let number = value.strip_suffix(unit).unwrap_or(value);
    match number.trim().parse::<f64>() {
        Ok(target) if target < 0.0 && quantity != Quantity::Rebound => {
            let complaint = format!("is below 0, where {} never is", quantity.label());
            Err(refused(value, &complaint, "0 or more"))
        }
        Ok(target) if quantity.is_risk() && target > 100.0 => {
            Err(refused(value, "is beyond 100 %, which no share of eyes exceeds", "0 to 100 %"))
        }
        Ok(target) if quantity == Quantity::Shortening && target > 100.0 * PRESSED_FLAT => {
            let complaint = "is beyond where the eye is pressed flat, at which a run ends";
            let allowed = format!("up to {} %", 100.0 * PRESSED_FLAT);
            Err(refused(value, complaint, &allowed))
        }
        Ok(target) if target.is_finite() => Ok((quantity, target)),
        _ => Err(refused(value, "is no number", example)),
    }
}
