//! One crossing: bracketed, with the errors of step and mesh there, or the range of a risk.

use std::sync::atomic::AtomicBool;

use super::ThresholdSearch;
use crate::answer::mesh_error::{add_mesh_error, is_asked};
use crate::answer::results::Results;
use crate::answer::solve::{Answer, solve};
use crate::injury::{Injury, Risk};
use crate::many::root::{Bracket, narrowed};
use crate::run::refusal::{Refusal, unstopped};
use crate::run::{flags::Flag, kept::Keep, ordered::until, threads::beside};

/// How wide the bracket of a crossing is in the end, as a share of it.
pub(super) const WIDTH: f64 = 1e-4;
/// Share of a crossing by which its slope is measured to each side.
const STEP_ASIDE: f64 = 0.01;
/// How many runs a crossing takes is not known: each leaves this share of its progress to go.
const PATIENCE: f64 = 0.85;
/// Within a bracket a result jumps if it changes by more than this share of its range on the grid.
const JUMP: f64 = 0.05;
/// An end of such a range is looked for in steps of this ratio, so many of them at most.
const ASIDE: f64 = 1.2;
const FARTHEST: usize = 15;
/// Halvings of the step in which the end is found.
const HALVINGS: usize = 3;

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

/// What came of a run that may fail; only who stopped it wants no more.
fn if_known<T>(outcome: Result<T, Refusal>) -> Result<Option<T>, Refusal> {
    unstopped(outcome).map(Result::ok).ok_or(Refusal::Cancelled)
}

impl ThresholdSearch {
    /// The crossing within a bracket, of results that range over `spread` on the grid.
    pub(super) fn crossing(
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
            Ok(result.ok_or_else(|| self.absent(""))? - self.target)
        })?;
        let at = bracket.secant();
        let jump = ((bracket.high.1 - bracket.low.1).abs() > JUMP * spread)
            .then_some((bracket.low.1 + self.target, bracket.high.1 + self.target));
        let scenario = self.at(at)?;
        let mut answer = solve(&scenario, Keep::default(), &mut until(stop))?;
        one_more_run();
        if is_asked(&scenario) {
            add_mesh_error(&scenario, &mut answer, &mut until(stop))?;
        }
        one_more_run();
        let flags = answer.flags.clone();
        let mut crossing = Crossing { at, rising, step: None, mesh: None, jump, flags, risk: None };
        if jump.is_some() {
            return Ok(crossing);
        }
        if let Some(injury) = Injury::of(self.quantity) {
            let range = self.risk_range(injury, (at, rising), &answer, stop)?;
            crossing.risk = answer.risk(injury).map(|risk| RiskThere { risk, range });
            return Ok(crossing);
        }
        let aside = STEP_ASIDE * at.abs().max(WIDTH * (self.range.1 - self.range.0));
        let bounds = &self.bounds;
        let [from, to] = [at - aside, at + aside].map(|x| x.clamp(bounds.min, bounds.max));
        // Where nothing is beyond an end the slope is not known.
        let answer_at = |end| solve(&self.at(end)?, Keep::default(), &mut until(stop));
        let [low, high] = [from, to].map(|end| if_known(answer_at(end)));
        let value = |answer: &Answer| answer.results()[self.quantity];
        let rise = low?.zip(high?).and_then(|(low, high)| Some(value(&high)? - value(&low)?));
        let off = |errors: Option<&Results>| {
            let slope = rise? / (to - from);
            let off = errors?[self.quantity]? / 100.0 * value(&answer)?.abs() / slope.abs();
            off.is_finite().then_some(off)
        };
        crossing.step = off(Some(&answer.errors.time_step));
        crossing.mesh = off(answer.errors.mesh.as_ref());
        Ok(crossing)
    }

    /// Between which values of the field the range of a risk holds the target, as known at `at`.
    fn risk_range(
        &self,
        injury: Injury,
        (at, rising): (f64, bool),
        answer: &Answer,
        stop: &AtomicBool,
    ) -> Result<(Option<f64>, Option<f64>), Refusal> {
        let there = answer.risk(injury).filter(|_| at > 0.0);
        if there.is_none() {
            return Ok((None, None));
        }
        let target = self.target / self.quantity.row().factor;
        // Whether the upper or lower end of the range has the target at a value, if it is known.
        let reached = |value: f64, upper: bool| {
            let run = if_known(solve(&self.at(value)?, Keep::default(), &mut until(stop)))?;
            Ok(run
                .and_then(|run| run.risk(injury))
                .map(|risk| (if upper { risk.hit.high } else { risk.hit.low }) >= target))
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
                let has = reached(middle, upper)?;
                *(if has == Some(upper) { &mut near } else { &mut far }) = middle;
            }
            Ok(Some((near * far).sqrt()))
        };
        let (lower, upper) = beside(|| end(rising), || end(!rising));
        Ok((lower?, upper?))
    }
}
