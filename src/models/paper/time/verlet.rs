//! Steps of a scene with a projectile: velocity Verlet.
//!
//! With a(x) the acceleration by springs and contact, one step is
//!
//! `v' = v + h/2 a,  x += h v',  a = a(x),  v = v' + h/2 a`,
//!
//! of second order, with one evaluation a step. Drag on absolute velocity is solved exactly within the
//! drift, as in [`crate::models::paper::time::composition`]. It is stable up to h = 2 / w of the largest frequency w; the bound
//! of w holds for springs in any shape, that of the contact is an estimate, see there.
//!
//! The penalty of a contact is far stiffer than the eye, and its force has a kink at touch, where
//! methods of high order lose theirs. So the steps are short while the projectile could touch, and
//! a whole number of times longer while it could not.

use crate::models::paper::forces::coupled::{Coupled, Workspace};
use crate::models::paper::forces::kernel;
use crate::models::paper::forces::kernel::Survey;
use crate::models::pulse::Segment;
use crate::models::paper::forces::state::State;
use crate::models::paper::forces::system::{LANES, System};
use crate::models::paper::time::composition::exact_reach;
use crate::run::plan::Cost;
use crate::models::paper::time::stepper::{EqualSteps, Stepper};

/// Share of its radius that a projectile may fly within a step.
const FLIGHT: f64 = 0.1;
/// Short steps in a long one at most.
const MAX_SHORT: f64 = 1000.0;
/// How many times the distance that could be closed within a long step must be left for one.
const CAUTION: f64 = 2.0;

impl Coupled {
    /// Largest step in contact, in s: stable, and too short for the projectile to pass the shell.
    pub fn step_limit(&self) -> f64 {
        let flight = FLIGHT * self.contact.radius / self.contact.speed;
        (2.0 / self.omega(true).max(1.0)).min(flight)
    }

    /// How many short steps one out of contact may be long.
    fn substeps(&self) -> usize {
        let ratio = 2.0 / self.omega(false).max(1.0) / self.step_limit();
        // Rounding must not turn a ratio of one into none.
        (ratio * (1.0 + 1e-9)).clamp(1.0, MAX_SHORT) as usize
    }
}

/// Velocity Verlet with substeps where the projectile could touch.
pub(crate) struct SubsteppedVerlet<'a> {
    system: &'a System,
    coupled: &'a Coupled,
    work: Workspace,
    /// Short steps in a long one.
    substeps: usize,
    /// Counts short steps.
    clock: EqualSteps,
    short: Drift,
    long: Drift,
}

/// A step of one length.
#[derive(Debug, Clone, Copy, Default)]
struct Drift {
    /// In s.
    step: f64,
    /// Distance per speed in globe and fat, in s.
    reach: [f64; 2],
    /// Share of the speed that is left, in globe and fat.
    keep: [f64; 2],
}

impl Drift {
    fn new(decay: [f64; 2], step: f64) -> Self {
        Self {
            step,
            reach: decay.map(|rate| exact_reach(rate, step)),
            keep: decay.map(|rate| libm::exp(-rate * step)),
        }
    }
}

impl<'a> SubsteppedVerlet<'a> {
    pub fn new(system: &'a System, coupled: &'a Coupled) -> Self {
        Self {
            system,
            coupled,
            work: coupled.workspace(),
            substeps: coupled.substeps(),
            clock: EqualSteps::default(),
            short: Drift::default(),
            long: Drift::default(),
        }
    }

    /// Acceleration, readings and survey at the state.
    fn evaluate(&mut self, state: &mut State, force: f64, cost: &mut Cost) -> Survey {
        let mut survey = kernel::evaluate(self.system, state, force, 0.0);
        self.coupled.accelerate(state, &mut self.work, cost);
        cost.evaluations += 1;
        survey.elastic += state.readings.stored;
        survey
    }

    /// Whether the projectile could come to touch within `time` s.
    fn may_touch(&self, state: &State, time: f64) -> bool {
        let r = &state.readings;
        let closing = r.body.velocity.norm() + self.coupled.fastest_shell(state);
        r.gap <= CAUTION * closing * time
    }
}

impl Stepper for SubsteppedVerlet<'_> {
    fn begin(
        &mut self,
        state: &mut State,
        segment: &Segment,
        steps: usize,
        cost: &mut Cost,
    ) -> Survey {
        let long_steps = steps.div_ceil(self.substeps);
        self.clock = EqualSteps::new(segment, long_steps * self.substeps);
        let (decay, short) = (self.system.decay, self.clock.length());
        self.short = Drift::new(decay, short);
        self.long = Drift::new(decay, short * self.substeps as f64);
        state.time = segment.start;
        let force = self.system.load().pulse.force(segment.piece, segment.start);
        self.evaluate(state, force, cost)
    }

    fn step(&mut self, state: &mut State, segment: &Segment, cost: &mut Cost) -> Survey {
        let long = self.clock.taken().is_multiple_of(self.substeps)
            && !self.may_touch(state, self.long.step);
        let (share, drift) = if long {
            (self.substeps, self.long)
        } else {
            (1, self.short)
        };
        let Drift {
            step: h,
            reach,
            keep,
        } = drift;
        let half = 0.5 * h;
        let pulse = &self.system.load().pulse;
        let forces = [state.time, state.time + h].map(|time| pulse.force(segment.piece, time));
        let earlier = state.readings;
        let len = self.coupled.inverse_mass.len();
        let groups = &self.system.groups;
        for slot in 0..len {
            let fat = usize::from(groups[slot / LANES].fat[slot % LANES] > 0.0);
            let (ax, ay) = (state.ax[slot], state.ay[slot]);
            let (vx, vy) = (state.vx[slot] + half * ax, state.vy[slot] + half * ay);
            state.x[slot] += reach[fat] * vx;
            state.y[slot] += reach[fat] * vy;
            let lost = (1.0 - keep[fat] * keep[fat]) * self.coupled.half_mass[slot];
            state.dissipated += lost * (vx * vx + vy * vy);
            let (vx, vy) = (keep[fat] * vx, keep[fat] * vy);
            (state.vx[slot], state.vy[slot]) = (vx, vy);
        }
        let body = &mut state.readings.body;
        body.velocity += body.acceleration * half;
        body.position += body.velocity * h;

        let mut survey = self.evaluate(state, forces[1], cost);
        for slot in 0..len {
            state.vx[slot] += half * state.ax[slot];
            state.vy[slot] += half * state.ay[slot];
        }
        let readings = &mut state.readings;
        readings.body.velocity += readings.body.acceleration * half;
        readings.impulse += (earlier.contact_force + readings.contact_force) * half;
        let contact = &self.coupled.contact;
        state.work = contact.energy() - 0.5 * contact.mass * readings.body.velocity.norm_squared();
        survey.kinetic = self.coupled.kinetic(state);
        state.time = self.clock.advance(share);
        survey
    }
}

impl State {
    /// Acceleration and readings where the state is, as for a frame between two steps.
    pub(crate) fn evaluate_coupled(
        &mut self,
        system: &System,
        coupled: &Coupled,
        force: f64,
    ) -> Survey {
        let mut verlet = SubsteppedVerlet::new(system, coupled);
        let mut survey = verlet.evaluate(self, force, &mut Cost::default());
        survey.kinetic = coupled.kinetic(self);
        survey
    }
}
