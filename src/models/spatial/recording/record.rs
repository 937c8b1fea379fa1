//! What is read off the moving eye at each step, and what is kept of it.

use crate::models::axisymmetric::recording::record::NODE_MASS;
use crate::models::axisymmetric::recording::sensor::LowPass;
use crate::models::spatial::eye::mesh::Place;
use crate::models::spatial::forces::state::Cells;
use crate::models::spatial::time::run::{Instant, Motion};
use crate::run::places::Region;
use nalgebra::{Point2, Vector3};
use std::f64::consts::PI;

/// Steps between two looks at the shape, and at the turn of the globe, which are slow.
const SHAPE_EVERY: usize = 4;
const TURN_EVERY: usize = 16;

impl<C: Cells> Motion<'_, C> {
    /// Extremes of this instant, `step` s after the one before; returns the forces of the monitored
    /// nodes.
    pub fn read(&mut self, now: &Instant, (steps, time): (usize, f64), step: f64) -> [f64; 4] {
        let share = LowPass::share(step);
        let e = &mut self.extremes.common;
        e.force.offer(now.force, time);
        let mean = self.force_mean.pass(now.force, time, step);
        e.mean_force.offer(mean, time);
        let pressure = self.filters[0].pass(now.sums.pressure, share);
        e.pressure.offer(pressure, time);
        let back = self.filters[1].pass(now.sums.sensor, share);
        e.back_pressure.offer(back, time);
        let mean = self.back_mean.pass(now.sums.sensor, time, step);
        e.mean_back_pressure.offer(mean, time);
        self.stress = 0.0;
        let tensions = self.shell.tensions();
        for (i, (passed, now)) in self.tension_passed.iter_mut().zip(tensions).enumerate() {
            self.stress = self.stress.max(passed.pass(*now, share));
            if self.stress > e.scleral_stress.value {
                e.scleral_stress.offer(self.stress, time);
                self.extremes.stress_at = self.eye.quads[i].seen;
            }
        }
        let radius = (now.touch.area / PI).sqrt();
        e.contact_radius = e.contact_radius.max(radius);
        if now.touch.used_up >= 1.0 {
            e.crushed_at.get_or_insert(time);
        }
        if let Some(push) = &now.push {
            e.rim_force.offer(push.force.norm(), time);
            if push.used_up >= 1.0 {
                e.crushed_at.get_or_insert(time);
            }
        }
        let moving = &self.flying.moving;
        let kept = moving.kinetic(0.0) + moving.stored() + self.account.energy.lost_in_object;
        let at_bone = now.push.map_or(0.0, |push| push.energy);
        let given = self.account.energy_before - kept - now.touch.energy - at_bone;
        e.energy_given.offer(given, time);
        e.intrusion.offer(self.flying.intrusion(&self.way), time);
        let volume = now.sums.volume / self.globe_volume;
        e.least_volume = e.least_volume.min(volume);
        e.most_volume = e.most_volume.max(volume);
        e.least_triangle = e.least_triangle.min(now.sums.least_corner);
        if let Some(held) = &now.held {
            let force = self.eye.copies() * held.force;
            self.extremes.globe_on_bone.offer(force, time);
        }
        for (i, dented) in self.dented.iter_mut().enumerate() {
            *dented = self.near_entry[i] && self.target.touched[i];
        }
        self.tissues.read(
            self.eye,
            &self.state.at,
            (&self.shell.along, &self.dented),
            share,
            time,
            &mut self.extremes,
        );
        if steps % SHAPE_EVERY == 0 {
            self.read_shape(time);
        }
        if steps % TURN_EVERY == 0 {
            self.read_turn(time);
        }
        let (eye, balance, state) = (self.eye, &self.balance, &self.state);
        self.fold.record(
            time,
            now.sums.least_corner,
            |cell| balance.least_corner(state, cell),
            |cell| {
                let cell = &eye.cells[cell];
                let sum: Vector3<f64> = cell.corners.iter().map(|n| eye.mesh.at[*n]).sum();
                let middle = sum / 8.0;
                let part = match cell.place {
                    Place::Surround => Region::Fat,
                    Place::Globe if cell.lens > 0.0 => Region::Lens,
                    Place::Globe => Region::Interior,
                };
                let side = if middle.y < 0.0 { -1.0 } else { 1.0 };
                let across = side * libm::hypot(middle.y, middle.z);
                (Point2::new(middle.x, across), part)
            },
        );
        let accelerations = self
            .accelerometers
            .read(&self.state.speed, time - 0.5 * step);
        let forces = accelerations.map(|a| NODE_MASS * a);
        let e = &mut self.extremes.common;
        for (peak, force) in e.node_force.iter_mut().zip(forces) {
            peak.offer(force, time);
        }
        forces
    }

    pub fn read_shape(&mut self, time: f64) {
        self.shape = self.shapes.read(&self.state.at);
        let (shape, e) = (self.shape, &mut self.extremes.common);
        e.shortening.offer(shape.shortening, time);
        e.equator_growth.offer(shape.width_growth, time);
        e.shell_growth.offer(shape.shell_growth, time);
        e.apex.offer(shape.apex, time);
        e.lens.offer(shape.lens, time);
    }

    /// How the globe has moved and turned.
    pub fn read_turn(&mut self, time: f64) {
        let (way, turn) = self.shapes.moved(&self.state.at);
        let e = &mut self.extremes;
        e.turn.offer(turn, time);
        if way.norm() > e.way.value {
            e.way.offer(way.norm(), time);
            e.way_then = turned(way, self.up);
        }
    }

    pub fn balance(&mut self, now: &Instant, kick: f64) {
        let (state, copies) = (&self.state, self.eye.copies());
        let stored = self.balance.energy(state) + now.shell;
        self.account.energy.elastic = copies * (stored + now.held.map_or(0.0, |held| held.energy));
        self.account.energy.contact = now.touch.energy + now.push.map_or(0.0, |p| p.energy);
        self.account.energy.lost = self.lost + 0.5 * kick * copies * now.sums.loss;
        let kinetic = |node: usize| -> f64 {
            let of = |k: usize| {
                let speed = state.speed[k][node];
                speed * (speed + kick * state.force[k][node] * state.free[k][node])
            };
            0.5 * self.eye.mass[node] * (of(0) + of(1) + of(2))
        };
        self.account.energy.kinetic = copies * (0..self.eye.mass.len()).map(kinetic).sum::<f64>();
        let moving = &self.flying.moving;
        self.account.energy.object = moving.kinetic(kick) + moving.stored();
        let given = self.account.energy_before
            - self.account.energy.object
            - self.account.energy.lost_in_object
            - self.account.energy.contact;
        self.extremes.common.energy_imparted = given;
    }

    pub fn trace(&mut self, now: &Instant, time: f64, node_force: [f64; 4]) {
        let shape = self.shapes.read(&self.state.at);
        let t = &mut self.account.traces;
        t.time.push(time);
        t.load.push(now.force);
        for (trace, force) in t.force.iter_mut().zip(node_force) {
            trace.push(force);
        }
        t.apex.push(shape.apex);
        t.shell_growth.push(shape.shell_growth);
        t.meridian_growth.push(shape.width_growth);
        t.kinetic.push(self.account.energy.kinetic);
        t.elastic.push(self.account.energy.elastic);
        t.dissipated.push(self.account.energy.lost);
        t.work.push(self.extremes.common.energy_imparted);
        t.pressure.push(self.filters[0].now);
        t.back_pressure.push(self.back_mean.now);
        t.scleral_stress.push(self.stress);
        for (trace, now) in t.tissue.iter_mut().zip(self.tissues.now) {
            trace.push(now);
        }
        t.shortening.push(shape.shortening);
        t.lens.push(shape.lens);
        let moving = &self.flying.moving;
        t.contact_force.push(self.force_mean.now);
        t.intrusion.push(self.flying.intrusion(&self.way));
        t.projectile.push(moving.middle().dot(&self.way));
        t.projectile_velocity.push(moving.velocity().dot(&self.way));
    }
}

/// A vector of the mesh in the eye's own axes.
fn turned(of: Vector3<f64>, up: f64) -> Vector3<f64> {
    let (sin, cos) = (libm::sin(up), libm::cos(up));
    Vector3::new(of.x, cos * of.y - sin * of.z, sin * of.y + cos * of.z)
}
