//! Through the window: a leapfrog whose step follows the stability bounds, for every eye of cells.
//!
//! v(n + 1/2) = v(n - 1/2) + a(x(n), v(n - 1/2)) (h(n-1) + h(n))/2, x(n + 1) = x(n) + v(n + 1/2)
//! h(n). Elastic forces are central, viscous ones lag half a step. The step grows by 5 % at most.
//! Semi-implicit Euler, for comparison, kicks by h(n) instead.
//!
//! A run without a set time ends when what acts is gone and nothing that is read has grown for a
//! whole swing of the eye; any run ends when the eye is pressed flat.

use crate::models::axisymmetric::recording::results::Extremes;
use crate::models::axisymmetric::{readings, recording::account::Recorded};
use crate::run::watch::Watch;
use crate::run::{flags::PRESSED_FLAT, kept::Frame, plan::Plan, refusal::Refusal, rules::Rules};
use crate::scenario::Integrator;
use fearless_simd::Level;
use std::ops::ControlFlow;

/// Share of the stability bound that steps take unless asked otherwise. From 0.75 to 0.9 the
/// results of presets change by about 1 % at most, but for a pellet that flattens the eye.
pub const STEP_SHARE: f64 = 0.9;
/// Most a step grows.
pub(crate) const GROWTH: f64 = 1.05;
/// A run may end when nothing has grown for a whole swing of the eye after its object has gone
/// this far, in m, or its pulse is over.
pub(crate) const GONE: f64 = 0.5e-3;
/// What comes after [`PRESSED_FLAT`] is not in the model, nor what comes where the stability bound
/// of a cell has fallen to this share of that at rest: it is pressed to nothing. No preset at twice
/// its speed comes near, but what is flat before.
const PRESSED_TO_NOTHING: f64 = 7e-4;
/// An object is narrow if its radius is less than this share of the eye's.
pub(crate) const NARROW: f64 = 0.25;
/// Steps between two looks at the watch.
const WATCH_EVERY: usize = 256;

/// How the cells are computed.
#[derive(Debug, Clone, Copy)]
pub enum CellLoop {
    /// One by one.
    Plain,
    /// In rows, many at once, by the widest vectors of the machine.
    Rows,
    /// In rows, by these vectors.
    Vectors(Level),
}

impl CellLoop {
    /// The vectors of what goes by vectors.
    pub(crate) fn level(self) -> Level {
        match self {
            Self::Plain | Self::Rows => Level::new(),
            Self::Vectors(level) => level,
        }
    }
}

/// Why a run ended without a result.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Stop {
    /// The motion left the finite numbers.
    NotFinite {
        /// Simulated time, in s.
        time: f64,
        /// Number of the step.
        step: usize,
    },
    /// The object's centre came to lie behind the shell, at this time in s: such a thing bursts or
    /// flattens, or the eye does.
    WentThrough(f64),
    /// The watch stopped it.
    Watched,
}

/// How long forces act on a step.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Scheme {
    /// Half of the step before and half of the step to come: velocity Verlet.
    Leapfrog,
    /// The step to come.
    SemiImplicitEuler,
}

/// How long steps are and how they are taken.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Steps {
    /// Share of the stability bound.
    pub share: f64,
    /// How long forces act on each.
    pub scheme: Scheme,
}

impl From<f64> for Steps {
    fn from(share: f64) -> Self {
        let scheme = Scheme::Leapfrog;
        Self { share, scheme }
    }
}

impl Steps {
    /// Those of a plan, whose step is that of the eye at rest: a share of its `limit`, in s.
    ///
    /// # Errors
    /// Refuses an integrator that is not among the `rules`.
    pub(crate) fn by(plan: &Plan, limit: f64, rules: &Rules) -> Result<Self, Refusal> {
        Ok(Self {
            share: plan.step / plan.multiple / limit,
            scheme: match plan.integrator {
                Integrator::VelocityVerlet => Scheme::Leapfrog,
                Integrator::SemiImplicitEuler => Scheme::SemiImplicitEuler,
                other => return Err(rules.unfit(other)),
            },
        })
    }

    /// How long forces act on a step of `step` s after one of `before` s.
    fn kick(&self, before: f64, step: f64) -> f64 {
        match self.scheme {
            Scheme::SemiImplicitEuler => step,
            Scheme::Leapfrog => 0.5 * (before + step),
        }
    }
}

/// Takes frames as they come, and may stop the run.
pub type Take<'a> = &'a mut dyn FnMut(Frame) -> ControlFlow<()>;

/// When one of the readings, or a force or pressure that some of them are means of, last grew, in
/// s.
pub(crate) fn last_growth(extremes: &Extremes) -> f64 {
    let unfiltered = extremes.force.time.max(extremes.back_pressure.time);
    readings::of(extremes).last_peak().max(unfiltered)
}

/// The longest stable step, s, of all parts and of the cells alone.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Bounds {
    pub all: f64,
    pub cells: f64,
}

/// An eye and what hits it, on their way through the window.
pub(crate) trait Marching: Recorded + Sized {
    /// What is left at the end.
    type Run;
    /// Steps between two looks at whether a run may end.
    const ENDS_EVERY: usize;

    /// Forces of everything where it is now.
    fn forces(&mut self, time: f64) -> Self::Now;
    fn bounds(now: &Self::Now) -> Bounds;
    /// Whether what acts is gone and nothing can grow any more.
    fn settled(&mut self, time: f64) -> bool;
    /// Whether the object has gone through; some look at every so many steps, and at the last.
    fn gone_through(&self, steps: usize, last: bool) -> bool;
    /// Moves everything by `step` s after a kick of `kick` s, and adds up what that costs.
    fn advance(&mut self, now: &Self::Now, kick: f64, step: f64);
    fn finish(self, time: f64, steps: usize, settled: bool) -> Self::Run;

    /// Follows it through the window with such steps. Frames that nobody takes are kept.
    ///
    /// # Errors
    /// See [`Stop`].
    fn march(mut self, by: Steps, watch: Watch, mut take: Option<Take>) -> Result<Self::Run, Stop> {
        let (mut time, mut step, mut steps) = (0.0, 0.0, 0);
        let (mut next_trace, mut next_balance) = (0.0, 0.0);
        let (window, swing) = (self.account().window, self.account().swing);
        let mut trace_every = window.trace_every();
        let (end, balance_every) = (window.most(), window.balance_every());
        let after = |time: f64, every: f64| every * ((time / every).floor() + 1.0);
        let mut at_rest = None;
        loop {
            if steps % WATCH_EVERY == 0 && watch(window.share(time, swing)).is_break() {
                return Err(Stop::Watched);
            }
            let now = self.forces(time);
            let bounds = Self::bounds(&now);
            let most = by.share * bounds.all;
            let before = step;
            step = if steps == 0 { most } else { most.min(GROWTH * before) };
            let forces = self.read(&now, (steps, time), (before, by.kick(before, step)));
            let settled = steps.is_multiple_of(Self::ENDS_EVERY) && self.settled(time);
            let least = PRESSED_TO_NOTHING * *at_rest.get_or_insert(bounds.cells);
            let extremes = &mut self.account().extremes;
            let flat = bounds.cells < least || extremes.shortening.value > PRESSED_FLAT;
            if flat {
                extremes.flat_at = Some(time);
            }
            let last = time >= end || settled || flat;
            if last {
                self.read_last(time);
            }
            let trace = self.account().keep.traces && (time >= next_trace || last);
            let balance = time >= next_balance || last;
            if balance || trace {
                self.balance(&now, by.kick(before, step));
                if balance {
                    next_balance = after(time, balance_every);
                    self.account().audit();
                }
                if !self.account().energy.total().is_finite() {
                    return Err(Stop::NotFinite { time, step: steps });
                }
            }
            if trace {
                self.trace(&now, time, forces);
                if !last {
                    window.thin(&mut self.account().traces, &mut trace_every);
                }
                next_trace = after(time, trace_every);
            }
            if !step.is_finite() || step <= 0.0 {
                return Err(Stop::NotFinite { time, step: steps });
            }
            if self.gone_through(steps, last) {
                return Err(Stop::WentThrough(time));
            }
            if last {
                return Ok(self.finish(time, steps, settled && time < end));
            }
            step = step.min(end - time).max(f64::MIN_POSITIVE);
            self.advance(&now, by.kick(before, step), step);
            time += step;
            steps += 1;
            let frames = self.frames(time, step);
            let Some(take) = &mut take else {
                self.account().frames.extend(frames);
                continue;
            };
            for frame in frames {
                if take(frame).is_break() {
                    return Err(Stop::Watched);
                }
            }
        }
    }
}
