//! The physiological model: what it adds to the paper's, each part with its own switch.
//!
//! The mesh, the springs and their moduli are the paper's, from [`super::EyeInput`]. This holds what
//! the paper leaves out or what its static moduli miss, so that a scene can turn on one part alone.

use serde::{Deserialize, Serialize};

/// What the physiological model adds to the paper's.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Physiological {
    /// Whether the section is a slab of [`Self::depth_mm`]; off, it has the paper's unit depth.
    pub slab: bool,
    /// Depth of the slab, in mm: 16 mm holds the globe's 7.5 g at the density of tissue.
    pub depth_mm: f64,
    /// Whether the globe holds a fluid that resists a change of its area.
    pub pressure: bool,
    /// Intraocular pressure before the blow, in mm of mercury.
    pub initial_pressure_mmhg: f64,
    /// Effective bulk modulus B of the fluid, in megapascals: p = p0 - B (A/A0 - 1).
    pub bulk_modulus_mpa: f64,
    /// Whether dashpots along the springs take the place of drag on every node.
    pub dashpots: bool,
    /// Damping ratio of the dashpots in the globe, as a share of the critical one.
    pub globe_damping_ratio: f64,
    /// Damping ratio of the dashpots in fat, as a share of the critical one.
    pub fat_damping_ratio: f64,
    /// Multiplies `eye.sclera_kpa`: tissue is stiffer in a fast blow.
    pub sclera_stiffening: f64,
    /// Multiplies `eye.fat_kpa`.
    pub fat_stiffening: f64,
}

impl Physiological {
    /// Every part switched on, with what was fitted to experiments on mesh level 1.
    pub const FITTED: Self = Self {
        slab: true,
        depth_mm: 16.0,
        pressure: true,
        initial_pressure_mmhg: 15.0,
        bulk_modulus_mpa: 233.0,
        dashpots: true,
        globe_damping_ratio: 0.1,
        fat_damping_ratio: 0.22,
        sclera_stiffening: 4.51,
        fat_stiffening: 10.0,
    };
}

impl Default for Physiological {
    fn default() -> Self {
        Self::FITTED
    }
}
