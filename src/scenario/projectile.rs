//! An object that flies at the eye of the Physiological model.

use crate::scenario::direction::{Directions, HOURS};
use crate::scenario::is_default;
use serde::{Deserialize, Serialize};
use strum::IntoStaticStr;

/// A ball or cylinder that flies at the cornea along the inward normal at its angle.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Projectile {
    /// Mass of the object, in g.
    pub mass_g: f64,
    /// Diameter of the object, in mm.
    pub diameter_mm: f64,
    /// Speed at first contact, in m/s.
    pub speed_m_s: f64,
    /// Angle between its path and the eye's axis, in degrees.
    #[serde(default)]
    pub angle_deg: f64,
    /// The hour that it comes from.
    #[serde(default = "usual::<12>", skip_serializing_if = "is_usual::<12>")]
    pub angle_clock: f64,
    /// How far beside the middle of the cornea it aims, in mm.
    #[serde(default, skip_serializing_if = "is_default")]
    pub offset_mm: f64,
    /// The hour towards which that is.
    #[serde(default = "usual::<12>", skip_serializing_if = "is_usual::<12>")]
    pub offset_clock: f64,
    /// Whether it is known where it came from; angle and offset are 0 where it is not.
    #[serde(default, skip_serializing_if = "is_default")]
    pub directions: Directions,
    /// How it gives way as a whole.
    #[serde(default)]
    pub stiffness: ProjectileStiffness,
    /// Its shape.
    #[serde(default, skip_serializing_if = "is_default")]
    pub outline: Outline,
    /// How its surface gives way.
    #[serde(default, skip_serializing_if = "is_default")]
    pub surface: Surface,
    /// Share of its speed that it keeps off a rigid wall, thrown back by its surface and spring.
    #[serde(default = "usual::<1>", skip_serializing_if = "is_usual::<1>")]
    pub restitution: f64,
    /// Names of the fields above whose figures come from no source that was checked.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub unverified: Vec<String>,
}

impl Projectile {
    /// The fields that [`Self::unverified`] may name.
    pub const FIELDS: [&'static str; 9] = [
        "mass_g",
        "diameter_mm",
        "speed_m_s",
        "angle_deg",
        "offset_mm",
        "stiffness",
        "outline",
        "surface",
        "restitution",
    ];

    /// Mass, in kg.
    pub fn mass_kg(&self) -> f64 {
        self.mass_g * 1e-3
    }

    /// Diameter, in m.
    pub fn diameter_m(&self) -> f64 {
        self.diameter_mm * 1e-3
    }

    /// Energy that it brings, in J.
    pub fn energy_j(&self) -> f64 {
        0.5e-3 * self.mass_g * self.speed_m_s * self.speed_m_s
    }
}

/// A number that files leave out where it is the usual one.
fn usual<const N: u8>() -> f64 {
    f64::from(N)
}

#[expect(clippy::trivially_copy_pass_by_ref, reason = "serde asks for a reference")]
fn is_usual<const N: u8>(number: &f64) -> bool {
    *number == usual::<N>()
}

/// A 6.35 mm steel ball at 20 m/s.
impl Default for Projectile {
    fn default() -> Self {
        Self {
            mass_g: 1.05,
            diameter_mm: 6.35,
            speed_m_s: 20.0,
            angle_deg: 0.0,
            angle_clock: HOURS,
            offset_mm: 0.0,
            offset_clock: HOURS,
            directions: Directions::default(),
            stiffness: ProjectileStiffness::default(),
            outline: Outline::default(),
            surface: Surface::default(),
            restitution: 1.0,
            unverified: Vec::new(),
        }
    }
}

/// How an object gives way.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize, IntoStaticStr)]
#[serde(deny_unknown_fields)]
pub enum ProjectileStiffness {
    /// It does not give way.
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

/// Shape of an object, with its axis along its path.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize, IntoStaticStr)]
#[serde(deny_unknown_fields)]
pub enum Outline {
    /// A ball.
    #[default]
    Sphere,
    /// A flat end with a rounded edge, as the rods of published tests have.
    Cylinder {
        /// Radius of the edge.
        edge_mm: f64,
    },
}

impl Outline {
    /// What a switch to `Cylinder` starts from.
    pub(super) const CYLINDER: Self = Self::Cylinder { edge_mm: 1.0 };
}

/// How the surface of an object gives way: an elastic foundation that stiffens as it is used up.
/// Its stiffness is the modulus over the radius.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize, IntoStaticStr)]
#[serde(deny_unknown_fields)]
pub enum Surface {
    /// It hardly gives way.
    #[default]
    Hard,
    /// A solid body.
    Elastic {
        /// Its modulus.
        modulus_mpa: f64,
    },
    /// A wall around gas, or foam that crushes: until it is used up it presses no harder than its
    /// cap and what stops it, half its density times the square of its speed.
    Inflated {
        /// The cap: the gas pressure with what the wall adds, or the stress of collapse.
        kpa: f64,
        /// Modulus at small dents.
        modulus_mpa: f64,
    },
    /// Liquid in a skin that bursts, or a gel that flows: `Inflated` without a cap of its own.
    Splashing,
}

impl Surface {
    /// What a switch to `Elastic` starts from: soft rubber.
    pub(super) const ELASTIC: Self = Self::Elastic { modulus_mpa: 5.0 };
    /// What a switch to `Inflated` starts from: soft rubber around the gas of a soccer ball.
    pub(super) const INFLATED: Self = Self::Inflated { kpa: 110.0, modulus_mpa: 5.0 };
}
