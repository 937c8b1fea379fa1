//! Kick-drift compositions, with the drag solved exactly inside the drift.
//!
//! The motion m a = F(x, t) - c v splits into a kick, v += F/m dt at fixed x, and a drift, which
//! is exact: v decays by exp(-c/m dt) and x moves by v (1 - exp(-c/m dt)) m/c. A symmetric
//! composition kick b1, drift a1, kick b2, ... has even order. The last kick of a step and the
//! first of the next share one force evaluation.
//!
//! The Runge-Kutta-Nystrom conditions of Blanes and Moan hold with linear drag in the drift,
//! because the kick depends on positions alone.

use crate::models::paper::forces::kernel::{Stage, Survey};
use crate::models::paper::forces::{kernel, state::State, system::System};
use crate::models::paper::time::stepper::{Drag, EqualSteps, Stepper};
use crate::models::pulse::Segment;
use crate::run::plan::Cost;

/// A composition, ready for steps of one length.
pub(crate) struct Composition<'a> {
    system: &'a System,
    kicks: &'static [f64],
    drifts: &'static [f64],
    drag: Drag,
    clock: EqualSteps,
    step: f64,
    /// Share of the speed kept by an explicit drag ahead of the first kick.
    keep_before: [f64; 2],
    stages: Vec<Stage>,
    /// Time of each kick from the start of the step.
    times: Vec<f64>,
    last_kick: f64,
}

impl<'a> Composition<'a> {
    /// Kicks and drifts are shares of the step.
    pub fn new(
        system: &'a System,
        kicks: &'static [f64],
        drifts: &'static [f64],
        drag: Drag,
    ) -> Self {
        Self {
            system,
            kicks,
            drifts,
            drag,
            clock: EqualSteps::default(),
            step: 0.0,
            keep_before: [1.0, 1.0],
            stages: Vec::with_capacity(drifts.len()),
            times: Vec::with_capacity(drifts.len()),
            last_kick: 0.0,
        }
    }

    /// Prepares the stages for steps of `h` seconds.
    fn prepare(&mut self, h: f64) {
        // An explicit drag acts ahead of the first kick and leaves none for the drifts.
        let decay = self.system.decay;
        let (before, within) = match self.drag {
            Drag::WithKick => (decay, [0.0, 0.0]),
            Drag::Exact | Drag::InRates => ([0.0, 0.0], decay),
        };
        self.step = h;
        self.keep_before = before.map(|rate| 1.0 - rate * h);
        self.stages.clear();
        self.times.clear();
        let mut time = 0.0;
        for (b, a) in self.kicks.iter().zip(self.drifts) {
            self.times.push(time);
            time += a * h;
            self.stages.push(Stage {
                kick: b * h,
                drift: within.map(|rate| exact_reach(rate, a * h)),
                keep: within.map(|rate| libm::exp(-rate * a * h)),
            });
        }
        self.last_kick = self.kicks[self.drifts.len()] * h;
    }
}

/// Distance per initial speed when the speed decays at `rate` for `t` seconds.
fn exact_reach(rate: f64, t: f64) -> f64 {
    if rate == 0.0 { t } else { -libm::expm1(-rate * t) / rate }
}

impl Stepper for Composition<'_> {
    fn begin(
        &mut self,
        state: &mut State,
        segment: &Segment,
        steps: usize,
        cost: &mut Cost,
    ) -> Survey {
        self.clock = EqualSteps::new(segment, steps);
        self.prepare(self.clock.length());
        state.time = segment.start;
        cost.evaluations += 1;
        let force = self.system.load().pulse.force(segment.piece, segment.start);
        kernel::evaluate(self.system, state, force, 0.0)
    }

    fn step(&mut self, state: &mut State, segment: &Segment, cost: &mut Cost) -> Survey {
        let system = self.system;
        let pulse = &system.load().pulse;
        let start = state.time;
        let mut speed = state.load_speed(system);
        for (i, (stage, time)) in self.stages.iter().zip(&self.times).enumerate() {
            let force = pulse.force(segment.piece, start + time);
            let lost = if i == 0 {
                kernel::start(system, state, self.keep_before, *stage)
            } else {
                kernel::kick_drift(system, state, force, *stage)
            };
            state.dissipated += lost;
            // The load acts on the globe only, so one factor takes the drift's decay back out.
            let after = state.load_speed(system);
            state.work += stage.kick * force * 0.5 * (speed + after / stage.keep[0]);
            speed = after;
        }
        let force = pulse.force(segment.piece, start + self.step);
        let survey = kernel::evaluate(system, state, force, self.last_kick);
        let after = state.load_speed(system);
        state.work += self.last_kick * force * 0.5 * (speed + after);
        state.time = self.clock.advance();
        cost.evaluations += self.stages.len();
        survey
    }
}
