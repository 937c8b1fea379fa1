//! What acts beside springs, drag and pulse: a projectile, the fluid, dashpots.
//!
//! A scene that has none of them compiles none, and takes the paths of [`super::composition`]
//! untouched. A scene that has some moves the whole eye: the row kernel computes the springs, the
//! parts here add their accelerations, and [`super::verlet`] makes the steps.
//!
//! Each part counts its work, see [`super::Cost`].

use super::contact::{Body, Contact, Touch};
use super::dashpots::Dashpots;
use super::fluid::{Fluid, PA_PER_MMHG};
use super::march::Cost;
use super::scene::SceneKind;
use super::state::State;
use super::system::{LANES, System};
use crate::eye::{Eye, GLOBE_RADIUS_M, depth_m};
use crate::scenario::{Impact, Model, Scenario};
use nalgebra::{Point2, Vector2};

/// The parts of one scene.
#[derive(Debug, Clone)]
pub struct Coupled {
    pub(super) kind: SceneKind,
    /// A projectile.
    pub contact: Option<Contact>,
    /// The fluid in the globe.
    pub fluid: Option<Fluid>,
    /// Dashpots along the springs.
    pub dashpots: Option<Dashpots>,
    /// Slots of the shell, anticlockwise.
    shell: Vec<u32>,
    /// Mass of a node of the shell, in kg.
    node_mass: f64,
    /// Length of a segment of the shell at rest, in m.
    spacing: f64,
    /// Bound of the squared angular frequency without contact, in 1/s^2.
    free_omega_squared: f64,
    pub(super) inverse_mass: Vec<f64>,
    pub(super) half_mass: Vec<f64>,
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
    /// Intraocular pressure, in Pa.
    pub pressure: f64,
    /// Area of the globe over its area at rest.
    pub area_ratio: f64,
    /// Energy in fluid and contact, in J.
    pub(super) stored: f64,
    /// Power that the dashpots take, in W.
    pub(super) power: f64,
}

/// Space that an evaluation writes before it reads.
#[derive(Debug, Clone)]
pub(super) struct Workspace {
    ring: Vec<Point2<f64>>,
    ring_forces: Vec<Vector2<f64>>,
    fx: Vec<f64>,
    fy: Vec<f64>,
    /// Velocities that the dashpots see.
    pub vx: Vec<f64>,
    pub vy: Vec<f64>,
}

impl Coupled {
    /// The parts that `scenario` asks for, if any, for `eye` compiled whole as `system`.
    pub fn new(scenario: &Scenario, eye: &Eye, system: &System) -> Option<Self> {
        let kind = SceneKind::of(scenario);
        if kind == SceneKind::Springs {
            return None;
        }
        let ring: Vec<Point2<f64>> = eye
            .landmarks
            .shell
            .iter()
            .map(|&node| eye.nodes[node].position)
            .collect();
        let node_mass = eye.nodes[eye.landmarks.shell[0]].mass;
        let contact = match &scenario.impact {
            Impact::Projectile(shot) => Some(Contact::new(shot, &ring, node_mass, eye.opening_rad)),
            Impact::ForcePulse(_) => None,
        };
        let (fluid, dashpots) = match &scenario.model {
            Model::Paper | Model::Axisymmetric(_) => (None, None),
            Model::Physiological(parts) => (
                parts.pressure.then(|| {
                    Fluid::new(
                        parts.initial_pressure_mmhg * PA_PER_MMHG,
                        parts.bulk_modulus_mpa * 1e6,
                        depth_m(&scenario.model),
                        &ring,
                    )
                }),
                parts.dashpots.then(|| {
                    let (globe, fat) = (parts.globe_damping_ratio, parts.fat_damping_ratio);
                    Dashpots::new(eye, system, globe, fat)
                }),
            ),
        };
        let by_fluid = fluid.map_or(0.0, |f| f.omega_squared(&ring, node_mass));
        let lanes = || {
            system
                .groups
                .iter()
                .flat_map(|g| (0..LANES).map(move |l| (g, l)))
        };
        Some(Self {
            kind,
            contact,
            fluid,
            dashpots,
            shell: eye
                .landmarks
                .shell
                .iter()
                .map(|&node| system.place(node).slot as u32)
                .collect(),
            node_mass,
            spacing: std::f64::consts::TAU * GLOBE_RADIUS_M / ring.len() as f64,
            free_omega_squared: system.omega_by_nodes().powi(2) + by_fluid,
            inverse_mass: lanes().map(|(g, l)| g.inverse_mass[l]).collect(),
            half_mass: lanes().map(|(g, l)| g.half_mass[l]).collect(),
        })
    }

    /// Bounds of the angular frequency and of the decay rate, in 1/s: in contact, or out of it.
    pub fn rates(&self, in_contact: bool) -> (f64, f64) {
        let by_contact = self.contact.filter(|_| in_contact).map_or(0.0, |c| {
            c.omega_squared(self.node_mass, self.spacing, self.shell.len())
        });
        let omega = (self.free_omega_squared + by_contact).sqrt();
        (omega, self.dashpots.as_ref().map_or(0.0, |d| d.rate))
    }

    /// The readings of an eye at rest.
    pub(super) fn at_rest(&self) -> Readings {
        Readings {
            body: self.contact.map_or_else(Body::default, |c| c.body()),
            pressure: self.fluid.map_or(0.0, |f| f.rest_pressure),
            area_ratio: 1.0,
            ..Readings::default()
        }
    }

    pub(super) fn workspace(&self, len: usize) -> Workspace {
        let zeros = || vec![0.0; len];
        Workspace {
            ring: vec![Point2::origin(); self.shell.len()],
            ring_forces: vec![Vector2::zeros(); self.shell.len()],
            fx: zeros(),
            fy: zeros(),
            vx: zeros(),
            vy: zeros(),
        }
    }

    /// Adds the accelerations by all parts to those of `state`, whose dashpots see the velocities in
    /// `work`, and brings its readings up to date.
    pub(super) fn accelerate(&self, state: &mut State, work: &mut Workspace, cost: &mut Cost) {
        let readings = &mut state.readings;
        readings.stored = 0.0;
        if self.contact.is_some() || self.fluid.is_some() {
            for (to, &slot) in work.ring.iter_mut().zip(&self.shell) {
                *to = Point2::new(state.x[slot as usize], state.y[slot as usize]);
            }
            work.ring_forces.fill(Vector2::zeros());
            if let Some(fluid) = &self.fluid {
                let ratio = fluid.apply(&work.ring, &mut work.ring_forces);
                readings.area_ratio = ratio;
                readings.pressure = fluid.pressure(ratio);
                readings.stored += fluid.energy(ratio);
                cost.pressure_evaluations += 1;
            }
            if let Some(contact) = &self.contact {
                let touch = contact.apply(&mut readings.body, &work.ring, &mut work.ring_forces);
                read(readings, &touch);
                cost.contact_tests += touch.tests;
            }
            for (force, &slot) in work.ring_forces.iter().zip(&self.shell) {
                let slot = slot as usize;
                state.ax[slot] += force.x * self.inverse_mass[slot];
                state.ay[slot] += force.y * self.inverse_mass[slot];
            }
        }
        if let Some(dashpots) = &self.dashpots {
            work.fx.fill(0.0);
            work.fy.fill(0.0);
            state.readings.power = dashpots.apply(
                (&state.x, &state.y),
                (&work.vx, &work.vy),
                (&mut work.fx, &mut work.fy),
            );
            cost.dashpot_evaluations += dashpots.len();
            for (slot, inverse) in self.inverse_mass.iter().enumerate() {
                state.ax[slot] += work.fx[slot] * inverse;
                state.ay[slot] += work.fy[slot] * inverse;
            }
        }
    }

    /// Kinetic energy of the eye, in J.
    pub(super) fn kinetic(&self, state: &State) -> f64 {
        let speeds = state.vx.iter().zip(&state.vy[..]);
        self.half_mass
            .iter()
            .zip(speeds)
            .map(|(m, (vx, vy))| m * (vx * vx + vy * vy))
            .sum()
    }

    /// Largest speed of a node of the shell, in m/s.
    pub(super) fn fastest_shell(&self, state: &State) -> f64 {
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
