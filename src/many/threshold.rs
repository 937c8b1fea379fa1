//! Where a result reaches a value as one number of the scenario goes through a range.
//!
//! The range is looked at on a grid, on all cores, coarsely at first where nobody narrowed it;
//! wherever two neighbours lie on two sides of the value, the crossing between them is bracketed
//! to [`WIDTH`] of itself (see [`crate::many::root`]). With e the error of the result there, as
//! answers state it, and s its slope over [`STEP_ASIDE`] to both sides, the crossing may be off by
//! e / s: one figure for the step, one for the mesh. A risk carries what is said of it there, and
//! the range of the field over which its range, with all that is not known at the crossing, holds
//! the value.
//!
//! Left out: two crossings between neighbours of the grid, which leave no change of sign to be
//! seen, and of results that are no risks what the inputs that are not varied may be off by (see
//! [`crate::many::ensemble`]).

use std::ops::ControlFlow;
use std::sync::atomic::AtomicBool;

use crate::answer::brief::single;
use crate::answer::results::Results;
use crate::answer::solve::{Answer, complete, solve};
use crate::injury::{Blow, Injury, Known, Risk};
use crate::many::root::{Bracket, narrowed};
use crate::many::sweep::spaced;
use crate::run::flags::Flag;
use crate::run::kept::Keep;
use crate::run::ordered::{self, until};
use crate::run::quantity::Quantity;
use crate::run::refusal::Refusal;
use crate::scenario::fields::{Bounds, Field, Kind};
use crate::scenario::problem::{Problem, ScenarioError, five_nearest, plain, suggestion};
use crate::scenario::set::{full_path, set};
use crate::scenario::{Impact, Model, Scenario, fields};

/// How wide the bracket of a crossing is in the end, as a share of it.
const WIDTH: f64 = 1e-4;
/// Share of a crossing by which its slope is measured to each side.
const STEP_ASIDE: f64 = 0.01;
/// Intervals of the grid, at least, and the largest ratio of neighbours on it.
const INTERVALS: usize = 24;
const LARGEST_RATIO: f64 = 2.0;
/// The grid goes down to this share of the present value, and then to the end of a range that
/// somebody gave.
const LEAST_SHARE: f64 = 1e-3;
/// To this share alone where nobody gave one: a blow so slow lasts for ever.
const SLOWEST_SHARE: f64 = 1e-2;
/// Of a range that nobody narrowed, one value of the grid in this many is looked at first.
const COARSE: usize = 4;
/// The share of the progress that stands for the grid.
const LOOKED: f64 = 0.6;
/// How many runs a crossing takes is not known: each leaves this share of its progress to go.
const PATIENCE: f64 = 0.85;
/// A result that changes within a bracket by more than this share of its range on the grid jumps
/// there.
const JUMP: f64 = 0.05;

/// A search for the values of `field` at which a result reaches `target`.
#[derive(Clone)]
pub struct ThresholdSearch {
    scenario: Scenario,
    /// The field that is varied.
    pub field: &'static Field,
    bounds: Bounds,
    /// Least and greatest value of the field.
    pub range: (f64, f64),
    /// Whether the person gave that range; else it is all that the field may be, but for what is
    /// less than a hundredth of the present value.
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

/// Values of the field, and the result there if there is one, or why nothing could be computed.
type Seen = Result<Vec<(f64, Result<Option<f64>, String>)>, Refusal>;

/// A value of the field at which the result passes the target.
#[derive(Debug, Clone)]
pub struct Crossing {
    /// The value.
    pub at: f64,
    /// Whether the result rises there.
    pub rising: bool,
    /// By how much the value may be off for the time step; none where that is not known.
    pub step: Option<f64>,
    /// By how much the value may be off for the mesh; none where that is not known.
    pub mesh: Option<f64>,
    /// From which value to which the result jumps there, if it does.
    pub jump: Option<(f64, f64)>,
    /// What limits the results there.
    pub flags: Vec<Flag>,
    /// The risk there, where the result is one.
    pub risk: Option<RiskThere>,
}

/// A risk where it passes the target.
#[derive(Debug, Clone)]
pub struct RiskThere {
    /// What is said of it.
    pub risk: Risk,
    /// From which to which value of the field its range holds the target, where it does at all.
    pub range: (Option<f64>, Option<f64>),
}

/// An end of such a range is looked for in steps of this ratio, so many of them at most.
const ASIDE: f64 = 1.2;
const FARTHEST: usize = 15;
/// Halvings of the step in which the end is found.
const HALVINGS: usize = 3;

impl ThresholdSearch {
    /// Varies what is read from `FIELD` or `FIELD=FROM:TO` until a result has a value, see
    /// [`wanted`].
    ///
    /// # Errors
    /// Says why the field cannot be varied so, and what could.
    pub fn read(
        scenario: Scenario,
        vary: &str,
        (quantity, target): (Quantity, f64),
    ) -> Result<Self, ScenarioError> {
        let (path, ends) = match vary.split_once('=') {
            Some((path, ends)) => (path.trim(), Some(ends)),
            None => (vary.trim(), None),
        };
        let (field, bounds) = bounds(&scenario, path)?;
        let range = match ends {
            None => (bounds.min, bounds.max),
            Some(ends) => self::range(field, &bounds, ends)?,
        };
        let mut search = Self {
            scenario,
            field,
            bounds,
            range,
            narrow: ends.is_some(),
            quantity,
            target,
        };
        let (from, present) = (search.range.0, search.present());
        if !search.narrow && from > 0.0 && present > from {
            search.range.0 = from.max(SLOWEST_SHARE * present);
        }
        Ok(search)
    }

    /// The scenario with another value of the field.
    fn at(&self, value: f64) -> Result<Scenario, ScenarioError> {
        let mut scenario = self.scenario.clone();
        set(&mut scenario, self.field.path, &plain(value))?;
        Ok(scenario)
    }

    fn absent(&self) -> Refusal {
        let message = "this scenario has no such result";
        ScenarioError::from(Problem::new(self.quantity.key(), message)).into()
    }

    fn answer_at(&self, value: f64, stop: &AtomicBool) -> Result<Answer, Refusal> {
        let scenario = self.at(value)?.check()?;
        solve(&scenario, Keep::default(), &mut until(stop))
    }

    /// The value of the field now.
    pub fn present(&self) -> f64 {
        match &self.field.kind {
            Kind::Number(_, place) => (place.get)(&self.scenario).copied(),
            Kind::OptionalNumber(_, place) => (place.get)(&self.scenario).copied().flatten(),
            _ => None,
        }
        .unwrap_or(f64::NAN)
    }

    /// The values that are looked at first: evenly where the range has both signs or is narrow,
    /// else by ratios from the present value on.
    fn grid(&self) -> Vec<f64> {
        let (from, to) = self.range;
        if from < 0.0 || to <= 4.0 * from || from == to {
            return spaced(from, to, if from == to { 1 } else { INTERVALS + 1 });
        }
        let middle = match self.present() {
            present if present > 0.0 => present,
            _ => LEAST_SHARE * to,
        };
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
            let message = format!(
                "this scenario has no such result; the nearest that it has: {}",
                five_nearest(self.quantity.key(), there)
            );
            return Err(ScenarioError::from(Problem::new(self.quantity.key(), message)).into());
        }
        let none = || "no such result there".to_owned();
        let seen: Vec<(f64, Result<f64, String>)> = seen
            .into_iter()
            .map(|(at, result)| (at, result.and_then(|value| value.ok_or_else(none))))
            .collect();
        let brackets = self.brackets(&seen);
        let mut crossings = Vec::new();
        let values = || seen.iter().filter_map(|(_, result)| result.as_ref().ok());
        let spread =
            values().fold(f64::MIN, |a, b| a.max(*b)) - values().fold(f64::MAX, |a, b| a.min(*b));
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
    fn run_grid(&self, stop: &AtomicBool, progress: &mut (impl FnMut(f64) + Send)) -> Seen {
        let grid = self.grid();
        let last = grid.len() - 1;
        let mut seen: Vec<Option<Result<Option<f64>, String>>> = vec![None; grid.len()];
        let coarse = if self.narrow { 1 } else { COARSE };
        let first: Vec<usize> = (0..=last)
            .filter(|i| i % coarse == 0 || *i == last)
            .collect();
        let mut done = 0;
        let mut run_at = |at: &[usize], seen: &mut Vec<_>| {
            let run = |i: usize| match self.results_at(grid[at[i]], stop) {
                Err(Refusal::Cancelled) => None,
                Err(refusal) => Some(Err(refusal.to_string())),
                Ok(results) => Some(Ok(results[self.quantity])),
            };
            let begun = done;
            ordered::run((0, at.len()), stop, run, |i, result| {
                seen[at[i]] = Some(result);
                done += 1;
                progress(LOOKED * done as f64 / grid.len() as f64);
                ControlFlow::Continue(())
            });
            if done < begun + at.len() {
                return Err(Refusal::Cancelled);
            }
            Ok(())
        };
        run_at(&first, &mut seen)?;
        let value = |i: usize| seen[i].clone().and_then(Result::ok).flatten();
        let worth = |(a, b): (usize, usize)| match (value(a), value(b)) {
            (Some(a), Some(b)) => {
                let slack = (a - b).abs();
                (a.min(b) - slack..=a.max(b) + slack).contains(&self.target)
            }
            (a, b) => a.is_some() != b.is_some(),
        };
        let pairs = first.windows(2).map(|pair| (pair[0], pair[1]));
        let between = pairs
            .filter(|pair| worth(*pair))
            .flat_map(|(a, b)| a + 1..b);
        run_at(&between.collect::<Vec<_>>(), &mut seen)?;
        let pairs = grid.into_iter().zip(seen);
        Ok(pairs
            .filter_map(|(at, result)| Some((at, result?)))
            .collect())
    }

    /// The results of one run at a value of the field.
    fn results_at(&self, value: f64, stop: &AtomicBool) -> Result<Results, Refusal> {
        let scenario = self.at(value)?.check()?;
        Ok(single(&scenario, None, &mut until(stop))?.values)
    }

    /// Neighbours on two sides of the target.
    fn brackets(&self, seen: &[(f64, Result<f64, String>)]) -> Vec<Bracket> {
        let pairs = seen.windows(2).filter_map(|pair| {
            let [(a, Ok(low)), (b, Ok(high))] = pair else {
                return None;
            };
            let bracket = Bracket {
                low: (*a, low - self.target),
                high: (*b, high - self.target),
            };
            ((bracket.low.1 < 0.0) != (bracket.high.1 < 0.0)).then_some(bracket)
        });
        pairs.collect()
    }

    fn crossing(
        &self,
        bracket: Bracket,
        spread: f64,
        stop: &AtomicBool,
        progress: &mut dyn FnMut(f64),
    ) -> Result<Crossing, Refusal> {
        let rising = bracket.low.1 < 0.0;
        let width = WIDTH * bracket.high.0.abs().max(bracket.low.0.abs());
        let mut left = 1.0;
        let mut one_more_run = || {
            left *= PATIENCE;
            progress(1.0 - left);
        };
        let bracket = narrowed(bracket, width, |value| -> Result<f64, Refusal> {
            let result = self.results_at(value, stop)?[self.quantity];
            one_more_run();
            Ok(result.ok_or_else(|| self.absent())? - self.target)
        })?;
        let at = bracket.secant();
        let jump = ((bracket.high.1 - bracket.low.1).abs() > JUMP * spread)
            .then_some((bracket.low.1 + self.target, bracket.high.1 + self.target));
        let scenario = self.at(at)?.check()?;
        let mut answer = solve(&scenario, Keep::default(), &mut until(stop))?;
        one_more_run();
        complete(&scenario, &mut answer, stop, |_| {})?;
        one_more_run();
        let mut crossing = Crossing {
            at,
            rising,
            step: None,
            mesh: None,
            jump,
            flags: answer.flags.clone(),
            risk: None,
        };
        if jump.is_some() {
            return Ok(crossing);
        }
        if let Some(injury) = Injury::of(self.quantity) {
            let range = self.risk_range(injury, (at, rising), &answer, stop)?;
            crossing.risk = answer.risk(injury).map(|risk| RiskThere { risk, range });
            return Ok(crossing);
        }
        let [low, high] = self.aside(at).map(|end| match self.answer_at(end, stop) {
            Err(Refusal::Cancelled) => Err(Refusal::Cancelled),
            // Beyond there is nothing: the slope is not known.
            solved => Ok(solved.ok()),
        });
        let ends = low?.zip(high?);
        let [from, to] = self.aside(at);
        let slope = ends.map_or(f64::NAN, |(low, high)| {
            let value = |answer: &Answer| answer.results()[self.quantity].unwrap_or(f64::NAN);
            (value(&high) - value(&low)) / (to - from)
        });
        let value = answer.results()[self.quantity];
        let errors = &answer.errors;
        let off =
            [Some(&errors.time_step), errors.mesh.as_ref()].map(|errors: Option<&Results>| {
                let off = errors?[self.quantity]? / 100.0 * value?.abs() / slope.abs();
                off.is_finite().then_some(off)
            });
        [crossing.step, crossing.mesh] = off;
        Ok(crossing)
    }

    /// Two values on both sides of one, between which slopes are taken.
    fn aside(&self, at: f64) -> [f64; 2] {
        let aside = STEP_ASIDE * at.abs().max(WIDTH * (self.range.1 - self.range.0));
        [at - aside, at + aside].map(|x| x.clamp(self.bounds.min, self.bounds.max))
    }

    /// From which to which value of the field the range of a risk holds the target: by runs at
    /// other values, with what is not known at the crossing `at`.
    fn risk_range(
        &self,
        injury: Injury,
        (at, rising): (f64, bool),
        answer: &Answer,
        stop: &AtomicBool,
    ) -> Result<(Option<f64>, Option<f64>), Refusal> {
        let Some(there) = answer.risk(injury) else {
            return Ok((None, None));
        };
        let target = self.target / self.quantity.row().factor;
        // Whether the upper end of the range, or the lower one, has the target at a value; none
        // where nothing can be computed.
        let reached = |value: f64, upper: bool| {
            let scenario = self.at(value)?;
            let checked = scenario.check()?;
            let run = match single(&checked, None, &mut until(stop)) {
                Err(Refusal::Cancelled) => return Err(Refusal::Cancelled),
                other => other.ok(),
            };
            let measure = injury.measure();
            let value = run.and_then(|run| run.values[measure]);
            Ok(value.map(|value| {
                let value = value / measure.row().factor;
                let known = Known {
                    value,
                    ..there.known
                };
                let range = injury.assess(&Blow::of(&scenario), known).range;
                (if upper { range.1 } else { range.0 }) >= target
            }))
        };
        let end = |upper: bool| {
            // The upper end has the target where the risk itself has not yet, the lower one later.
            let away = if upper == rising { 1.0 / ASIDE } else { ASIDE };
            let (mut near, mut far) = (at, at);
            for step in 0.. {
                far = (near * away).clamp(self.bounds.min, self.bounds.max);
                match reached(far, upper) {
                    Ok(Some(has)) if has != upper => break,
                    Ok(Some(_)) if far != near && step < FARTHEST => near = far,
                    Err(Refusal::Cancelled) => return Err(Refusal::Cancelled),
                    _ => return Ok(None),
                }
            }
            for _ in 0..HALVINGS {
                let middle = (near * far).sqrt();
                match reached(middle, upper)? {
                    Some(has) if has == upper => near = middle,
                    _ => far = middle,
                }
            }
            Ok(Some((near * far).sqrt()))
        };
        if at <= 0.0 {
            return Ok((None, None));
        }
        let mut ends = Vec::new();
        ordered::run(
            (0, 2),
            stop,
            |i| Some(end((i == 0) == rising)),
            |_, end| {
                ends.push(end);
                ControlFlow::Continue(())
            },
        );
        let mut ends = ends.into_iter();
        let mut next = || ends.next().unwrap_or(Err(Refusal::Cancelled));
        Ok((next()?, next()?))
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
    match &field.kind {
        Kind::Number(bounds, _) | Kind::OptionalNumber(bounds, _) => Ok((field, *bounds)),
        Kind::Integer(..) => {
            let message =
                format!("is a whole number, now {present}: `contrecoup sweep` lists its results");
            Err(Problem::new(path, message).into())
        }
        _ => Err(Problem::new(path, format!("is no number but {present}")).into()),
    }
}

fn range(field: &Field, bounds: &Bounds, ends: &str) -> Result<(f64, f64), ScenarioError> {
    let allowed = || format!("FROM:TO within {}", field.allowed());
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

/// What is asked of a scenario unless something else is: the field to vary, and the result with the
/// value that it is to reach.
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
    let Some((key, value)) = text.split_once('=') else {
        return Err(refused(text, "has no =", example));
    };
    let (key, value) = (
        key.trim().trim_end_matches('='),
        value.trim_start_matches('=').trim(),
    );
    let Some(quantity) = meant(key) else {
        let near = suggestion(&bare(key), Quantity::ALL.iter().map(|q| q.key()));
        let allowed = "any of the results that contrecoup run --json lists";
        return Err(refused(key, &format!("is no result{near}"), allowed));
    };
    // The index is no percentage for a reader, but its key says so.
    let unit = match quantity.row().unit {
        "" => "%",
        unit => unit,
    };
    let number = value.strip_suffix(unit).unwrap_or(value);
    match number.trim().parse::<f64>() {
        Ok(target) if target.is_finite() => Ok((quantity, target)),
        _ => Err(refused(value, "is no number", example)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::answer::solve::tests::answered;
    use crate::scenario::library::tests::preset;

    #[test]
    fn a_result_is_found_by_its_key_and_by_what_it_is_called() {
        for name in ["globe_rupture_percent", "globe rupture", "Globe-Rupture"] {
            assert_eq!(meant(name), Some(Quantity::GlobeRupture), "{name}");
        }
        for quantity in Quantity::ALL {
            assert_eq!(meant(quantity.label()), Some(*quantity));
        }
        assert_eq!(meant("globe"), None);
        let told = wanted("globe ruptur = 50").unwrap_err().to_string();
        assert!(
            told.contains("globe_rupture_percent") && told.len() < 200,
            "{told}"
        );
    }

    fn found(scenario: Scenario, vary: &str, until: &str) -> Threshold {
        let question = ThresholdSearch::read(scenario, vary, wanted(until).unwrap()).unwrap();
        question.answer(&AtomicBool::new(false), |_| {}).unwrap()
    }

    fn short() -> Scenario {
        Scenario {
            window_ms: Some(0.3),
            ..Scenario::default()
        }
    }

    #[test]
    fn a_crossing_is_where_the_result_has_the_value_and_its_errors_follow_the_slope() {
        let threshold = found(short(), "impact.force_n=50:800", "apex_displacement_mm = 2");
        let [crossing] = &threshold.crossings[..] else {
            panic!("{threshold:?}")
        };
        let mut there = short();
        set(&mut there, "impact.force_n", &plain(crossing.at)).unwrap();
        let answer = answered(&there);
        let apex = answer.results()[Quantity::Apex].unwrap();
        assert!((apex / 2.0 - 1.0).abs() < 2e-4, "{apex} at {}", crossing.at);
        // The apex is nearly proportional to the force, so their errors are of one share.
        let error = answer.errors.time_step[Quantity::Apex].unwrap() / 100.0;
        let share = crossing.step.unwrap() / crossing.at;
        assert!((0.5..2.0).contains(&(share / error)), "{share} {error}");
        assert!(crossing.mesh.unwrap() > crossing.step.unwrap());
        assert!(crossing.rising && crossing.jump.is_none());
    }

    #[test]
    fn one_that_falls_again_is_crossed_twice_and_one_beyond_reach_never() {
        let angles = "impact.angle_deg=-40:40";
        let below = found(short(), angles, "apex_displacement_mm = 1.5");
        let ways: Vec<bool> = below.crossings.iter().map(|c| c.rising).collect();
        assert_eq!(ways, [true, false], "{below:?}");
        // The section is the same above and below.
        let ends = below.crossings[0].at + below.crossings[1].at;
        assert!(ends.abs() < 0.1, "{below:?}");
        let never = found(short(), angles, "apex_displacement_mm = 50");
        assert!(never.crossings.is_empty() && never.seen.len() > 20);
    }

    #[test]
    fn a_risk_carries_what_is_said_of_it_and_the_speeds_at_which_its_range_holds_the_target() {
        let bb = preset("bb-56", &[]);
        let until = "globe_rupture_percent = 50";
        let anywhere = found(bb.clone(), "impact.speed_m_s", until);
        let between = found(bb, "impact.speed_m_s=50:75", until);
        let [one, other] = [&anywhere, &between].map(|found| &found.crossings[0]);
        assert!(
            (one.at / other.at - 1.0).abs() < 2.0 * WIDTH,
            "{one:?} {other:?}"
        );
        // At a BB the published energy counts: 35.8 kJ/m2.
        assert!((one.at / 57.4 - 1.0).abs() < 0.01, "{one:?}");
        let there = one.risk.as_ref().unwrap();
        assert!((there.risk.risk - 0.5).abs() < 1e-3, "{there:?}");
        let (from, to) = (there.range.0.unwrap(), there.range.1.unwrap());
        assert!(from < 0.95 * one.at && to > 1.05 * one.at, "{there:?}");
        // The coarse look leaves out what is far away.
        assert!(anywhere.seen.len() < 20 && between.seen.len() > 20);
    }

    #[test]
    fn what_is_refused_on_the_way_is_told_and_does_not_end_the_search() {
        let threshold = found(short(), "impact.angle_deg", "apex_displacement_mm = 1.5");
        let refused = threshold.seen.iter().filter(|(_, r)| r.is_err()).count();
        assert!(refused > 0 && refused < threshold.seen.len());
    }

    #[test]
    fn questions_that_make_no_sense_are_refused_in_words() {
        let refused = |vary: &str| {
            let question = ThresholdSearch::read(short(), vary, (Quantity::Damage, 50.0));
            question.err().unwrap().to_string()
        };
        assert!(refused("impact.farce_n").contains("did you mean"));
        assert!(refused("impact.shape").contains("is no number"));
        assert!(refused("eye").contains("holds several fields"));
        let by_end = ThresholdSearch::read(short(), "force", (Quantity::Damage, 50.0)).unwrap();
        assert_eq!(by_end.field.path, "impact.force_n");
        assert!(refused("eye.level").contains("whole number"));
        assert!(refused("impact.speed_m_s").contains("which has no"));
        assert!(refused("impact.force_n=9:1").contains("goes from"));
        assert!(refused("impact.force_n=9").contains("is no range"));
        assert!(refused("impact.force_n=0:1e9").contains("out of range"));
        let unread = |until: &str| wanted(until).unwrap_err().to_string();
        assert!(unread("damge=50").contains("did you mean damage_percent"));
        assert!(unread("damage_percent>50").contains("has no ="));
        assert!(unread("damage_percent=x").contains("is no number"));
        assert_eq!(wanted("peak_pressure_mpa = 1 MPa").unwrap().1, 1.0);
        let until = (Quantity::Pressure, 1.0);
        let question = ThresholdSearch::read(short(), "impact.force_n=100:200", until).unwrap();
        let error = question
            .answer(&AtomicBool::new(false), |_| {})
            .unwrap_err();
        let error = error.to_string();
        assert!(
            error.contains("the nearest that it has: peak_force_") && error.len() < 250,
            "{error}"
        );
    }
}
