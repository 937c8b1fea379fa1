//! The section at chosen instants.
//!
//! From step to step a leapfrog moves every node at one velocity, so that the places in between
//! are its own. The force of a point is 75 mg times the mean of its acceleration over the 20 us
//! before, as it is for the monitored places. Pressures are those at the beginning of the step.

use crate::models::axisymmetric::recording::record::NODE_MASS;
use crate::models::axisymmetric::recording::sensor::SMOOTHING_S;
use crate::models::spatial::eye::SpatialEye;
use crate::models::spatial::forces::state::Cells;
use crate::models::spatial::recording::section::Section;
use crate::models::spatial::time::run::{Blow, Motion};
use crate::run::kept::{Frame, Spacing};
use nalgebra::Vector3;
use std::collections::VecDeque;

/// Which frames are due, and the velocities that their forces are reckoned from.
#[derive(Debug, Clone)]
pub(crate) struct FramesDue {
    section: Section,
    spacing: Spacing,
    taken: usize,
    marked: usize,
    /// Velocities of each point 20 us before the frames to come, in m/s; none before the start.
    before: VecDeque<Vec<Vector3<f64>>>,
}

impl FramesDue {
    pub fn new(spacing: Spacing, eye: &SpatialEye, blow: &Blow) -> Self {
        Self {
            section: Section::new(eye, blow),
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
                self.velocities(&taker.section)
            });
            taker.marked += 1;
        }
        let mut frames = Vec::new();
        // The frame at the end of the window must not be lost to rounding.
        while due(taker.taken) <= time + 1e-9 * taker.spacing.every {
            let before = taker.before.pop_front().unwrap_or_default();
            let due = due(taker.taken);
            frames.push(self.frame(&taker.section, due, time - due, &before));
            taker.taken += 1;
        }
        self.frame_taker = Some(taker);
        frames
    }

    fn velocities(&self, section: &Section) -> Vec<Vector3<f64>> {
        let points = section.points.iter();
        points
            .map(|shown| shown.point.of(&self.state.speed))
            .collect()
    }

    /// The section at `due`, `back` s before now.
    fn frame(&self, section: &Section, due: f64, back: f64, before: &[Vector3<f64>]) -> Frame {
        let velocities = self.velocities(section);
        let points = section.points.iter().zip(&velocities);
        let position = |at: Vector3<f64>, speed: Vector3<f64>| section.shown(at - speed * back);
        let forces = velocities.iter().enumerate().map(|(i, speed)| {
            let earlier = before.get(i).copied().unwrap_or_default();
            NODE_MASS * (speed - earlier).norm() / SMOOTHING_S
        });
        let pressures = self.cells.pressures();
        let moving = &self.flying.moving;
        Frame {
            time: due,
            positions: points
                .map(|(shown, speed)| position(shown.point.of(&self.state.at), *speed))
                .collect(),
            forces: forces.collect(),
            cells: section
                .cells
                .iter()
                .map(|(_, cell)| pressures[*cell])
                .collect(),
            projectile: Some(position(moving.middle(), moving.velocity())),
            squeezed: moving.squeezed(),
            pressure: Some(self.filters[0].now),
        }
    }
}
