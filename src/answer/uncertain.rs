//! How far published measurements of the eye differ, and what an ensemble draws from.
//!
//! [`SPREADS`] holds one line for each material or measure with a published range. It counts where
//! the scenario holds the nominal value of that field: a value of one's own is taken at its word,
//! and a doubt (`± 20`, or `± 0` for a known value) takes the place of the line.
//!
//! The Paper model's lens (6880 kPa) and fat (47 kPa) stand at the upper end of what was measured,
//! so the band of an ensemble need not lie round the single result.
//!
//! Left out: `eye.rest_kpa`. The vitreous is a fluid whose shear modulus was measured three to
//! four orders below the nominal 42 kPa, which in this model stands for what keeps the globe's
//! volume; drawn from the measurements the mesh would have nothing to hold it. Left out too:
//! densities and correlations between tissues, for which no spread is published.

use crate::normal;
use crate::scenario::fields::{Bounds, FIELDS, Field};
use crate::scenario::{Geometry, Model, Physiological, Rim, Scenario, Support, fields, set};
use crate::scenario::{direction::HOURS, direction::Side, doubt::number};
use std::f64::consts::PI;

/// A distribution.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Shape {
    /// Every factor as likely as its inverse, from the first to the second.
    LogUniform(f64, f64),
    /// Every value equally likely, from the first to the second.
    Uniform(f64, f64),
    /// Mean and standard deviation, cut off at the field's bounds.
    Normal(f64, f64),
}

/// One line: what was measured of one field.
pub struct Spread {
    /// The field.
    pub path: &'static str,
    /// The value that the model takes unless told otherwise.
    pub nominal: f64,
    /// The range that was measured.
    pub shape: Shape,
    /// The source of that range.
    pub source: &'static str,
}

/// Damping ratios from 0.05 to 0.5 cover what the sources allow.
const DAMPING: (f64, f64) = (0.05, 0.5);
const DAMPING_SOURCE: &str =
    "damping ratio 0.05 to 0.5 (paper: eye 0.1, fat 0.22); lens tissue overdamped (Schachar)";

/// A drag whose nominal value gives `ratio`, over all damping ratios: the two are in proportion.
const fn drag(path: &'static str, nominal: f64, ratio: f64) -> Spread {
    let shape = Shape::LogUniform(nominal * DAMPING.0 / ratio, nominal * DAMPING.1 / ratio);
    spread(path, nominal, shape).by(DAMPING_SOURCE)
}

const fn spread(path: &'static str, nominal: f64, shape: Shape) -> Spread {
    Spread { path, nominal, shape, source: "" }
}

impl Spread {
    const fn by(self, source: &'static str) -> Self {
        Self { source, ..self }
    }
}

/// Every published spread.
pub static SPREADS: &[Spread] = &[
    spread("eye.sclera_kpa", 2600.0, Shape::LogUniform(1e3, 30e3))
        .by("quasi-static 2.9 ± 2.0 MPa (Eilaghi 2010) to ten times that at 29 /s (Kim 2012)"),
    spread("eye.lens_kpa", 6880.0, Shape::LogUniform(1.0, 6880.0))
        .by("20 Pa shear (Schachar) to 6.88 MPa (paper); the centre stiffens 10^4 times by age \
             (Weeber)"),
    spread("eye.fat_kpa", 47.0, Shape::LogUniform(0.9, 47.0))
        .by("0.9 kPa from 290 Pa shear, long-term (Yoo 2011), to 47 kPa (paper)"),
    spread("eye.globe_mass_g", 7.5, Shape::Normal(7.5, 7.5 * 1.57 / 24.51))
        .by("in proportion to the axial length of 24.51 ± 1.57 mm (Nagra 2017)"),
    drag("eye.globe_drag_ns_m", 0.705, 0.1),
    drag("eye.fat_drag_ns_m", 1.44, 0.22),
    spread("model.sclera_mpa", 138.0, Shape::LogUniform(69.0, 276.0))
        .by("a factor of two either way: stiffness of eyes is spread by 2.0 of 2.9 MPa (Eilaghi \
             2010)"),
    spread("model.sclera_thickness", 1.0, Shape::Normal(1.0, 0.14 / 0.53))
        .by("0.53 ± 0.14 mm at the limbus, 0.39 ± 0.17 mm at the equator (Olsen 1998)"),
    spread("model.lens_shear_kpa", 10.0, Shape::LogUniform(0.02, 6880.0 / 3.0))
        .by("20 Pa (Schachar) to a third of 6.88 MPa (paper); the centre stiffens 10^4 times by \
             age (Weeber)"),
    spread("model.fat_shear_kpa", 15.7, Shape::LogUniform(0.29, 15.7))
        .by("290 Pa, long-term (Yoo 2011), to a third of 47 kPa (Power 2002)"),
    spread("model.fat_bulk_mpa", 0.40, Shape::LogUniform(0.20, 0.55))
        .by("fits published tests nearly as well as 0.40 (contrecoup verify fit)"),
];

/// An input that is not known and that an ensemble draws.
#[derive(Clone)]
pub struct UncertainInput {
    /// The field of the scenario that it stands for.
    pub field: &'static Field,
    /// The value in the scenario.
    pub nominal: f64,
    /// The distribution that it is drawn from.
    pub shape: Shape,
    /// What it is drawn within.
    bounds: (f64, f64),
    /// Whether it is the mirror image of what a right eye draws: an hour of a left one.
    mirrored: bool,
    /// The published source; none where the person doubts the value.
    pub source: Option<&'static str>,
}

impl UncertainInput {
    /// A field of `scenario` that is drawn from `shape`; none where the scenario lacks it.
    fn new(
        field: &'static Field,
        scenario: &Scenario,
        shape: Shape,
        source: Option<&'static str>,
    ) -> Option<Self> {
        let (nominal, Bounds { min, max, .. }) = number(field, scenario)?;
        // An hour goes once round.
        let round = (nominal - 0.5 * HOURS, nominal + 0.5 * HOURS);
        let bounds = if is_clock(field) { round } else { (min, max) };
        let mirrored = is_clock(field) && scenario.eye_side() == Side::Left;
        Some(Self { field, nominal, shape, bounds, mirrored, source })
    }

    /// What a source says of a field; none where the person doubts it themselves.
    fn published(
        field: &'static Field,
        scenario: &Scenario,
        shape: Shape,
        source: &'static str,
    ) -> Option<Self> {
        let own = scenario.doubt.contains_key(field.path);
        Self::new(field, scenario, shape, Some(source)).filter(|_| !own)
    }

    /// The value below which the share `u` of the draws lies; above which, where it is mirrored.
    pub fn value(&self, u: f64) -> f64 {
        let (min, max) = self.bounds;
        let u = if self.mirrored { 1.0 - u } else { u };
        let value = match self.shape {
            Shape::LogUniform(low, high) => low * libm::pow(high / low, u),
            Shape::Uniform(low, high) => low + u * (high - low),
            Shape::Normal(mean, sd) => normal::cut_off(mean, sd, self.bounds, u),
        };
        value.clamp(min, max)
    }

    /// Whether the scenario's value lies among the outermost twentieth of the draws to either side.
    pub fn stands_at_an_end(&self) -> bool {
        // A nominal hour is the middle of its draws.
        !is_clock(self.field)
            && (self.nominal < self.value(0.05) || self.nominal > self.value(0.95))
    }
}

/// Puts a value of each input into a scenario.
pub fn put(scenario: &mut Scenario, inputs: &[UncertainInput], values: &[f64]) {
    let hour = |value: f64| value.rem_euclid(HOURS);
    let value = |field: &Field, value| if is_clock(field) { hour(value) } else { value };
    let numbers = inputs.iter().zip(values).map(|(input, drawn)| (input.field, *drawn));
    set::put_numbers(scenario, numbers.map(|(field, drawn)| (field, value(field, drawn))));
}

/// Standard deviations, not measured, of an object's angle, in degrees, and where it hits, in mm.
const AIM: (f64, f64) = (10.0, 2.0);
const AIM_SOURCE: &str = "a guess of ours, 10 degrees and 2 mm: nobody measured how eyes are hit";

/// Where an object comes from and what it aims at.
fn aim(scenario: &Scenario) -> Vec<UncertainInput> {
    // Straight on is what a person means who says nothing else.
    let turns = scenario.is_spatial();
    let Some(projectile) = scenario.projectile().filter(|_| turns) else { return Vec::new() };
    // Off the axis an hour is known as well as the distance is.
    let hours = |hour: f64, off: f64, sd: f64| {
        let sd = sd / off * 0.5 * HOURS / PI;
        let all_round = Shape::Uniform(hour - 0.5 * HOURS, hour + 0.5 * HOURS);
        if sd < 0.25 * HOURS { Shape::Normal(hour, sd) } else { all_round }
    };
    let (angle, offset) = (projectile.angle_deg, projectile.offset_mm);
    let all = [
        ("impact.angle_deg", Shape::Normal(angle, AIM.0)),
        ("impact.offset_mm", Shape::Normal(offset, AIM.1)),
        ("impact.angle_clock", hours(projectile.angle_clock, angle, AIM.0)),
        ("impact.offset_clock", hours(projectile.offset_clock, offset, AIM.1)),
    ];
    let input =
        |(path, shape)| UncertainInput::published(fields::find(path)?, scenario, shape, AIM_SOURCE);
    all.into_iter().filter_map(input).collect()
}

/// Where the paths of the rim's lengths begin.
const RIM: &str = "model.rim.";
const RIM_SOURCE: &str = "15 orbits by computed tomography (Arch Facial Plast Surg 2011;13:51)";

/// The rim of an orbit, where the eye is computed in it and nobody gave it lengths of their own.
fn rim(scenario: &Scenario) -> Vec<UncertainInput> {
    let measured = |model: &&Physiological| {
        let full = scenario.geometry() == Some(Geometry::Full);
        full && model.support == Support::Orbit && model.rim.name() != "Own"
    };
    let Some(model) = scenario.physiological().filter(measured) else { return Vec::new() };
    let spread = Scenario {
        model: Model::Physiological(Physiological { rim: Rim::SPREAD, ..*model }),
        ..Scenario::default()
    };
    let input = |field: &'static Field| {
        let shape = Shape::Normal(number(field, scenario)?.0, number(field, &spread)?.0);
        UncertainInput::published(field, scenario, shape, RIM_SOURCE)
    };
    FIELDS.iter().filter(|field| field.path.starts_with(RIM)).filter_map(input).collect()
}

/// Whether a field holds an hour of the clock.
fn is_clock(field: &Field) -> bool {
    field.path.ends_with("_clock")
}

/// What an ensemble draws: first what the person doubts, then what is published.
pub fn inputs(scenario: &Scenario) -> Vec<UncertainInput> {
    let doubted = FIELDS.iter().filter_map(|field| {
        let (value, _) = number(field, scenario)?;
        let sd = scenario.doubt.get(field.path).filter(|sd| **sd > 0.0)?;
        UncertainInput::new(field, scenario, Shape::Normal(value, *sd), None)
    });
    let published = SPREADS.iter().filter_map(|spread| {
        let field = fields::find(spread.path)?;
        UncertainInput::published(field, scenario, spread.shape, spread.source)
            .filter(|input| input.nominal == spread.nominal)
    });
    let aimed = aim(scenario).into_iter().chain(rim(scenario));
    doubted.chain(published).chain(aimed).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scenario::set::set;

    /// A scenario that has the field.
    fn with(path: &str) -> Scenario {
        let mut scenario = Scenario::default();
        if path.starts_with("model.") {
            set(&mut scenario, "model", "Physiological").unwrap();
        }
        scenario
    }

    fn paths(scenario: &Scenario) -> Vec<&'static str> {
        inputs(scenario).iter().map(|i| i.field.path).collect()
    }

    #[test]
    fn every_line_is_of_a_field_that_exists_and_fits_its_bounds() {
        for spread in SPREADS {
            let field = fields::find(spread.path).expect(spread.path);
            assert!(!spread.source.is_empty());
            let scenario = with(spread.path);
            let (value, bounds) = number(field, &scenario).expect(spread.path);
            assert_eq!(value, spread.nominal, "{}", spread.path);
            let input = inputs(&scenario);
            let input = input.iter().find(|i| i.field.path == spread.path).unwrap();
            let (low, high) = (input.value(1e-6), input.value(1.0 - 1e-6));
            assert!(bounds.min <= low && low < high && high <= bounds.max);
            let middle = input.value(0.5);
            // A bound that cuts one side off moves the middle a little.
            let (expected, near) = match spread.shape {
                Shape::LogUniform(a, b) => ((a * b).sqrt(), 1e-12),
                Shape::Uniform(a, b) => (0.5 * (a + b), 1e-12),
                Shape::Normal(mean, _) => (mean, 1e-3),
            };
            assert!((middle / expected - 1.0).abs() < near, "{}", spread.path);
        }
    }

    #[test]
    fn a_doubt_takes_the_place_of_what_is_published() {
        let mut scenario = Scenario::default();
        let (all, other) = (paths(&scenario).len(), paths(&with("model.")).len());
        assert_eq!(all + other, SPREADS.len());
        set(&mut scenario, "impact.force_n", "300 ± 20").unwrap();
        set(&mut scenario, "eye.sclera_kpa", "2600 ± 0").unwrap();
        set(&mut scenario, "eye.lens_kpa", "100").unwrap();
        let paths = paths(&scenario);
        assert_eq!(paths[0], "impact.force_n");
        assert!(!paths.contains(&"eye.sclera_kpa") && !paths.contains(&"eye.lens_kpa"));
        assert_eq!(paths.len(), all - 1);
    }
}
