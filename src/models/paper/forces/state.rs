//! Positions, velocities and accelerations in the kernel's rows, and its working space.

use crate::models::paper::forces::layout::{LANES, RowPlace};
use crate::models::paper::forces::{aligned::Aligned, system::System};
use nalgebra::{Point2, Vector2};

/// The eye at one instant.
#[derive(Debug, Clone, Default)]
pub struct State {
    /// Time, in s.
    pub time: f64,
    pub(crate) x: Aligned,
    pub(crate) y: Aligned,
    pub(crate) vx: Aligned,
    pub(crate) vy: Aligned,
    /// Acceleration by springs and load, drag left out.
    pub(crate) ax: Aligned,
    pub(crate) ay: Aligned,
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
    pub up_x: Aligned,
    pub up_y: Aligned,
    /// Forces from filaments and load; zero but on the shell.
    pub extra_x: Aligned,
    pub extra_y: Aligned,
    /// The gathered ring.
    pub ring_x: Aligned,
    pub ring_y: Aligned,
    /// Forces of the filaments on their first ends, a run for each hop count.
    pub hop_fx: Aligned,
    pub hop_fy: Aligned,
}

impl State {
    /// `system` at rest, at time 0.
    pub fn at_rest(system: &System) -> Self {
        let len = system.rest_x.len();
        let zeros = || Aligned::zeros(len);
        let ring = || Aligned::zeros(system.ring.padded_len());
        let hops = || Aligned::zeros(system.ring.hops_len());
        Self {
            x: system.rest_x.clone(),
            y: system.rest_y.clone(),
            vx: zeros(),
            vy: zeros(),
            ax: zeros(),
            ay: zeros(),
            scratch: Scratch {
                up_x: zeros(),
                up_y: zeros(),
                extra_x: zeros(),
                extra_y: zeros(),
                ring_x: ring(),
                ring_y: ring(),
                hop_fx: hops(),
                hop_fy: hops(),
            },
            ..Self::default()
        }
    }

    /// Takes over the time, positions, velocities and accelerations of `other`, a state of the same
    /// `system`.
    pub fn copy_motion(&mut self, system: &System, other: &Self) {
        self.time = other.time;
        let moved = system.first_row * system.stride..;
        for (to, from) in [
            (&mut self.x, &other.x),
            (&mut self.y, &other.y),
            (&mut self.vx, &other.vx),
            (&mut self.vy, &other.vy),
            (&mut self.ax, &other.ax),
            (&mut self.ay, &other.ay),
        ] {
            to[moved.clone()].copy_from_slice(&from[moved.clone()]);
        }
    }

    /// Position of the node at `place`, in m.
    pub fn position(&self, place: RowPlace) -> Point2<f64> {
        Point2::new(self.x[place.slot], place.sign() * self.y[place.slot])
    }

    /// Velocity of the node at `place`, in m/s.
    pub fn velocity(&self, place: RowPlace) -> Vector2<f64> {
        Vector2::new(self.vx[place.slot], place.sign() * self.vy[place.slot])
    }

    /// Acceleration of the node at `place`, drag included, in m/s^2.
    pub fn acceleration(&self, system: &System, place: RowPlace) -> Vector2<f64> {
        let drag = system.decay_at(place.slot);
        Vector2::new(
            self.ax[place.slot] - drag * self.vx[place.slot],
            place.sign() * (self.ay[place.slot] - drag * self.vy[place.slot]),
        )
    }

    /// Moves the node at `place` and sets its velocity: for tests and for starting off rest.
    pub fn set(&mut self, place: RowPlace, position: Point2<f64>, velocity: Vector2<f64>) {
        self.x[place.slot] = position.x;
        self.y[place.slot] = place.sign() * position.y;
        self.vx[place.slot] = velocity.x;
        self.vy[place.slot] = place.sign() * velocity.y;
    }

    /// Speed that the load works on: the sum of share times velocity along the force, in m/s.
    pub(crate) fn load_speed(&self, system: &System) -> f64 {
        system
            .load()
            .work
            .iter()
            .map(|&(slot, wx, wy)| wx * self.vx[slot] + wy * self.vy[slot])
            .sum()
    }
}

impl System {
    /// Decay rate c/m at a slot, in 1/s.
    pub(crate) fn decay_at(&self, slot: usize) -> f64 {
        let fat = self.groups[slot / LANES].fat[slot % LANES];
        if fat > 0.0 { self.decay[1] } else { self.decay[0] }
    }
}
