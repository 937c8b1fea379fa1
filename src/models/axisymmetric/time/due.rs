//! Frames at chosen instants, which fall between the steps.
//!
//! From step to step a leapfrog moves every node at one velocity, so that the places in between
//! are its own. The force of a node is 75 mg times the mean of its acceleration over the 20 us
//! before, as it is for the monitored places. Pressures are those at the beginning of the step.

use crate::models::axisymmetric::recording::sensor::SMOOTHING_S;
use crate::run::kept::{Frame, Spacing};
use std::collections::VecDeque;

/// Which frames are due, and the velocities `V` that their forces are reckoned from.
#[derive(Debug, Clone)]
pub(crate) struct FramesDue<V> {
    spacing: Spacing,
    taken: usize,
    marked: usize,
    /// Velocities of each node 20 us before the frames to come, in m/s; none before the start.
    before: VecDeque<Vec<V>>,
}

impl<V> FramesDue<V> {
    pub fn new(spacing: Spacing) -> Self {
        Self { spacing, taken: 0, marked: 0, before: VecDeque::new() }
    }

    /// The frames that fall into the step of `step` s that ended at `time`, each from the time that
    /// it shows and the velocities 20 us before that.
    pub fn take(
        &mut self,
        (time, step): (f64, f64),
        velocities: impl Fn() -> Vec<V>,
        frame: impl Fn(f64, &[V]) -> Frame,
    ) -> Vec<Frame> {
        let spacing = self.spacing;
        while spacing.due(self.marked) - SMOOTHING_S <= time - 0.5 * step {
            let at_rest = spacing.due(self.marked) < SMOOTHING_S;
            self.before.push_back(if at_rest { Vec::new() } else { velocities() });
            self.marked += 1;
        }
        let mut frames = Vec::new();
        // The frame at the end of the window must not be lost to rounding.
        while spacing.due(self.taken) <= time + 1e-9 * spacing.every {
            let before = self.before.pop_front().unwrap_or_default();
            frames.push(frame(spacing.due(self.taken), &before));
            self.taken += 1;
        }
        frames
    }
}
