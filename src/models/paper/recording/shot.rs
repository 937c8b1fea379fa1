//! What a projectile leaves behind.
//!
//! The force of contact is told as its mean over [`MEAN_S`]: the difference of the impulse over that
//! time. The nodes of a mesh are lumps, and a lump that is met at full speed answers with a spike
//! that depends on the penalty of the contact and on the lump's mass but not on the eye; its
//! impulse is right, its height is not. Experiments filter their forces over such times too.

use crate::models::paper::forces::contact::Contact;
use crate::models::paper::forces::coupled::Readings;
use crate::models::paper::forces::state::State;
use crate::models::paper::forces::system::System;
use crate::run::kept::Peak;
use nalgebra::{Point2, Vector2};
use std::collections::VecDeque;

/// Time over which the force of contact is averaged, in s.
pub const MEAN_S: f64 = 100e-6;

/// What a projectile did.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ShotExtremes {
    /// Diameter, in m.
    pub diameter: f64,
    /// Force of the shell on it, mean over the 100 us before, in N.
    pub force: Peak,
    /// First and last instant in touch with the shell, in s.
    pub contact: Option<(f64, f64)>,
    /// Velocity at the end of the window, in m/s.
    pub velocity: Vector2<f64>,
    /// Speed back along the way it came, at the end of the window, in m/s; negative if it still goes
    /// on.
    pub rebound_speed: f64,
    /// Kinetic energy that it has given up by then, in J.
    pub energy: f64,
    /// Kinetic energy at the start, in J.
    pub energy_before: f64,
    /// Largest penetration of shell or rim, in m.
    pub penetration: f64,
    /// The same as a share of the diameter.
    pub penetration_share: f64,
    /// Largest compression of a soft object, as a share of the diameter.
    pub squeezed_share: f64,
    /// How far it went along its way, in m, and when.
    pub travel: Peak,
    /// When it first met the rim, in s.
    pub rim_at: Option<f64>,
    /// When it first passed the wall of the orbit, which stops it at the rim only, in s.
    pub through_bone_at: Option<f64>,
    /// Whether it is lighter than a node of the shell.
    pub light: bool,
    /// Whether it touched the shell at the end of the window.
    pub touching: bool,
    /// Whether it was free of the shell but still going on at the end of the window.
    pub going_on: bool,
}

/// Follows it over the steps of one march.
#[derive(Debug)]
pub(crate) struct ShotWatch(Option<Shot>);

#[derive(Debug)]
struct Shot {
    contact: Contact,
    results: ShotExtremes,
    /// Times and impulses over the last [`MEAN_S`], the first at or before its start.
    history: VecDeque<(f64, Vector2<f64>)>,
    mean: f64,
}

impl ShotWatch {
    pub fn new(system: &System) -> Self {
        Self(system.coupled().map(|c| c.contact).map(|contact| Shot {
            contact,
            results: ShotExtremes {
                diameter: 2.0 * contact.radius,
                force: Peak::floor(0.0),
                contact: None,
                velocity: contact.direction * contact.speed,
                rebound_speed: -contact.speed,
                energy: 0.0,
                energy_before: contact.energy(),
                penetration: 0.0,
                penetration_share: 0.0,
                squeezed_share: 0.0,
                travel: Peak::floor(0.0),
                rim_at: None,
                through_bone_at: None,
                light: contact.mass < contact.node_mass,
                touching: false,
                going_on: true,
            },
            history: VecDeque::from([(0.0, Vector2::zeros())]),
            mean: 0.0,
        }))
    }

    /// Takes in the end of a step.
    pub fn look(&mut self, state: &State) {
        if let Some(shot) = &mut self.0 {
            shot.look(state.time, &state.readings);
        }
    }

    /// Force of contact at the last step end, mean over the time before, in N.
    pub fn contact_force(&self) -> Option<f64> {
        self.0.as_ref().map(|s| s.mean)
    }

    pub fn finish(self) -> Option<ShotExtremes> {
        self.0.map(|s| s.results)
    }
}

impl Shot {
    fn look(&mut self, time: f64, readings: &Readings) {
        let r = &mut self.results;
        let body = &readings.body;
        r.touching = readings.contact_force != Vector2::zeros();
        if r.touching {
            let first = r.contact.map_or(time, |(first, _)| first);
            r.contact = Some((first, time));
        }
        if readings.rim_force != Vector2::zeros() && r.rim_at.is_none() {
            r.rim_at = Some(time);
        }
        if r.through_bone_at.is_none() && self.contact.through_bone(body) {
            r.through_bone_at = Some(time);
        }
        r.penetration = r.penetration.max(readings.penetration);
        r.penetration_share = r.penetration / (2.0 * self.contact.radius);
        let squeezed = body.shift.norm() / (2.0 * self.contact.radius);
        r.squeezed_share = r.squeezed_share.max(squeezed);
        r.velocity = body.velocity;
        r.rebound_speed = -body.velocity.dot(&self.contact.direction);
        r.energy = r.energy_before - 0.5 * self.contact.mass * body.velocity.norm_squared();
        r.going_on = !r.touching && r.rebound_speed < 0.0;
        let way = (body.position - self.contact.start).dot(&self.contact.direction);
        r.travel.offer(way, time);

        self.history.push_back((time, readings.impulse));
        let start = time - MEAN_S;
        while self.history.len() > 2 && self.history[1].0 <= start {
            self.history.pop_front();
        }
        let [(t0, j0), (t1, j1)] = [self.history[0], self.history[1]];
        let share = if t1 > t0 {
            ((start - t0) / (t1 - t0)).clamp(0.0, 1.0)
        } else {
            0.0
        };
        let earlier = j0 + (j1 - j0) * share;
        self.mean = (readings.impulse - earlier).norm() / MEAN_S;
        r.force.offer(self.mean, time);
    }
}

/// Centre of the projectile at share `s` of a step, by the cubic through positions and velocities.
pub(crate) fn centre(before: &State, after: &State, s: f64) -> Point2<f64> {
    let h = after.time - before.time;
    let (a, b) = (&before.readings.body, &after.readings.body);
    let (v0, v1) = (a.velocity * h, b.velocity * h);
    let d = b.position - a.position;
    let (c2, c3) = (d * 3.0 - v0 * 2.0 - v1, v0 + v1 - d * 2.0);
    a.position + (v0 + (c2 + c3 * s) * s) * s
}
