//! An object that flies at the eye.
//!
//! In the section it is a disc, so in space it is a rod across the slab: a small ball engages more of
//! the eye here than in life.

use serde::{Deserialize, Serialize};

/// A disc that flies at the cornea along the inward normal at its angle.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Projectile {
    /// Mass of the object, in g.
    pub mass_g: f64,
    /// Diameter of the object, in mm.
    pub diameter_mm: f64,
    /// Speed at first contact, in m/s.
    pub speed_m_s: f64,
    /// Front angle that it aims at, in degrees: 0 at the corneal apex, positive above.
    #[serde(default)]
    pub angle_deg: f64,
    /// Sideways shift of its path, in mm, positive to the left of its flight: up for a level shot.
    #[serde(default)]
    pub offset_mm: f64,
    /// How it gives way itself.
    #[serde(default)]
    pub stiffness: ProjectileStiffness,
    /// Names of the fields above whose figures come from no source that was checked, as in
    /// `["speed_m_s"]`. Shown with the results; nothing is computed from it.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub unverified: Vec<String>,
}

impl Projectile {
    /// The fields that [`Self::unverified`] may name.
    pub const FIELDS: [&'static str; 6] = [
        "mass_g",
        "diameter_mm",
        "speed_m_s",
        "angle_deg",
        "offset_mm",
        "stiffness",
    ];
}

/// A 6.35 mm steel ball at 20 m/s.
impl Default for Projectile {
    fn default() -> Self {
        Self {
            mass_g: 1.05,
            diameter_mm: 6.35,
            speed_m_s: 20.0,
            angle_deg: 0.0,
            offset_mm: 0.0,
            stiffness: ProjectileStiffness::default(),
            unverified: Vec::new(),
        }
    }
}

/// How an object gives way.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub enum ProjectileStiffness {
    /// Not at all.
    #[default]
    Rigid,
    /// Like a spring between its surface and its mass.
    Linear {
        /// Force per shortening, in N/m.
        n_per_m: f64,
    },
}

impl ProjectileStiffness {
    /// What a switch to `Linear` starts from: a tennis ball's order of magnitude.
    pub(super) const LINEAR: Self = Self::Linear { n_per_m: 2e4 };
}
