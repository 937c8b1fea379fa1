//! Through the window: a leapfrog whose step follows the stability bounds.
//!
//! v(n + 1/2) = v(n - 1/2) + a(x(n), v(n - 1/2)) (h(n-1) + h(n))/2, x(n + 1) = x(n) + v(n + 1/2) h(n).
//! Elastic forces are central, viscous ones lag half a step. The step grows by 5 % at most.

use super::contact::{Target, Touch};
use super::object::{Flight, Object};
use super::plain::Plain;
use super::results::{Energy, Extremes, Frame, Keep, Peak, Run, Traces};
use super::rows::Rows;
use super::sensor::{Accelerometers, LowPass};
use super::shell::{Shell, ShellState};
use super::state::{Cells, State, Sums};
use crate::dynamics::load::{Piece, Pulse, Segment};
use crate::eye::revolution::RevolutionEye;
use fearless_simd::Level;
use std::ops::ControlFlow;

/// Share of the stability bound that steps take unless asked otherwise.
pub const STEP_SHARE: f64 = 0.6;
/// Most a step grows.
const GROWTH: f64 = 1.05;
/// Mass by which accelerations become the node forces of the paper, kg.
const NODE_MASS: f64 = 75e-6;
/// Balances of energy taken over a window.
const BALANCES: f64 = 100.0;
/// A run may end when nothing has grown since this share of its time, and for this long, in s, after its
/// object has gone this far from the eye, in m, or its pulse is over.
const QUIET_SHARE: f64 = 0.5;
const QUIET: f64 = 0.2e-3;
const GONE: f64 = 0.5e-3;
/// Steps between two looks at the watch.
const WATCH_EVERY: usize = 256;

/// What acts on the eye.
#[derive(Debug, Clone, PartialEq)]
pub enum Blow {
    /// It touches the front pole at the start.
    Object(Object),
    /// A force against time, as a uniform traction along the axis on the area within a front angle (rad).
    Pulse(Pulse, f64),
}

/// How the cells are computed.
#[derive(Debug, Clone, Copy)]
pub enum Form {
    /// One by one.
    Plain,
    /// In rows, many at once.
    Rows,
    /// The same with certain vectors.
    Vectors(Level),
}

/// A run without a result.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum Refusal {
    /// The motion left the finite numbers.
    #[error("the motion is no longer finite at {:.6} ms", .0 * 1e3)]
    NotFinite(f64),
    /// The object's centre came to lie behind the shell: such a thing bursts or flattens, or the eye does.
    #[error("the object went through the front of the eye at {:.6} ms", .0 * 1e3)]
    Through(f64),
    /// The watch stopped it.
    #[error("stopped at {:.6} ms", .0 * 1e3)]
    Stopped(f64),
}

/// Told of the share of the window that is done, it may stop the run.
pub type Watch<'a> = &'a mut dyn FnMut(f64) -> ControlFlow<()>;

/// Hits `eye` and follows it for `window` s, with steps of `step_share` of the stability bound.
///
/// # Errors
/// Motion that leaves the finite numbers, an object that goes through the eye, and what the watch stops.
pub fn run(
    eye: &RevolutionEye,
    blow: &Blow,
    window: f64,
    step_share: f64,
    keep: Keep,
    watch: Watch,
) -> Result<Run, Refusal> {
    run_as(Form::Rows, eye, blow, window, step_share, keep, watch)
}

/// The same with the cells computed in a certain form.
///
/// # Errors
/// See [`run`].
pub fn run_as(
    form: Form,
    eye: &RevolutionEye,
    blow: &Blow,
    window: f64,
    step_share: f64,
    keep: Keep,
    watch: Watch,
) -> Result<Run, Refusal> {
    match form {
        Form::Plain => Motion::new(eye, Plain::new(eye), blow, keep, window).go(step_share, watch),
        Form::Rows => Motion::new(eye, Rows::new(eye), blow, keep, window).go(step_share, watch),
        Form::Vectors(level) => {
            let rows = Rows::with_level(eye, level);
            Motion::new(eye, rows, blow, keep, window).go(step_share, watch)
        }
    }
}

/// The load of a pulse on the shell's nodes.
struct Load {
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

struct Motion<'a, C> {
    eye: &'a RevolutionEye,
    cells: C,
    /// For the elastic energy.
    balance: Plain,
    mass: Vec<f64>,
    state: State,
    shell: Shell,
    target: Target,
    object: Option<(Object, Flight)>,
    load: Option<Load>,
    /// Node and share of the lens's mass.
    lens: Vec<(usize, f64)>,
    lens_rest: f64,
    globe_volume: f64,
    accelerometers: Accelerometers,
    filters: [LowPass; 3],
    window: f64,
    keep: Keep,
    energy_before: f64,
    /// Most energy that has come in, and most that the balance was off, J.
    came: f64,
    missing: f64,
    energy: Energy,
    extremes: Extremes,
    traces: Traces,
    frames: Vec<Frame>,
}

/// What all parts say at some instant.
struct Instant {
    sums: Sums,
    shell: ShellState,
    touch: Option<Touch>,
    force: f64,
    loss_in_object: f64,
    limit: f64,
}

impl<'a, C: Cells> Motion<'a, C> {
    fn new(eye: &'a RevolutionEye, cells: C, blow: &Blow, keep: Keep, window: f64) -> Self {
        let (object, load) = match blow {
            Blow::Object(object) => {
                let flight = Flight::new(object, -eye.parameters.radius);
                (Some((*object, flight)), None)
            }
            Blow::Pulse(pulse, half_width) => {
                let shares = Target::shares(eye, *half_width);
                let pulse = pulse.clone();
                let load = Load {
                    segments: pulse.segments(window),
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
        let state = cells.rest();
        let mut mass = vec![0.0; state.x.len()];
        for (node, m) in eye.mass.iter().enumerate() {
            mass[cells.place(node)] = *m;
        }
        let zero = Peak::default();
        let mut balance = Plain::new(eye);
        let globe_volume = balance.forces(&mut balance.rest()).volume;
        Self {
            lens_rest: lens.iter().map(|&(n, s)| s * state.x[n]).sum(),
            lens,
            globe_volume,
            accelerometers: Accelerometers::new(eye, |n| cells.place(n)),
            balance,
            shell: Shell::new(eye),
            target: Target::new(eye),
            eye,
            cells,
            mass,
            state,
            energy_before: object.as_ref().map_or(0.0, |(_, f)| f.kinetic(0.0)),
            object,
            load,
            filters: [LowPass::default(); 3],
            window,
            keep,
            came: 0.0,
            missing: 0.0,
            energy: Energy::default(),
            extremes: Extremes {
                force: zero,
                filtered_force: zero,
                rim_force: zero,
                pressure: zero,
                back_pressure: zero,
                scleral_stress: zero,
                stress_angle: 0.0,
                shortening: zero,
                equator_growth: zero,
                meridian_growth: zero,
                intrusion: zero,
                apex: zero,
                lens: zero,
                node_force: [zero; 4],
                least_volume: 1.0,
                most_volume: 1.0,
                least_triangle: 1.0,
                folded_at: None,
                energy_imparted: 0.0,
                rebound: None,
                energy_residual: 0.0,
            },
            traces: Traces::default(),
            frames: Vec::new(),
        }
    }

    fn go(mut self, step_share: f64, watch: Watch) -> Result<Run, Refusal> {
        let (mut time, mut step, mut steps) = (0.0, 0.0, 0);
        let (mut next_trace, mut next_frame, mut next_balance) = (0.0, 0.0, 0.0);
        loop {
            if steps % WATCH_EVERY == 0 && watch(time / self.window).is_break() {
                return Err(Refusal::Stopped(time));
            }
            let now = self.forces(time);
            let most = step_share * now.limit;
            let before = step;
            step = if steps == 0 {
                most
            } else {
                most.min(GROWTH * before)
            };
            let kick = 0.5 * (before + step);
            let forces = self.look(&now, time, before);
            let settled = steps % WATCH_EVERY == 0 && self.settled(time);
            let last = time >= self.window || settled;
            let due = |next: &mut f64, every: Option<f64>| match every {
                Some(every) if time >= *next || last => {
                    *next = time + every;
                    true
                }
                _ => false,
            };
            let trace = due(&mut next_trace, self.keep.traces);
            if due(&mut next_balance, Some(self.window / BALANCES)) || trace {
                self.take_balance(&now, kick);
                if !self.energy.total().is_finite() {
                    return Err(Refusal::NotFinite(time));
                }
            }
            if trace {
                self.take_trace(&now, time, forces);
            }
            if due(&mut next_frame, self.keep.frames) {
                self.take_frame(time);
            }
            if !step.is_finite() || step <= 0.0 {
                return Err(Refusal::NotFinite(time));
            }
            self.through(time)?;
            if last {
                let settled = time < self.window;
                return Ok(self.finish(time, steps, settled));
            }
            step = step.min(self.window - time).max(f64::MIN_POSITIVE);
            let kick = 0.5 * (before + step);
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
            if let Some((_, flight)) = &mut self.object {
                self.energy.lost_in_object += flight.advance(kick, step);
            }
            time += step;
            steps += 1;
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
        let shell = self.shell.forces(x, r, fx, fr);
        let mut limit = sums.limit.min(self.shell.limit);
        let (mut force, mut loss_in_object) = (0.0, 0.0);
        let mut touch = None;
        if let Some((object, flight)) = &mut self.object {
            flight.inner();
            let touched = self.target.forces(object, flight, (x, r), v, (fx, fr));
            loss_in_object = touched.loss;
            limit = limit.min(flight.limit).min(touched.limit);
            force = touched.force;
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

    /// Extremes of this instant, `step` s after the one before; returns the forces of the monitored nodes.
    fn look(&mut self, now: &Instant, time: f64, step: f64) -> [f64; 4] {
        let share = LowPass::share(step);
        let e = &mut self.extremes;
        e.force.raise(now.force, time);
        e.filtered_force
            .raise(self.filters[0].pass(now.force, share), time);
        e.pressure
            .raise(self.filters[1].pass(now.sums.pressure, share), time);
        e.back_pressure
            .raise(self.filters[2].pass(now.sums.sensor, share), time);
        if now.shell.stress > e.scleral_stress.value {
            e.scleral_stress.raise(now.shell.stress, time);
            e.stress_angle = self.eye.segments[now.shell.at].front_angle;
        }
        if let Some(touch) = &now.touch {
            e.rim_force.raise(-touch.rim, time);
        }
        let shape = Shape::of(self.eye, &self.state, &self.lens, self.lens_rest);
        e.shortening.raise(shape.shortening, time);
        e.equator_growth.raise(shape.equator_growth, time);
        e.meridian_growth
            .raise(now.shell.length / self.shell.rest_length - 1.0, time);
        e.apex.raise(shape.apex, time);
        e.lens.raise(shape.lens, time);
        if let Some((object, flight)) = &self.object {
            let touched = -self.eye.parameters.radius - object.reach();
            e.intrusion.raise(flight.x[0] - touched, time);
        }
        let volume = now.sums.volume / self.globe_volume;
        e.least_volume = e.least_volume.min(volume);
        e.most_volume = e.most_volume.max(volume);
        e.least_triangle = e.least_triangle.min(now.sums.least_triangle);
        if now.sums.least_triangle <= 0.0 && e.folded_at.is_none() {
            e.folded_at = Some(time);
        }
        let accelerations = self.accelerometers.read(&self.state, time - 0.5 * step);
        let forces = accelerations.map(|a| NODE_MASS * a);
        for (peak, force) in e.node_force.iter_mut().zip(forces) {
            peak.raise(force, time);
        }
        forces
    }

    /// Whether what acts is gone and nothing has grown for long. Traces and frames want the whole window.
    fn settled(&self, time: f64) -> bool {
        if self.keep != Keep::default() {
            return false;
        }
        let over = match (&self.object, &self.load) {
            (Some((object, flight)), _) => {
                let apex = self.state.shell.start;
                let away = self.state.x[apex] - flight.x[0] - object.reach();
                let slowest = flight.velocity().max(flight.v[0]);
                away > GONE && slowest < self.state.vx[apex].min(0.0)
            }
            (_, Some(load)) => load
                .segments
                .iter()
                .any(|s| s.piece == Piece::Nothing && time > s.start),
            _ => false,
        };
        let growth = self.extremes.last_growth();
        over && growth < QUIET_SHARE * time && growth < time - QUIET
    }

    /// Whether the centre of the object lies behind the shell, on the axis or off it.
    fn through(&self, time: f64) -> Result<(), Refusal> {
        let Some((object, flight)) = &self.object else {
            return Ok(());
        };
        let apex = self.state.x[self.state.shell.start];
        let centre = match object.outline {
            super::Outline::Sphere(_) => flight.x[0],
            super::Outline::Cylinder(radius, _) => flight.x[0] - radius,
        };
        if centre > apex {
            return Err(Refusal::Through(time));
        }
        Ok(())
    }

    fn take_balance(&mut self, now: &Instant, kick: f64) {
        let state = &self.state;
        let stored = self.balance.energy(|node| {
            let place = self.cells.place(node);
            (state.x[place], state.r[place])
        });
        self.energy.elastic = stored + now.shell.energy;
        self.energy.contact = now.touch.map_or(0.0, |t| t.energy);
        self.energy.kinetic = (0..state.x.len())
            .map(|i| {
                let along = state.vx[i] * (state.vx[i] + kick * state.fx[i] * state.free_x[i]);
                let across = state.vr[i] * (state.vr[i] + kick * state.fr[i] * state.free_r[i]);
                0.5 * self.mass[i] * (along + across)
            })
            .sum();
        let (mut object, mut given) = (0.0, self.energy.work);
        if let Some((_, flight)) = &self.object {
            object = flight.kinetic(kick) + flight.stored();
            given = self.energy_before - object - self.energy.lost_in_object - self.energy.contact;
        }
        self.energy.object = object;
        self.extremes.energy_imparted = given;
        self.came = self.came.max(self.energy_before + self.energy.work.abs());
        let missing = (self.energy.total() - self.energy_before).abs();
        self.missing = self.missing.max(missing);
    }

    fn take_trace(&mut self, now: &Instant, time: f64, node_force: [f64; 4]) {
        let shape = Shape::of(self.eye, &self.state, &self.lens, self.lens_rest);
        let t = &mut self.traces;
        t.time.push(time);
        t.force.push(now.force);
        t.pressure.push(self.filters[1].0);
        t.back_pressure.push(self.filters[2].0);
        t.scleral_stress.push(now.shell.stress);
        t.shortening.push(shape.shortening);
        t.equator_growth.push(shape.equator_growth);
        t.meridian_growth
            .push(now.shell.length / self.shell.rest_length - 1.0);
        t.apex.push(shape.apex);
        t.lens.push(shape.lens);
        if let Some((object, flight)) = &self.object {
            t.object.push(flight.x[0]);
            t.intrusion
                .push(flight.x[0] + self.eye.parameters.radius + object.reach());
        }
        for (trace, force) in t.node_force.iter_mut().zip(node_force) {
            trace.push(force);
        }
        t.energy.push(self.energy);
    }

    fn take_frame(&mut self, time: f64) {
        let nodes = 0..self.eye.mass.len();
        let read = |of: &[f64]| nodes.clone().map(|n| of[self.cells.place(n)]).collect();
        self.frames.push(Frame {
            time,
            x: read(&self.state.x),
            r: read(&self.state.r),
            pressure: self.cells.pressures(),
            object: self.object.as_ref().map(|(_, f)| f.x[0]),
        });
    }

    fn finish(mut self, time: f64, steps: usize, settled: bool) -> Run {
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
        self.extremes.rebound = self.object.as_ref().map(|(_, f)| -f.velocity());
        Run {
            extremes: self.extremes,
            traces: self.keep.traces.map(|_| self.traces),
            frames: self.frames,
            energy: self.energy,
            momentum: eye + object,
            steps,
            simulated: time,
            settled,
            cell_evaluations: (steps + 1) * self.eye.cells.len(),
        }
    }
}

/// How the eye has changed its shape.
struct Shape {
    shortening: f64,
    equator_growth: f64,
    apex: f64,
    lens: f64,
}

impl Shape {
    fn of(eye: &RevolutionEye, state: &State, lens: &[(usize, f64)], lens_rest: f64) -> Self {
        let shell = state.shell.clone();
        let (front, back) = (state.x[shell.start], state.x[shell.end - 1]);
        let radius = eye.parameters.radius;
        let widest = |r: &[f64]| r.iter().copied().fold(0.0, f64::max);
        let rest = eye
            .mesh
            .shell
            .iter()
            .map(|&n| eye.mesh.r[n])
            .fold(0.0, f64::max);
        Self {
            shortening: 1.0 - (back - front) / (2.0 * radius),
            equator_growth: widest(&state.r[shell]) / rest - 1.0,
            apex: front + radius,
            lens: lens.iter().map(|&(n, s)| s * state.x[n]).sum::<f64>() - lens_rest,
        }
    }
}
