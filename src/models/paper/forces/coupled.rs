//! What acts beside springs, drag and pulse: a projectile.
//!
//! A scene without one compiles none of it, and takes the paths of [`crate::models::paper::time::composition`] untouched. A
//! scene with one moves the whole eye: the row kernel computes the springs, the contact adds its
//! accelerations, and [`crate::models::paper::time::verlet`] makes the steps.
//!
//! Its work is counted, see [`crate::run::plan::Cost`].

use crate::models::paper::eye::Eye;
use crate::run::places::GLOBE_RADIUS_M;
use crate::models::paper::forces::contact::{Body, Contact, Touch};
use crate::models::paper::forces::state::State;
use crate::models::paper::forces::system::{LANES, System};
use crate::run::plan::Cost;
use crate::scenario::{Impact, Scenario};
use nalgebra::{Point2, Vector2};

/// A projectile and the shell that it meets.
#[derive(Debug, Clone)]
pub struct Coupled {
    /// The projectile.
    pub contact: Contact,
    /// Slots of the shell, anticlockwise.
    shell: Vec<u32>,
    /// Mass of a node of the shell, in kg.
    node_mass: f64,
    /// Length of a segment of the shell at rest, in m.
    spacing: f64,
    /// Bound of the squared angular frequency without contact, in 1/s^2.
    free_omega_squared: f64,
    pub(crate) inverse_mass: Vec<f64>,
    pub(crate) half_mass: Vec<f64>,
}

/// What the parts read at one instant.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Readings {
    /// The projectile.
    pub body: Body,
    /// Force of the shell on the projectile, in N.
    pub contact_force: Vector2<f64>,
    /// Its integral over time, in N s.
    pub impulse: Vector2<f64>,
    /// Force of the rim on the projectile, in N.
    pub rim_force: Vector2<f64>,
    /// Penetration of the projectile, in m.
    pub penetration: f64,
    /// Distance between projectile and shell or rim, whichever is closer, in m.
    pub gap: f64,
    /// Energy in the contact, in J.
    pub(crate) stored: f64,
}

/// Space that an evaluation writes before it reads.
#[derive(Debug, Clone)]
pub(crate) struct Workspace {
    ring: Vec<Point2<f64>>,
    ring_forces: Vec<Vector2<f64>>,
}

impl Coupled {
    /// The projectile of `scenario`, if it has one, for `eye` compiled whole as `system`.
    pub fn new(scenario: &Scenario, eye: &Eye, system: &System) -> Option<Self> {
        let Impact::Projectile(shot) = &scenario.impact else {
            return None;
        };
        let ring: Vec<Point2<f64>> = eye
            .landmarks
            .shell
            .iter()
            .map(|&node| eye.nodes[node].position)
            .collect();
        let node_mass = eye.nodes[eye.landmarks.shell[0]].mass;
        let contact = Contact::new(shot, &ring, node_mass, eye.opening_rad);
        let lanes = || {
            system
                .groups
                .iter()
                .flat_map(|g| (0..LANES).map(move |l| (g, l)))
        };
        Some(Self {
            contact,
            shell: eye
                .landmarks
                .shell
                .iter()
                .map(|&node| system.place(node).slot as u32)
                .collect(),
            node_mass,
            spacing: std::f64::consts::TAU * GLOBE_RADIUS_M / ring.len() as f64,
            free_omega_squared: system.omega_by_nodes().powi(2),
            inverse_mass: lanes().map(|(g, l)| g.inverse_mass[l]).collect(),
            half_mass: lanes().map(|(g, l)| g.half_mass[l]).collect(),
        })
    }

    /// Bound of the angular frequency, in 1/s: in contact, or out of it.
    pub fn omega(&self, in_contact: bool) -> f64 {
        let by_contact = if in_contact {
            self.contact
                .omega_squared(self.node_mass, self.spacing, self.shell.len())
        } else {
            0.0
        };
        (self.free_omega_squared + by_contact).sqrt()
    }

    /// The readings of an eye at rest.
    pub(crate) fn at_rest(&self) -> Readings {
        Readings {
            body: self.contact.body(),
            ..Readings::default()
        }
    }

    pub(crate) fn workspace(&self) -> Workspace {
        Workspace {
            ring: vec![Point2::origin(); self.shell.len()],
            ring_forces: vec![Vector2::zeros(); self.shell.len()],
        }
    }

    /// Adds the accelerations by the contact to those of `state`, and brings its readings up to date.
    pub(crate) fn accelerate(&self, state: &mut State, work: &mut Workspace, cost: &mut Cost) {
        let readings = &mut state.readings;
        readings.stored = 0.0;
        for (to, &slot) in work.ring.iter_mut().zip(&self.shell) {
            *to = Point2::new(state.x[slot as usize], state.y[slot as usize]);
        }
        work.ring_forces.fill(Vector2::zeros());
        let touch = self
            .contact
            .apply(&mut readings.body, &work.ring, &mut work.ring_forces);
        read(readings, &touch);
        cost.contact_tests += touch.tests;
        for (force, &slot) in work.ring_forces.iter().zip(&self.shell) {
            let slot = slot as usize;
            state.ax[slot] += force.x * self.inverse_mass[slot];
            state.ay[slot] += force.y * self.inverse_mass[slot];
        }
    }

    /// Kinetic energy of the eye, in J.
    pub(crate) fn kinetic(&self, state: &State) -> f64 {
        let speeds = state.vx.iter().zip(&state.vy[..]);
        self.half_mass
            .iter()
            .zip(speeds)
            .map(|(m, (vx, vy))| m * (vx * vx + vy * vy))
            .sum()
    }

    /// Largest speed of a node of the shell, in m/s.
    pub(crate) fn fastest_shell(&self, state: &State) -> f64 {
        let squares = self.shell.iter().map(|&slot| {
            let (vx, vy) = (state.vx[slot as usize], state.vy[slot as usize]);
            vx * vx + vy * vy
        });
        squares.fold(0.0, f64::max).sqrt()
    }
}

fn read(readings: &mut Readings, touch: &Touch) {
    readings.contact_force = touch.shell;
    readings.rim_force = touch.rim;
    readings.penetration = touch.penetration;
    readings.gap = touch.gap.min(touch.rim_gap);
    readings.stored += touch.potential;
}
