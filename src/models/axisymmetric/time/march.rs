//! Through the window: a leapfrog whose step follows the stability bounds, for every eye of cells.
//!
//! v(n + 1/2) = v(n - 1/2) + a(x(n), v(n - 1/2)) (h(n-1) + h(n))/2, x(n + 1) = x(n) + v(n + 1/2)
//! h(n). Elastic forces are central, viscous ones lag half a step. The step grows by 5 % at most.
//! Semi-implicit Euler, for comparison, kicks by h(n) instead.
//!
//! A run without a set time ends when what acts is gone and nothing that is read has grown for a
//! whole swing of the eye; any run ends when the eye is pressed flat.

use crate::models::axisymmetric::readings;
use crate::models::axisymmetric::recording::results::{Energy, Extremes};
use crate::models::axisymmetric::time::until::Until;
use crate::run::kept::{Frame, Keep, Traces};
use crate::run::watch::Watch;
use fearless_simd::Level;
use std::ops::ControlFlow;

/// Share of the stability bound that steps take unless asked otherwise. From 0.75 to 0.9 the
/// results of presets change by about 1 % at most, but for a pellet that flattens the eye.
pub const STEP_SHARE: f64 = 0.9;
/// Most a step grows.
const GROWTH: f64 = 1.05;
/// A run may end when nothing has grown for a whole swing of the eye after its object has gone
/// this far, in m, or its pulse is over.
pub(crate) const GONE: f64 = 0.5e-3;
/// An eye shortened by this share has its front on its back: what comes then is not in the model.
const FLAT: f64 = 0.85;
/// Nor is it where the stability bound of a cell has fallen to this share of that at rest: it is
/// pressed to nothing. No preset at twice its speed comes below 0.0026, but what is flat before.
const PRESSED_TO_NOTHING: f64 = 1e-3;
/// An object is narrow if its radius is less than this share of the eye's.
pub(crate) const NARROW: f64 = 0.25;
/// Steps between two looks at the watch, and at whether a run may end.
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

/// What a march keeps account of, whatever moves.
#[derive(Debug, Clone)]
pub(crate) struct Account {
    pub window: Until,
    /// How long the slowest swing of the eye takes, s.
    swing: f64,
    pub keep: Keep,
    /// Of the object at the start, J.
    pub energy_before: f64,
    pub energy: Energy,
    pub traces: Traces,
    /// When what acts was last seen to be gone, s.
    over_since: Option<f64>,
    /// Most energy that has come in, and most that the balance was off, J.
    came: f64,
    missing: f64,
}

impl Account {
    pub fn new(window: Until, swing: f64, keep: Keep, energy_before: f64) -> Self {
        Self {
            window,
            swing,
            keep,
            energy_before,
            energy: Energy::default(),
            traces: Traces::default(),
            over_since: None,
            came: 0.0,
            missing: 0.0,
        }
    }

    /// Compares the energies of the last balance. How often that is done must not depend on what is
    /// kept.
    fn audit(&mut self) {
        self.came = self.came.max(self.energy_before + self.energy.work.abs());
        let missing = (self.energy.total() - self.energy_before).abs();
        self.missing = self.missing.max(missing);
    }

    /// Largest error of the balance over the energy that came in.
    pub fn residual(&self) -> f64 {
        if self.came > 0.0 {
            self.missing / self.came
        } else {
            0.0
        }
    }

    /// Whether what acts is gone and nothing has grown for long. Traces and frames want the whole
    /// of a time that was asked for.
    fn settled(&mut self, over: bool, last_growth: f64, time: f64) -> bool {
        if matches!(self.window, Until::Time(_)) && self.keep != Keep::default() {
            return false;
        }
        // An eye that was let go swings back: its growth may begin only now.
        let since = if over {
            *self.over_since.get_or_insert(time)
        } else {
            self.over_since = None;
            time
        };
        over && last_growth.max(since) < time - self.swing
    }
}

/// When one of the readings, or a force or pressure that some of them are means of, last grew, in
/// s.
fn last_growth(extremes: &Extremes) -> f64 {
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
pub(crate) trait Marching: Sized {
    /// What all parts say at some instant.
    type Now;
    /// What is left at the end.
    type Run;

    fn account(&self) -> &Account;
    fn account_mut(&mut self) -> &mut Account;
    fn extremes(&self) -> &Extremes;
    fn extremes_mut(&mut self) -> &mut Extremes;

    /// Forces of everything where it is now.
    fn forces(&mut self, time: f64) -> Self::Now;
    fn bounds(now: &Self::Now) -> Bounds;
    /// Extremes of this instant, `step` s after the one before; returns the forces of the monitored
    /// nodes.
    fn offer_readings(&mut self, now: &Self::Now, at: (usize, f64), step: f64) -> [f64; 4];
    /// Readings that are not taken at every step, at the last.
    fn offer_last(&mut self, _time: f64) {}
    /// Whether what acts is gone.
    fn over(&self, time: f64) -> bool;
    /// Energies of this instant, at which forces act for `kick` s.
    fn take_balance(&mut self, now: &Self::Now, kick: f64);
    fn take_trace(&mut self, now: &Self::Now, time: f64, node_force: [f64; 4]);
    /// Whether the object has gone through; some look at every so many steps, and at the last.
    fn gone_through(&self, steps: usize, last: bool) -> bool;
    /// Moves everything by `step` s after a kick of `kick` s, and adds up what that costs.
    fn advance(&mut self, now: &Self::Now, kick: f64, step: f64);
    /// The frames that fall into the step of `step` s that ended at `time`.
    fn take_frames(&mut self, time: f64, step: f64) -> Vec<Frame>;
    fn finish(self, time: f64, steps: usize, settled: bool) -> Self::Run;

    /// Follows it through the window with such steps.
    ///
    /// # Errors
    /// See [`Stop`].
    fn march(mut self, by: Steps, watch: Watch, take: Take) -> Result<Self::Run, Stop> {
        let (mut time, mut step, mut steps) = (0.0, 0.0, 0);
        let (mut next_trace, mut next_balance) = (0.0, 0.0);
        let (window, swing) = (self.account().window, self.account().swing);
        let mut trace_every = window.trace_every();
        let (end, balance_every) = (window.most(), window.balance_every());
        let after = |time: f64, every: f64| every * ((time / every).floor() + 1.0);
        let mut at_rest = None;
        loop {
            let looks = steps % WATCH_EVERY == 0;
            if looks && watch(window.share(time, swing)).is_break() {
                return Err(Stop::Watched);
            }
            let now = self.forces(time);
            let bounds = Self::bounds(&now);
            let most = by.share * bounds.all;
            let before = step;
            step = if steps == 0 {
                most
            } else {
                most.min(GROWTH * before)
            };
            let forces = self.offer_readings(&now, (steps, time), before);
            let settled = looks && {
                let (over, growth) = (self.over(time), last_growth(self.extremes()));
                self.account_mut().settled(over, growth, time)
            };
            let least = PRESSED_TO_NOTHING * *at_rest.get_or_insert(bounds.cells);
            let flat = bounds.cells < least || self.extremes().shortening.value > FLAT;
            if flat {
                self.extremes_mut().flat_at = Some(time);
            }
            let last = time >= end || settled || flat;
            if last {
                self.offer_last(time);
            }
            let trace = self.account().keep.traces && (time >= next_trace || last);
            let balance = time >= next_balance || last;
            if balance || trace {
                self.take_balance(&now, by.kick(before, step));
                if balance {
                    next_balance = after(time, balance_every);
                    self.account_mut().audit();
                }
                if !self.account().energy.total().is_finite() {
                    return Err(Stop::NotFinite { time, step: steps });
                }
            }
            if trace {
                self.take_trace(&now, time, forces);
                if !last {
                    window.thin(&mut self.account_mut().traces, &mut trace_every);
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
            for frame in self.take_frames(time, step) {
                if take(frame).is_break() {
                    return Err(Stop::Watched);
                }
            }
        }
    }
}
