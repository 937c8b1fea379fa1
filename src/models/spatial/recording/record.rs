//! What is read off the moving eye at each step, and its section at the instants that frames are
//! due.

use crate::models::axisymmetric::recording::account::{Account, Flight, NODE_MASS, Recorded};
use crate::models::axisymmetric::recording::sensor::SMOOTHING_S;
use crate::models::spatial::recording::section::Section;
use crate::models::spatial::time::run::{Instant, Motion};
use crate::run::kept::{Frame, FrontFrame};
use nalgebra::{Point2, Vector3};
use std::f64::consts::PI;

/// Steps between two looks at the shape, and at the turn of the globe, which are slow.
const SHAPE_EVERY: usize = 4;
const TURN_EVERY: usize = 16;

impl Recorded for Motion<'_> {
    type Now = Instant;

    fn account(&mut self) -> &mut Account {
        &mut self.account
    }

    fn read(
        &mut self,
        now: &Instant,
        (steps, time): (usize, f64),
        (step, kick): (f64, f64),
    ) -> [f64; 4] {
        let share = self.account.read(now.force, &now.sums, (time, step));
        let e = &mut self.account.extremes;
        let mut stress = 0.0_f64;
        let tensions = self.shell.tensions();
        for (i, (passed, now)) in self.tension_passed.iter_mut().zip(tensions).enumerate() {
            stress = stress.max(passed.pass(*now, share));
            if stress > e.scleral_stress.value {
                e.scleral_stress.offer(stress, time);
                self.extremes.stress_at = self.eye.quads[i].seen;
            }
        }
        e.contact_radius = e.contact_radius.max((now.touch.area / PI).sqrt());
        let cornea = &mut self.extremes.cornea_touched;
        *cornea = cornea.max(now.touch.cornea);
        let mut used_up = now.touch.used_up;
        if let Some(push) = &now.push {
            e.rim_force.offer(push.force.norm(), time);
            used_up = used_up.max(push.used_up);
        }
        if used_up >= 1.0 {
            e.crushed_at.get_or_insert(time);
        }
        self.account.stress = stress;
        if now.touch.force != Vector3::zeros() {
            self.ending.touched(time);
        }
        let moving = &self.flying.moving;
        let energy = moving.energy(kick, now.touch.loss);
        let between = (now.touch.energy, now.push.map_or(0.0, |push| push.energy));
        let intrusion = self.flying.intrusion(&self.way);
        self.account.read_object(energy, between, intrusion, time);
        if let Some(held) = &now.held {
            self.extremes.globe_on_bone.offer(self.eye.copies() * held.force, time);
        }
        for (i, dented) in self.dented.iter_mut().enumerate() {
            *dented = self.near_entry[i] && self.target.touched[i];
        }
        self.tissues.read(
            self.eye,
            &self.state.at,
            (&self.shell.along, &self.dented),
            (share, time),
            self.ending.reads_pulls(time),
            &mut self.account.extremes.tissue,
            &mut self.extremes,
        );
        if steps % SHAPE_EVERY == 0 {
            self.read_shape(time);
        }
        if steps % TURN_EVERY == 0 {
            self.read_turn(time);
        }
        let (eye, balance, state) = (self.eye, &self.balance, &self.state);
        self.account.fold.record(
            time,
            now.sums.least_corner,
            |cell| balance.least_corner(state, cell),
            |cell| {
                let cell = &eye.cells[cell];
                let sum: Vector3<f64> = cell.corners.iter().map(|n| eye.mesh.at[*n]).sum();
                let middle = sum / 8.0;
                let side = if middle.y < 0.0 { -1.0 } else { 1.0 };
                let across = side * libm::hypot(middle.y, middle.z);
                (Point2::new(middle.x, across), cell.part())
            },
        );
        let accelerations = self.accelerometers.read(&self.state.speed, time - 0.5 * step);
        self.account.read_nodes(accelerations, time)
    }

    fn read_last(&mut self, time: f64) {
        self.read_shape(time);
        self.read_turn(time);
    }

    fn balance(&mut self, now: &Instant, kick: f64) {
        let (state, copies, moving) = (&self.state, self.eye.copies(), &self.flying.moving);
        let stored = self.balance.energy(state) + now.shell;
        let energy = &mut self.account.energy;
        energy.elastic = copies * (stored + now.held.map_or(0.0, |held| held.energy));
        energy.contact = now.touch.energy + now.push.map_or(0.0, |p| p.energy);
        energy.lost = self.lost + 0.5 * kick * copies * now.sums.loss;
        energy.object = moving.energy(kick, now.touch.loss);
        let kinetic = |node: usize| -> f64 {
            let of = |k: usize| {
                let speed = state.speed[k][node];
                speed * (speed + kick * state.force[k][node] * state.free[k][node])
            };
            0.5 * self.eye.mass[node] * (of(0) + of(1) + of(2))
        };
        energy.kinetic = copies * (0..self.eye.mass.len()).map(kinetic).sum::<f64>();
        let flown = self.flown(kick);
        self.account.impart(self.account.given(), flown);
    }

    fn trace(&mut self, now: &Instant, time: f64, node_force: [f64; 4]) {
        let shape = self.shapes.read(&self.state.at);
        let moving = &self.flying.moving;
        let flight = Flight {
            intrusion: self.flying.intrusion(&self.way),
            middle: moving.middle().dot(&self.way),
            velocity: moving.velocity().dot(&self.way),
        };
        let (forces, tissue) = ((now.force, node_force), self.tissues.now);
        self.account.trace(time, forces, &shape, tissue, Some(flight));
    }

    fn frames(&mut self, time: f64, step: f64) -> Vec<Frame> {
        let Some((section, mut due)) = self.frames_due.take() else { return Vec::new() };
        let frame = |due, before: &[_]| self.frame(&section, due, time - due, before);
        let frames = due.take((time, step), || self.velocities(&section), frame);
        self.frames_due = Some((section, due));
        frames
    }
}

impl Motion<'_> {
    fn read_shape(&mut self, time: f64) {
        self.account.read_shape(&self.shapes.read(&self.state.at), time);
    }

    /// The energy of flight as a whole, J, of an eye that nothing holds; forces act for `kick` s.
    fn flown(&self, kick: f64) -> f64 {
        if self.eye.parameters.surround.is_some() {
            return 0.0;
        }
        let (state, mass, copies) = (&self.state, &self.eye.mass, self.eye.copies());
        let momentum = |k: usize| -> f64 {
            let speed =
                |i: usize| state.speed[k][i] + 0.5 * kick * state.force[k][i] * state.free[k][i];
            (0..mass.len()).map(|i| mass[i] * speed(i)).sum()
        };
        // Half of an eye and its image fly along their plane.
        let ways = if copies > 1.0 { 2 } else { 3 };
        let squares: f64 = (0..ways).map(|k| momentum(k) * momentum(k)).sum();
        0.5 * copies * squares / mass.iter().sum::<f64>()
    }

    /// How the globe has moved and turned.
    fn read_turn(&mut self, time: f64) {
        let (way, turn) = self.shapes.moved(&self.state.at);
        let e = &mut self.extremes;
        e.turn.offer(turn, time);
        if way.norm() > e.way.value {
            e.way.offer(way.norm(), time);
            e.way_then = turned(way, self.up);
        }
    }

    fn velocities(&self, section: &Section) -> Vec<Vector3<f64>> {
        let points = section.points.iter();
        points.map(|shown| shown.point.of(&self.state.speed)).collect()
    }

    /// The section at `due`, `back` s before now.
    fn frame(&self, section: &Section, due: f64, back: f64, before: &[Vector3<f64>]) -> Frame {
        let velocities = self.velocities(section);
        let points = section.points.iter().zip(&velocities);
        let places: Vec<Vector3<f64>> =
            points.map(|(shown, v)| shown.point.of(&self.state.at) - v * back).collect();
        let forces = velocities.iter().enumerate().map(|(i, speed)| {
            let earlier = before.get(i).copied().unwrap_or_default();
            NODE_MASS * (speed - earlier).norm() / SMOOTHING_S
        });
        let pressures = self.cells.pressures();
        let moving = &self.flying.moving;
        Frame {
            time: due,
            positions: places.iter().map(|place| section.shown(*place)).collect(),
            aside: places.iter().map(|place| section.aside(*place)).collect(),
            forces: forces.collect(),
            cells: section.cells.iter().map(|(_, cell)| pressures[*cell]).collect(),
            projectile: Some(section.shown(moving.middle() - moving.velocity() * back)),
            squeezed: moving.squeezed(),
            pressure: Some(self.account.pressure()),
            front: Some(self.front(section, back)),
        }
    }

    /// The eye from the front, `back` s before now.
    fn front(&self, section: &Section, back: f64) -> FrontFrame {
        let seen = |at: Vector3<f64>, speed: Vector3<f64>| section.facing(at - speed * back);
        let (at, speed) = (&self.state.at, &self.state.speed);
        let [limbus, equator] = section
            .rings
            .each_ref()
            .map(|ring| ring.iter().map(|point| seen(point.of(at), point.of(speed))).collect());
        let moving = &self.flying.moving;
        FrontFrame { limbus, equator, object: seen(moving.middle(), moving.velocity()) }
    }
}

/// A vector of the mesh in the eye's own axes.
fn turned(of: Vector3<f64>, up: f64) -> Vector3<f64> {
    let (sin, cos) = (libm::sin(up), libm::cos(up));
    Vector3::new(of.x, cos * of.y - sin * of.z, sin * of.y + cos * of.z)
}
