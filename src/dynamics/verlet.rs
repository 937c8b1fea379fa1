//! Steps of a scene with a projectile, a fluid or dashpots: velocity Verlet with a predicted speed.
//!
//! With a(x, v) the acceleration by springs, contact, fluid, pulse and dashpots, one step is
//!
//! `v' = v + h/2 a,  x += h v',  a = a(x, v' + h/2 a_old),  v = v' + h/2 a`,
//!
//! of second order also where the force depends on the speed, with one evaluation a step. Drag on
//! absolute velocity is solved exactly within the drift, as in [`super::composition`].
//!
//! For an oscillator of frequency w and decay rate g it is stable while (w h)^2 / 4 + g h <= 1 (a
//! test scans it), so the limit is h = 2 / (g + sqrt(g^2 + w^2)). The bounds of w and g hold for
//! springs and dashpots in any shape; those of fluid and contact are estimates, see there.
//!
//! The penalty of a contact is far stiffer than the eye, and its force has a kink at touch, where
//! methods of high order lose theirs. So the steps are short while the projectile could touch, and
//! a whole number of times longer while it could not.

use super::composition::exact_reach;
use super::coupled::{Coupled, Workspace};
use super::kernel::{self, Survey};
use super::load::Segment;
use super::march::Cost;
use super::state::State;
use super::stepper::{EqualSteps, Stepper};
use super::system::{LANES, System};

/// Share of its radius that a projectile may fly within a step.
const FLIGHT: f64 = 0.1;
/// Short steps in a long one at most.
const MAX_SHORT: f64 = 1000.0;
/// How many times the distance that could be closed within a long step must be left for one.
const CAUTION: f64 = 2.0;

/// Largest stable step with bounds of the angular frequency and the decay rate, in s.
fn stable(omega: f64, rate: f64) -> f64 {
    2.0 / (rate + (rate * rate + omega * omega).sqrt())
}

impl Coupled {
    /// Largest step in contact, in s: stable, and too short for the projectile to pass the shell.
    pub fn step_limit(&self) -> f64 {
        let (omega, rate) = self.rates(true);
        let flight = self
            .contact
            .map_or(f64::INFINITY, |c| FLIGHT * c.radius / c.speed);
        stable(omega.max(1.0), rate).min(flight)
    }

    /// How many short steps one out of contact may be long.
    fn substeps(&self) -> usize {
        let (omega, rate) = self.rates(false);
        let ratio = stable(omega.max(1.0), rate) / self.step_limit();
        // Rounding must not turn a ratio of one into none.
        (ratio * (1.0 + 1e-9)).clamp(1.0, MAX_SHORT) as usize
    }
}

/// Velocity Verlet with substeps where the projectile could touch.
pub(super) struct SubsteppedVerlet<'a> {
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
            keep: decay.map(|rate| (-rate * step).exp()),
        }
    }
}

impl<'a> SubsteppedVerlet<'a> {
    pub fn new(system: &'a System, coupled: &'a Coupled) -> Self {
        Self {
            system,
            coupled,
            work: coupled.workspace(system.rest_x.len()),
            substeps: coupled.substeps(),
            clock: EqualSteps::default(),
            short: Drift::default(),
            long: Drift::default(),
        }
    }

    /// Acceleration, readings and survey at the state, with the speeds in the workspace.
    fn evaluate(&mut self, state: &mut State, force: f64, cost: &mut Cost) -> Survey {
        let mut survey = kernel::evaluate(self.system, state, force, 0.0);
        self.coupled.accelerate(state, &mut self.work, cost);
        cost.evaluations += 1;
        survey.elastic += state.readings.stored;
        survey
    }

    /// The same with the speeds of the state.
    fn evaluate_afresh(&mut self, state: &mut State, force: f64, cost: &mut Cost) -> Survey {
        self.work.vx.copy_from_slice(&state.vx);
        self.work.vy.copy_from_slice(&state.vy);
        self.evaluate(state, force, cost)
    }

    /// Whether the projectile could come to touch within `time` s.
    fn may_touch(&self, state: &State, time: f64) -> bool {
        self.coupled.contact.is_some() && {
            let r = &state.readings;
            let closing = r.body.velocity.norm() + self.coupled.fastest_shell(state);
            r.gap <= CAUTION * closing * time
        }
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
        self.evaluate_afresh(state, force, cost)
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
        let before = state.load_speed(self.system);
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
            self.work.vx[slot] = vx + half * ax;
            self.work.vy[slot] = vy + half * ay;
        }
        let body = &mut state.readings.body;
        body.velocity += body.acceleration * half;
        body.position += body.velocity * h;

        let middle = state.load_speed(self.system);
        let mut survey = self.evaluate(state, forces[1], cost);
        for slot in 0..len {
            state.vx[slot] += half * state.ax[slot];
            state.vy[slot] += half * state.ay[slot];
        }
        let after = state.load_speed(self.system);
        let readings = &mut state.readings;
        readings.body.velocity += readings.body.acceleration * half;
        readings.impulse += (earlier.contact_force + readings.contact_force) * half;
        state.dissipated += half * (earlier.power + readings.power);
        state.work = if let Some(contact) = &self.coupled.contact {
            contact.energy() - 0.5 * contact.mass * readings.body.velocity.norm_squared()
        } else {
            // The load acts on the globe only, so one factor takes the drift's decay back out.
            state.work
                + 0.5
                    * half
                    * (forces[0] * (before + middle / keep[0]) + forces[1] * (middle + after))
        };
        survey.kinetic = self.coupled.kinetic(state);
        state.time = self.clock.advance(share);
        survey
    }
}

impl State {
    /// Acceleration and readings where the state is, as for a frame between two steps.
    pub(super) fn evaluate_coupled(
        &mut self,
        system: &System,
        coupled: &Coupled,
        force: f64,
    ) -> Survey {
        let mut verlet = SubsteppedVerlet::new(system, coupled);
        let mut survey = verlet.evaluate_afresh(self, force, &mut Cost::default());
        survey.kinetic = coupled.kinetic(self);
        survey
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Largest growth of an oscillator over many steps of one second.
    fn growth(omega: f64, rate: f64) -> f64 {
        let (mut x, mut v, mut a) = (1.0, 0.3, -omega * omega - 0.3 * rate);
        let mut most: f64 = 0.0;
        for _ in 0..20_000 {
            let half = v + 0.5 * a;
            x += half;
            a = -omega * omega * x - rate * (half + 0.5 * a);
            v = half + 0.5 * a;
            most = most.max(x.abs());
        }
        most
    }

    #[test]
    fn the_limit_is_where_a_damped_oscillator_begins_to_grow() {
        for share in [0.01, 0.3, 0.7, 1.5, 5.0] {
            let limit = stable(1.0, share);
            let (below, above) = (0.999 * limit, 1.01 * limit);
            assert!(growth(below, below * share) < 1e3, "{share}");
            assert!(growth(above, above * share) > 1e6, "{share}");
        }
    }
}
