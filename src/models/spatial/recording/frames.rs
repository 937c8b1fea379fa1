//! The section, and the eye from the front, at the instants that frames are due.

use crate::models::axisymmetric::recording::record::NODE_MASS;
use crate::models::axisymmetric::recording::sensor::SMOOTHING_S;
use crate::models::spatial::forces::state::Cells;
use crate::models::spatial::recording::section::Section;
use crate::models::spatial::time::run::Motion;
use crate::run::kept::{Frame, FrontFrame};
use nalgebra::Vector3;

impl<C: Cells> Motion<'_, C> {
    /// The frames that fall into the step of `step` s that ended at `time`.
    pub fn frames(&mut self, time: f64, step: f64) -> Vec<Frame> {
        let Some((section, mut due)) = self.frames_due.take() else {
            return Vec::new();
        };
        let frames = due.take(
            (time, step),
            || self.velocities(&section),
            |due, before| self.frame(&section, due, time - due, before),
        );
        self.frames_due = Some((section, due));
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
            front: Some(self.front(section, back)),
        }
    }

    /// The eye from the front, `back` s before now.
    fn front(&self, section: &Section, back: f64) -> FrontFrame {
        let seen = |at: Vector3<f64>, speed: Vector3<f64>| section.facing(at - speed * back);
        let [limbus, equator] = section.rings.each_ref().map(|ring| {
            let (at, speed) = (&self.state.at, &self.state.speed);
            let points = ring.iter().map(|point| seen(point.of(at), point.of(speed)));
            points.collect()
        });
        let moving = &self.flying.moving;
        FrontFrame {
            limbus,
            equator,
            object: seen(moving.middle(), moving.velocity()),
        }
    }
}
