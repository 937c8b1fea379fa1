//! Random objects that fly at random eyes of revolution, for what is claimed of many scenes.

use crate::scenario::{
    Impact, Model, Outline, Physiological, Projectile, ProjectileStiffness, Scenario, Species,
    Support, Surface,
};
use crate::verify::coverage::draw;
use std::f64::consts::PI;

/// Largest kinetic energy of an object, in J.
const HARDEST_J: f64 = 20.0;

/// Random scene number `index` of `seed`.
pub(crate) fn random_object(index: u32, seed: u32) -> Scenario {
    let share = |dimension| draw(index, dimension, seed);
    let between = |dimension, low: f64, high: f64| low + (high - low) * share(dimension);
    let ratio = |dimension, low: f64, high: f64| low * libm::pow(high / low, share(dimension));
    let diameter_mm = ratio(0, 3.0, 100.0);
    // Of a ball of foam to one of steel, in g/cm3.
    let density = ratio(1, 0.1, 8.0);
    let mass_g = density * PI / 6.0 * (0.1 * diameter_mm).powi(3);
    let fastest = (2.0 * HARDEST_J / (mass_g * 1e-3)).sqrt();
    let modulus_mpa = ratio(3, 1.0, 300.0);
    let (surface, restitution) = match share(4) {
        s if s < 0.4 => (Surface::Hard, 1.0),
        s if s < 0.7 => (Surface::Elastic { modulus_mpa }, between(5, 0.2, 1.0)),
        _ => {
            let kpa = ratio(6, 50.0, 2000.0);
            (Surface::Inflated { kpa, modulus_mpa }, between(5, 0.2, 1.0))
        }
    };
    let springy = surface != Surface::Hard && share(7) < 0.3;
    let outline = if share(8) < 0.8 {
        Outline::Sphere
    } else {
        let edge_mm = between(9, 0.05, 0.5) * diameter_mm;
        Outline::Cylinder { edge_mm }
    };
    let around = |dimension, value: f64| value * ratio(dimension, 0.7, 1.4);
    let plain = Physiological::default();
    Scenario {
        name: format!("random object {index} of seed {seed}"),
        model: Model::Physiological(Physiological {
            species: if share(10) < 0.7 {
                Species::Human
            } else {
                Species::Pig
            },
            support: match share(11) {
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
            speed_m_s: ratio(2, 5.0, 150.0).min(fastest),
            // One in four is head-on, as most presets are.
            angle_deg: if share(16) < 0.25 {
                0.0
            } else {
                between(17, 0.0, 40.0)
            },
            outline,
            surface,
            restitution,
            stiffness: if springy {
                let n_per_m = ratio(18, 1e4, 1e6);
                ProjectileStiffness::Linear { n_per_m }
            } else {
                ProjectileStiffness::Rigid
            },
            ..Projectile::default()
        }),
        ..Scenario::default()
    }
}
