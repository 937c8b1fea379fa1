//! the frames of a run, handed on one by one, so that a film of any length takes no memory.
//!
//! The run is done again by the plan that was found good: the same steps, so the same digits.

use std::ops::ControlFlow;

use crate::models::paper::time::march::{Observer, march};
use crate::models::paper::{case::PaperCase, forces::kernel::Survey, forces::state::State};
use crate::models::paper::{forces::system::System, recording::frames::FrameTaker};
use crate::models::pulse::Piece;
use crate::run::kept::{Frame, Spacing};
use crate::run::{plan::Plan, refusal::Refusal};

struct Stream<'a> {
    taker: FrameTaker,
    before: State,
    take: &'a mut dyn FnMut(Frame) -> ControlFlow<()>,
    stopped: bool,
}

impl Stream<'_> {
    fn hand_on(&mut self) {
        for frame in self.taker.frames.drain(..) {
            self.stopped = self.stopped || (self.take)(frame).is_break();
        }
    }
}

impl Observer for Stream<'_> {
    fn begin(&mut self, system: &System, state: &State, _: Piece, _: &Survey) {
        self.before.copy_motion(system, state);
        self.taker.begin(system, state);
        self.hand_on();
    }

    fn step(&mut self, system: &System, state: &State, piece: Piece, _: &Survey) {
        self.taker.step(system, (&self.before, state), piece);
        self.before.copy_motion(system, state);
        self.hand_on();
    }

    fn satisfied(&self) -> bool {
        self.stopped
    }
}

/// Moves the eye of `case` by `plan` and gives every frame to `take` once it is due.
///
/// # Errors
/// [`Refusal::Cancelled`] if `take` stopped it, [`Refusal::NotFinite`] if the motion leaves the
/// finite numbers.
pub(crate) fn frames(
    case: &PaperCase,
    plan: &Plan,
    spacing: Spacing,
    take: &mut dyn FnMut(Frame) -> ControlFlow<()>,
) -> Result<(), Refusal> {
    let mut stream = Stream {
        taker: FrameTaker::new(spacing, &case.eye, &case.system),
        before: State::at_rest(&case.system),
        take,
        stopped: false,
    };
    march(&case.system, plan, &mut case.start.clone(), &mut stream)?;
    if stream.stopped { Err(Refusal::Cancelled) } else { Ok(()) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::answer::solve::tests::answered_with;
    use crate::run::kept::Keep;
    use crate::scenario::library::tests::preset;

    #[test]
    fn the_same_frames_come_one_by_one_as_are_kept() {
        let spacing = Spacing::even(1e-5);
        let keep = Keep { traces: false, frames: Some(spacing) };
        let kept = answered_with(&preset("paper-300n", &[("window_ms", "0.2")]), keep);
        let mut streamed = Vec::new();
        let take = &mut |frame| {
            streamed.push(frame);
            ControlFlow::Continue(())
        };
        kept.case.frames(&kept.plan, spacing, take).unwrap();
        assert_eq!(streamed.len(), 21);
        assert_eq!(streamed, kept.run.frames);
        let stop = &mut |_| ControlFlow::Break(());
        assert!(matches!(kept.case.frames(&kept.plan, spacing, stop), Err(Refusal::Cancelled)));
    }
}
