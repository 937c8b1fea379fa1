//! A scenario with the Physiological model, compiled: the eye in SI units and what hits it.

use crate::answer::believed::Scene;
use crate::models::axisymmetric as engine;
use crate::models::axisymmetric::eye::RevolutionEye;
use crate::models::axisymmetric::eye::parameters::{
    Material, Parameters, ShellParameters, Surround,
};
use crate::models::axisymmetric::forces::object::{BallSpring, Object};
use crate::models::compiled::Ran;
use crate::models::left::Left;
use crate::models::paper::case::{Moved, Refusal, Watch};
use crate::models::paper::forces::load::Pulse;
use crate::models::paper::time::march::{Cost, Plan};
use crate::run::kept::{Frame, Keep, Spacing};
use crate::run::rules::{REVOLUTION, Rules};
use crate::scenario::Integrator;
use crate::scenario::problem::{Problem, plain};
use crate::scenario::{
    CheckedScenario, Impact, Model, Outline, Physiological, Projectile, ProjectileStiffness,
    Species, Support, Surface,
};
use std::f64::consts::PI;
use std::ops::ControlFlow;

/// A cell with its share of shell and nodes takes some 40 ns, a spring a little more than one.
const SPRINGS_A_CELL: f64 = 30.0;

/// An eye of revolution ready to be hit.
#[derive(Debug, Clone)]
pub struct RevolutionCase {
    /// The eye.
    pub eye: RevolutionEye,
    /// What hits it.
    pub load: engine::Blow,
    /// What risks rest on beside what a run leaves.
    pub scene: Scene,
    /// Simulated time, in s.
    pub window: f64,
    /// Front angle of the blow, in degrees.
    pub angle_deg: f64,
    /// What catches an object that is too wide.
    pub rim: &'static str,
    /// Longest stable step at rest, in s.
    limit: f64,
}

impl Moved for RevolutionCase {
    fn rules(&self) -> &'static Rules {
        &REVOLUTION
    }

    fn step_limit(&self, _: Integrator) -> f64 {
        self.limit
    }

    fn elements_per_evaluation(&self) -> usize {
        self.eye.cells.len()
    }

    fn springs_an_element(&self) -> f64 {
        SPRINGS_A_CELL
    }

    fn window(&self) -> f64 {
        self.window
    }
}

impl RevolutionCase {
    /// Compiles a scenario; none if its model is another.
    pub fn new(scenario: &CheckedScenario) -> Option<Self> {
        let Model::Physiological(model) = &scenario.model else {
            return None;
        };
        let (angle_deg, load) = match &scenario.impact {
            Impact::ForcePulse(pulse) => {
                let half_width = pulse.half_width_deg.to_radians();
                (
                    pulse.angle_deg,
                    engine::Blow::Pulse(Pulse::new(pulse), half_width),
                )
            }
            Impact::Projectile(shot) => (shot.angle_deg, engine::Blow::Object(object(shot))),
        };
        let eye = RevolutionEye::new(&parameters(model, angle_deg), scenario.eye.level);
        Some(Self {
            limit: engine::step_limit(&eye, &load),
            eye,
            load,
            scene: Scene::of(scenario),
            window: scenario.window_ms * 1e-3,
            angle_deg,
            rim: match model.support {
                Support::Gelatin => "the rim of the gelatin's cup",
                Support::Orbit | Support::Free => "the orbit's rim",
            },
        })
    }

    /// The same on a mesh of another level.
    pub(crate) fn at_level(&self, level: u32) -> Self {
        let eye = RevolutionEye::new(&self.eye.parameters, level);
        Self {
            limit: engine::step_limit(&eye, &self.load),
            eye,
            ..self.clone()
        }
    }

    /// The share of the stability bound that a plan takes: its step is that of the eye at rest.
    fn steps(&self, plan: &Plan) -> engine::Steps {
        engine::Steps {
            share: plan.step / plan.multiple / self.limit,
            integrator: plan.integrator,
        }
    }

    /// Why there is no result; of an object that went through the eye what it would have to be.
    fn refused(&self, refusal: engine::Refusal) -> Refusal {
        let (time, object) = match (refusal, &self.load) {
            (engine::Refusal::Stopped(_), _) => return Refusal::Cancelled,
            (engine::Refusal::Through(time), engine::Blow::Object(object)) => (time * 1e3, object),
            (other, _) => return other.into(),
        };
        let shell = &self.eye.mesh.shell;
        let ((xa, ra), (xb, rb)) = (self.eye.at(shell[0]), self.eye.at(shell[1]));
        let (wide, apart) = (2.0 * object.outline.radius(), libm::hypot(xb - xa, rb - ra));
        let width = format!("{:.2}", wide * 1e3);
        let level = self.eye.level;
        let through = format!("went through the front of the eye at {time:.4} ms");
        let problem = if wide < apart {
            let narrow = format!(
                "mm is narrower than what lies between two nodes of mesh level {level}, and {through}"
            );
            let allowed = format!(
                "{:.2} mm or more, or a finer mesh by eye.level",
                apart * 1e3
            );
            Problem::refused("impact.diameter_mm", &width, &narrow, allowed)
        } else {
            let allowed =
                "a slower, lighter or wider object: what pierces an eye is beyond this model";
            let speed = plain(object.speed);
            let heavy = format!("m/s is too fast for an object {width} mm wide, which {through}");
            Problem::refused("impact.speed_m_s", &speed, &heavy, allowed.to_owned())
        };
        Refusal::Through(problem.into())
    }

    /// Moves the eye by `plan` and records it under the eyes of `watch`.
    ///
    /// # Errors
    /// Motion that leaves the finite numbers, an object that goes through the eye, and
    /// [`Refusal::Cancelled`] if the watch stopped it.
    pub fn run(&self, plan: &Plan, keep: Keep, watch: Watch) -> Result<Ran, Refusal> {
        let steps = self.steps(plan);
        let run = engine::run(&self.eye, &self.load, plan.window, steps, keep, watch);
        let run = run.map_err(|refusal| self.refused(refusal))?;
        Ok(Ran {
            left: Left::Revolution(run.extremes),
            traces: run.traces,
            frames: run.frames,
            cost: Cost {
                steps: run.steps,
                evaluations: run.steps + 1,
            },
            simulated: run.simulated,
        })
    }

    /// Moves the eye by `plan` and gives every frame to `take` once it is due.
    ///
    /// # Errors
    /// As [`Self::run`]; [`Refusal::Cancelled`] if `take` stopped it.
    pub fn frames(
        &self,
        plan: &Plan,
        spacing: Spacing,
        take: &mut dyn FnMut(Frame) -> ControlFlow<()>,
    ) -> Result<(), Refusal> {
        let steps = self.steps(plan);
        engine::run_through(&self.eye, &self.load, plan.window, steps, spacing, take)
            .map_err(|refusal| self.refused(refusal))
    }

    /// Duration of a pulse, in s.
    pub fn pulse(&self) -> Option<f64> {
        match &self.load {
            engine::Blow::Pulse(pulse, _) => Some(pulse.duration()),
            engine::Blow::Object(_) => None,
        }
    }
}

fn parameters(model: &Physiological, angle_deg: f64) -> Parameters {
    let mut parameters = Parameters {
        axis_angle: angle_deg.abs().to_radians(),
        shell: match model.species {
            Species::Human => ShellParameters::human(),
            Species::Pig => ShellParameters::pig(),
        },
        surround: surround(model),
        ..Parameters::default()
    };
    let bulk = model.globe_bulk_mpa * 1e6;
    parameters.vitreous = Material {
        bulk,
        shear: model.vitreous_shear_pa,
        viscosity: model.vitreous_viscosity_pa_s,
        ..parameters.vitreous
    };
    parameters.lens.material = Material {
        bulk,
        shear: model.lens_shear_kpa * 1e3,
        ..parameters.lens.material
    };
    let shell = &mut parameters.shell;
    shell.sclera_modulus = model.sclera_mpa * 1e6;
    shell.cornea_modulus = model.cornea_mpa * 1e6;
    shell.cornea_thickness *= model.cornea_thickness;
    for (_, thickness) in &mut shell.sclera_thickness {
        *thickness *= model.sclera_thickness;
    }
    parameters
}

fn surround(model: &Physiological) -> Option<Surround> {
    let (plain, bulk_mpa, shear_kpa, opening_deg) = match model.support {
        Support::Free => return None,
        Support::Orbit => (
            Surround::orbit(),
            model.fat_bulk_mpa,
            model.fat_shear_kpa,
            model.orbit_opening_deg,
        ),
        Support::Gelatin => (
            Surround::gelatin(),
            model.gelatin_bulk_mpa,
            model.gelatin_shear_kpa,
            model.gelatin_opening_deg,
        ),
    };
    let mut surround = plain.with_bulk(bulk_mpa * 1e6);
    surround.material.shear = shear_kpa * 1e3;
    surround.opening = opening_deg.to_radians();
    Some(surround)
}

fn object(shot: &Projectile) -> Object {
    let radius = 0.5e-3 * shot.diameter_mm;
    let surface = match shot.surface {
        Surface::Hard => engine::Surface::RIGID,
        Surface::Elastic { modulus_mpa } => engine::Surface::elastic(modulus_mpa * 1e6, radius),
        Surface::Inflated { kpa, modulus_mpa } => {
            let cap = kpa * 1e3 + inertia(shot);
            engine::Surface::capped(modulus_mpa * 1e6 / radius, cap, radius)
        }
        Surface::Splashing => engine::Surface::splashing(inertia(shot), radius),
    };
    Object {
        outline: match shot.outline {
            Outline::Sphere => engine::Outline::Sphere(radius),
            Outline::Cylinder { edge_mm } => engine::Outline::Cylinder(radius, edge_mm * 1e-3),
        },
        mass: shot.mass_g * 1e-3,
        speed: shot.speed_m_s,
        surface: surface.losing(shot.restitution),
        spring: match shot.stiffness {
            ProjectileStiffness::Rigid => None,
            ProjectileStiffness::Linear { n_per_m } => Some(BallSpring {
                stiffness: n_per_m,
                restitution: shot.restitution,
            }),
        },
    }
}

/// Half the density times the square of the speed, in Pa: what it takes to stop what is crushed or flattened.
fn inertia(shot: &Projectile) -> f64 {
    let density = shot.mass_g * 1e-3 / (PI / 6.0 * (shot.diameter_mm * 1e-3).powi(3));
    0.5 * density * shot.speed_m_s * shot.speed_m_s
}
