//! One scenario compiled: the eye, its load, the rows that the kernel moves, and the step.

use crate::models::paper::recording::recorder::Recorder;
use crate::models::paper::time::march::{Observer, march};
use crate::models::paper::{eye::Eye, forces::kernel::Survey, forces::load::ArcLoad};
use crate::models::paper::{forces::state::State, forces::system::System, recording::Recording};
use crate::models::pulse::{Piece, Pulse};
use crate::run::{kept::Keep, plan::Plan, refusal::Refusal, watch::Watch};
use crate::scenario::{CheckedScenario, EyeInput, ForcePulse};

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
pub struct PaperCase {
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
    /// What it starts from: rest, unless a test moves it.
    pub start: State,
}

impl PaperCase {
    /// The same eye and pulse on the mesh of another level.
    pub(super) fn on_level(&self, level: u32) -> Self {
        let (mut eye, pulse) = self.input.clone();
        eye.level = level;
        Self::built((eye, pulse), self.window, (false, false))
    }

    /// Compiles a scenario.
    pub fn new(scenario: &CheckedScenario) -> Self {
        Self::with(scenario, false, false)
    }

    /// Compiles a scenario; `whole` leaves symmetry unused, `portable` asks for the
    /// kernel that rounds alike everywhere.
    pub fn with(scenario: &CheckedScenario, whole: bool, portable: bool) -> Self {
        let (Some(pulse), Some(window_ms)) = (scenario.pulse(), scenario.known_window_ms()) else {
            unreachable!("no checked scenario has an object at the Paper model");
        };
        let input = (scenario.eye.clone(), pulse.clone());
        Self::built(input, window_ms * 1e-3, (whole, portable))
    }

    fn built(input: (EyeInput, ForcePulse), window: f64, (whole, portable): (bool, bool)) -> Self {
        let (eye_input, pulse) = &input;
        let eye = Eye::build(eye_input);
        let load = ArcLoad::new(pulse, &eye);
        let system = System::new(&eye, Pulse::new(pulse), &load, whole, portable);
        Self { start: State::at_rest(&system), eye, load, system, window, input }
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
