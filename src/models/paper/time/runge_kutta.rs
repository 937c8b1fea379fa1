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

#![allow(
    clippy::inline_always,
    reason = "what is called within a vector dispatch must be compiled for its instructions"
)]

use crate::models::paper::forces::kernel::{Survey, by_tissue};
use crate::models::paper::forces::lanes::{V, fused, load, splat, store, total};
use crate::models::paper::forces::system::System;
use crate::models::paper::forces::{aligned::Aligned, kernel, layout::LANES, state::State};
use crate::models::paper::time::stepper::{EqualSteps, Stepper};
use crate::models::pulse::{Piece, Segment};
use crate::run::plan::{Cost, Plan};
use fearless_simd::{Simd, SimdBase, dispatch};
use std::ops::Range;

/// Coefficients of an explicit method; its last stage is the solution at the end of the step.
#[derive(Debug)]
pub(crate) struct Tableau {
    pub nodes: &'static [f64],
    pub stages: &'static [&'static [f64]],
    pub weights: &'static [f64],
    /// Weights of the solution minus those of the embedded one, the last for the end of the step;
    /// empty where there is none.
    pub error: &'static [f64],
}

/// Power of the step that the error estimate falls with, for embedded solutions of order four.
const ERROR_POWER: f64 = 5.0;
/// A step is never made longer, or shorter, than this at once.
const GROWTH: (f64, f64) = (0.2, 5.0);
/// Share of the step that the error would allow.
const CAUTION: f64 = 0.9;
/// A step this small a share of the segment is taken whatever its error, so that time advances.
const SMALLEST_SHARE: f64 = 1e-9;
/// Errors are shares of no less than this: of an eye at rest only rounding is left, which no step
/// makes small.
const LEAST_ENERGY_J: f64 = 1e-14;
/// Rates that a sum may be of: stages, and the end of the step.
const MAX_RATES: usize = 8;

/// Positions and speeds of all nodes with the energies that came and went, or the rates of change
/// of all these.
struct Phase {
    x: Aligned,
    y: Aligned,
    vx: Aligned,
    vy: Aligned,
    work: f64,
    dissipated: f64,
}

impl Phase {
    fn zeros(len: usize) -> Self {
        let zeros = || Aligned::zeros(len);
        Self { x: zeros(), y: zeros(), vx: zeros(), vy: zeros(), work: 0.0, dissipated: 0.0 }
    }
}

/// A part of a [`Phase`].
type Part = fn(&Phase) -> &[f64];
const PARTS: [Part; 4] = [|p| &p.x, |p| &p.y, |p| &p.vx, |p| &p.vy];

/// One part of several rates, each with its weight.
struct Terms<'a> {
    each: [(f64, &'a [f64]); MAX_RATES],
    count: usize,
}

impl<'a> Terms<'a> {
    fn new(weights: &[f64], rates: &'a [Phase], part: Part, h: f64) -> Self {
        let mut terms = Self { each: [(0.0, &[]); MAX_RATES], count: 0 };
        for (weight, rates) in weights.iter().zip(rates) {
            if *weight != 0.0 {
                terms.each[terms.count] = (weight * h, part(rates));
                terms.count += 1;
            }
        }
        terms
    }

    /// `from` plus the weighted sum at some nodes.
    #[inline(always)]
    fn onto<S: Simd, const QUICK: bool>(&self, simd: S, from: V<S>, slot: usize) -> V<S> {
        let mut sum = from;
        for &(weight, rate) in &self.each[..self.count] {
            sum = fused::<S, QUICK>(splat(simd, weight), load(simd, rate, slot), sum);
        }
        sum
    }
}

#[inline(always)]
fn add_as<S: Simd, const QUICK: bool>(
    simd: S,
    slots: Range<usize>,
    to: &mut [f64],
    from: &[f64],
    terms: &Terms,
) {
    for slot in slots.step_by(V::<S>::LEN) {
        let sum = terms.onto::<S, QUICK>(simd, load(simd, from, slot), slot);
        store::<S>(to, slot, sum);
    }
}

/// Rates of the nodes of `state`; returns the power that drag takes.
#[inline(always)]
fn rates_as<S: Simd, const QUICK: bool>(
    simd: S,
    system: &System,
    state: &State,
    rates: &mut Phase,
) -> f64 {
    let mut power = splat(simd, 0.0);
    for slot in moving(system).step_by(V::<S>::LEN) {
        let (group, lane) = (&system.groups[slot / LANES], slot % LANES);
        let fat = load(simd, &group.fat, lane);
        let decay = by_tissue::<S, QUICK>(simd, fat, system.decay);
        let (vx, vy) = (load(simd, &state.vx, slot), load(simd, &state.vy, slot));
        let (ax, ay) = (load(simd, &state.ax, slot), load(simd, &state.ay, slot));
        store::<S>(&mut rates.x, slot, vx);
        store::<S>(&mut rates.y, slot, vy);
        store::<S>(&mut rates.vx, slot, fused::<S, QUICK>(-decay, vx, ax));
        store::<S>(&mut rates.vy, slot, fused::<S, QUICK>(-decay, vy, ay));
        let speed_squared = fused::<S, QUICK>(vx, vx, vy * vy);
        let lost = decay * load(simd, &group.half_mass, lane);
        power = fused::<S, QUICK>(lost, speed_squared, power);
    }
    2.0 * total::<S>(power)
}

/// Energy of the differences that `parts` sum up to.
#[inline(always)]
fn energy_as<S: Simd, const QUICK: bool>(simd: S, system: &System, parts: &[Terms; 4]) -> f64 {
    let omega_squared = splat(simd, system.omega_bound() * system.omega_bound());
    let mut energy = splat(simd, 0.0);
    for slot in moving(system).step_by(V::<S>::LEN) {
        let half_mass = load(simd, &system.groups[slot / LANES].half_mass, slot % LANES);
        let none = splat(simd, 0.0);
        let [ex, ey, evx, evy] =
            std::array::from_fn(|i| parts[i].onto::<S, QUICK>(simd, none, slot));
        let positions = fused::<S, QUICK>(ex, ex, ey * ey);
        let speeds = fused::<S, QUICK>(evx, evx, evy * evy);
        let both = fused::<S, QUICK>(omega_squared, positions, speeds);
        energy = fused::<S, QUICK>(half_mass, both, energy);
    }
    total::<S>(energy)
}

/// The slots of the rows that hold all moving nodes.
fn moving(system: &System) -> Range<usize> {
    system.first_row * system.stride..(system.side - 1) * system.stride
}

/// Runs one of the forms above on the machine's vectors.
macro_rules! on_vectors {
    ($system:expr, $form:ident($($argument:expr),*)) => {{
        let level = $system.level;
        if $system.portable {
            dispatch!(level, simd => $form::<_, false>(simd, $($argument),*))
        } else {
            dispatch!(level, simd => $form::<_, true>(simd, $($argument),*))
        }
    }};
}

/// A Runge-Kutta method in the middle of a run.
pub(crate) struct RungeKutta<'a> {
    system: &'a System,
    tableau: &'static Tableau,
    /// Local error allowed; none for equal steps.
    tolerance: Option<f64>,
    clock: EqualSteps,
    /// Next step, in s.
    next: f64,
    largest_energy: f64,
    start: Phase,
    /// Rates at each stage and at the end of the step. Between steps the first is that of the
    /// state.
    rates: Vec<Phase>,
}

impl<'a> RungeKutta<'a> {
    pub fn new(system: &'a System, tableau: &'static Tableau, plan: &Plan) -> Self {
        let phase = || Phase::zeros(system.rest_x.len());
        Self {
            system,
            tableau,
            tolerance: (!tableau.error.is_empty()).then_some(plan.local_tolerance),
            clock: EqualSteps::default(),
            next: 0.0,
            largest_energy: 0.0,
            start: phase(),
            rates: (0..=tableau.nodes.len()).map(|_| phase()).collect(),
        }
    }

    /// Rates at the state, whose acceleration is up to date.
    fn take_rates(&mut self, stage: usize, state: &State, force: f64) {
        let system = self.system;
        let rates = &mut self.rates[stage];
        rates.dissipated = on_vectors!(system, rates_as(system, state, rates));
        rates.work = force * state.load_speed(system);
    }

    /// Sets `state` to the start of the step plus `h` times the weighted rates.
    fn combine(&self, state: &mut State, weights: &[f64], h: f64) {
        let (system, start) = (self.system, &self.start);
        for (part, to) in
            PARTS.iter().zip([&mut state.x, &mut state.y, &mut state.vx, &mut state.vy])
        {
            let terms = Terms::new(weights, &self.rates, *part, h);
            on_vectors!(system, add_as(moving(system), &mut *to, part(start), &terms));
        }
        let weighted = || weights.iter().zip(&self.rates);
        state.work = start.work + h * weighted().map(|(w, r)| w * r.work).sum::<f64>();
        state.dissipated =
            start.dissipated + h * weighted().map(|(w, r)| w * r.dissipated).sum::<f64>();
    }

    fn remember(&mut self, state: &State) {
        self.start.x.copy_from_slice(&state.x);
        self.start.y.copy_from_slice(&state.y);
        self.start.vx.copy_from_slice(&state.vx);
        self.start.vy.copy_from_slice(&state.vy);
        (self.start.work, self.start.dissipated) = (state.work, state.dissipated);
    }

    /// Tries one step of `h`; leaves the result in `state` but for its time, which is that of the
    /// start still.
    fn attempt(&mut self, state: &mut State, piece: Piece, h: f64, cost: &mut Cost) -> Survey {
        let (system, tableau) = (self.system, self.tableau);
        let pulse = &system.load().pulse;
        for stage in 1..tableau.nodes.len() {
            self.combine(state, tableau.stages[stage], h);
            let force = pulse.force(piece, state.time + tableau.nodes[stage] * h);
            kernel::evaluate(system, state, force, 0.0);
            self.take_rates(stage, state, force);
        }
        self.combine(state, tableau.weights, h);
        let force = pulse.force(piece, state.time + h);
        let survey = kernel::evaluate(system, state, force, 0.0);
        self.take_rates(tableau.nodes.len(), state, force);
        cost.evaluations += tableau.nodes.len();
        survey
    }

    /// Local error in the energy norm.
    fn error(&self, h: f64) -> f64 {
        let (system, weights) = (self.system, self.tableau.error);
        let parts = PARTS.map(|part| Terms::new(weights, &self.rates, part, h));
        let energy = on_vectors!(system, energy_as(system, &parts));
        (energy / self.largest_energy).sqrt()
    }

    /// Steps until the error is below the tolerance.
    fn adaptive(
        &mut self,
        state: &mut State,
        segment: &Segment,
        tolerance: f64,
        cost: &mut Cost,
    ) -> Survey {
        let longest = self.clock.length();
        loop {
            let left = segment.end - state.time;
            // The last two steps of a segment share what is left, so that none is tiny.
            let h = if self.next >= left {
                left
            } else if 2.0 * self.next > left {
                0.5 * left
            } else {
                self.next
            };
            let survey = self.attempt(state, segment.piece, h, cost);
            self.largest_energy =
                self.largest_energy.max(survey.kinetic + survey.elastic).max(LEAST_ENERGY_J);
            let error = self.error(h);
            let factor = CAUTION * libm::pow(tolerance / error, 1.0 / ERROR_POWER);
            let accepted = error <= tolerance || h <= SMALLEST_SHARE * longest;
            self.next = (h * factor.clamp(GROWTH.0, GROWTH.1)).min(longest);
            if accepted || !error.is_finite() {
                state.time = if h == left { segment.end } else { state.time + h };
                return survey;
            }
        }
    }
}

impl Stepper for RungeKutta<'_> {
    fn begin(
        &mut self,
        state: &mut State,
        segment: &Segment,
        steps: usize,
        cost: &mut Cost,
    ) -> Survey {
        self.clock = EqualSteps::new(segment, steps);
        self.next = self.clock.length();
        self.largest_energy = 0.0;
        state.time = segment.start;
        cost.evaluations += 1;
        let force = self.system.load().pulse.force(segment.piece, segment.start);
        let survey = kernel::evaluate(self.system, state, force, 0.0);
        self.take_rates(0, state, force);
        survey
    }

    fn step(&mut self, state: &mut State, segment: &Segment, cost: &mut Cost) -> Survey {
        self.remember(state);
        let survey = if let Some(tolerance) = self.tolerance {
            self.adaptive(state, segment, tolerance, cost)
        } else {
            let h = self.clock.length();
            let survey = self.attempt(state, segment.piece, h, cost);
            state.time = self.clock.advance();
            survey
        };
        // The end of this step is the start of the next.
        self.rates.swap(0, self.tableau.nodes.len());
        survey
    }
}
