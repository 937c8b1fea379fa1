//! The axisymmetric eye and what hits it, through the window.
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
use crate::models::axisymmetric::forces::shell::{Shell, ShellState};
use crate::models::axisymmetric::forces::state::{CellSums, Cells, NodeState};
use crate::models::axisymmetric::forces::{plain::PlainCells, rows::CellRows};
use crate::models::axisymmetric::recording::account::{Account, Shape};
use crate::models::axisymmetric::recording::sensor::{Accelerometers, LowPass};
use crate::models::axisymmetric::recording::{results::EngineRun, tissue::Tissues};
use crate::models::axisymmetric::time::due::FramesDue;
use crate::models::axisymmetric::time::march::{
    Bounds, CellLoop, GONE, Marching, NARROW, Steps, Stop, Take, last_growth,
};
use crate::models::axisymmetric::time::until::Until;
use crate::models::pulse::{Piece, Pulse, Segment};
use crate::run::kept::{Keep, Spacing};
use crate::run::watch::{Watch, unwatched};
use std::f64::consts::PI;

/// What acts on the eye.
#[derive(Debug, Clone, PartialEq)]
pub enum AxisymmetricLoad {
    /// It touches the front pole at the start, or the rim if that is nearer.
    Object(Object),
    /// A force against time, as a uniform traction along the axis on the area within a front angle
    /// (rad).
    Pulse(Pulse, f64),
}

/// The longest stable step of an eye that nothing has moved yet, in s.
pub fn step_limit(eye: &AxisymmetricEye, blow: &AxisymmetricLoad) -> f64 {
    let (keep, window) = (Keep::default(), Until::Time(1.0));
    let mut motion = Motion::new(eye, CellLoop::Rows, blow, keep, window);
    motion.forces(0.0).limit
}

/// Hits `eye` and follows it for `window`, which a number alone gives in s, with such `steps`,
/// which a number alone gives as a share of the stability bound.
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
    let motion = Motion::new(eye, form, blow, keep, window.into());
    motion.march(steps.into(), watch, None)
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
    let keep = Keep { traces: false, frames: Some(spacing) };
    let motion = Motion::new(eye, CellLoop::Rows, blow, keep, window.into());
    let run = motion.march(steps.into(), &mut unwatched, Some(take));
    run.map(|_| ())
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
        let now = self.segments.iter().find(|s| time >= s.start && time <= s.end);
        now.map_or(0.0, |s| self.pulse.force(s.piece, time))
    }
}

pub(crate) struct Motion<'a> {
    pub eye: &'a AxisymmetricEye,
    pub cells: Box<dyn Cells>,
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
    /// Centre of mass at rest, m.
    pub middle: f64,
    pub shape: Shape,
    pub accelerometers: Accelerometers,
    pub tissues: Tissues,
    /// Tension of the sclera in each segment, along and around, Pa, and through a low pass.
    pub tension: Vec<[f64; 2]>,
    pub tension_passed: Vec<[LowPass; 2]>,
    pub account: Account,
    pub frames_due: Option<FramesDue<(f64, f64)>>,
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

impl<'a> Motion<'a> {
    pub(crate) fn new(
        eye: &'a AxisymmetricEye,
        form: CellLoop,
        blow: &AxisymmetricLoad,
        keep: Keep,
        window: Until,
    ) -> Self {
        let cells: Box<dyn Cells> = match form {
            CellLoop::Plain => Box::new(PlainCells::new(eye)),
            _ => Box::new(CellRows::new(eye, form.level())),
        };
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
                let load = Load { segments: pulse.segments(window.most()), pulse, shares };
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
        let state = cells.rest();
        let mut mass = vec![0.0; state.x.len()];
        for (node, m) in eye.mass.iter().enumerate() {
            mass[cells.place(node)] = *m;
        }
        let mut balance = PlainCells::new(eye);
        let globe_volume = balance.forces(&mut balance.rest()).volume;
        let brought = object.as_ref().map_or(0.0, |(_, f)| f.kinetic(0.0));
        let size = (globe_volume, eye.cells.len());
        let mut account = Account::new((window, keep), swing(eye), brought, size);
        if let AxisymmetricLoad::Pulse(_, half_width) = blow {
            let radius = eye.parameters.radius * libm::sin(half_width.min(0.5 * PI));
            account.extremes.contact_radius = radius;
        }
        Self {
            middle: mass.iter().zip(&state.x).map(|(m, x)| m * x).sum::<f64>()
                / mass.iter().sum::<f64>(),
            lens_rest: lens.iter().map(|&(n, s)| s * state.x[n]).sum(),
            lens,
            shape: Shape::default(),
            accelerometers: Accelerometers::new(eye, |n| cells.place(n)),
            tissues: Tissues::new(eye, &state, |n| cells.place(n)),
            balance,
            shell: Shell::new(eye),
            target,
            eye,
            cells,
            mass,
            state,
            account,
            object,
            load,
            tension: vec![[0.0; 2]; eye.segments.len()],
            tension_passed: vec![[LowPass::default(); 2]; eye.segments.len()],
            frames_due: keep.frames.map(FramesDue::new),
        }
    }
}

impl Marching for Motion<'_> {
    type Run = EngineRun;
    const ENDS_EVERY: usize = 256;

    fn forces(&mut self, time: f64) -> Instant {
        let sums = self.cells.forces(&mut self.state);
        let at = self.state.shell.clone();
        let (x, r) = (&self.state.x[at.clone()], &self.state.r[at.clone()]);
        let v = (&self.state.vx[at.clone()], &self.state.vr[at.clone()]);
        let fx = &mut self.state.fx[at.clone()];
        let fr = &mut self.state.fr[at];
        let shell = self.shell.forces((x, r), (&mut *fx, &mut *fr), &mut self.tension);
        let mut limit = sums.limit.min(self.shell.limit);
        let (mut force, mut loss_in_object) = (0.0, 0.0);
        let mut touch = None;
        if let Some((object, projectile)) = &mut self.object {
            projectile.inner();
            let touched = self.target.forces(object, projectile, (x, r), v, (fx, fr));
            loss_in_object = touched.loss;
            limit = limit.min(projectile.limit).min(touched.limit);
            force = touched.force;
            touch = Some(touched);
        }
        if let Some(load) = &self.load {
            force = load.force(time);
            for (f, share) in fx.iter_mut().zip(&load.shares) {
                *f += force * share;
            }
        }
        Instant { sums, shell, touch, force, loss_in_object, limit }
    }

    fn bounds(now: &Instant) -> Bounds {
        Bounds { all: now.limit, cells: now.sums.limit }
    }

    fn settled(&mut self, time: f64) -> bool {
        let over = match (&self.object, &self.load) {
            (Some((object, projectile)), _) => {
                let apex = self.state.shell.start;
                let away = self.state.x[apex] - projectile.x[0] - object.reach();
                away > GONE + projectile.swing()
                    && projectile.velocity() < self.state.vx[apex].min(0.0)
            }
            (_, Some(load)) => {
                load.segments.iter().any(|s| s.piece == Piece::Nothing && time > s.start)
            }
            _ => false,
        };
        let growth = last_growth(&self.account.extremes);
        self.account.settled(over, growth, time)
    }

    /// Whether the centre of the object lies behind the shell, on the axis or off it.
    fn gone_through(&self, _steps: usize, _last: bool) -> bool {
        let Some((object, projectile)) = &self.object else {
            return false;
        };
        let apex = self.state.x[self.state.shell.start];
        let centre = match object.outline {
            ObjectOutline::Sphere(_) => projectile.x[0],
            ObjectOutline::Cylinder(radius, _) => projectile.x[0] - radius,
        };
        // What flattens the eye with no more than a point is on its way through.
        let narrow = object.outline.radius() < NARROW * self.eye.parameters.radius;
        centre > apex || narrow && self.account.extremes.flat_at.is_some()
    }

    fn advance(&mut self, now: &Instant, kick: f64, step: f64) {
        let energy = &mut self.account.energy;
        energy.lost += now.sums.loss * kick;
        energy.lost_in_object += now.loss_in_object * kick;
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
            energy.work += now.force * speed * kick;
        }
        self.cells.advance(&mut self.state, kick, step);
        if let Some((_, projectile)) = &mut self.object {
            energy.lost_in_object += projectile.advance(kick, step);
        }
    }

    fn finish(mut self, time: f64, steps: usize, settled: bool) -> EngineRun {
        let eye: f64 = self.mass.iter().zip(&self.state.vx).map(|(m, v)| m * v).sum();
        let object = self.object.as_ref().map_or(0.0, |(_, f)| f.momentum());
        let rebound = self.object.as_ref().map(|(_, f)| -f.velocity());
        self.account.finish(rebound);
        EngineRun {
            extremes: self.account.extremes,
            traces: self.account.keep.traces.then_some(self.account.traces),
            frames: self.account.frames,
            energy: self.account.energy,
            momentum: eye + object,
            steps,
            simulated: time,
            settled,
        }
    }
}
