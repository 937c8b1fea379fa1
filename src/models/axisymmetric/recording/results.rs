//! What a run leaves: extremes over every step, and its balance of energy.

use crate::run::fold::Fold;
use crate::run::kept::{Frame, Peak, Traces};
use std::f64::consts::PI;

/// Largest values over every step.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Extremes {
    /// Force of contact or of the pulse on the eye, along the blow, N.
    pub force: Peak,
    /// Mean of that force over the 100 us before, N.
    pub mean_force: Peak,
    /// Force of the orbit's front edge on the object, N.
    pub rim_force: Peak,
    /// Mean pressure of the globe through a low pass of 20 us, Pa.
    pub pressure: Peak,
    /// Pressure at the back, through the same, Pa, as a sensor may show it.
    pub back_pressure: Peak,
    /// Pressure at the back as a mean over the 150 us before, Pa.
    pub mean_back_pressure: Peak,
    /// The larger tension of the sclera, along or around, through a low pass of 20 us, Pa.
    pub scleral_stress: Peak,
    /// Front angle of the place of that stress, rad.
    pub stress_angle: f64,
    /// Loss of the distance between the poles over the diameter at rest.
    pub shortening: Peak,
    /// Growth of the largest radius over that at rest.
    pub equator_growth: Peak,
    /// Growth of the length of the shell's meridian over that at rest.
    pub shell_growth: Peak,
    /// Way of the object's surface from the first touch, m.
    pub intrusion: Peak,
    /// Way of the front pole, m.
    pub apex: Peak,
    /// Way of the lens's centre of mass along the axis, m.
    pub lens: Peak,
    /// Stretch of the wall at the equator and at the back, growth of the radius at the retina's
    /// front edge, and how much the lens and the root of the iris are drawn apart, in m; see
    /// [`super::tissue`].
    pub tissue: [Peak; 5],
    /// Most energy that the eye held of what hit it, J.
    pub energy_given: Peak,
    /// Radius of the largest contact, m.
    pub contact_radius: f64,
    /// How much of what that contact takes counts at the cornea, 0 to 1.
    pub on_cornea: f64,
    /// Mean acceleration over 20 us times 75 mg at centre, front, right and top, N.
    pub node_force: [Peak; 4],
    /// Least volume of the globe over that at rest.
    pub least_volume: f64,
    /// Largest volume of the globe over that at rest.
    pub most_volume: f64,
    /// Smallest corner triangle over its volume at rest: below 0 the mesh has folded.
    pub least_triangle: f64,
    /// How the mesh folded: cells with such a triangle.
    pub fold: Option<Fold>,
    /// Energy that the eye was given, but for that of its flight as a whole, J.
    pub energy_imparted: f64,
    /// When the object's surface was first crushed through to its hard core, s.
    pub crushed_at: Option<f64>,
    /// When the eye was pressed flat, s: the run ends there.
    pub flat_at: Option<f64>,
    /// Whether the object touched the eye at the end.
    pub touching: bool,
    /// Speed at which the object ends, away from the eye, m/s.
    pub rebound: Option<f64>,
    /// Largest error of the balance of energy over the energy that came in.
    pub energy_residual: f64,
}

impl Extremes {
    /// The extremes of an eye that nothing has happened to.
    pub fn at_rest() -> Self {
        Self {
            on_cornea: 1.0,
            least_volume: 1.0,
            most_volume: 1.0,
            least_triangle: 1.0,
            ..Self::default()
        }
    }

    /// Most energy that the eye was given over the area of the largest contact, if any, as far as
    /// it counts at the cornea, J/m2.
    pub fn energy_over_contact(&self) -> f64 {
        let area = PI * self.contact_radius * self.contact_radius;
        if area > 0.0 { self.on_cornea * self.energy_given.value / area } else { 0.0 }
    }

    /// Whether an object never touched the eye, as one that bone caught.
    pub fn missed(&self) -> bool {
        self.rebound.is_some() && self.force.value == 0.0
    }
}

/// Where the energy is at some instant, in J.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Energy {
    /// Kinetic energy of the nodes.
    pub kinetic: f64,
    /// Elastic energy of cells and shell.
    pub elastic: f64,
    /// Energy stored in the contact.
    pub contact: f64,
    /// Energy of the object: kinetic and in its spring.
    pub object: f64,
    /// Energy lost to all viscosities of the eye so far.
    pub lost: f64,
    /// Energy lost within the object so far.
    pub lost_in_object: f64,
    /// Work of a pulse so far.
    pub work: f64,
}

impl Energy {
    /// Sum of all energies less the work of a pulse, J: constant but for rounding and steps.
    pub fn total(&self) -> f64 {
        self.kinetic + self.elastic + self.contact + self.object + self.lost + self.lost_in_object
            - self.work
    }
}

/// What the engine gives of one run, with extremes `E` and momentum `M`.
#[derive(Debug, Clone, PartialEq)]
pub struct EngineRun<E = Extremes, M = f64> {
    /// Largest values over every step.
    pub extremes: E,
    /// Traces, if they were asked for.
    pub traces: Option<Traces>,
    /// Frames, if they were asked for.
    pub frames: Vec<Frame>,
    /// Energies at the end.
    pub energy: Energy,
    /// Momentum of eye and object at the end, kg m/s; of the axisymmetric eye along the blow.
    pub momentum: M,
    /// Steps taken.
    pub steps: usize,
    /// Simulated time, s.
    pub simulated: f64,
    /// Whether it ended before its window as nothing had grown for long: a rule, not a proof.
    pub settled: bool,
}
