//! Kick-drift compositions, with the drag solved exactly inside the drift.
//!
//! The motion m a = F(x, t) - c v splits into a kick, v += F/m dt at fixed x, and a drift, which
//! is exact: v decays by exp(-c/m dt) and x moves by v (1 - exp(-c/m dt)) m/c. A symmetric
//! composition kick b1, drift a1, kick b2, ... has even order. The last kick of a step and the
//! first of the next share one force evaluation.
//!
//! The Runge-Kutta-Nystrom conditions of Blanes and Moan hold with linear drag in the drift,
//! because the kick depends on positions alone.

use crate::models::paper::forces::kernel::{self, Stage, Survey};
use crate::models::paper::forces::{state::State, system::System};
use crate::models::paper::time::stepper::{Drag, EqualSteps, Stepper};
use crate::run::plan::Cost;

/// Kicks and drifts in shares of the step, and what they are for the present length of it.
pub(crate) struct Composition<'a> {
    pub system: &'a System,
    pub kicks: &'static [f64],
    pub drifts: &'static [f64],
    pub drag: Drag,
    /// Share of the speed kept by an explicit drag ahead of the first kick.
    pub keep_before: [f64; 2],
    /// All but the last kick, each with its time from the start of the step.
    pub stages: Vec<(f64, Stage)>,
}

/// Distance per initial speed when the speed decays at `rate` for `t` seconds.
fn exact_reach(rate: f64, t: f64) -> f64 {
    if rate == 0.0 { t } else { -libm::expm1(-rate * t) / rate }
}

impl Stepper for Composition<'_> {
    fn begin(&mut self, _: &State, steps: &EqualSteps) {
        // An explicit drag acts ahead of the first kick and leaves none for the drifts.
        let (h, decay) = (steps.length, self.system.decay);
        let (before, within) = match self.drag {
            Drag::WithKick => (decay, [0.0, 0.0]),
            Drag::Exact | Drag::InRates => ([0.0, 0.0], decay),
        };
        self.keep_before = before.map(|rate| 1.0 - rate * h);
        self.stages.clear();
        let mut time = 0.0;
        for (b, a) in self.kicks.iter().zip(self.drifts) {
            let stage = Stage {
                kick: b * h,
                drift: within.map(|rate| exact_reach(rate, a * h)),
                keep: within.map(|rate| libm::exp(-rate * a * h)),
            };
            self.stages.push((time, stage));
            time += a * h;
        }
    }

    fn step(&mut self, state: &mut State, steps: &mut EqualSteps, cost: &mut Cost) -> Survey {
        let (system, piece) = (self.system, steps.segment.piece);
        let start = state.time;
        let mut speed = state.load_speed(system);
        for (i, (time, stage)) in self.stages.iter().enumerate() {
            let force = system.pulse.force(piece, start + time);
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
        let last_kick = self.kicks[self.stages.len()] * steps.length;
        let force = system.pulse.force(piece, start + steps.length);
        let survey = kernel::evaluate(system, state, force, last_kick);
        let after = state.load_speed(system);
        state.work += last_kick * force * 0.5 * (speed + after);
        state.time = steps.advance();
        cost.evaluations += self.stages.len();
        survey
    }
}
