//! Explicit Runge-Kutta methods on the motion in first-order form, x' = v, v' = F/m - c v/m.
//!
//! Some take equal steps. An embedded pair compares its two solutions and chooses the step: the
//! error is measured in the energy norm, `sqrt(sum m (|e_v|^2 + w^2 |e_x|^2) / 2E)` with w the
//! frequency bound and E the largest energy so far, and kept below the local tolerance.
//!
//! They are here to be compared with the compositions, which win on this problem: the spectrum is
//! nearly imaginary, so stability per evaluation decides. For the comparison to be fair they use
//! the same force kernel, update their nodes by the same vectors, and allocate nothing after the
//! start.

use crate::models::paper::forces::kernel::{self, Survey, by_tissue};
use crate::models::paper::forces::lanes::{
    V, fused, fused_pair, load, load_pair, on_vectors, splat, squared, store_pair, total,
};
use crate::models::paper::forces::{aligned::Pairs, layout::LANES, state::State, system::System};
use crate::models::paper::time::stepper::{EqualSteps, Stepper};
use crate::models::pulse::Piece;
use crate::run::plan::{Cost, Plan};
use fearless_simd::{Simd, SimdBase, dispatch};

/// Coefficients of an explicit method, row by row; the last is the solution at the end of the
/// step, whose evaluation the next step shares.
#[derive(Debug)]
pub(crate) struct Tableau {
    pub nodes: &'static [f64],
    pub stages: &'static [&'static [f64]],
    /// Weights of the solution minus those of the embedded one, the last for the end of the step;
    /// empty where there is none.
    pub error: &'static [f64],
}

impl Tableau {
    /// Force evaluations a step.
    pub fn evaluations(&self) -> usize {
        self.nodes.len() - 1
    }
}

/// Power of the step that the error estimate falls with, for embedded solutions of order four.
const ERROR_POWER: f64 = 5.0;
/// A step is never made longer, or shorter, than this at once.
const GROWTH: (f64, f64) = (0.2, 5.0);
/// Share of the step that the error would allow.
const CAUTION: f64 = 0.9;
/// A step this small a share of the segment is taken whatever its error, so that time advances.
const SMALLEST_SHARE: f64 = 1e-9;
/// Errors are shares of no less than this: an eye at rest has only rounding left.
const LEAST_ENERGY_J: f64 = 1e-14;

/// Adds `weight` times `of` to `to`.
#[inline(always)]
fn add_as<S: Simd, const QUICK: bool>(
    simd: S,
    system: &System,
    to: &mut Pairs,
    weight: f64,
    of: &Pairs,
) {
    let (weight, of) = (splat(simd, weight), of.slices());
    let (x, y) = to.slices_mut();
    for slot in system.moving().step_by(V::<S>::LEN) {
        let sum = load_pair(simd, (x, y), slot);
        let sum = fused_pair::<S, QUICK>(load_pair(simd, of, slot), weight, sum);
        store_pair::<S>((x, y), slot, sum);
    }
}

/// Rates of the nodes of `state`; returns the power that drag takes.
#[inline(always)]
fn rates_as<S: Simd, const QUICK: bool>(
    simd: S,
    system: &System,
    state: &State,
    rates: &mut State,
) -> f64 {
    let (velocity, acceleration) = (state.velocity.slices(), state.acceleration.slices());
    let (x, y) = rates.position.slices_mut();
    let (vx, vy) = rates.velocity.slices_mut();
    let mut power = splat(simd, 0.0);
    for slot in system.moving().step_by(V::<S>::LEN) {
        let (group, lane) = (&system.groups[slot / LANES], slot % LANES);
        let decay = by_tissue::<S, QUICK>(simd, load(simd, &group.fat, lane), system.decay);
        let velocity = load_pair(simd, velocity, slot);
        let undamped = load_pair(simd, acceleration, slot);
        store_pair::<S>((x, y), slot, velocity);
        store_pair::<S>((vx, vy), slot, fused_pair::<S, QUICK>(velocity, -decay, undamped));
        let lost = decay * load(simd, &group.half_mass, lane);
        power = fused::<S, QUICK>(lost, squared::<S, QUICK>(velocity), power);
    }
    2.0 * total::<S>(power)
}

/// Energy of `difference`.
#[inline(always)]
fn energy_as<S: Simd, const QUICK: bool>(simd: S, system: &System, difference: &State) -> f64 {
    let omega_squared = splat(simd, system.omega_bound * system.omega_bound);
    let (position, velocity) = (difference.position.slices(), difference.velocity.slices());
    let mut energy = splat(simd, 0.0);
    for slot in system.moving().step_by(V::<S>::LEN) {
        let half_mass = load(simd, &system.groups[slot / LANES].half_mass, slot % LANES);
        let positions = squared::<S, QUICK>(load_pair(simd, position, slot));
        let speeds = squared::<S, QUICK>(load_pair(simd, velocity, slot));
        let both = fused::<S, QUICK>(omega_squared, positions, speeds);
        energy = fused::<S, QUICK>(half_mass, both, energy);
    }
    total::<S>(energy)
}

/// Adds `h` times the weighted rates to a motion.
fn add(system: &System, to: &mut State, rates: &[State], weights: &[f64], h: f64) {
    for (weight, rates) in weights.iter().zip(rates).filter(|(weight, _)| **weight != 0.0) {
        let step = weight * h;
        on_vectors!(system, add_as(system, &mut to.position, step, &rates.position));
        on_vectors!(system, add_as(system, &mut to.velocity, step, &rates.velocity));
    }
    let sum = |of: fn(&State) -> f64| -> f64 {
        weights.iter().zip(rates).map(|(weight, rates)| weight * of(rates)).sum()
    };
    to.work += h * sum(|rates| rates.work);
    to.dissipated += h * sum(|rates| rates.dissipated);
}

/// A Runge-Kutta method in the middle of a run.
pub(crate) struct RungeKutta<'a> {
    system: &'a System,
    tableau: &'static Tableau,
    /// Local error allowed; none for equal steps.
    tolerance: Option<f64>,
    /// Next step, in s.
    next: f64,
    largest_energy: f64,
    start: State,
    /// Rates at each stage and at the end of the step, each in the place of what it changes.
    /// Between steps the first is that of the state.
    rates: Vec<State>,
    /// Of the two solutions of a pair.
    difference: State,
}

impl<'a> RungeKutta<'a> {
    pub fn new(system: &'a System, tableau: &'static Tableau, plan: &Plan) -> Self {
        let rest = State::at_rest(system);
        Self {
            system,
            tableau,
            tolerance: (!tableau.error.is_empty()).then_some(plan.local_tolerance),
            next: 0.0,
            largest_energy: 0.0,
            start: rest.clone(),
            rates: vec![rest.clone(); tableau.nodes.len()],
            difference: rest,
        }
    }

    /// Takes the rates of the state, whose acceleration is up to date.
    fn take_rates(&mut self, stage: usize, state: &State, force: f64) {
        let (system, rates) = (self.system, &mut self.rates[stage]);
        rates.dissipated = on_vectors!(system, rates_as(system, state, rates));
        rates.work = force * state.load_speed(system);
    }

    /// Moves `state` from the start of a step of `h` to a stage of it and takes the rates there.
    fn go(&mut self, state: &mut State, piece: Piece, h: f64, stage: usize) -> Survey {
        let (system, tableau) = (self.system, self.tableau);
        state.copy_motion(system, &self.start);
        add(system, state, &self.rates, tableau.stages[stage], h);
        let force = system.pulse.force(piece, state.time + tableau.nodes[stage] * h);
        let survey = kernel::evaluate(system, state, force, 0.0);
        self.take_rates(stage, state, force);
        survey
    }

    /// Tries one step of `h`; leaves the result in `state`, but for its time.
    fn attempt(&mut self, state: &mut State, piece: Piece, h: f64, cost: &mut Cost) -> Survey {
        let last = self.tableau.evaluations();
        cost.evaluations += last;
        for stage in 1..last {
            self.go(state, piece, h, stage);
        }
        self.go(state, piece, h, last)
    }

    /// Local error in the energy norm.
    fn error(&mut self, h: f64) -> f64 {
        let (system, difference) = (self.system, &mut self.difference);
        for pairs in [&mut difference.position, &mut difference.velocity] {
            pairs.x.fill(0.0);
            pairs.y.fill(0.0);
        }
        add(system, difference, &self.rates, self.tableau.error, h);
        let energy = on_vectors!(system, energy_as(system, difference));
        (energy / self.largest_energy).sqrt()
    }

    /// Steps until the error is below the tolerance.
    fn adaptive(
        &mut self,
        state: &mut State,
        steps: &EqualSteps,
        tolerance: f64,
        cost: &mut Cost,
    ) -> Survey {
        let (longest, end) = (steps.length, steps.segment.end);
        loop {
            let left = end - self.start.time;
            // The last two steps of a segment share what is left, so that none is tiny.
            let h = if self.next >= left {
                left
            } else if 2.0 * self.next > left {
                0.5 * left
            } else {
                self.next
            };
            let survey = self.attempt(state, steps.segment.piece, h, cost);
            self.largest_energy =
                self.largest_energy.max(survey.kinetic + survey.elastic).max(LEAST_ENERGY_J);
            let error = self.error(h);
            let factor = CAUTION * libm::pow(tolerance / error, 1.0 / ERROR_POWER);
            let accepted = error <= tolerance || h <= SMALLEST_SHARE * longest;
            self.next = (h * factor.clamp(GROWTH.0, GROWTH.1)).min(longest);
            if accepted || !error.is_finite() {
                state.time = if h == left { end } else { state.time + h };
                return survey;
            }
        }
    }
}

impl Stepper for RungeKutta<'_> {
    fn begin(&mut self, state: &State, steps: &EqualSteps) {
        self.next = steps.length;
        self.largest_energy = 0.0;
        self.take_rates(0, state, self.system.pulse.force(steps.segment.piece, state.time));
    }

    fn step(&mut self, state: &mut State, steps: &mut EqualSteps, cost: &mut Cost) -> Survey {
        self.start.copy_motion(self.system, state);
        let survey = if let Some(tolerance) = self.tolerance {
            self.adaptive(state, steps, tolerance, cost)
        } else {
            let survey = self.attempt(state, steps.segment.piece, steps.length, cost);
            state.time = steps.advance();
            survey
        };
        // The end of this step is the start of the next.
        self.rates.swap(0, self.tableau.evaluations());
        survey
    }
}
