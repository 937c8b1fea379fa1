//! Random scenes on which claims are checked.
//!
//! A scene is drawn from a scrambled Sobol sequence, so a seed names it for good.

use crate::scenario::{EyeInput, ForcePulse, Geometry, Impact, Model, NumericsInput, Outline};
use crate::scenario::{Physiological, Projectile, ProjectileStiffness, PulseShape, Scenario};
use crate::scenario::{Species, Support, Surface};
use std::f64::consts::PI;

/// Most scenes that the sequence has for one seed.
pub const MAX_SCENES: u32 = 1 << 16;
/// Largest kinetic energy of an object, in J.
const HARDEST_J: f64 = 20.0;
/// Largest angle of a blow from the side, in degrees, and distance beside the middle, in mm.
const STEEPEST_DEG: f64 = 70.0;
const FARTHEST_MM: f64 = 8.0;

/// The kind of scenes that are drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Scenes {
    /// Pulses on the Paper model: force, duration, angle, width, shape, filaments.
    Pulses,
    /// Objects of any mass, size, speed, angle and make at eyes of the Physiological model.
    Objects,
    /// The same from the side: to 70 degrees at any hour, aimed up to 8 mm beside the middle.
    Sides,
}

impl Scenes {
    /// How many times as many steps the reference of a step error takes.
    pub fn fineness(self) -> f64 {
        match self {
            Self::Pulses => 100.0,
            // Its steps cost far more, and its errors fall with the first order.
            Self::Objects => 8.0,
            // And twenty times as much again.
            Self::Sides => 4.0,
        }
    }

    /// Random scene number `index` of `seed`.
    pub fn scene(self, index: u32, seed: u32) -> Scenario {
        let draw = Draw { index, seed };
        match self {
            Self::Pulses => pulse(draw),
            Self::Objects => object(draw),
            Self::Sides => side(draw),
        }
    }
}

/// The random numbers of one scene, one for each dimension.
#[derive(Clone, Copy)]
struct Draw {
    index: u32,
    seed: u32,
}

impl Draw {
    /// From 0 to 1.
    fn share(self, dimension: u32) -> f64 {
        f64::from(sobol_burley::sample(self.index, dimension, self.seed))
    }

    /// From `low` to `high`, evenly.
    fn between(self, dimension: u32, low: f64, high: f64) -> f64 {
        low + (high - low) * self.share(dimension)
    }

    /// From `low` to `high`, evenly by ratio.
    fn ratio(self, dimension: u32, low: f64, high: f64) -> f64 {
        low * libm::pow(high / low, self.share(dimension))
    }
}

fn pulse(draw: Draw) -> Scenario {
    let shape = match draw.between(5, 0.0, 3.0) as u32 {
        0 => PulseShape::SmoothRectangle { edge_fraction: draw.between(6, 0.0, 0.5) },
        1 => PulseShape::Triangle,
        _ => PulseShape::HalfSine,
    };
    // One scene in four is head-on, as most presets are.
    let head_on = draw.share(10) < 0.25;
    let hops = draw.between(8, 0.0, 8.0) as u32;
    Scenario {
        name: format!("random scene {} of seed {}", draw.index, draw.seed),
        impact: Impact::ForcePulse(ForcePulse {
            force_n: draw.between(0, 20.0, 700.0),
            duration_ms: draw.between(1, 0.05, 0.35),
            angle_deg: if head_on { 0.0 } else { draw.between(2, -38.0, 38.0) },
            half_width_deg: draw.between(3, 3.0, 35.0),
            shape,
        }),
        eye: EyeInput {
            filament_hops: [2, 3, 4].into_iter().filter(|h| hops >> (h - 2) & 1 == 1).collect(),
            filament_factor: draw.between(9, 0.2, 3.0),
            ..EyeInput::default()
        },
        ..Scenario::default()
    }
}

fn object(draw: Draw) -> Scenario {
    let diameter_mm = draw.ratio(0, 3.0, 100.0);
    // Of a ball of foam to one of steel, in g/cm3.
    let density = draw.ratio(1, 0.1, 8.0);
    let mass_g = density * PI / 6.0 * (0.1 * diameter_mm).powi(3);
    let fastest = (2.0 * HARDEST_J / (mass_g * 1e-3)).sqrt();
    let modulus_mpa = draw.ratio(3, 1.0, 300.0);
    let bounce = draw.between(5, 0.2, 1.0);
    let (surface, restitution) = match draw.share(4) {
        s if s < 0.4 => (Surface::Hard, 1.0),
        s if s < 0.7 => (Surface::Elastic { modulus_mpa }, bounce),
        _ => (Surface::Inflated { kpa: draw.ratio(6, 50.0, 2000.0), modulus_mpa }, bounce),
    };
    let springy = surface != Surface::Hard && draw.share(7) < 0.3;
    let edge_mm = draw.between(9, 0.05, 0.5) * diameter_mm;
    let sphere = draw.share(8) < 0.8;
    let outline = if sphere { Outline::Sphere } else { Outline::Cylinder { edge_mm } };
    let n_per_m = draw.ratio(18, 1e4, 1e6);
    let spring = ProjectileStiffness::Linear { n_per_m };
    let around = |dimension, value: f64| value * draw.ratio(dimension, 0.7, 1.4);
    let plain = Physiological::default();
    Scenario {
        name: format!("random object {} of seed {}", draw.index, draw.seed),
        model: Model::Physiological(Physiological {
            species: if draw.share(10) < 0.7 { Species::Human } else { Species::Pig },
            support: match draw.share(11) {
                s if s < 0.6 => Support::Orbit,
                s if s < 0.8 => Support::Gelatin,
                _ => Support::Free,
            },
            sclera_mpa: around(12, plain.sclera_mpa),
            cornea_mpa: around(13, plain.cornea_mpa),
            fat_bulk_mpa: around(14, plain.fat_bulk_mpa),
            globe_bulk_mpa: around(15, plain.globe_bulk_mpa),
            ..plain
        }),
        impact: Impact::Projectile(Projectile {
            mass_g,
            diameter_mm,
            speed_m_s: draw.ratio(2, 5.0, 150.0).min(fastest),
            // One in four is head-on, as most presets are.
            angle_deg: if draw.share(16) < 0.25 { 0.0 } else { draw.between(17, 0.0, 40.0) },
            outline,
            surface,
            restitution,
            stiffness: if springy { spring } else { ProjectileStiffness::Rigid },
            ..Projectile::default()
        }),
        // What a blow does at first; the published coverage is of this.
        window_ms: Some(3.0),
        // Of the axisymmetric eye, whose coverage it is.
        numerics: NumericsInput { geometry: Geometry::Axisymmetric, ..NumericsInput::default() },
        ..Scenario::default()
    }
}

fn side(draw: Draw) -> Scenario {
    let mut scene = object(draw);
    scene.name = format!("random side {} of seed {}", draw.index, draw.seed);
    scene.numerics.geometry = Geometry::Auto;
    if let Impact::Projectile(object) = &mut scene.impact {
        object.angle_deg = draw.between(17, 0.5, STEEPEST_DEG);
        object.angle_clock = draw.between(19, 0.0, 12.0);
        object.offset_mm = draw.between(20, 0.0, FARTHEST_MM);
        // Every second one in the plane of the eye's axis, where half of an eye may do.
        object.offset_clock =
            if draw.share(21) < 0.5 { object.angle_clock } else { draw.between(22, 0.0, 12.0) };
    }
    if let (Err(_), Model::Physiological(eye)) = (scene.check(), &mut scene.model) {
        // It would land on the gelatin, or does not fit its opening.
        eye.support = Support::Free;
    }
    scene
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_scene_is_one_that_a_person_could_ask_for() {
        for seed in [0, 1, u32::MAX] {
            for index in (0..2000).chain([MAX_SCENES - 1]) {
                for scenes in [Scenes::Pulses, Scenes::Objects, Scenes::Sides] {
                    let scene = scenes.scene(index, seed);
                    assert!(scene.check().is_ok(), "{scene:?}");
                }
            }
        }
    }
}
