//! What makes the steps of a run.

use crate::models::paper::forces::{kernel::Survey, state::State};
use crate::models::pulse::Segment;
use crate::run::plan::Cost;

/// How a method treats the drag, which decides what it costs in step length; see
/// [`crate::models::paper::time::method`].
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Drag {
    /// Solved exactly within each drift.
    Exact,
    /// Added to the kick at the start of the step.
    WithKick,
    /// Part of the acceleration at every stage.
    InRates,
}

/// Makes the steps of one run, segment by segment, without allocating.
pub(crate) trait Stepper {
    /// Gets ready for a segment, at whose start `state` is and has been evaluated.
    fn begin(&mut self, state: &State, steps: &EqualSteps);

    /// Moves `state`, evaluated before, by one step; the last ends exactly where the segment does.
    fn step(&mut self, state: &mut State, steps: &mut EqualSteps, cost: &mut Cost) -> Survey;
}

/// Equal steps through a segment.
#[derive(Debug)]
pub(crate) struct EqualSteps {
    pub segment: Segment,
    /// Length of a step, in s.
    pub length: f64,
    total: usize,
    taken: usize,
}

impl EqualSteps {
    pub fn new(segment: Segment, total: usize) -> Self {
        let length = (segment.end - segment.start) / total as f64;
        Self { segment, length, total, taken: 0 }
    }

    /// The time after one more step, in s: computed, not summed, so that rounding never piles up.
    pub fn advance(&mut self) -> f64 {
        self.taken += 1;
        if self.taken == self.total {
            self.segment.end
        } else {
            self.segment.start + self.length * self.taken as f64
        }
    }
}
