//! One scenario compiled: the eye, its load, the rows that the kernel moves, and the step.

use crate::models::paper::recording::{Recording, recorder::Recorder};
use crate::models::paper::{eye::Eye, forces::load::ArcLoad, forces::state::State};
use crate::models::paper::{forces::system::System, time::march};
use crate::models::pulse::Pulse;
use crate::run::{kept::Keep, plan::Plan, refusal::Refusal, watch::Watch};
use crate::scenario::{CheckedScenario, EyeInput, ForcePulse};
use std::ops::ControlFlow;

/// Step ends between two calls of a watch.
const MOMENTS_BETWEEN_CALLS: usize = 64;

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
        let (eye, pulse) = self.input.clone();
        Self::built((EyeInput { level, ..eye }, pulse), self.window, (false, false))
    }

    /// Compiles a scenario.
    pub fn new(scenario: &CheckedScenario) -> Self {
        Self::with(scenario, false, false)
    }

    /// Compiles it; `whole` leaves symmetry unused, the `portable` kernel rounds alike everywhere.
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
        let mut moments = 0_usize;
        self.follow(plan, keep, |_, time| {
            moments += 1;
            if moments.is_multiple_of(MOMENTS_BETWEEN_CALLS) {
                watch(time / self.window)
            } else {
                ControlFlow::Continue(())
            }
        })
    }

    /// The same; `look` is given the recorder at every moment, and the time.
    pub(super) fn follow(
        &self,
        plan: &Plan,
        keep: Keep,
        mut look: impl FnMut(&mut Recorder, f64) -> ControlFlow<()>,
    ) -> Result<Recording, Refusal> {
        let span = (self.window, march::steps(plan, &self.system.pulse));
        let mut recorder = Recorder::new(&self.eye, &self.load, &self.system, span, keep);
        let mut state = self.start.clone();
        let mut looked = ControlFlow::Continue(());
        let cost = march::march(&self.system, plan, &mut state, |now| {
            recorder.see(&self.system, &now);
            looked = look(&mut recorder, now.state.time);
            let settled = !now.starts && recorder.settled();
            if settled { ControlFlow::Break(()) } else { looked }
        })?;
        if looked.is_break() {
            return Err(Refusal::Cancelled);
        }
        Ok(recorder.finish(&state, cost))
    }
}
