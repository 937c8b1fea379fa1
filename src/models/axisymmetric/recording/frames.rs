//! The eye at chosen instants.
//!
//! From step to step a leapfrog moves every node at one velocity, so that the places in between
//! are its own. The force of a node is 75 mg times the mean of its acceleration over the 20 us
//! before, as it is for the monitored places. Pressures are those at the beginning of the step.

use crate::models::axisymmetric::forces::object::MovingObject;
use crate::models::axisymmetric::forces::state::Cells;
use crate::models::axisymmetric::recording::record::NODE_MASS;
use crate::models::axisymmetric::recording::sensor::SMOOTHING_S;
use crate::models::axisymmetric::time::run::Motion;
use crate::run::kept::{Frame, Spacing};
use nalgebra::Point2;
use std::collections::VecDeque;

/// Which frames are due, and the velocities that their forces are reckoned from.
#[derive(Debug, Clone)]
pub(crate) struct FramesDue {
    spacing: Spacing,
    taken: usize,
    marked: usize,
    /// Velocities of each node 20 us before the frames to come, in m/s; none before the start.
    before: VecDeque<Vec<(f64, f64)>>,
}

impl FramesDue {
    pub fn new(spacing: Spacing) -> Self {
        Self {
            spacing,
            taken: 0,
            marked: 0,
            before: VecDeque::new(),
        }
    }
}

impl<C: Cells> Motion<'_, C> {
    /// The frames that fall into the step of `step` s that ended at `time`.
    pub fn take_frames(&mut self, time: f64, step: f64) -> Vec<Frame> {
        let Some(mut taker) = self.frame_taker.take() else {
            return Vec::new();
        };
        let due = |number| taker.spacing.due(number);
        while due(taker.marked) - SMOOTHING_S <= time - 0.5 * step {
            let at_rest = due(taker.marked) < SMOOTHING_S;
            taker.before.push_back(if at_rest {
                Vec::new()
            } else {
                self.velocities()
            });
            taker.marked += 1;
        }
        let mut frames = Vec::new();
        // The frame at the end of the window must not be lost to rounding.
        while due(taker.taken) <= time + 1e-9 * taker.spacing.every {
            let before = taker.before.pop_front().unwrap_or_default();
            frames.push(self.frame(due(taker.taken), time, &before));
            taker.taken += 1;
        }
        self.frame_taker = Some(taker);
        frames
    }

    fn velocities(&self) -> Vec<(f64, f64)> {
        let of = |node| {
            let place = self.cells.place(node);
            (self.state.vx[place], self.state.vr[place])
        };
        (0..self.eye.mass.len()).map(of).collect()
    }

    /// The eye at `due`, within the step that ended at `time`.
    fn frame(&self, due: f64, time: f64, before: &[(f64, f64)]) -> Frame {
        let (eye, state, back) = (self.eye, &self.state, time - due);
        let position = |node: usize| {
            let place = self.cells.place(node);
            Point2::new(
                state.x[place] - back * state.vx[place],
                state.r[place] - back * state.vr[place],
            )
        };
        let force = |(node, v): (usize, (f64, f64))| {
            let earlier = before.get(node).copied().unwrap_or_default();
            let change = libm::hypot(v.0 - earlier.0, v.1 - earlier.1);
            if eye.fixed[node] {
                0.0
            } else {
                NODE_MASS * change / SMOOTHING_S
            }
        };
        let projectile = self.object.as_ref().map(|(_, projectile)| projectile);
        Frame {
            time: due,
            positions: (0..eye.mass.len()).map(position).collect(),
            forces: self
                .velocities()
                .into_iter()
                .enumerate()
                .map(force)
                .collect(),
            cells: self.cells.pressures(),
            projectile: projectile.map(|f| Point2::new(f.middle() - back * f.velocity(), 0.0)),
            squeezed: projectile.map_or(0.0, MovingObject::squeezed),
            pressure: Some(self.filters[0].now),
        }
    }
}
