//! The eye at the instants that frames are due.

use crate::models::axisymmetric::forces::object::MovingObject;
use crate::models::axisymmetric::forces::state::Cells;
use crate::models::axisymmetric::recording::record::NODE_MASS;
use crate::models::axisymmetric::recording::sensor::SMOOTHING_S;
use crate::models::axisymmetric::time::run::Motion;
use crate::run::kept::Frame;
use nalgebra::Point2;

impl<C: Cells> Motion<'_, C> {
    /// The frames that fall into the step of `step` s that ended at `time`.
    pub fn frames(&mut self, time: f64, step: f64) -> Vec<Frame> {
        let Some(mut due) = self.frames_due.take() else {
            return Vec::new();
        };
        let frames = due.take(
            (time, step),
            || self.velocities(),
            |due, before| self.frame(due, time, before),
        );
        self.frames_due = Some(due);
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
            front: None,
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
