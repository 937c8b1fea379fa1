//! Positions, velocities and accelerations in the kernel's rows, and its working space.

use crate::models::paper::forces::layout::{LANES, RowPlace};
use crate::models::paper::forces::{aligned::Pairs, system::System};
use nalgebra::{Point2, Vector2};

/// The eye at one instant.
#[derive(Debug, Clone, Default)]
pub struct State {
    /// Time, in s.
    pub time: f64,
    pub(crate) position: Pairs,
    pub(crate) velocity: Pairs,
    /// Acceleration by springs and load, drag left out.
    pub(crate) acceleration: Pairs,
    /// Work done by the load so far, in J.
    pub work: f64,
    /// Energy lost to drag so far, in J.
    pub dissipated: f64,
    pub(crate) scratch: Scratch,
}

/// Space that the kernel writes before it reads.
#[derive(Debug, Clone, Default)]
pub(crate) struct Scratch {
    /// Forces from the row below.
    pub up: Pairs,
    /// Forces from filaments and load; zero but on the shell.
    pub extra: Pairs,
    /// The gathered ring.
    pub ring: Pairs,
    /// Forces of the filaments on their first ends, a run for each hop count.
    pub hops: Pairs,
}

impl State {
    /// `system` at rest, at time 0.
    pub fn at_rest(system: &System) -> Self {
        let zeros = || Pairs::zeros(system.rest.x.len());
        Self {
            position: system.rest.clone(),
            velocity: zeros(),
            acceleration: zeros(),
            scratch: Scratch {
                up: zeros(),
                extra: zeros(),
                ring: Pairs::zeros(system.ring.padded_len()),
                hops: Pairs::zeros(system.ring.padded_len() * system.ring.hops.len()),
            },
            ..Self::default()
        }
    }

    /// Takes over all but the working space of `other`, a state of the same `system`.
    pub fn copy_motion(&mut self, system: &System, other: &Self) {
        (self.time, self.work, self.dissipated) = (other.time, other.work, other.dissipated);
        let moved = system.rows.first * system.rows.stride..;
        for (to, from) in [
            (&mut self.position, &other.position),
            (&mut self.velocity, &other.velocity),
            (&mut self.acceleration, &other.acceleration),
        ] {
            to.x[moved.clone()].copy_from_slice(&from.x[moved.clone()]);
            to.y[moved.clone()].copy_from_slice(&from.y[moved.clone()]);
        }
    }

    /// Position of the node at `place`, in m.
    #[inline]
    pub fn position(&self, place: RowPlace) -> Point2<f64> {
        self.position.at(place).into()
    }

    /// Velocity of the node at `place`, in m/s.
    #[inline]
    pub fn velocity(&self, place: RowPlace) -> Vector2<f64> {
        self.velocity.at(place)
    }

    /// Acceleration of the node at `place`, drag included, in m/s^2.
    #[inline]
    pub fn acceleration(&self, system: &System, place: RowPlace) -> Vector2<f64> {
        let fat = system.groups[place.slot / LANES].fat[place.slot % LANES];
        let decay = system.decay[usize::from(fat > 0.0)];
        self.acceleration.at(place) - self.velocity.at(place) * decay
    }

    /// Moves the node at `place` and sets its velocity: for tests and for starting off rest.
    pub fn set(&mut self, place: RowPlace, position: Point2<f64>, velocity: Vector2<f64>) {
        self.position.put(place, position.coords);
        self.velocity.put(place, velocity);
    }

    /// Speed that the load works on: the sum of share times velocity along the force, in m/s.
    pub(crate) fn load_speed(&self, system: &System) -> f64 {
        let (vx, vy) = self.velocity.slices();
        let along = |&(slot, weight, force): &(usize, f64, Vector2<f64>)| {
            weight * (force.x * vx[slot] + force.y * vy[slot])
        };
        system.loaded.iter().map(along).sum()
    }
}
