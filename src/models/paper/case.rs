//! One scenario compiled: the eye, its load, the rows that the kernel moves, and the step.

use crate::models::paper::eye::Eye;
use crate::models::paper::forces::kernel::Survey;
use crate::models::paper::forces::load::ArcLoad;
use crate::models::paper::forces::state::State;
use crate::models::paper::forces::system::System;
use crate::models::paper::recording::Recording;
use crate::models::paper::recording::recorder::Recorder;
use crate::models::paper::rules::RULES;
use crate::models::paper::time::march::{Observer, march};
use crate::models::paper::time::{second, stability};
use crate::models::paper::{drawing, flags, frames, readings};
use crate::models::pulse::{Piece, Pulse};
use crate::run::drawing::Drawing;
use crate::run::kept::{Frame, Keep, Spacing};
use crate::run::model::{EyeModel, Run};
use crate::run::places::Region;
use crate::run::plan::Plan;
use crate::run::refusal::Refusal;
use crate::run::rules::Rules;
use crate::run::watch::Watch;
use crate::scenario::{CheckedScenario, EyeInput, ForcePulse, Impact, Integrator};
use std::ops::ControlFlow;
use std::sync::Arc;

/// Steps between two calls of a watch.
const STEPS_BETWEEN_CALLS: usize = 64;

/// Passes everything on to a recorder and calls the watch now and then.
struct Watched<'a> {
    recorder: Recorder,
    watch: Watch<'a>,
    window: f64,
    steps: usize,
    cancelled: bool,
}

impl Observer for Watched<'_> {
    fn begin(&mut self, system: &System, state: &State, piece: Piece, survey: &Survey) {
        self.recorder.begin(system, state, piece, survey);
    }

    fn step(&mut self, system: &System, state: &State, piece: Piece, survey: &Survey) {
        self.recorder.step(system, state, piece, survey);
        self.steps += 1;
        if self.steps.is_multiple_of(STEPS_BETWEEN_CALLS) {
            self.cancelled = (self.watch)(state.time / self.window).is_break();
        }
    }

    fn satisfied(&self) -> bool {
        self.cancelled || self.recorder.settled()
    }
}

/// The section of a scenario, ready to be hit.
#[derive(Debug, Clone)]
pub struct Case {
    /// The eye.
    pub eye: Eye,
    /// What it was built from.
    input: (EyeInput, ForcePulse),
    /// The loaded arc.
    #[doc(hidden)]
    pub load: ArcLoad,
    /// What the kernel moves.
    #[doc(hidden)]
    pub system: System,
    /// Simulated time, in s.
    pub window: f64,
    #[doc(hidden)]
    /// What it starts from: rest, unless a test moves it.
    pub start: State,
}

impl EyeModel for Case {
    fn rules(&self) -> &'static Rules {
        &RULES
    }

    fn window(&self) -> f64 {
        self.window
    }

    fn level(&self) -> u32 {
        self.eye.level
    }

    fn at_level(&self, level: u32) -> Arc<dyn EyeModel> {
        let (mut eye, pulse) = self.input.clone();
        eye.level = level;
        Arc::new(Self::built((eye, pulse), self.window, (false, false)))
    }

    fn regions(&self) -> Vec<Region> {
        self.eye.nodes.iter().map(|node| node.region).collect()
    }

    fn elements(&self) -> usize {
        self.eye.springs.len()
    }

    fn elements_per_evaluation(&self) -> usize {
        self.system.springs_per_evaluation()
    }

    fn step_limit(&self, integrator: Integrator) -> f64 {
        stability::step_limit(integrator, &self.system)
    }

    fn longest_step(&self, plan: &Plan) -> f64 {
        plan.longest_step(&self.system.load().pulse)
    }

    fn steps(&self, plan: &Plan) -> usize {
        plan.steps(&self.system.load().pulse)
    }

    fn second_plan(&self, plan: &Plan) -> (Plan, f64) {
        second::plan(self, plan)
    }

    fn run(&self, plan: &Plan, keep: Keep, watch: Watch) -> Result<Run, Refusal> {
        let recording = self.record(plan, keep, watch)?;
        let extremes = &recording.extremes;
        Ok(Run {
            readings: readings::of(extremes),
            details: readings::details(self, extremes),
            flags: flags::raise(self, extremes),
            fold: extremes.fold,
            missed: false,
            energy_residual: extremes.energy_residual,
            simulated: recording.simulated,
            traces: recording.traces,
            frames: recording.frames,
            cost: recording.cost,
        })
    }

    fn frames(
        &self,
        plan: &Plan,
        spacing: Spacing,
        take: &mut dyn FnMut(Frame) -> ControlFlow<()>,
    ) -> Result<(), Refusal> {
        frames::frames(self, plan, spacing, take)
    }

    fn drawing(&self) -> Drawing {
        drawing::of(self)
    }
}

impl Case {
    /// Compiles a scenario.
    pub fn new(scenario: &CheckedScenario) -> Self {
        Self::with(scenario, false, false)
    }

    /// Compiles a scenario; `whole` leaves symmetry unused, `portable` asks for the
    /// kernel that rounds alike everywhere.
    pub fn with(scenario: &CheckedScenario, whole: bool, portable: bool) -> Self {
        let Impact::ForcePulse(pulse) = &scenario.impact else {
            unreachable!("no checked scenario has an object at the Paper model");
        };
        let input = (scenario.eye.clone(), pulse.clone());
        Self::built(input, scenario.window_ms * 1e-3, (whole, portable))
    }

    fn built(input: (EyeInput, ForcePulse), window: f64, (whole, portable): (bool, bool)) -> Self {
        let (eye_input, pulse) = &input;
        let eye = Eye::build(eye_input);
        let load = ArcLoad::new(pulse, &eye);
        let system = System::new(&eye, Pulse::new(pulse), &load, whole, portable);
        Self {
            start: State::at_rest(&system),
            eye,
            load,
            system,
            window,
            input,
        }
    }

    /// Moves the eye by `plan` and records it under the eyes of `watch`.
    ///
    /// # Errors
    /// [`Refusal::NotFinite`] if the motion leaves the finite numbers, [`Refusal::Cancelled`] if
    /// the watch stopped it.
    pub fn record(&self, plan: &Plan, keep: Keep, watch: Watch) -> Result<Recording, Refusal> {
        let steps = plan.steps(&self.system.load().pulse);
        let mut observer = Watched {
            recorder: Recorder::new(
                &self.eye,
                &self.load,
                &self.system,
                (self.window, steps),
                keep,
            ),
            watch,
            window: self.window,
            steps: 0,
            cancelled: false,
        };
        let mut state = self.start.clone();
        let cost = march(&self.system, plan, &mut state, &mut observer)?;
        if observer.cancelled {
            return Err(Refusal::Cancelled);
        }
        Ok(observer.recorder.finish(&state, cost))
    }
}
