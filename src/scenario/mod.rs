//! What a person asks for, in their own units.
//!
//! A [`Scenario`] is one blow to one eye, read from RON and checked field by field. Units live in
//! the names of the fields (`force_n`, `duration_ms`); the rooms below convert once to SI.

mod auto;
mod check;
mod curve;
mod curve_file;
pub mod direction;
pub(crate) mod doubt;
pub mod fields;
mod geometry;
mod integrator;
pub mod library;
pub mod load;
pub(crate) mod locate;
mod naming;
mod parts;
mod physiological;
pub(crate) mod problem;
mod projectile;
mod rim;
pub(crate) mod ron_text;
pub mod set;
mod text_file;

use std::collections::BTreeMap;

pub use crate::scenario::check::CheckedScenario;
pub use crate::scenario::curve::{Curve, CurveError};
pub use crate::scenario::direction::{Directions, STEEPEST_OBJECT_DEG, Side};
pub use crate::scenario::geometry::{FINEST_SPATIAL_LEVEL, Geometry};
pub use crate::scenario::integrator::Integrator;
pub use crate::scenario::physiological::{
    FASTEST_M_S, FINEST_PHYSIOLOGICAL_LEVEL, MOST_ENERGY_J, Physiological, Species, Support,
    TRUSTED_ANGLE_DEG,
};
use crate::scenario::problem::plain;
pub use crate::scenario::problem::{Problem, ScenarioError};
pub use crate::scenario::projectile::{Outline, Projectile, ProjectileStiffness, Surface};
pub use crate::scenario::rim::{Around, Rim};
use curve_file::CurveFile;
use serde::{Deserialize, Deserializer, Serialize};
use strum::IntoStaticStr;

/// The finest mesh level of any model.
pub const FINEST_LEVEL: u32 = 8;

/// One blow to one eye: everything that a run depends on.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(from = "WrittenScenario")]
pub struct Scenario {
    /// Shown wherever the result is shown.
    pub name: String,
    /// The material model.
    pub model: Model,
    /// What hits the eye.
    pub impact: Impact,
    /// Simulated time from the first contact, in ms; none (`Auto`) lasts until nothing can grow.
    #[serde(serialize_with = "auto::serialize")]
    pub window_ms: Option<f64>,
    /// Anatomy and mesh.
    pub eye: EyeInput,
    /// Integrator and step.
    pub numerics: NumericsInput,
    /// Standard deviations of numbers that are in doubt, by the path of their field and in its
    /// unit. No single run changes by them; an ensemble draws from them.
    #[serde(skip_serializing_if = "BTreeMap::is_empty")]
    pub doubt: BTreeMap<String, f64>,
}

/// A scenario as text gives it: what hits the eye decides about a model that is not named.
#[derive(Deserialize)]
#[serde(rename = "Scenario", deny_unknown_fields)]
struct WrittenScenario {
    name: String,
    #[serde(default, deserialize_with = "named")]
    model: Option<Model>,
    impact: Impact,
    #[serde(default, deserialize_with = "auto::deserialize")]
    window_ms: Option<f64>,
    #[serde(default)]
    eye: EyeInput,
    #[serde(default)]
    numerics: NumericsInput,
    #[serde(default, deserialize_with = "doubt::once")]
    doubt: BTreeMap<String, f64>,
}

/// Reads a model that is named without `Some`.
fn named<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Option<Model>, D::Error> {
    Model::deserialize(deserializer).map(Some)
}

impl From<WrittenScenario> for Scenario {
    fn from(written: WrittenScenario) -> Self {
        let WrittenScenario { name, model, mut impact, window_ms, eye, numerics, doubt } = written;
        impact.by_the_clock();
        let model = model.unwrap_or_else(|| Model::usual_for(&impact));
        Self { name, model, impact, window_ms, eye, numerics, doubt }
    }
}

/// Whether a value is the usual one, which files leave out.
fn is_default<T: Default + PartialEq>(value: &T) -> bool {
    *value == T::default()
}

impl Scenario {
    /// Such a blow to an eye of the model that takes it.
    pub fn of(impact: Impact) -> Self {
        Self { model: Model::usual_for(&impact), impact, ..Self::default() }
    }

    /// Simulated time in ms, where it is known before a run: what is asked, else of a pulse at the
    /// Paper model 3 ms, or until its drag has stilled the eye, within 2 ms after the pulse.
    pub fn known_window_ms(&self) -> Option<f64> {
        match (&self.model, &self.impact) {
            _ if self.window_ms.is_some() => self.window_ms,
            (Model::Paper, Impact::ForcePulse(pulse)) => Some((pulse.duration_ms + 2.0).max(3.0)),
            _ => None,
        }
    }
}

impl Default for Scenario {
    fn default() -> Self {
        Self {
            name: "300 N for 0.2 ms".to_owned(),
            model: Model::default(),
            impact: Impact::ForcePulse(ForcePulse::default()),
            window_ms: None,
            eye: EyeInput::default(),
            numerics: NumericsInput::default(),
            doubt: BTreeMap::new(),
        }
    }
}

/// Which model of the eye, with its materials and forces.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize, IntoStaticStr)]
#[serde(deny_unknown_fields)]
pub enum Model {
    /// The mass-spring-damper eye of Sathyanarayanan, Mahadas and Hung (2013), of unit depth. It
    /// takes force pulses only: a ball in its flat section would be a rod.
    #[default]
    Paper,
    /// A round eye of tissues, axisymmetric or in three dimensions.
    Physiological(Physiological),
}

impl Model {
    /// The model of a scenario that names none: only the Physiological one takes objects.
    pub fn usual_for(impact: &Impact) -> Self {
        match impact {
            Impact::ForcePulse(_) => Self::Paper,
            Impact::Projectile(_) => Self::Physiological(Physiological::default()),
        }
    }

    /// Whose eye it is.
    pub fn species(&self) -> Species {
        match self {
            Self::Paper => Species::Human,
            Self::Physiological(model) => model.species,
        }
    }

    /// In words, with what was chosen of it.
    pub fn description(&self) -> String {
        match self {
            Self::Paper => "Paper model, unit depth (1 m)".to_owned(),
            Self::Physiological(model) => model.description(),
        }
    }

    /// The model in two or three words.
    pub fn title(&self) -> &'static str {
        match self {
            Self::Paper => "Paper model, unit depth",
            Self::Physiological(_) => "Physiological model",
        }
    }
}

/// What hits the eye.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, IntoStaticStr)]
#[serde(deny_unknown_fields)]
pub enum Impact {
    /// A force on an arc of the cornea that follows a given pulse in time.
    ForcePulse(ForcePulse),
    /// An object that flies at the eye.
    Projectile(Projectile),
}

impl Impact {
    /// Front angle that it comes from, in degrees.
    pub fn angle_deg(&self) -> f64 {
        match self {
            Self::ForcePulse(pulse) => pulse.angle_deg,
            Self::Projectile(projectile) => projectile.angle_deg,
        }
    }
}

/// A force on an arc of the cornea, along the inward normal at its middle.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(from = "WrittenPulse")]
pub struct ForcePulse {
    /// Peak of the total force, in N; of a table, the force that a share of 1 stands for.
    pub force_n: f64,
    /// Time from the start of the blow to the last force, in ms. A table is stretched so that its
    /// last knot falls there; a text with a table and no duration leaves its times as they are.
    pub duration_ms: f64,
    /// Front angle of the middle of the arc, in degrees: 0 at the corneal apex, positive above.
    pub angle_deg: f64,
    /// Half of the loaded arc, in degrees (the paper's "impact area").
    pub half_width_deg: f64,
    /// How the force rises and falls.
    pub shape: PulseShape,
}

impl Default for ForcePulse {
    fn default() -> Self {
        let shape = PulseShape::default();
        Self { force_n: 300.0, duration_ms: 0.2, angle_deg: 0.0, half_width_deg: 20.0, shape }
    }
}

impl ForcePulse {
    /// Takes a recorded curve with its own times.
    pub fn follow(&mut self, curve: Curve) {
        self.duration_ms = curve.last_ms();
        self.shape = PulseShape::Table(curve);
    }

    /// The largest force either way, in N.
    pub fn peak_n(&self) -> f64 {
        match &self.shape {
            PulseShape::Table(curve) => self.force_n * curve.peak(),
            _ => self.force_n,
        }
    }
}

/// A pulse as text gives it: a table brings its own duration.
#[derive(Deserialize)]
#[serde(rename = "ForcePulse", deny_unknown_fields, default)]
struct WrittenPulse {
    force_n: f64,
    duration_ms: Option<f64>,
    angle_deg: f64,
    half_width_deg: f64,
    shape: PulseShape,
}

impl Default for WrittenPulse {
    fn default() -> Self {
        let ForcePulse { force_n, angle_deg, half_width_deg, shape, .. } = ForcePulse::default();
        Self { force_n, duration_ms: None, angle_deg, half_width_deg, shape }
    }
}

impl From<WrittenPulse> for ForcePulse {
    fn from(written: WrittenPulse) -> Self {
        let WrittenPulse { force_n, duration_ms, angle_deg, half_width_deg, shape } = written;
        let own = match &shape {
            PulseShape::Table(curve) => curve.last_ms(),
            _ => Self::default().duration_ms,
        };
        let duration_ms = duration_ms.unwrap_or(own);
        Self { force_n, duration_ms, angle_deg, half_width_deg, shape }
    }
}

/// How the force of a pulse rises and falls.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, IntoStaticStr)]
#[serde(from = "WrittenShape")]
pub enum PulseShape {
    /// Constant, with raised-cosine edges.
    SmoothRectangle {
        /// Share of the duration that each edge takes, 0 to 0.5.
        edge_fraction: f64,
    },
    /// Linear rise to the middle, linear fall.
    Triangle,
    /// Half a sine.
    HalfSine,
    /// Recorded: straight lines between knots of a time and a share of the force.
    Table(Curve),
}

/// A shape as text gives it: a curve may stand in a file, which is read at once.
#[derive(Deserialize)]
#[serde(rename = "PulseShape", deny_unknown_fields)]
enum WrittenShape {
    SmoothRectangle {
        #[serde(default = "PulseShape::default_edge")]
        edge_fraction: f64,
    },
    Triangle,
    HalfSine,
    Table(Curve),
    Csv(CurveFile),
}

impl From<WrittenShape> for PulseShape {
    fn from(written: WrittenShape) -> Self {
        match written {
            WrittenShape::SmoothRectangle { edge_fraction } => {
                Self::SmoothRectangle { edge_fraction }
            }
            WrittenShape::Triangle => Self::Triangle,
            WrittenShape::HalfSine => Self::HalfSine,
            WrittenShape::Table(curve) | WrittenShape::Csv(CurveFile(curve)) => Self::Table(curve),
        }
    }
}

impl PulseShape {
    fn default_edge() -> f64 {
        0.1
    }
}

impl Default for PulseShape {
    fn default() -> Self {
        Self::SmoothRectangle { edge_fraction: Self::default_edge() }
    }
}

/// Anatomy, materials and mesh, by default those of Sathyanarayanan, Mahadas and Hung (2013).
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct EyeInput {
    /// Refinement level k: 15k+1 nodes a side. Level 1 is the paper's mesh.
    pub level: u32,
    /// Half-angle of the front opening of the orbit, in degrees.
    pub opening_deg: f64,
    /// Which springs have the lens modulus.
    pub lens: Lens,
    /// Which shell nodes the filaments join, in hops of level 1 (10 degrees each).
    pub filament_hops: Vec<u32>,
    /// Multiplies the stiffness of every filament; 0 leaves them out.
    pub filament_factor: f64,
    /// Half-angle of the retina from the posterior pole, in degrees.
    pub retina_deg: f64,
    /// Elastic modulus of the corneoscleral shell, in kPa.
    pub sclera_kpa: f64,
    /// Elastic modulus of the orbital fat, in kPa.
    pub fat_kpa: f64,
    /// Elastic modulus of the lens, in kPa.
    pub lens_kpa: f64,
    /// Elastic modulus of the rest of the globe, in kPa.
    pub rest_kpa: f64,
    /// Mass of the globe, in g, shared equally by its nodes.
    pub globe_mass_g: f64,
    /// Drag on a globe node of level 1, in N s/m.
    pub globe_drag_ns_m: f64,
    /// Drag on a fat node of level 1, in N s/m.
    pub fat_drag_ns_m: f64,
}

impl Default for EyeInput {
    fn default() -> Self {
        Self {
            level: 1,
            opening_deg: 40.0,
            lens: Lens::Auto,
            filament_hops: vec![2, 3, 4],
            filament_factor: 1.0,
            retina_deg: 129.6,
            sclera_kpa: 2600.0,
            fat_kpa: 47.0,
            lens_kpa: 6880.0,
            rest_kpa: 42.0,
            globe_mass_g: 7.5,
            globe_drag_ns_m: 0.705,
            fat_drag_ns_m: 1.44,
        }
    }
}

/// Which springs have the lens modulus; files may say `true` for `Auto` and `false` for `Soft`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, IntoStaticStr)]
pub enum Lens {
    /// By nodes at level 1, as in the paper, and by area at finer levels.
    #[default]
    #[serde(alias = "true")]
    Auto,
    /// Those with both ends in the lens.
    Nodes,
    /// Each for the share of its area that lies in the lens.
    Area,
    /// None: the lens is as soft as what is around it.
    #[serde(alias = "false")]
    Soft,
}

/// How the equations of motion are solved.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct NumericsInput {
    /// The integrator; none, spelled `Auto`, lets the program choose.
    #[serde(with = "integrator")]
    pub integrator: Option<Integrator>,
    /// The step, in us; none lets the program take one from the stability bound.
    #[serde(deserialize_with = "auto::deserialize")]
    pub step_us: Option<f64>,
    /// How much of the eye is computed.
    pub geometry: Geometry,
}

impl NumericsInput {
    /// The same eye, solved as the program chooses.
    #[must_use]
    pub fn automatic(&self) -> Self {
        Self { geometry: self.geometry, ..Self::default() }
    }
}
