//! What a person may change of the Physiological model, where each default has its source. Of
//! [`crate::scenario::EyeInput`] it takes the level alone.

use crate::scenario::{Rim, Side, is_default};
use serde::{Deserialize, Serialize};
use strum::IntoStaticStr;

/// Angle of a blow, in degrees, up to which bone that turns with its axis can be trusted.
pub const TRUSTED_ANGLE_DEG: f64 = 40.0;
/// The fastest object that the model takes, in m/s: a faster one goes into an eye.
pub const FASTEST_M_S: f64 = 200.0;
/// The most energy that one brings, in J.
pub const MOST_ENERGY_J: f64 = 300.0;
/// The finest mesh level of this model.
pub const FINEST_PHYSIOLOGICAL_LEVEL: u32 = 5;

/// What the axisymmetric eye is made of.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Physiological {
    /// Whose eye: it sets the thickness of the shell.
    pub species: Species,
    /// Right or left.
    pub eye_side: Side,
    /// What holds the globe.
    pub support: Support,
    /// Bulk modulus of vitreous and lens.
    pub globe_bulk_mpa: f64,
    /// Shear modulus of the vitreous.
    pub vitreous_shear_pa: f64,
    /// Newtonian viscosity of the vitreous.
    pub vitreous_viscosity_pa_s: f64,
    /// Shear modulus of the lens.
    pub lens_shear_kpa: f64,
    /// Secant modulus of the sclera at failure (Uchio et al. 1999).
    pub sclera_mpa: f64,
    /// Secant modulus of the cornea at failure (Uchio et al. 1999).
    pub cornea_mpa: f64,
    /// Multiplies the thickness of the sclera.
    pub sclera_thickness: f64,
    /// Multiplies the thickness of the cornea.
    pub cornea_thickness: f64,
    /// Bulk modulus of orbital fat: fitted, see [`Self::PUBLISHED_FAT_BULK_MPA`].
    pub fat_bulk_mpa: f64,
    /// Shear modulus of orbital fat.
    pub fat_shear_kpa: f64,
    /// Front angle at which orbital fat and bone begin.
    pub orbit_opening_deg: f64,
    /// Where the rim of the bone lies, where the eye is computed in three dimensions.
    #[serde(skip_serializing_if = "is_default")]
    pub rim: Rim,
    /// Bulk modulus of the gelatin.
    pub gelatin_bulk_mpa: f64,
    /// Shear modulus of the gelatin.
    pub gelatin_shear_kpa: f64,
    /// Front angle at which gelatin and holder begin.
    pub gelatin_opening_deg: f64,
}

impl Physiological {
    /// It in words, with species and support.
    pub(super) fn description(&self) -> String {
        let species = <&str>::from(self.species).to_lowercase();
        let support = match self.support {
            Support::Orbit => "in its orbit",
            Support::Gelatin => "in gelatin",
            Support::Free => "free",
        };
        format!("Physiological model, {species} eye {support}")
    }

    /// Of the published Young's modulus of fat, 47 kPa, with a Poisson ratio of 0.49. A ratio of
    /// 0.48 makes half of it, as two tests of an impactor in the orbit want: the one fitted number.
    pub const PUBLISHED_FAT_BULK_MPA: f64 = 0.78;
}

impl Default for Physiological {
    fn default() -> Self {
        Self {
            species: Species::Human,
            eye_side: Side::Right,
            support: Support::Orbit,
            globe_bulk_mpa: 100.0,
            vitreous_shear_pa: 10.0,
            vitreous_viscosity_pa_s: 0.1,
            lens_shear_kpa: 10.0,
            sclera_mpa: 138.0,
            cornea_mpa: 52.0,
            sclera_thickness: 1.0,
            cornea_thickness: 1.0,
            fat_bulk_mpa: 0.4,
            fat_shear_kpa: 15.7,
            orbit_opening_deg: 72.0,
            rim: Rim::CAUCASIAN,
            gelatin_bulk_mpa: 100.0,
            gelatin_shear_kpa: 30.0,
            gelatin_opening_deg: 40.0,
        }
    }
}

/// Whose eye.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, IntoStaticStr)]
pub enum Species {
    /// Thicknesses of human eyes (Vurgese et al. 2012).
    #[default]
    Human,
    /// Sclera twice and cornea 1.6 times as thick: an assumption.
    Pig,
}

/// What holds the globe.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, IntoStaticStr)]
pub enum Support {
    /// Fat in a rigid bony cone, as in the head.
    #[default]
    Orbit,
    /// Gelatin in a rigid cup, as enucleated eyes in experiments.
    Gelatin,
    /// Nothing.
    Free,
}
