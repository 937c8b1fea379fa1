//! Whether the values of a scenario are allowed.
//!
//! Every problem is found, not only the first. Ranges come from the registry of fields; only rules
//! that join two fields are written out here. Only what has been checked can be simulated.

use crate::plain_text::printable;
use crate::scenario::fields::{FIELDS, Field, Kind};
use crate::scenario::problem::{Problem, ScenarioError, plain};
use crate::scenario::{FASTEST_M_S, Impact, MOST_ENERGY_J, Model, Outline, Projectile};
use crate::scenario::{Scenario, Support, doubt, fields};
use std::ops::Deref;

/// A scenario whose every value is allowed: what simulations take. It cannot be changed.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct CheckedScenario(Scenario);

impl Scenario {
    /// Checks every value and gives the scenario as a type that can be simulated.
    ///
    /// # Errors
    /// Names every field that is not allowed, its value and what would be.
    pub fn check(&self) -> Result<CheckedScenario, ScenarioError> {
        let ranges = FIELDS.iter().filter_map(|field| check_field(field, self));
        let rules = behind_bone(self)
            .into_iter()
            .chain(too_high(self))
            .chain(object_at_paper(self))
            .chain(beyond_axisymmetry(self))
            .chain(unknown_marks(self));
        outcome(ranges.chain(rules).chain(doubt::check(self)).collect())?;
        let mut sound = self.clone();
        near_zero_is_zero(&mut sound);
        Ok(CheckedScenario(sound))
    }
}

/// Makes a 0 of -0 and of subnormal numbers, whose products have no digits and which are slow.
pub(super) fn near_zero_is_zero(scenario: &mut Scenario) {
    let zeroed = |number: &mut f64| {
        if number.is_finite() && !number.is_normal() {
            *number = 0.0;
        }
    };
    for field in FIELDS {
        if let Kind::Number(_, place) = &field.kind
            && let Some(number) = (place.get_mut)(scenario)
        {
            zeroed(number);
        }
    }
    scenario.doubt.values_mut().for_each(zeroed);
}

impl Deref for CheckedScenario {
    type Target = Scenario;

    fn deref(&self) -> &Scenario {
        &self.0
    }
}

impl From<CheckedScenario> for Scenario {
    fn from(checked: CheckedScenario) -> Self {
        checked.0
    }
}

impl CheckedScenario {
    /// The scenario under another name, which changes no figure.
    #[cfg(feature = "app")]
    pub(crate) fn renamed(mut self, name: String) -> Self {
        self.0.name = name;
        self
    }
}

/// The ranges of the field at `path` and of those inside it. No rule that joins two fields: of two
/// values set one after the other, the first may need the second.
pub(super) fn check_inside(scenario: &Scenario, path: &str) -> Result<(), ScenarioError> {
    let inside = |rest: &str| rest.is_empty() || rest.starts_with('.');
    let inside = |field: &&Field| field.path.strip_prefix(path).is_some_and(inside);
    let ranges = FIELDS.iter().filter(inside).filter_map(|field| check_field(field, scenario));
    outcome(ranges.chain(doubt::check(scenario)).collect())
}

fn outcome(problems: Vec<Problem>) -> Result<(), ScenarioError> {
    if problems.is_empty() { Ok(()) } else { Err(ScenarioError { problems }) }
}

fn check_field(field: &Field, scenario: &Scenario) -> Option<Problem> {
    let complaint = match &field.kind {
        Kind::Number(bounds, place) => bounds.refuse(*(place.get)(scenario)?),
        Kind::OptionalNumber(bounds, place) => bounds.refuse((*(place.get)(scenario)?)?),
        Kind::Integer(min, max, place) => {
            (!(min..=max).contains(&(place.get)(scenario)?)).then_some("is out of range")
        }
        Kind::Integers(min, max, most, place) => {
            let list = (place.get)(scenario)?;
            let repeated = |(index, hop)| list[..index].contains(hop);
            if list.len() > *most {
                Some("is too long a list")
            } else if !list.iter().all(|hop| (min..=max).contains(&hop)) {
                Some("is out of range")
            } else {
                list.iter().enumerate().any(repeated).then_some("repeats a number")
            }
        }
        Kind::Text(most, place) => {
            let text = (place.get)(scenario)?;
            match text.trim().chars().count() {
                0 => Some("is empty"),
                length if length > *most => Some("is too long"),
                _ => (printable(text) != text.as_str())
                    .then_some("holds a control character or one that cannot be seen"),
            }
        }
        Kind::Choice(_) => None,
    }?;
    let text = field.text(scenario)?;
    let value = if matches!(field.kind, Kind::Text(..)) { format!("{text:?}") } else { text };
    Some(Problem::refused(field.path, &value, complaint, field.allowed_in(scenario)))
}

/// The Paper model takes no object: in its flat section a ball is a rod.
fn object_at_paper(scenario: &Scenario) -> Option<Problem> {
    let (Model::Paper, Impact::Projectile(_)) = (&scenario.model, &scenario.impact) else {
        return None;
    };
    let complaint = "takes no object, since a ball in its flat section is a rod";
    let allowed = "Physiological(...), or impact: ForcePulse(...)".to_owned();
    Some(Problem::refused("model", "Paper", complaint, allowed))
}

/// What the axisymmetric eye cannot take.
fn beyond_axisymmetry(scenario: &Scenario) -> Vec<Problem> {
    let Some(model) = scenario.physiological() else { return Vec::new() };
    let mut problems = Vec::new();
    let mut refuse = |path, value: &str, complaint, allowed: &str| {
        problems.push(Problem::refused(path, value, complaint, allowed.to_owned()));
    };
    let angle = scenario.impact.angle_deg();
    let steepest = scenario.steepest_deg();
    if angle.abs() > steepest {
        let allowed = format!("-{steepest} to {steepest} deg");
        let complaint = "is out of range for model Physiological";
        refuse("impact.angle_deg", &plain(angle), complaint, &allowed);
    }
    if let Some((complaint, allowed)) = scenario.geometry_unfit() {
        let asked = format!("{:?}", scenario.numerics.geometry);
        refuse("numerics.geometry", &asked, complaint, allowed);
    }
    if let Some(projectile) = scenario.projectile() {
        let opening = model.gelatin_opening_deg;
        let in_holder = model.support == Support::Gelatin && scenario.is_spatial();
        let fits_mm = 2.0 * HOLDER_MM * libm::sin(opening.min(90.0).to_radians());
        if in_holder && projectile.diameter_mm > fits_mm {
            let allowed = format!(
                "up to {fits_mm:.1} mm, which fits the gelatin's opening, or support Orbit, or a \
                 blow straight on at the axisymmetric eye"
            );
            let complaint = "would hit the holder of the gelatin, which this eye has not";
            refuse("impact.diameter_mm", &plain(projectile.diameter_mm), complaint, &allowed);
        }
        let lands = projectile.lands_at_deg();
        if in_holder && lands.is_some_and(|lands| lands > opening - EDGE_DEG) {
            let most = plain(opening - EDGE_DEG);
            let allowed = format!(
                "what lands up to {most} deg from the front, or a larger model.gelatin_opening_deg"
            );
            let complaint = "brings the object onto the gelatin, not the eye";
            refuse("impact.angle_deg", &plain(angle), complaint, &allowed);
        }
        if projectile.speed_m_s <= FASTEST_M_S && projectile.energy_j() > MOST_ENERGY_J {
            let complaint = "brings more energy than model Physiological takes";
            let most = projectile.mass_g * MOST_ENERGY_J / projectile.energy_j();
            let allowed = format!("up to {most:.1} g at this speed, which is {MOST_ENERGY_J} J");
            refuse("impact.mass_g", &plain(projectile.mass_g), complaint, &allowed);
        }
        if let Outline::Cylinder { edge_mm } = projectile.outline
            && edge_mm > 0.5 * projectile.diameter_mm
        {
            let allowed =
                format!("up to {} mm, half of its diameter", plain(0.5 * projectile.diameter_mm));
            let complaint = "is larger than the cylinder";
            refuse("impact.outline.edge_mm", &plain(edge_mm), complaint, &allowed);
        }
    }
    let (level, finest) = (scenario.eye.level, scenario.finest_level());
    if level > finest {
        let allowed = format!("whole numbers 1 to {finest}");
        let complaint = if scenario.is_spatial() {
            "is too fine for the eye in three dimensions, which numerics.geometry chooses"
        } else {
            "is out of range for this eye"
        };
        refuse("eye.level", &level.to_string(), complaint, &allowed);
    }
    problems
}

/// Inner radius of the holder of the gelatin, in mm.
const HOLDER_MM: f64 = 20.0;
/// This near to where gelatin begins, in degrees, a BB touches it.
const EDGE_DEG: f64 = 8.0;

/// A blow whose middle lies beyond the opening of the orbit would land on bone.
fn behind_bone(scenario: &Scenario) -> Option<Problem> {
    let (Model::Paper, Impact::ForcePulse(pulse)) = (&scenario.model, &scenario.impact) else {
        return None;
    };
    let (angle, opening) = (pulse.angle_deg, scenario.eye.opening_deg);
    (angle.abs() > opening).then(|| {
        let (least, most) = (plain(-opening), plain(opening));
        let allowed = format!("{least} to {most} deg, the opening of the orbit (eye.opening_deg)");
        let complaint = "is out of range, since bone shields the eye there";
        Problem::refused("impact.angle_deg", &plain(angle), complaint, allowed)
    })
}

/// The bound of a force holds for the highest knot of a table too.
fn too_high(scenario: &Scenario) -> Option<Problem> {
    let pulse = scenario.pulse()?;
    let force = fields::find("impact.force_n")?;
    let Kind::Number(bounds, _) = &force.kind else { return None };
    // A force that is itself out of range has been refused already.
    let stretched = pulse.force_n <= bounds.max && pulse.peak_n() > bounds.max;
    stretched.then(|| {
        let complaint = format!("makes the table's peak {} N", plain(pulse.peak_n()));
        Problem::refused(force.path, &plain(pulse.force_n), &complaint, force.allowed())
    })
}

/// A mark of doubt must name something.
fn unknown_marks(scenario: &Scenario) -> Option<Problem> {
    let projectile = scenario.projectile()?;
    let known = |name: &&String| Projectile::FIELDS.contains(&name.as_str());
    let stranger = format!("{:?}", projectile.unverified.iter().find(|name| !known(name))?);
    let (complaint, allowed) = ("names no field of a projectile", Projectile::FIELDS.join(", "));
    Some(Problem::refused("impact.unverified", &stranger, complaint, allowed))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The fields that are refused, and the refusals.
    fn refused(scenario: &Scenario) -> (Vec<String>, Vec<Problem>) {
        let problems = scenario.check().unwrap_err().problems;
        (problems.iter().map(|problem| problem.field.clone()).collect(), problems)
    }

    #[test]
    fn every_problem_is_reported_in_the_order_of_the_fields() {
        let mut scenario = Scenario { window_ms: Some(f64::NAN), ..Scenario::default() };
        scenario.eye.filament_hops = vec![2, 2];
        scenario.eye.opening_deg = 10.0;
        scenario.name = "\u{1b}[31m".to_owned();
        scenario.pulse_mut().unwrap().angle_deg = -10.5;
        let (fields, problems) = refused(&scenario);
        assert_eq!(fields, ["name", "window_ms", "eye.filament_hops", "impact.angle_deg"]);
        assert!(problems[3].message.contains("-10 to 10 deg"));
        assert!(!problems[0].to_string().contains('\u{1b}'));
    }

    #[test]
    fn an_object_is_refused_at_the_paper_model_and_doubts_what_it_has() {
        let unverified = ["speed_m_s", "colour"].map(str::to_owned).to_vec();
        let impact = Impact::Projectile(Projectile { unverified, ..Projectile::default() });
        let (fields, problems) = refused(&Scenario { impact, ..Scenario::default() });
        assert_eq!(fields, ["model", "impact.unverified"]);
        assert!(problems[1].message.contains("colour"));
    }

    #[test]
    fn the_axisymmetric_eye_has_its_own_limits_and_none_of_the_sections() {
        let of = |projectile| Scenario::of(Impact::Projectile(projectile));
        let usual = Projectile::default();
        assert!(of(Projectile { angle_deg: 60.0, ..usual.clone() }).check().is_ok());
        let (fields, _) = refused(&of(Projectile { speed_m_s: 201.0, ..usual.clone() }));
        assert_eq!(fields, ["impact.speed_m_s"]);
        let (fields, problems) =
            refused(&of(Projectile { mass_g: 700.0, speed_m_s: 30.0, ..usual.clone() }));
        assert_eq!(fields, ["impact.mass_g"]);
        let allowed = problems[0].allowed.as_deref();
        assert_eq!(allowed, Some("up to 666.7 g at this speed, which is 300 J"));
        let outline = Outline::Cylinder { edge_mm: 5.0 };
        let mut scenario = of(Projectile { offset_mm: 1.0, angle_deg: -91.0, outline, ..usual });
        scenario.eye.level = 6;
        let (fields, problems) = refused(&scenario);
        assert_eq!(fields, ["impact.angle_deg", "impact.outline.edge_mm", "eye.level"]);
        assert!(problems[2].message.contains("numerics.geometry"), "{}", problems[2]);
    }
}
