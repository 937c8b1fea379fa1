//! The one registry of everything in a scenario that can be set.
//!
//! The checks of a file, the command line's `--set`, forms and sweeps all read [`FIELDS`]. Rules
//! that join two fields are in `check`, the reading of typed text is in `set`.

mod words;

use self::words::Directions;
use crate::scenario::{
    FASTEST_M_S, ForcePulse, Geometry, Impact,
    auto::AUTO,
    direction::{FARTHEST_AIM_MM, HOURS},
};
use crate::scenario::{Integrator, Lens, Model, Outline, Physiological, Projectile};
use crate::scenario::{ProjectileStiffness, PulseShape, Rim, Scenario, Side, Species, Support};
use crate::scenario::{Surface, integrator, problem::plain};

/// Characters that a name may have.
pub const LONGEST_NAME: usize = 80;

/// A field of a scenario.
pub struct Field {
    /// Dotted path, as in `impact.force_n`.
    pub path: &'static str,
    /// A few words for a form or a heading.
    pub label: &'static str,
    /// Unit for display; empty where there is none.
    pub unit: &'static str,
    /// What it means, in a few words for those who meet it first.
    pub help: &'static str,
    /// What kind of value it holds, what it may be, and how to reach it.
    pub kind: Kind,
}

/// What a field holds, with its bounds (inclusive) and its place in a scenario.
pub enum Kind {
    /// A finite number.
    Number(Bounds, Place<f64>),
    /// A finite number, or none.
    OptionalNumber(Bounds, Place<Option<f64>>),
    /// A whole number.
    Integer(u32, u32, Place<u32>),
    /// One variant of an enum, by name.
    Choice(&'static (dyn Choices + Sync)),
    /// A set of whole numbers between the first two, at most as many as the third.
    Integers(u32, u32, usize, Place<Vec<u32>>),
    /// Text of 1 character to this many.
    Text(usize, Place<String>),
}

/// The bounds of a number and how far one key press moves it.
#[derive(Debug, Clone, Copy)]
pub struct Bounds {
    /// Least value allowed.
    pub min: f64,
    /// Greatest value allowed.
    pub max: f64,
    /// A small step.
    pub fine: f64,
    /// A large step.
    pub coarse: f64,
}

impl Bounds {
    /// What is wrong with a number, if anything.
    pub(super) fn refuse(self, number: f64) -> Option<&'static str> {
        if !number.is_finite() {
            return Some("is not a finite number");
        }
        (!(self.min..=self.max).contains(&number)).then_some("is out of range")
    }
}

/// How to reach a value; `None` where the present variant has no such field.
pub struct Place<T: 'static> {
    /// Gives the value to read.
    pub get: fn(&Scenario) -> Option<&T>,
    /// Gives the value to change.
    pub get_mut: fn(&mut Scenario) -> Option<&mut T>,
}

/// A field that holds one of several variants.
pub trait Choices {
    /// The names of the variants as RON has them, those that a name alone makes.
    fn names(&self) -> Vec<&'static str>;
    /// What else may be written in full.
    fn written(&self) -> &'static [&'static str] {
        &[]
    }
    /// Other words for a variant, each with its name.
    fn synonyms(&self) -> &'static [(&'static str, &'static str)] {
        &[]
    }
    /// Why a word that a person may well type means no variant; `None` of any other word.
    fn unclear(&self, _typed: &str) -> Option<&'static str> {
        None
    }
    /// The present variant; `None` where the scenario has no such field.
    fn get(&self, scenario: &Scenario) -> Option<&'static str>;
    /// Takes the named variant by default, or keeps it; `false` without such a variant or field.
    fn set(&self, scenario: &mut Scenario, name: &str) -> bool;
}

/// Variants by name; what cannot be made from its name alone is kept by it.
struct OneOf<T: 'static> {
    /// Those that a name alone makes, with their default content.
    variants: fn() -> Vec<T>,
    place: Place<T>,
    name: fn(&T) -> &'static str,
    written: &'static [&'static str],
}

const fn one_of<T>(variants: fn() -> Vec<T>, place: Place<T>) -> OneOf<T>
where
    for<'a> &'a T: Into<&'static str>,
{
    OneOf { variants, place, name: |value| value.into(), written: &[] }
}

impl<T> Choices for OneOf<T> {
    fn names(&self) -> Vec<&'static str> {
        (self.variants)().iter().map(self.name).collect()
    }

    fn written(&self) -> &'static [&'static str] {
        self.written
    }

    fn get(&self, scenario: &Scenario) -> Option<&'static str> {
        (self.place.get)(scenario).map(self.name)
    }

    fn set(&self, scenario: &mut Scenario, name: &str) -> bool {
        let Some(value) = (self.place.get_mut)(scenario) else { return false };
        let named = |value: &T| (self.name)(value) == name;
        if !named(value) {
            let Some(fresh) = (self.variants)().into_iter().find(named) else { return false };
            *value = fresh;
        }
        true
    }
}

/// Both accessors of a field that is always there.
macro_rules! at {
    ($($part:ident).+) => {
        Place { get: |s| Some(&s.$($part).+), get_mut: |s| Some(&mut s.$($part).+) }
    };
}

/// Both accessors of a part that a scenario may have.
macro_rules! within {
    ($get:ident, $get_mut:ident $(, $part:ident)*) => {
        Place {
            get: |s| Some(&s.$get()?$(.$part)*),
            get_mut: |s| Some(&mut s.$get_mut()?$(.$part)*),
        }
    };
}

/// Both accessors of what some variants of a part of the impact hold.
macro_rules! of_variant {
    ($get:ident, $get_mut:ident, $part:ident, $held:ident in $variant:pat) => {
        Place {
            get: |s| match &s.$get()?.$part {
                $variant => Some($held),
                _ => None,
            },
            get_mut: |s| match &mut s.$get_mut()?.$part {
                $variant => Some($held),
                _ => None,
            },
        }
    };
}

/// A length of the orbit's rim.
macro_rules! rim {
    ($length:ident, $direction:ident) => {
        Number(b(0.0, 40.0, 0.5, 2.0), within!(orbit, orbit_mut, rim, $length, $direction))
    };
}

/// Both accessors of a field that only the Paper model has.
macro_rules! of_section {
    ($part:ident) => {
        within!(section, section_mut, eye, $part)
    };
}

/// The field whose bounds hang on what hits which eye.
const ANGLE_PATH: &str = "impact.angle_deg";

/// Both impacts have an angle.
const ANGLE: Place<f64> = Place {
    get: |s| match &s.impact {
        Impact::ForcePulse(pulse) => Some(&pulse.angle_deg),
        Impact::Projectile(projectile) => Some(&projectile.angle_deg),
    },
    get_mut: |s| match &mut s.impact {
        Impact::ForcePulse(pulse) => Some(&mut pulse.angle_deg),
        Impact::Projectile(projectile) => Some(&mut projectile.angle_deg),
    },
};

const SHAPES: OneOf<PulseShape> = OneOf {
    written: &["Table([(t_ms, share), ...])", "Csv(\"file.csv\")"],
    ..one_of(
        || vec![PulseShape::default(), PulseShape::Triangle, PulseShape::HalfSine],
        within!(pulse, pulse_mut, shape),
    )
};
const RIMS: OneOf<Rim> = OneOf {
    variants: || Rim::NAMED.map(|(_, rim)| rim).to_vec(),
    place: within!(orbit, orbit_mut, rim),
    name: Rim::name,
    written: &[],
};
const INTEGRATORS: OneOf<Option<Integrator>> = OneOf {
    variants: || integrator::choices().collect(),
    place: at!(numerics.integrator),
    name: |choice| integrator::spelling(*choice),
    written: &[],
};

type Words = &'static str;

const fn field(path: Words, label: Words, unit: Words, help: Words, kind: Kind) -> Field {
    Field { path, label, unit, help, kind }
}

/// Bounds with a small and a large step.
const fn b(min: f64, max: f64, fine: f64, coarse: f64) -> Bounds {
    Bounds { min, max, fine, coarse }
}

use Kind::{Choice, Integer, Integers, Number, OptionalNumber, Text};

/// Every field, in the order in which a form shows them.
#[rustfmt::skip]
pub static FIELDS: &[Field] = &[
    field("name", "Name", "", "What lists and pages call this blow", Text(LONGEST_NAME, at!(name))),
    field("model", "Model", "", "The paper's springs in a flat section, or a round eye of tissues", Choice(&one_of(|| vec![Model::Paper, Model::Physiological(Physiological::default())], at!(model)))),
    field("model.species", "Species", "", "Whose eye: it sets the thickness of the walls", Choice(&one_of(|| vec![Species::Human, Species::Pig], within!(physiological, physiological_mut, species)))),
    field("model.eye_side", "Which eye", "", "The nose lies at 3 o'clock of the right eye, at 9 of the left", Choice(&one_of(|| vec![Side::Right, Side::Left], within!(physiological, physiological_mut, eye_side)))),
    field("model.support", "Held by", "", "What holds the globe: fat and bone, gelatin in a cup, or nothing", Choice(&one_of(|| vec![Support::Orbit, Support::Gelatin, Support::Free], within!(physiological, physiological_mut, support)))),
    field("model.globe_bulk_mpa", "Globe bulk modulus", "MPa", "How hard vitreous and lens are to compress", Number(b(10.0, 2200.0, 10.0, 100.0), within!(physiological, physiological_mut, globe_bulk_mpa))),
    field("model.vitreous_shear_pa", "Vitreous shear", "Pa", "How stiff the vitreous is against shear", Number(b(0.0, 1e5, 1.0, 10.0), within!(physiological, physiological_mut, vitreous_shear_pa))),
    field("model.vitreous_viscosity_pa_s", "Vitreous viscosity", "Pa s", "How thick the vitreous flows", Number(b(0.0, 100.0, 0.01, 0.1), within!(physiological, physiological_mut, vitreous_viscosity_pa_s))),
    field("model.lens_shear_kpa", "Lens shear", "kPa", "How stiff the lens is against shear", Number(b(0.0, 1e4, 1.0, 10.0), within!(physiological, physiological_mut, lens_shear_kpa))),
    field("model.sclera_mpa", "Sclera, at failure", "MPa", "Stiffness of the white of the eye when it tears", Number(b(0.1, 2e3, 1.0, 10.0), within!(physiological, physiological_mut, sclera_mpa))),
    field("model.cornea_mpa", "Cornea, at failure", "MPa", "Stiffness of the cornea when it tears", Number(b(0.1, 2e3, 1.0, 10.0), within!(physiological, physiological_mut, cornea_mpa))),
    field("model.sclera_thickness", "Sclera thickness", "x", "Multiplies the thickness of the sclera", Number(b(0.1, 10.0, 0.1, 0.5), within!(physiological, physiological_mut, sclera_thickness))),
    field("model.cornea_thickness", "Cornea thickness", "x", "Multiplies the thickness of the cornea", Number(b(0.1, 10.0, 0.1, 0.5), within!(physiological, physiological_mut, cornea_thickness))),
    field("model.fat_bulk_mpa", "Fat bulk modulus", "MPa", "How hard the fat around the globe is to compress", Number(b(0.05, 2200.0, 0.1, 1.0), within!(orbit, orbit_mut, fat_bulk_mpa))),
    field("model.fat_shear_kpa", "Fat shear", "kPa", "How stiff the fat around the globe is against shear", Number(b(0.0, 1e4, 1.0, 10.0), within!(orbit, orbit_mut, fat_shear_kpa))),
    field("model.orbit_opening_deg", "Orbit opening", "deg", "Angle from the front at which fat and bone begin", Number(b(40.0, 120.0, 1.0, 10.0), within!(orbit, orbit_mut, orbit_opening_deg))),
    field("model.rim", "Orbit's rim", "", "Whose bone: it sets the eight lengths of the rim below", Choice(&RIMS)),
    field("model.rim.depth_mm.above", "Brow rim depth", "mm", "How far behind the cornea's apex the rim lies above", rim!(depth_mm, above)),
    field("model.rim.depth_mm.nose", "Nose rim depth", "mm", "How far behind the cornea's apex the rim lies at the nose", rim!(depth_mm, nose)),
    field("model.rim.depth_mm.below", "Cheek rim depth", "mm", "How far behind the cornea's apex the rim lies below", rim!(depth_mm, below)),
    field("model.rim.depth_mm.temple", "Temple rim depth", "mm", "How far behind the cornea's apex the rim lies at the temple", rim!(depth_mm, temple)),
    field("model.rim.gap_mm.above", "Brow rim gap", "mm", "Between the globe and the rim above", rim!(gap_mm, above)),
    field("model.rim.gap_mm.nose", "Nose rim gap", "mm", "Between the globe and the rim at the nose", rim!(gap_mm, nose)),
    field("model.rim.gap_mm.below", "Cheek rim gap", "mm", "Between the globe and the rim below", rim!(gap_mm, below)),
    field("model.rim.gap_mm.temple", "Temple rim gap", "mm", "Between the globe and the rim at the temple", rim!(gap_mm, temple)),
    field("model.gelatin_bulk_mpa", "Gelatin bulk mod.", "MPa", "How hard the gelatin is to compress", Number(b(0.05, 2200.0, 10.0, 100.0), within!(gelatin, gelatin_mut, gelatin_bulk_mpa))),
    field("model.gelatin_shear_kpa", "Gelatin shear", "kPa", "How stiff the gelatin is against shear", Number(b(0.0, 1e4, 1.0, 10.0), within!(gelatin, gelatin_mut, gelatin_shear_kpa))),
    field("model.gelatin_opening_deg", "Gelatin opening", "deg", "Angle from the front at which gelatin and cup begin", Number(b(20.0, 120.0, 1.0, 10.0), within!(gelatin, gelatin_mut, gelatin_opening_deg))),
    field("impact", "Impact", "", "A given force on the cornea, or an object that flies at it", Choice(&one_of(|| vec![Impact::ForcePulse(ForcePulse::default()), Impact::Projectile(Projectile::default())], at!(impact)))),
    field("impact.force_n", "Peak force", "N", "The largest force on the loaded arc", Number(b(0.0, 1e5, 10.0, 100.0), within!(pulse, pulse_mut, force_n))),
    field("impact.duration_ms", "Duration", "ms", "From the first force to the last", Number(b(1e-4, 100.0, 0.01, 0.1), within!(pulse, pulse_mut, duration_ms))),
    field("impact.mass_g", "Mass", "g", "Of the object that hits the eye", Number(b(1e-3, 1e4, 0.1, 1.0), within!(projectile, projectile_mut, mass_g))),
    field("impact.diameter_mm", "Diameter", "mm", "Of the object that hits the eye", Number(b(0.1, 500.0, 0.1, 1.0), within!(projectile, projectile_mut, diameter_mm))),
    field("impact.speed_m_s", "Speed", "m/s", "Of the object when it touches the eye", Number(b(1e-2, FASTEST_M_S, 1.0, 10.0), within!(projectile, projectile_mut, speed_m_s))),
    field("impact.from", "Comes from", "", "The side that it comes from; its angle and hour follow", Choice(&Directions)),
    field(ANGLE_PATH, "Angle", "deg", "0 is straight on, below 0 from the other side; an object within 75", Number(b(-120.0, 120.0, 1.0, 10.0), ANGLE)),
    field("impact.angle_clock", "Hour of angle", "h", "12 above, 6 below; 3 the nose of a right eye, 9 of a left", Number(b(0.0, HOURS, 0.5, 3.0), within!(projectile, projectile_mut, angle_clock))),
    field("impact.offset_mm", "Off centre", "mm", "How far beside the middle of the cornea it aims", Number(b(0.0, FARTHEST_AIM_MM, 0.5, 2.0), within!(projectile, projectile_mut, offset_mm))),
    field("impact.offset_clock", "Aims towards", "h", "The hour towards which it aims beside the middle", Number(b(0.0, HOURS, 0.5, 3.0), within!(projectile, projectile_mut, offset_clock))),
    field("impact.stiffness", "Stiffness", "", "Whether the object as a whole gives way like a spring", Choice(&one_of(|| vec![ProjectileStiffness::Rigid, ProjectileStiffness::LINEAR], within!(projectile, projectile_mut, stiffness)))),
    field("impact.stiffness.n_per_m", "Spring stiffness", "N/m", "Force that it takes to shorten the object", Number(b(1.0, 1e9, 1e3, 1e4), of_variant!(projectile, projectile_mut, stiffness, n_per_m in ProjectileStiffness::Linear { n_per_m }))),
    field("impact.outline", "Shape", "", "A ball, or a rod with a flat end", Choice(&one_of(|| vec![Outline::Sphere, Outline::CYLINDER], within!(projectile, projectile_mut, outline)))),
    field("impact.outline.edge_mm", "Edge radius", "mm", "How round the edge of the flat end is", Number(b(0.01, 100.0, 0.1, 1.0), of_variant!(projectile, projectile_mut, outline, edge_mm in Outline::Cylinder { edge_mm }))),
    field("impact.surface", "Surface", "", "Hard, solid and elastic, gas or foam, or liquid in a skin", Choice(&one_of(|| vec![Surface::Hard, Surface::ELASTIC, Surface::INFLATED, Surface::Splashing], within!(projectile, projectile_mut, surface)))),
    field("impact.surface.kpa", "Gives way at", "kPa", "The pressure beyond which its surface gives way", Number(b(1.0, 1e5, 1.0, 10.0), of_variant!(projectile, projectile_mut, surface, kpa in Surface::Inflated { kpa, .. }))),
    field("impact.surface.modulus_mpa", "Contact stiffness", "MPa", "How stiff its surface is at first touch", Number(b(1e-3, 1e6, 0.1, 1.0), of_variant!(projectile, projectile_mut, surface, modulus_mpa in Surface::Elastic { modulus_mpa } | Surface::Inflated { modulus_mpa, .. }))),
    field("impact.restitution", "Restitution", "", "Share of its speed that it keeps off a rigid wall", Number(b(0.0, 1.0, 0.01, 0.1), within!(lossy, lossy_mut, restitution))),
    field("impact.half_width_deg", "Half width", "deg", "Half of the arc that the force acts on", Number(b(1e-3, 90.0, 1.0, 5.0), within!(pulse, pulse_mut, half_width_deg))),
    field("impact.shape", "Pulse shape", "", "How the force rises and falls", Choice(&SHAPES)),
    field("impact.shape.edge_fraction", "Edge, of duration", "", "Share of the duration in which the force rises, and falls", Number(b(0.0, 0.5, 0.01, 0.1), of_variant!(pulse, pulse_mut, shape, edge_fraction in PulseShape::SmoothRectangle { edge_fraction }))),
    field("window_ms", "Simulated time", "ms", "How long to watch from the first contact on; auto until it is over", OptionalNumber(b(1e-3, 1e3, 0.1, 1.0), at!(window_ms))),
    field("eye.level", "Mesh level", "", "A finer mesh is slower and off by less", Integer(1, 8, at!(eye.level))),
    field("eye.opening_deg", "Orbit opening", "deg", "Angle from the front at which bone begins", Number(b(1.0, 120.0, 1.0, 10.0), of_section!(opening_deg))),
    field("eye.lens", "Stiff lens", "", "Which springs are as stiff as the lens", Choice(&one_of(|| vec![Lens::Auto, Lens::Nodes, Lens::Area, Lens::Soft], of_section!(lens)))),
    field("eye.filament_hops", "Filament hops", "", "How many nodes of the shell apart the filaments join", Integers(1, 17, 8, of_section!(filament_hops))),
    field("eye.filament_factor", "Filament stiffness", "x", "Multiplies the stiffness of the filaments; 0 leaves them out", Number(b(0.0, 1e3, 0.1, 1.0), of_section!(filament_factor))),
    field("eye.retina_deg", "Retina half-angle", "deg", "How far the retina reaches from the back of the eye", Number(b(0.0, 180.0, 1.0, 10.0), of_section!(retina_deg))),
    field("eye.sclera_kpa", "Sclera modulus", "kPa", "Stiffness of sclera and cornea", Number(b(1e-3, 1e8, 10.0, 100.0), of_section!(sclera_kpa))),
    field("eye.fat_kpa", "Fat modulus", "kPa", "Stiffness of the fat behind the globe", Number(b(1e-3, 1e8, 1.0, 10.0), of_section!(fat_kpa))),
    field("eye.lens_kpa", "Lens modulus", "kPa", "Stiffness of the lens", Number(b(1e-3, 1e8, 10.0, 100.0), of_section!(lens_kpa))),
    field("eye.rest_kpa", "Rest modulus", "kPa", "Stiffness of the rest of the globe", Number(b(1e-3, 1e8, 1.0, 10.0), of_section!(rest_kpa))),
    field("eye.globe_mass_g", "Globe mass", "g", "Shared by all nodes of the globe", Number(b(0.1, 100.0, 0.1, 1.0), of_section!(globe_mass_g))),
    field("eye.globe_drag_ns_m", "Globe drag", "N s/m", "What slows each node of the globe", Number(b(0.0, 1e3, 0.01, 0.1), of_section!(globe_drag_ns_m))),
    field("eye.fat_drag_ns_m", "Fat drag", "N s/m", "What slows each node of the fat", Number(b(0.0, 1e3, 0.01, 0.1), of_section!(fat_drag_ns_m))),
    field("numerics.integrator", "Integrator", "", "How the motion is computed; Auto chooses for you", Choice(&INTEGRATORS)),
    field("numerics.step_us", "Time step", "µs", "Time between two states; auto takes a stable one", OptionalNumber(b(1e-6, 1e3, 0.01, 0.1), at!(numerics.step_us))),
    field("numerics.geometry", "Eye computed", "", "Auto: no more of the eye than the blow needs", Choice(&one_of(|| vec![Geometry::Auto, Geometry::Axisymmetric, Geometry::Half, Geometry::Full], Place { get: Scenario::choosing, get_mut: Scenario::choosing_mut }))),
];

/// The field at a dotted path.
pub fn find(path: &str) -> Option<&'static Field> {
    FIELDS.iter().find(|field| field.path == path)
}

impl Field {
    /// The present value as [`crate::scenario::set::set`] takes it, where there is such a field.
    pub fn text(&self, scenario: &Scenario) -> Option<String> {
        match &self.kind {
            Number(_, place) => (place.get)(scenario)
                .map(|number| plain(*number) + &crate::scenario::doubt::suffix(self, scenario)),
            OptionalNumber(_, place) => {
                (place.get)(scenario).map(|number| number.map_or(AUTO.to_owned(), plain))
            }
            Integer(_, _, place) => (place.get)(scenario).map(u32::to_string),
            Choice(choices) => choices.get(scenario).map(str::to_owned),
            Integers(_, _, _, place) => (place.get)(scenario).map(|list| format!("{list:?}")),
            Text(_, place) => (place.get)(scenario).cloned(),
        }
    }

    /// The bounds of a number in a scenario: how steep a blow may be hangs on what hits which eye.
    pub fn bounds_in(&self, scenario: &Scenario) -> Option<Bounds> {
        let (Number(bounds, _) | OptionalNumber(bounds, _)) = &self.kind else { return None };
        if self.path != ANGLE_PATH {
            return Some(*bounds);
        }
        let steepest = scenario.steepest_deg();
        Some(Bounds { min: -steepest, max: steepest, ..*bounds })
    }

    /// What the field accepts in a scenario, in words: each eye has levels of its own.
    pub fn allowed_in(&self, scenario: &Scenario) -> String {
        match &self.kind {
            Number(bounds, _) => self.between(&self.bounds_in(scenario).unwrap_or(*bounds)),
            Integer(min, max, _) => {
                format!("whole numbers {min} to {}", scenario.finest_level().min(*max))
            }
            _ => self.allowed(),
        }
    }

    /// Bounds in words.
    fn between(&self, Bounds { min, max, .. }: &Bounds) -> String {
        let words = format!("{} to {} {}", plain(*min), plain(*max), self.unit);
        words.trim_end().to_owned()
    }

    /// What the field accepts, in words.
    pub fn allowed(&self) -> String {
        match &self.kind {
            Number(bounds, _) => self.between(bounds),
            OptionalNumber(bounds, _) => format!("{AUTO}, or {}", self.between(bounds)),
            Integer(min, max, _) => format!("whole numbers {min} to {max}"),
            Choice(choices) => [&choices.names(), choices.written()].concat().join(", "),
            Integers(min, max, most, _) => {
                format!("a list of at most {most} different whole numbers, each {min} to {max}")
            }
            Text(most, _) => format!("1 to {most} characters, none of them a control character"),
        }
    }
}

#[cfg(test)]
pub(crate) mod tests;
