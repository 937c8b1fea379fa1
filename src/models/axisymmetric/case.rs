//! A scenario with the Physiological model, compiled: the eye in SI units and what hits it.

use crate::models::axisymmetric::eye::parameters::{
    Material, Parameters, ShellParameters, Surround,
};
use crate::models::axisymmetric::eye::{AxisymmetricEye, distance};
use crate::models::axisymmetric::forces::object::{
    BallSpring, Object, ObjectOutline, ObjectSurface,
};
use crate::models::axisymmetric::time::march::{Steps, Stop};
use crate::models::axisymmetric::time::run::{AxisymmetricLoad, run, run_through, step_limit};
use crate::models::axisymmetric::{drawing, flags, readings, rules::RULES, time::until::Until};
use crate::models::pulse::Pulse;
use crate::run::kept::{Frame, Keep, Spacing};
use crate::run::model::{EyeModel, Run};
use crate::run::plan::Plan;
use crate::run::{drawing::Drawing, places::Region, refusal::Refusal, rules::Rules, watch::Watch};
use crate::scenario::problem::{Problem, plain};
use crate::scenario::{
    CheckedScenario, Impact, Integrator, Outline, Physiological, Projectile, ProjectileStiffness,
    Species, Support, Surface,
};
use std::f64::consts::PI;
use std::ops::ControlFlow;
use std::sync::Arc;

/// The longest that a run without a set time lasts, in s, with a pulse the longest after it.
pub(crate) const LONGEST: f64 = 60e-3;

/// What catches an object that is wider than the orbit.
pub(crate) const ORBITS_RIM: &str = "the orbit's rim";

/// An axisymmetric eye ready to be hit.
#[derive(Debug, Clone)]
pub struct AxisymmetricCase {
    /// The eye.
    pub eye: AxisymmetricEye,
    /// What hits it.
    pub load: AxisymmetricLoad,
    /// Simulated time, in s.
    pub window: Until,
    /// Front angle of the blow, in degrees.
    pub angle_deg: f64,
    /// What catches an object that is too wide.
    pub rim: &'static str,
    /// Longest stable step at rest, in s.
    limit: f64,
}

impl AxisymmetricCase {
    /// Compiles a scenario with this model.
    pub fn new(scenario: &CheckedScenario, model: &Physiological) -> Self {
        let (angle_deg, load) = match &scenario.impact {
            Impact::ForcePulse(pulse) => {
                let half_width = pulse.half_width_deg.to_radians();
                (pulse.angle_deg, AxisymmetricLoad::Pulse(Pulse::new(pulse), half_width))
            }
            Impact::Projectile(of) => (of.angle_deg, AxisymmetricLoad::Object(object(of))),
        };
        let eye = AxisymmetricEye::new(&parameters(model, angle_deg), scenario.eye.level);
        Self {
            limit: step_limit(&eye, &load),
            eye,
            window: Until::asked(scenario.window_ms, LONGEST + duration(&load).unwrap_or(0.0)),
            load,
            angle_deg,
            rim: match model.support {
                Support::Gelatin => "the rim of the gelatin's cup",
                Support::Orbit | Support::Free => ORBITS_RIM,
            },
        }
    }

    /// Why there is no result.
    fn refused(&self, stop: Stop) -> Refusal {
        let shell = &self.eye.mesh.shell;
        let apart = distance(self.eye.at(shell[1]), self.eye.at(shell[0]));
        let object = if let AxisymmetricLoad::Object(of) = &self.load { Some(of) } else { None };
        refused(stop, object, (self.eye.level, apart))
    }
}

/// Why there is no result, where nodes of a mesh of some level lie so far `apart`, in m.
pub(crate) fn refused(stop: Stop, object: Option<&Object>, (level, apart): (u32, f64)) -> Refusal {
    let (time, object) = match (stop, object) {
        (Stop::WentThrough(time), Some(object)) => (time * 1e3, object),
        (Stop::NotFinite { time, step }, _) => return Refusal::NotFinite { time, step },
        _ => return Refusal::Cancelled,
    };
    let wide = 2.0 * object.outline.radius();
    let width = format!("{:.2}", wide * 1e3);
    let through = format!("went through the front of the eye at {time:.4} ms");
    let problem = if wide < apart {
        let narrow = format!(
            "mm is narrower than what lies between two nodes of mesh level {level}, and {through}"
        );
        let allowed = format!("{:.2} mm or more, or a finer mesh by eye.level", apart * 1e3);
        Problem::refused("impact.diameter_mm", &width, &narrow, allowed)
    } else {
        let allowed = "a slower, lighter or wider object: what pierces an eye is beyond this model";
        let speed = plain(object.speed);
        let heavy = format!("m/s is too fast for an object {width} mm wide, which {through}");
        Problem::refused("impact.speed_m_s", &speed, &heavy, allowed.to_owned())
    };
    Refusal::WentThrough(problem.into())
}

/// Duration of a pulse, in s.
pub(crate) fn duration(load: &AxisymmetricLoad) -> Option<f64> {
    if let AxisymmetricLoad::Pulse(pulse, _) = load { Some(pulse.duration()) } else { None }
}

/// What the eye of a scenario is made of, about an axis at so many degrees from its own.
pub(crate) fn parameters(model: &Physiological, angle_deg: f64) -> Parameters {
    let mut parameters = Parameters {
        axis_angle: angle_deg.abs().to_radians(),
        shell: match model.species {
            Species::Human => ShellParameters::human(),
            Species::Pig => ShellParameters::pig(),
        },
        surround: surround(model),
        ..Parameters::default()
    };
    let (vitreous, lens) = (&mut parameters.vitreous, &mut parameters.lens.material);
    vitreous.bulk = model.globe_bulk_mpa * 1e6;
    vitreous.shear = model.vitreous_shear_pa;
    vitreous.viscosity = model.vitreous_viscosity_pa_s;
    lens.bulk = vitreous.bulk;
    lens.shear = model.lens_shear_kpa * 1e3;
    let shell = &mut parameters.shell;
    shell.sclera_modulus = model.sclera_mpa * 1e6;
    shell.cornea_modulus = model.cornea_mpa * 1e6;
    shell.cornea_thickness *= model.cornea_thickness;
    for (_, thickness) in &mut shell.sclera_thickness {
        *thickness *= model.sclera_thickness;
    }
    parameters
}

fn surround(of: &Physiological) -> Option<Surround> {
    let (plain, opening_deg, bulk_mpa, shear_kpa) = match of.support {
        Support::Free => return None,
        Support::Orbit => {
            (Surround::orbit(), of.orbit_opening_deg, of.fat_bulk_mpa, of.fat_shear_kpa)
        }
        Support::Gelatin => {
            let opening_deg = of.gelatin_opening_deg;
            (Surround::gelatin(), opening_deg, of.gelatin_bulk_mpa, of.gelatin_shear_kpa)
        }
    };
    let material = Material { bulk: bulk_mpa * 1e6, shear: shear_kpa * 1e3, ..plain.material };
    Some(Surround { material, opening: opening_deg.to_radians(), ..plain })
}

/// The object of a scenario.
pub(crate) fn object(projectile: &Projectile) -> Object {
    let radius = 0.5e-3 * projectile.diameter_mm;
    let surface = match projectile.surface {
        Surface::Hard => ObjectSurface::RIGID,
        Surface::Elastic { modulus_mpa } => ObjectSurface::elastic(modulus_mpa * 1e6, radius),
        Surface::Inflated { kpa, modulus_mpa } => {
            let cap = kpa * 1e3 + inertia(projectile);
            ObjectSurface::capped(modulus_mpa * 1e6 / radius, cap, radius)
        }
        Surface::Splashing => ObjectSurface::splashing(inertia(projectile), radius),
    };
    Object {
        outline: match projectile.outline {
            Outline::Sphere => ObjectOutline::Sphere(radius),
            Outline::Cylinder { edge_mm } => ObjectOutline::Cylinder(radius, edge_mm * 1e-3),
        },
        mass: projectile.mass_kg(),
        speed: projectile.speed_m_s,
        surface: surface.losing(projectile.restitution),
        spring: match projectile.stiffness {
            ProjectileStiffness::Rigid => None,
            ProjectileStiffness::Linear { n_per_m } => {
                Some(BallSpring { stiffness: n_per_m, restitution: projectile.restitution })
            }
        },
    }
}

/// Half the density times the square of the speed, in Pa: what stops what is crushed or flattened.
fn inertia(projectile: &Projectile) -> f64 {
    let density = projectile.mass_kg() / (PI / 6.0 * projectile.diameter_m().powi(3));
    0.5 * density * projectile.speed_m_s * projectile.speed_m_s
}

impl EyeModel for AxisymmetricCase {
    fn rules(&self) -> &'static Rules {
        &RULES
    }

    fn window(&self) -> f64 {
        self.window.most()
    }

    fn ends_by_itself(&self) -> bool {
        matches!(self.window, Until::Settled(_))
    }

    fn level(&self) -> u32 {
        self.eye.level
    }

    fn at_level(&self, level: u32) -> Arc<dyn EyeModel> {
        let eye = AxisymmetricEye::new(&self.eye.parameters, level);
        Arc::new(Self { limit: step_limit(&eye, &self.load), eye, ..self.clone() })
    }

    fn regions(&self) -> Vec<Region> {
        self.eye.node_regions()
    }

    fn elements(&self) -> usize {
        self.eye.cells.len()
    }

    fn step_limit(&self, _: Integrator) -> f64 {
        self.limit
    }

    fn run(&self, plan: &Plan, keep: Keep, watch: Watch) -> Result<Run, Refusal> {
        let steps = Steps::by(plan, self.limit, &RULES)?;
        let window = self.window.within(plan.window);
        let run = run(&self.eye, &self.load, window, steps, keep, watch);
        let run = run.map_err(|stop| self.refused(stop))?;
        let extremes = run.extremes;
        let told = readings::told(run, &extremes);
        Ok(Run {
            details: readings::details(&extremes),
            flags: flags::raise(self, &extremes, &told.readings, told.simulated),
            ..told
        })
    }

    fn frames(
        &self,
        plan: &Plan,
        spacing: Spacing,
        take: &mut dyn FnMut(Frame) -> ControlFlow<()>,
    ) -> Result<(), Refusal> {
        let steps = Steps::by(plan, self.limit, &RULES)?;
        let window = self.window.within(plan.window);
        run_through(&self.eye, &self.load, window, steps, spacing, take)
            .map_err(|stop| self.refused(stop))
    }

    fn drawing(&self) -> Drawing {
        drawing::of(self)
    }
}
