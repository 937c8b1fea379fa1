//! Through the window: a leapfrog whose step follows the stability bounds.
//!
//! v(n + 1/2) = v(n - 1/2) + a(x(n), v(n - 1/2)) (h(n-1) + h(n))/2, x(n + 1) = x(n) + v(n + 1/2)
//! h(n). Elastic forces are central, viscous ones lag half a step. The step grows by 5 % at most.
//! Semi-implicit Euler, for comparison, kicks by h(n) instead.
//!
//! The bound of the step is the least of these. Of each cell, by the theorem that no frequency of
//! the whole is above the highest of its parts (Irons and Treharne 1972): l/(sqrt(c^2 + s^2) + s),
//! which a test compares with the eigenvalues of every cell at rest, and l^2/(4 nu) of its
//! viscosity. Half of the time in which a corner triangle would be gone at its present rate: the
//! stiffness of a squeezed corner is not in the bound, so none is passed over in a step. Of each
//! segment of the shell, and of each segment in contact, a Courant number with the mass that moves
//! along with it, which was found by trial; random objects, their balance of energy and a quarter
//! of the step watch over it.

use crate::models::axisymmetric::eye::AxisymmetricEye;
use crate::models::axisymmetric::eye::parameters::Parameters;
use crate::models::axisymmetric::forces::contact::{Target, Touch};
use crate::models::axisymmetric::forces::object::{MovingObject, Object, ObjectOutline};
use crate::models::axisymmetric::forces::plain::PlainCells;
use crate::models::axisymmetric::forces::rows::CellRows;
use crate::models::axisymmetric::forces::shell::{Shell, ShellState};
use crate::models::axisymmetric::forces::state::{CellSums, Cells, NodeState};
use crate::models::axisymmetric::readings;
use crate::models::axisymmetric::recording::frames::FramesDue;
use crate::models::axisymmetric::recording::results::{Energy, EngineRun, Extremes};
use crate::models::axisymmetric::recording::sensor::{
    Accelerometers, BACK_MEAN_S, FORCE_MEAN_S, LowPass, RunningMean,
};
use crate::models::axisymmetric::recording::tissue::Tissues;
use crate::models::axisymmetric::time::until::Until;
use crate::models::pulse::{Piece, Pulse, Segment};
use crate::run::fold::FoldWatch;
use crate::run::kept::{Frame, Keep, Spacing, Traces};
use crate::run::watch::Watch;
use fearless_simd::Level;
use std::f64::consts::PI;
use std::ops::ControlFlow;

/// Share of the stability bound that steps take unless asked otherwise.
pub const STEP_SHARE: f64 = 0.75;
/// Most a step grows.
pub(crate) const GROWTH: f64 = 1.05;
/// A run may end when nothing has grown for a whole swing of the eye after its object has gone
/// this far, in m, or its pulse is over.
pub(crate) const GONE: f64 = 0.5e-3;
/// An eye shortened by this share has its front on its back: what comes then is not in the model.
pub(crate) const FLAT: f64 = 0.85;
/// Nor is it where the stability bound of a cell has fallen to this share of that at rest: a cell is pressed
/// to nothing. No preset at twice its speed comes below 0.0026, but what is flat before.
pub(crate) const PRESSED_TO_NOTHING: f64 = 1e-3;
/// An object is narrow if its radius is less than this share of the eye's.
pub(crate) const NARROW: f64 = 0.25;
/// Steps between two looks at the watch.
pub(crate) const WATCH_EVERY: usize = 256;

/// What acts on the eye.
#[derive(Debug, Clone, PartialEq)]
pub enum AxisymmetricLoad {
    /// It touches the front pole at the start, or the rim if that is nearer.
    Object(Object),
    /// A force against time, as a uniform traction along the axis on the area within a front angle
    /// (rad).
    Pulse(Pulse, f64),
}

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
    pub(crate) fn kick(&self, before: f64, step: f64) -> f64 {
        match self.scheme {
            Scheme::SemiImplicitEuler => step,
            Scheme::Leapfrog => 0.5 * (before + step),
        }
    }
}

/// Takes frames as they come, and may stop the run.
pub type Take<'a> = &'a mut dyn FnMut(Frame) -> ControlFlow<()>;

/// The longest stable step of an eye that nothing has moved yet, in s.
pub fn step_limit(eye: &AxisymmetricEye, blow: &AxisymmetricLoad) -> f64 {
    let mut motion = Motion::new(
        eye,
        CellRows::new(eye),
        blow,
        Keep::default(),
        Until::Time(1.0),
    );
    motion.forces(0.0).limit
}

/// Hits `eye` and follows it for `window`, which a number alone gives in s, with such `steps`, which
/// a number alone gives as a share of the stability bound.
///
/// # Errors
/// Motion that leaves the finite numbers, an object that goes through the eye, and what the watch
/// stops.
pub fn run(
    eye: &AxisymmetricEye,
    blow: &AxisymmetricLoad,
    window: impl Into<Until>,
    steps: impl Into<Steps>,
    keep: Keep,
    watch: Watch,
) -> Result<EngineRun, Stop> {
    run_as(CellLoop::Rows, eye, blow, window, steps, keep, watch)
}

/// [`run`] with the cells computed by `form`.
///
/// # Errors
/// See [`run`].
pub fn run_as(
    form: CellLoop,
    eye: &AxisymmetricEye,
    blow: &AxisymmetricLoad,
    window: impl Into<Until>,
    steps: impl Into<Steps>,
    keep: Keep,
    watch: Watch,
) -> Result<EngineRun, Stop> {
    let (steps, window) = (steps.into(), window.into());
    let mut frames = Vec::new();
    let take = &mut |frame| {
        frames.push(frame);
        ControlFlow::Continue(())
    };
    let run = match form {
        CellLoop::Plain => Motion::new(eye, PlainCells::new(eye), blow, keep, window)
            .run_through_window(steps, watch, take),
        CellLoop::Rows => Motion::new(eye, CellRows::new(eye), blow, keep, window)
            .run_through_window(steps, watch, take),
        CellLoop::Vectors(level) => {
            let rows = CellRows::with_level(eye, level);
            Motion::new(eye, rows, blow, keep, window).run_through_window(steps, watch, take)
        }
    };
    Ok(EngineRun { frames, ..run? })
}

/// [`run`] that hands on each frame when it is due and keeps nothing.
///
/// # Errors
/// See [`run`]; stopped by `take` too.
pub fn run_through(
    eye: &AxisymmetricEye,
    blow: &AxisymmetricLoad,
    window: impl Into<Until>,
    steps: impl Into<Steps>,
    spacing: Spacing,
    take: Take,
) -> Result<(), Stop> {
    let keep = Keep {
        traces: false,
        frames: Some(spacing),
    };
    let watch = &mut |_| ControlFlow::Continue(());
    let motion = Motion::new(eye, CellRows::new(eye), blow, keep, window.into());
    motion
        .run_through_window(steps.into(), watch, take)
        .map(|_| ())
}

/// When one of the readings, or a force or pressure that some of them are means of, last grew, in
/// s.
fn last_growth(extremes: &Extremes) -> f64 {
    let unfiltered = extremes.force.time.max(extremes.back_pressure.time);
    readings::of(extremes).last_peak().max(unfiltered)
}

/// How long the slowest swing of a filled shell takes, 2 pi sqrt(rho R^3/(E t)) but for a factor
/// near 1, in s. What a blow left then is smaller by what viscosity took: a rule, which tests
/// compare with whole windows, not a proof.
fn swing(eye: &AxisymmetricEye) -> f64 {
    let stiffness: f64 = eye.segments.iter().map(|s| s.modulus * s.thickness).sum();
    slowest_swing(&eye.parameters, stiffness / eye.segments.len() as f64)
}

/// [`swing`] with this mean of modulus times thickness, N/m.
pub(crate) fn slowest_swing(p: &Parameters, stiffness: f64) -> f64 {
    2.0 * PI * (p.vitreous.density * p.radius.powi(3) / stiffness).sqrt()
}

/// The load of a pulse on the shell's nodes.
pub(crate) struct Load {
    pulse: Pulse,
    segments: Vec<Segment>,
    shares: Vec<f64>,
}

impl Load {
    fn force(&self, time: f64) -> f64 {
        let now = self
            .segments
            .iter()
            .find(|s| time >= s.start && time <= s.end);
        now.map_or(0.0, |s| self.pulse.force(s.piece, time))
    }
}

pub(crate) struct Motion<'a, C> {
    pub eye: &'a AxisymmetricEye,
    pub cells: C,
    /// For the elastic energy.
    pub balance: PlainCells,
    pub mass: Vec<f64>,
    pub state: NodeState,
    pub shell: Shell,
    pub target: Target,
    pub object: Option<(Object, MovingObject)>,
    pub load: Option<Load>,
    /// Node and share of the lens's mass.
    pub lens: Vec<(usize, f64)>,
    pub lens_rest: f64,
    pub globe_volume: f64,
    /// s.
    pub swing: f64,
    pub accelerometers: Accelerometers,
    pub tissues: Tissues,
    pub force_mean: RunningMean,
    pub back_mean: RunningMean,
    /// Tension of the sclera in each segment, along and around, Pa, and through a low pass.
    pub tension: Vec<[f64; 2]>,
    pub tension_passed: Vec<[LowPass; 2]>,
    /// The largest of those that passed, Pa.
    pub stress: f64,
    /// Low passes of the mean pressure and of that at the back.
    pub filters: [LowPass; 2],
    pub window: Until,
    /// When what acts was last seen to be gone, s.
    pub over_since: Option<f64>,
    pub contact_evaluations: usize,
    pub keep: Keep,
    pub energy_before: f64,
    /// Most energy that has come in, and most that the balance was off, J.
    pub came: f64,
    pub missing: f64,
    pub energy: Energy,
    pub extremes: Extremes,
    pub fold: FoldWatch,
    pub traces: Traces,
    pub frame_taker: Option<FramesDue>,
}

/// What all parts say at some instant.
pub(crate) struct Instant {
    pub sums: CellSums,
    pub shell: ShellState,
    pub touch: Option<Touch>,
    pub force: f64,
    pub loss_in_object: f64,
    pub limit: f64,
}

impl<'a, C: Cells> Motion<'a, C> {
    fn new(
        eye: &'a AxisymmetricEye,
        cells: C,
        blow: &AxisymmetricLoad,
        keep: Keep,
        window: Until,
    ) -> Self {
        let target = Target::new(eye);
        let (object, load) = match blow {
            AxisymmetricLoad::Object(object) => {
                let front = target.first_touch(object, -eye.parameters.radius);
                let projectile = MovingObject::new(object, front);
                (Some((*object, projectile)), None)
            }
            AxisymmetricLoad::Pulse(pulse, half_width) => {
                let shares = Target::shares(eye, *half_width);
                let pulse = pulse.clone();
                let load = Load {
                    segments: pulse.segments(window.most()),
                    pulse,
                    shares,
                };
                (None, Some(load))
            }
        };
        let mut lens = vec![0.0; eye.mass.len()];
        for cell in eye.cells.iter().filter(|c| c.lens > 0.0) {
            for node in cell.corners {
                lens[node] += cell.lens * eye.mass[node];
            }
        }
        let total: f64 = lens.iter().sum();
        let lens: Vec<(usize, f64)> = lens
            .iter()
            .enumerate()
            .filter(|(_, m)| **m > 0.0)
            .map(|(node, m)| (cells.place(node), m / total))
            .collect();
        let mut extremes = Extremes::at_rest();
        if let AxisymmetricLoad::Pulse(_, half_width) = blow {
            extremes.contact_radius = eye.parameters.radius * libm::sin(half_width.min(0.5 * PI));
        }
        let state = cells.rest();
        let mut mass = vec![0.0; state.x.len()];
        for (node, m) in eye.mass.iter().enumerate() {
            mass[cells.place(node)] = *m;
        }
        let mut balance = PlainCells::new(eye);
        let globe_volume = balance.forces(&mut balance.rest()).volume;
        Self {
            lens_rest: lens.iter().map(|&(n, s)| s * state.x[n]).sum(),
            lens,
            globe_volume,
            swing: swing(eye),
            accelerometers: Accelerometers::new(eye, |n| cells.place(n)),
            tissues: Tissues::new(eye, &state, |n| cells.place(n)),
            balance,
            shell: Shell::new(eye),
            target,
            eye,
            cells,
            mass,
            state,
            energy_before: object.as_ref().map_or(0.0, |(_, f)| f.kinetic(0.0)),
            object,
            load,
            force_mean: RunningMean::over(FORCE_MEAN_S),
            back_mean: RunningMean::over(BACK_MEAN_S),
            tension: vec![[0.0; 2]; eye.segments.len()],
            tension_passed: vec![[LowPass::default(); 2]; eye.segments.len()],
            stress: 0.0,
            filters: [LowPass::default(); 2],
            window,
            over_since: None,
            contact_evaluations: 0,
            keep,
            came: 0.0,
            missing: 0.0,
            energy: Energy::default(),
            extremes,
            fold: FoldWatch::new(eye.cells.len()),
            traces: Traces::default(),
            frame_taker: keep.frames.map(FramesDue::new),
        }
    }

    fn run_through_window(
        mut self,
        by: Steps,
        watch: Watch,
        take: Take,
    ) -> Result<EngineRun, Stop> {
        let (mut time, mut step, mut steps) = (0.0, 0.0, 0);
        let (mut next_trace, mut next_balance) = (0.0, 0.0);
        let mut trace_every = self.window.trace_every();
        let (end, balance_every) = (self.window.most(), self.window.balance_every());
        let mut at_rest = None;
        loop {
            let share = self.window.share(time, self.swing);
            if steps % WATCH_EVERY == 0 && watch(share).is_break() {
                return Err(Stop::Watched);
            }
            let now = self.forces(time);
            let most = by.share * now.limit;
            let before = step;
            step = if steps == 0 {
                most
            } else {
                most.min(GROWTH * before)
            };
            let kick = by.kick(before, step);
            let forces = self.offer_readings(&now, time, before);
            let settled = steps % WATCH_EVERY == 0 && self.settled(time);
            let least = PRESSED_TO_NOTHING * *at_rest.get_or_insert(now.sums.limit);
            if now.sums.limit < least || self.extremes.shortening.value > FLAT {
                self.extremes.flat_at = Some(time);
            }
            let last = time >= end || settled || self.extremes.flat_at.is_some();
            let after = |every: f64| every * ((time / every).floor() + 1.0);
            let trace = self.keep.traces && (time >= next_trace || last);
            let balance = time >= next_balance || last;
            if balance {
                next_balance = after(balance_every);
            }
            if balance || trace {
                self.take_balance(&now, kick);
                if balance {
                    self.audit();
                }
                if !self.energy.total().is_finite() {
                    return Err(Stop::NotFinite { time, step: steps });
                }
            }
            if trace {
                self.take_trace(&now, time, forces);
                if !last {
                    self.window.thin(&mut self.traces, &mut trace_every);
                }
                next_trace = after(trace_every);
            }
            if !step.is_finite() || step <= 0.0 {
                return Err(Stop::NotFinite { time, step: steps });
            }
            self.refuse_if_gone_through(time)?;
            if last {
                return Ok(self.finish(time, steps, settled && time < end));
            }
            step = step.min(end - time).max(f64::MIN_POSITIVE);
            let kick = by.kick(before, step);
            self.energy.lost += now.sums.loss * kick;
            self.energy.lost_in_object += now.loss_in_object * kick;
            if let Some(load) = &self.load {
                let shell = self.state.shell.clone();
                let speed: f64 = load
                    .shares
                    .iter()
                    .zip(shell)
                    .map(|(share, i)| {
                        let after = kick * self.state.fx[i] * self.state.free_x[i];
                        share * (self.state.vx[i] + 0.5 * after)
                    })
                    .sum();
                self.energy.work += now.force * speed * kick;
            }
            self.cells.advance(&mut self.state, kick, step);
            if let Some((_, projectile)) = &mut self.object {
                self.energy.lost_in_object += projectile.advance(kick, step);
            }
            time += step;
            steps += 1;
            for frame in self.take_frames(time, step) {
                if take(frame).is_break() {
                    return Err(Stop::Watched);
                }
            }
        }
    }

    /// Forces of everything where it is now.
    fn forces(&mut self, time: f64) -> Instant {
        let sums = self.cells.forces(&mut self.state);
        let at = self.state.shell.clone();
        let (x, r) = (&self.state.x[at.clone()], &self.state.r[at.clone()]);
        let v = (&self.state.vx[at.clone()], &self.state.vr[at.clone()]);
        let fx = &mut self.state.fx[at.clone()];
        let fr = &mut self.state.fr[at];
        let shell = self
            .shell
            .forces((x, r), (&mut *fx, &mut *fr), &mut self.tension);
        let mut limit = sums.limit.min(self.shell.limit);
        let (mut force, mut loss_in_object) = (0.0, 0.0);
        let mut touch = None;
        if let Some((object, projectile)) = &mut self.object {
            projectile.inner();
            let touched = self.target.forces(object, projectile, (x, r), v, (fx, fr));
            loss_in_object = touched.loss;
            limit = limit.min(projectile.limit).min(touched.limit);
            force = touched.force;
            self.contact_evaluations += touched.segments;
            touch = Some(touched);
        }
        if let Some(load) = &self.load {
            force = load.force(time);
            for (f, share) in fx.iter_mut().zip(&load.shares) {
                *f += force * share;
            }
        }
        Instant {
            sums,
            shell,
            touch,
            force,
            loss_in_object,
            limit,
        }
    }

    /// Whether what acts is gone and nothing has grown for long. Traces and frames want the whole
    /// of a time that was asked for.
    fn settled(&mut self, time: f64) -> bool {
        if matches!(self.window, Until::Time(_)) && self.keep != Keep::default() {
            return false;
        }
        let over = match (&self.object, &self.load) {
            (Some((object, projectile)), _) => {
                let apex = self.state.shell.start;
                let away = self.state.x[apex] - projectile.x[0] - object.reach();
                let slowest = projectile.velocity().max(projectile.v[0]);
                away > GONE && slowest < self.state.vx[apex].min(0.0)
            }
            (_, Some(load)) => load
                .segments
                .iter()
                .any(|s| s.piece == Piece::Nothing && time > s.start),
            _ => false,
        };
        // An eye that was let go swings back: its growth may begin only now.
        let since = if over {
            *self.over_since.get_or_insert(time)
        } else {
            self.over_since = None;
            time
        };
        over && last_growth(&self.extremes).max(since) < time - self.swing
    }

    /// Whether the centre of the object lies behind the shell, on the axis or off it.
    fn refuse_if_gone_through(&self, time: f64) -> Result<(), Stop> {
        let Some((object, projectile)) = &self.object else {
            return Ok(());
        };
        let apex = self.state.x[self.state.shell.start];
        let centre = match object.outline {
            ObjectOutline::Sphere(_) => projectile.x[0],
            ObjectOutline::Cylinder(radius, _) => projectile.x[0] - radius,
        };
        // What flattens the eye with no more than a point is on its way through.
        let narrow = object.outline.radius() < NARROW * self.eye.parameters.radius;
        if centre > apex || narrow && self.extremes.flat_at.is_some() {
            return Err(Stop::WentThrough(time));
        }
        Ok(())
    }

    fn finish(mut self, time: f64, steps: usize, settled: bool) -> EngineRun {
        let eye: f64 = self
            .mass
            .iter()
            .zip(&self.state.vx)
            .map(|(m, v)| m * v)
            .sum();
        let object = self.object.as_ref().map_or(0.0, |(_, f)| f.momentum());
        if self.came > 0.0 {
            self.extremes.energy_residual = self.missing / self.came;
        }
        self.extremes.fold = self.fold.fold();
        self.extremes.touching = self.energy.contact > 0.0;
        self.extremes.rebound = self.object.as_ref().map(|(_, f)| -f.velocity());
        if self.extremes.missed() {
            // What an eye that nothing touched shows is rounding.
            self.extremes = Extremes {
                rim_force: self.extremes.rim_force,
                rebound: self.extremes.rebound,
                energy_residual: self.extremes.energy_residual,
                ..Extremes::at_rest()
            };
        }
        EngineRun {
            extremes: self.extremes,
            traces: self.keep.traces.then_some(self.traces),
            frames: Vec::new(),
            energy: self.energy,
            momentum: eye + object,
            steps,
            simulated: time,
            settled,
            cell_evaluations: (steps + 1) * self.eye.cells.len(),
            contact_evaluations: self.contact_evaluations,
        }
    }
}
