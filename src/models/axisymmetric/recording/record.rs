//! What is read off the moving eye at each step, and what is kept of it.

use crate::models::axisymmetric::eye::AxisymmetricEye;
use crate::models::axisymmetric::forces::cell;
use crate::models::axisymmetric::forces::state::{Cells, NodeState};
use crate::models::axisymmetric::recording::sensor::LowPass;
use crate::models::axisymmetric::time::run::{Instant, Motion};

/// Mass by which accelerations become the node forces of the paper, kg.
pub(crate) const NODE_MASS: f64 = 75e-6;

impl<C: Cells> Motion<'_, C> {
    /// Extremes of this instant, `step` s after the one before; returns the forces of the monitored
    /// nodes.
    pub fn read(&mut self, now: &Instant, time: f64, step: f64) -> [f64; 4] {
        let share = LowPass::share(step);
        let way = self.way();
        let e = &mut self.extremes;
        e.force.offer(now.force, time);
        let mean = self.force_mean.pass(now.force, time, step);
        e.mean_force.offer(mean, time);
        e.pressure
            .offer(self.filters[0].pass(now.sums.pressure, share), time);
        e.back_pressure
            .offer(self.filters[1].pass(now.sums.sensor, share), time);
        let mean = self.back_mean.pass(now.sums.sensor, time, step);
        e.mean_back_pressure.offer(mean, time);
        self.tissues.read(&self.state, share, time, e);
        self.stress = 0.0;
        for (i, (passed, now)) in self
            .tension_passed
            .iter_mut()
            .zip(&self.tension)
            .enumerate()
        {
            for (passed, now) in passed.iter_mut().zip(now) {
                self.stress = self.stress.max(passed.pass(*now, share));
            }
            if self.stress > e.scleral_stress.value {
                e.scleral_stress.offer(self.stress, time);
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
        let shape = Shape::of(self.eye, &self.state, &self.lens, self.lens_rest, way);
        e.shortening.offer(shape.shortening, time);
        e.equator_growth.offer(shape.equator_growth, time);
        e.shell_growth
            .offer(now.shell.length / self.shell.rest_length - 1.0, time);
        e.apex.offer(shape.apex, time);
        e.lens.offer(shape.lens, time);
        if let Some((object, projectile)) = &self.object {
            let kept =
                projectile.kinetic(0.0) + projectile.stored() + self.account.energy.lost_in_object;
            let between = now.touch.map_or(0.0, |touch| touch.energy);
            e.energy_given
                .offer(self.account.energy_before - kept - between, time);
            let touched = -self.eye.parameters.radius - object.reach();
            e.intrusion.offer(projectile.x[0] - touched, time);
        }
        if self.load.is_some() {
            e.energy_given.offer(self.account.energy.work, time);
        }
        let volume = now.sums.volume / self.globe_volume;
        e.least_volume = e.least_volume.min(volume);
        e.most_volume = e.most_volume.max(volume);
        e.least_triangle = e.least_triangle.min(now.sums.least_triangle);
        let (eye, cells, state) = (self.eye, &self.cells, &self.state);
        let at = |node: usize| {
            let place = cells.place(node);
            (state.x[place], state.r[place])
        };
        self.fold.record(
            time,
            now.sums.least_triangle,
            |cell| cell::least_triangle(eye, &eye.cells[cell].corners, at),
            |cell| eye.cells[cell].place(eye),
        );
        let accelerations = self.accelerometers.read(&self.state, time - 0.5 * step);
        let forces = accelerations.map(|a| NODE_MASS * a);
        for (peak, force) in e.node_force.iter_mut().zip(forces) {
            peak.offer(force, time);
        }
        forces
    }

    pub fn balance(&mut self, now: &Instant, kick: f64) {
        let state = &self.state;
        let stored = self.balance.energy(|node| {
            let place = self.cells.place(node);
            (state.x[place], state.r[place])
        });
        self.account.energy.elastic = stored + now.shell.energy;
        self.account.energy.contact = now.touch.map_or(0.0, |t| t.energy);
        self.account.energy.kinetic = (0..state.x.len())
            .map(|i| {
                let along = state.vx[i] * (state.vx[i] + kick * state.fx[i] * state.free_x[i]);
                let across = state.vr[i] * (state.vr[i] + kick * state.fr[i] * state.free_r[i]);
                0.5 * self.mass[i] * (along + across)
            })
            .sum();
        let (mut object, mut given) = (0.0, self.account.energy.work);
        if let Some((_, projectile)) = &self.object {
            object = projectile.kinetic(kick) + projectile.stored();
            given = self.account.energy_before
                - object
                - self.account.energy.lost_in_object
                - self.account.energy.contact;
        }
        self.account.energy.object = object;
        self.extremes.energy_imparted = given;
    }

    pub fn trace(&mut self, now: &Instant, time: f64, node_force: [f64; 4]) {
        let shape = Shape::of(
            self.eye,
            &self.state,
            &self.lens,
            self.lens_rest,
            self.way(),
        );
        let t = &mut self.account.traces;
        t.time.push(time);
        t.load.push(now.force);
        for (trace, force) in t.force.iter_mut().zip(node_force) {
            trace.push(force);
        }
        t.apex.push(shape.apex);
        t.shell_growth
            .push(now.shell.length / self.shell.rest_length - 1.0);
        t.meridian_growth.push(shape.equator_growth);
        t.kinetic.push(self.account.energy.kinetic);
        t.elastic.push(self.account.energy.elastic);
        t.dissipated.push(self.account.energy.lost);
        t.work.push(self.extremes.energy_imparted);
        t.pressure.push(self.filters[0].now);
        t.back_pressure.push(self.back_mean.now);
        t.scleral_stress.push(self.stress);
        for (trace, now) in t.tissue.iter_mut().zip(self.tissues.now) {
            trace.push(now);
        }
        t.shortening.push(shape.shortening);
        t.lens.push(shape.lens);
        if let Some((object, projectile)) = &self.object {
            t.contact_force.push(self.force_mean.now);
            t.intrusion
                .push(projectile.x[0] + self.eye.parameters.radius + object.reach());
            t.projectile.push(projectile.middle());
            t.projectile_velocity.push(projectile.velocity());
        }
    }
}

impl<C: Cells> Motion<'_, C> {
    /// How far an eye that nothing holds has flown as a whole, m: no part of it feels that.
    fn way(&self) -> f64 {
        if self.eye.parameters.surround.is_some() {
            return 0.0;
        }
        let weighed = self.mass.iter().zip(&self.state.x);
        let moment: f64 = weighed.map(|(m, x)| m * x).sum();
        moment / self.mass.iter().sum::<f64>() - self.middle
    }
}

/// How the eye has changed its shape.
struct Shape {
    shortening: f64,
    equator_growth: f64,
    apex: f64,
    lens: f64,
}

impl Shape {
    fn of(
        eye: &AxisymmetricEye,
        state: &NodeState,
        lens: &[(usize, f64)],
        lens_rest: f64,
        way: f64,
    ) -> Self {
        let shell = state.shell.clone();
        let (front, back) = (state.x[shell.start], state.x[shell.end - 1]);
        let radius = eye.parameters.radius;
        let widest = |r: &[f64]| r.iter().copied().fold(0.0, f64::max);
        let rest = eye
            .mesh
            .shell
            .iter()
            .map(|&n| eye.mesh.r[n])
            .fold(0.0, f64::max);
        Self {
            shortening: 1.0 - (back - front) / (2.0 * radius),
            equator_growth: widest(&state.r[shell]) / rest - 1.0,
            apex: front + radius - way,
            lens: lens.iter().map(|&(n, s)| s * state.x[n]).sum::<f64>() - lens_rest - way,
        }
    }
}
