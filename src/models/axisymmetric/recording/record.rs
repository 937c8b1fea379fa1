//! What is read off the moving eye at each step, and the eye at the instants that frames are due.

use crate::models::axisymmetric::recording::account::{
    Account, Flight, NODE_MASS, Recorded, Shape,
};
use crate::models::axisymmetric::recording::sensor::SMOOTHING_S;
use crate::models::axisymmetric::time::run::{Instant, Motion};
use crate::models::axisymmetric::{forces::cell, forces::object::MovingObject};
use crate::run::kept::Frame;
use nalgebra::Point2;

impl Recorded for Motion<'_> {
    type Now = Instant;

    fn account(&mut self) -> &mut Account {
        &mut self.account
    }

    fn read(
        &mut self,
        now: &Instant,
        (_, time): (usize, f64),
        (step, kick): (f64, f64),
    ) -> [f64; 4] {
        let share = self.account.read(now.force, &now.sums, (time, step));
        let e = &mut self.account.extremes;
        self.tissues.read(&self.state, share, time, e);
        let mut stress = 0.0_f64;
        for (i, (passed, now)) in self.tension_passed.iter_mut().zip(&self.tension).enumerate() {
            for (passed, now) in passed.iter_mut().zip(now) {
                stress = stress.max(passed.pass(*now, share));
            }
            if stress > e.scleral_stress.value {
                e.scleral_stress.offer(stress, time);
                e.stress_angle = self.eye.segments[i].front_angle;
            }
        }
        if let Some(touch) = &now.touch {
            e.rim_force.offer(-touch.rim, time);
            e.contact_radius = e.contact_radius.max(touch.radius);
            if touch.used_up >= 1.0 {
                e.crushed_at.get_or_insert(time);
            }
        }
        self.account.stress = stress;
        self.shape = self.shape(now.shell.length / self.shell.rest_length - 1.0);
        self.account.read_shape(&self.shape, time);
        if let Some((object, projectile)) = &self.object {
            let energy = projectile.energy(kick, now.loss_in_object);
            let between = now.touch.map_or(0.0, |touch| touch.energy);
            let touched = -self.eye.parameters.radius - object.reach();
            let intrusion = projectile.x[0] - touched;
            self.account.read_object(energy, (between, 0.0), intrusion, time);
        }
        if self.load.is_some() {
            let work = self.account.energy.work - self.flown(0.0);
            self.account.extremes.energy_given.offer(work, time);
        }
        let (eye, cells, state) = (self.eye, &self.cells, &self.state);
        self.account.fold.record(
            time,
            now.sums.least_corner,
            |cell| {
                let at = |node| state.at(cells.place(node));
                cell::least_triangle(eye, &eye.cells[cell].corners, at)
            },
            |cell| eye.place(cell),
        );
        let accelerations = self.accelerometers.read(&self.state, time - 0.5 * step);
        self.account.read_nodes(accelerations, time)
    }

    fn balance(&mut self, now: &Instant, kick: f64) {
        let state = &self.state;
        let stored = self.balance.energy(|node| state.at(self.cells.place(node)));
        let energy = &mut self.account.energy;
        energy.elastic = stored + now.shell.energy;
        energy.contact = now.touch.map_or(0.0, |t| t.energy);
        energy.kinetic = (0..state.x.len())
            .map(|i| {
                let along = state.vx[i] * (state.vx[i] + kick * state.fx[i] * state.free_x[i]);
                let across = state.vr[i] * (state.vr[i] + kick * state.fr[i] * state.free_r[i]);
                0.5 * self.mass[i] * (along + across)
            })
            .sum();
        let mut given = energy.work;
        if let Some((_, projectile)) = &self.object {
            energy.object = projectile.energy(kick, now.loss_in_object);
            given = self.account.given();
        }
        self.account.impart(given, self.flown(kick));
    }

    fn trace(&mut self, now: &Instant, time: f64, node_force: [f64; 4]) {
        let flight = self.object.as_ref().map(|(object, projectile)| Flight {
            intrusion: projectile.x[0] + self.eye.parameters.radius + object.reach(),
            middle: projectile.middle(),
            velocity: projectile.velocity(),
        });
        let (forces, tissue) = ((now.force, node_force), self.tissues.now);
        self.account.trace(time, forces, &self.shape, tissue, flight);
    }

    fn frames(&mut self, time: f64, step: f64) -> Vec<Frame> {
        let Some(mut due) = self.frames_due.take() else { return Vec::new() };
        let frame = |due, before: &[_]| self.frame(due, time, before);
        let frames = due.take((time, step), || self.velocities(), frame);
        self.frames_due = Some(due);
        frames
    }
}

impl Motion<'_> {
    /// How far an eye that nothing holds has flown as a whole, m: no part of it feels that.
    fn way(&self) -> f64 {
        if self.eye.parameters.surround.is_some() {
            return 0.0;
        }
        let weighed = self.mass.iter().zip(&self.state.x);
        let moment: f64 = weighed.map(|(m, x)| m * x).sum();
        moment / self.mass.iter().sum::<f64>() - self.middle
    }

    /// The shape now, where the shell has grown by some share.
    fn shape(&self, shell_growth: f64) -> Shape {
        let (eye, state, way) = (self.eye, &self.state, self.way());
        let shell = state.shell.clone();
        let (front, back) = (state.x[shell.start], state.x[shell.end - 1]);
        let radius = eye.parameters.radius;
        let rest = eye.mesh.shell.iter().map(|&n| eye.mesh.r[n]).fold(0.0, f64::max);
        let widest = state.r[shell].iter().copied().fold(0.0, f64::max);
        let lens: f64 = self.lens.iter().map(|&(n, s)| s * state.x[n]).sum();
        Shape {
            shortening: 1.0 - (back - front) / (2.0 * radius),
            width_growth: widest / rest - 1.0,
            shell_growth,
            apex: front + radius - way,
            lens: lens - self.lens_rest - way,
        }
    }

    /// The energy of that flight, J, where forces act for `kick` s.
    fn flown(&self, kick: f64) -> f64 {
        if self.eye.parameters.surround.is_some() {
            return 0.0;
        }
        let state = &self.state;
        let speed = |i: usize| state.vx[i] + 0.5 * kick * state.fx[i] * state.free_x[i];
        let momentum: f64 = (0..state.x.len()).map(|i| self.mass[i] * speed(i)).sum();
        0.5 * momentum * momentum / self.mass.iter().sum::<f64>()
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
            let (x, r) = state.at(place);
            Point2::new(x - back * state.vx[place], r - back * state.vr[place])
        };
        let force = |(node, v): (usize, (f64, f64))| {
            let earlier = before.get(node).copied().unwrap_or_default();
            let change = libm::hypot(v.0 - earlier.0, v.1 - earlier.1);
            if eye.fixed[node] { 0.0 } else { NODE_MASS * change / SMOOTHING_S }
        };
        let velocities = self.velocities().into_iter().enumerate();
        let projectile = self.object.as_ref().map(|(_, projectile)| projectile);
        Frame {
            front: None,
            aside: Vec::new(),
            time: due,
            positions: (0..eye.mass.len()).map(position).collect(),
            forces: velocities.map(force).collect(),
            cells: self.cells.pressures(),
            projectile: projectile.map(|f| Point2::new(f.middle() - back * f.velocity(), 0.0)),
            squeezed: projectile.map_or(0.0, MovingObject::squeezed),
            pressure: Some(self.account.pressure()),
        }
    }
}
