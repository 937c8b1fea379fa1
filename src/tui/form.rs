//! The form: which rows there are, and how a key press or typed text changes a value.
//!
//! Rows, ranges and steps come from the registry of fields. A new field shows up here by itself:
//! among the first rows if it belongs to the blow, folded away if it does not.

use crate::scenario::direction::Directions;
use crate::scenario::fields::{Bounds, FIELDS, Field, Kind};
use crate::scenario::set::{put_number, set};
use crate::scenario::{Impact, Model, Scenario};
use crate::scenario::{doubt::number, problem::ScenarioError};
use crate::tui::{line::TextLine, step::Step};

/// A row of the form.
#[derive(Clone, Copy, Default)]
pub enum FormRow {
    /// The preset: what hits the eye comes before by how much.
    #[default]
    Preset,
    /// A field of the scenario.
    Field(&'static Field),
    /// The line that unfolds the advanced fields.
    Fold,
}

impl FormRow {
    /// The field of a row that has one.
    pub fn field(self) -> Option<&'static Field> {
        if let Self::Field(field) = self { Some(field) } else { None }
    }

    fn path(self) -> &'static str {
        match self {
            Self::Preset => "preset",
            Self::Field(field) => field.path,
            Self::Fold => "fold",
        }
    }
}

impl PartialEq for FormRow {
    fn eq(&self, other: &Self) -> bool {
        self.path() == other.path()
    }
}

/// What is selected and what is being typed.
#[derive(Default)]
pub struct ScenarioForm {
    /// The row with the cursor.
    pub selected: FormRow,
    /// Whether the advanced fields are shown.
    pub advanced: bool,
    /// A value that is being typed.
    pub typing: Option<Typing>,
    /// Why the last key press changed nothing.
    pub complaint: Option<String>,
}

/// A value that is being typed.
pub struct Typing {
    /// The field.
    pub field: &'static Field,
    /// The text so far.
    pub input: TextLine,
    /// Whether it began with nothing: then a sideways arrow accepts, it moves in no text.
    pub fresh: bool,
    /// What is wrong with the text so far.
    pub error: Option<String>,
}

/// Whether a field belongs to the question itself, not to the anatomy or the numerics.
fn is_basic(field: &Field) -> bool {
    let others = ["model", "model.eye_side", "impact", "window_ms"];
    others.contains(&field.path) || field.path.starts_with("impact.")
}

/// Whether a field says nothing: the hour of a blow that comes straight on or at the centre, both
/// where nobody knows from where it came, and which eye a force acts on.
fn is_idle(field: &Field, scenario: &Scenario) -> bool {
    match (field.path, &scenario.impact) {
        ("model.eye_side", Impact::ForcePulse(_)) => true,
        (ANGLE | OFFSET, Impact::Projectile(object)) => object.directions == Directions::NotKnown,
        ("impact.angle_clock", Impact::Projectile(object)) => object.angle_deg == 0.0,
        ("impact.offset_clock", Impact::Projectile(object)) => object.offset_mm == 0.0,
        _ => false,
    }
}

const ANGLE: &str = "impact.angle_deg";
const OFFSET: &str = "impact.offset_mm";

/// The rows, from the top.
pub fn rows(scenario: &Scenario, advanced: bool) -> Vec<FormRow> {
    let there = |field: &&Field| field.text(scenario).is_some() && !is_idle(field, scenario);
    let fields = FIELDS.iter().filter(there);
    let (basic, rest): (Vec<_>, Vec<_>) = fields.partition(|field| is_basic(field));
    let mut rows = vec![FormRow::Preset];
    rows.extend(basic.into_iter().map(FormRow::Field));
    rows.push(FormRow::Fold);
    if advanced {
        rows.extend(rest.into_iter().map(FormRow::Field));
    }
    rows
}

impl ScenarioForm {
    /// Moves the cursor by so many rows.
    pub fn move_cursor(&mut self, scenario: &Scenario, by: isize) {
        let rows = rows(scenario, self.advanced);
        let here = rows.iter().position(|row| *row == self.selected);
        let next = here.unwrap_or(0).saturating_add_signed(by).min(rows.len() - 1);
        self.selected = rows[next];
        self.complaint = None;
    }

    /// Whether a digit begins a value in the row with the cursor.
    pub fn takes_numbers(&self) -> bool {
        let is_text = |field: &Field| matches!(field.kind, Kind::Choice(_) | Kind::Text(..));
        self.selected.field().is_some_and(|field| !is_text(field))
    }

    /// Shows or hides the advanced fields; the cursor stays on a row that is there.
    pub fn fold(&mut self, scenario: &Scenario) {
        self.advanced = !self.advanced;
        if !rows(scenario, self.advanced).contains(&self.selected) {
            self.selected = FormRow::Fold;
        }
    }

    /// Puts the cursor where it can be after the scenario has changed.
    pub fn settle(&mut self, scenario: &Scenario) {
        if !rows(scenario, self.advanced).contains(&self.selected) {
            self.move_cursor(scenario, 0);
        }
    }
}

/// The row of how hard the blow is: the speed of an object, the peak of a force.
pub fn strength(scenario: &Scenario) -> FormRow {
    let strengths = ["impact.speed_m_s", "impact.force_n"];
    let mut rows = rows(scenario, false).into_iter();
    rows.find(|row| strengths.contains(&row.path())).unwrap_or_default()
}

/// What a field accepts, in the words of the form.
pub fn allowed(scenario: &Scenario, field: &Field) -> String {
    as_typed(&field.allowed_in(scenario))
}

/// A file says `Auto` where a person says `auto`.
fn as_typed(text: &str) -> String {
    text.replace("Auto, or ", "auto, or ")
}

/// Whether the scenario says that no source of a field's figure was checked.
pub fn is_unverified(scenario: &Scenario, field: &Field) -> bool {
    let name = field.path.strip_prefix("impact.");
    let name = name.and_then(|path| path.split('.').next());
    unverified(scenario).iter().any(|figure| Some(figure.as_str()) == name)
}

/// The names of such fields.
pub fn unverified(scenario: &Scenario) -> &[String] {
    match &scenario.impact {
        Impact::Projectile(projectile) => &projectile.unverified,
        Impact::ForcePulse(_) => &[],
    }
}

/// The present value as a person types it.
pub fn typed_text(field: &Field, scenario: &Scenario) -> Option<String> {
    let text = field.text(scenario)?;
    Some(match (&field.kind, text.as_str()) {
        (Kind::OptionalNumber(..), "Auto") => "auto".to_owned(),
        _ => text,
    })
}

/// What a key puts into a field: a point for a decimal comma; none where it can be no part of it.
pub fn admitted(field: &Field, c: char) -> Option<char> {
    let numeral = c.is_ascii_digit()
        || matches!(c, '.' | '-' | '+' | '/' | ':' | '_' | 'e' | 'E' | '±' | ' ');
    let word = "noneauto".contains(c.to_ascii_lowercase());
    match field.kind {
        Kind::Number(..) | Kind::OptionalNumber(..) if c == ',' => Some('.'),
        Kind::Number(..) | Kind::Integer(..) => numeral.then_some(c),
        Kind::OptionalNumber(..) => (numeral || word).then_some(c),
        Kind::Integers(..) => (numeral || matches!(c, ',' | '[' | ']')).then_some(c),
        Kind::Choice(_) | Kind::Text(..) => Some(c),
    }
}

/// The whole complaint without the path, which the form shows by its place.
pub fn words(error: &ScenarioError) -> String {
    let messages: Vec<&str> = error.problems.iter().map(|p| p.message.as_str()).collect();
    as_typed(&messages.join("; "))
}

/// The scenario with `text` in a field, or why it may not be there.
pub(crate) fn with_text(
    scenario: &Scenario,
    field: &Field,
    text: &str,
) -> Result<Scenario, String> {
    let mut changed = scenario.clone();
    let refused = |error| words(&error);
    set(&mut changed, field.path, text).map_err(refused)?;
    if field.path == "impact" && Model::usual_for(&changed.impact) != Model::Paper {
        // Whoever asks for an object means the model that takes one, whose parts are kept.
        set(&mut changed, "model", "Physiological").map_err(refused)?;
    }
    changed.check().map_err(refused)?;
    Ok(changed)
}

/// The place of what is chosen. None of a recorded curve, which no key throws away.
pub fn chosen(field: &Field, scenario: &Scenario) -> Option<usize> {
    let Kind::Choice(choices) = &field.kind else { return None };
    let present = choices.get(scenario)?;
    choices.names().iter().position(|name| *name == present)
}

/// The scenario with a field one step further. Numbers land on multiples of the step and stop at
/// their bounds; choices go round. `present` is what an unset number stands at.
pub(crate) fn nudged(
    scenario: &Scenario,
    field: &Field,
    step: Step,
    present: Option<f64>,
) -> Result<Scenario, String> {
    let next = |value: f64, bounds: &Bounds| {
        let size = if step.coarse { bounds.coarse } else { bounds.fine };
        stepped(value, size, step.up).clamp(bounds.min, bounds.max)
    };
    let mut changed = scenario.clone();
    match &field.kind {
        Kind::Number(..) => {
            if let Some((value, bounds)) = number(field, scenario) {
                put_number(&mut changed, field, next(value, &bounds));
            }
        }
        Kind::OptionalNumber(bounds, place) => {
            if let Some(place) = (place.get_mut)(&mut changed)
                && let Some(value) = place.or(present)
            {
                *place = Some(next(value, bounds));
            }
        }
        Kind::Integer(min, max, place) => {
            if let Some(value) = (place.get_mut)(&mut changed) {
                let next = if step.up { value.saturating_add(1) } else { value.saturating_sub(1) };
                *value = next.clamp(*min, *max);
            }
        }
        Kind::Choice(choices) => {
            let names = choices.names();
            let Some(here) = chosen(field, scenario) else {
                return Err("Enter, then a name, takes another".to_owned());
            };
            let by = if step.up { 1 } else { names.len() - 1 };
            return with_text(scenario, field, names[(here + by) % names.len()]);
        }
        Kind::Integers(..) | Kind::Text(..) => return Err("Enter opens it for typing".to_owned()),
    }
    changed.check().map_err(|error| words(&error))?;
    Ok(changed)
}

/// The next multiple of `size` above or below.
fn stepped(value: f64, size: f64, up: bool) -> f64 {
    let count = value / size;
    // A value this close to a multiple is that multiple.
    let near = 1e-6;
    let next = if up { (count + near).floor() + 1.0 } else { (count - near).ceil() - 1.0 };
    // One division keeps 0.3 from becoming 0.30000000000000004.
    let inverse = 1.0 / size;
    if inverse.fract().abs() < 1e-9 || inverse > 1.0 { next / inverse.round() } else { next * size }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scenario::fields::tests::every_variant;
    use crate::scenario::{PulseShape, fields};

    fn field(path: &str) -> &'static Field {
        fields::find(path).unwrap()
    }

    #[test]
    fn a_step_lands_on_round_numbers_and_an_unset_one_starts_from_the_one_in_use() {
        for (path, step, expected) in [
            ("impact.force_n", Step::MORE, "310"),
            ("impact.force_n", Step::MUCH_LESS, "200"),
            ("impact.duration_ms", Step::MORE, "0.21"),
            ("impact.duration_ms", Step::MUCH_MORE, "0.3"),
            ("impact.angle_deg", Step::LESS, "-1"),
            ("eye.retina_deg", Step::MORE, "130"),
            ("eye.retina_deg", Step::LESS, "129"),
            ("eye.level", Step::MUCH_MORE, "2"),
            ("eye.lens", Step::LESS, "Soft"),
            ("impact.shape", Step::MORE, "Triangle"),
            ("impact.shape", Step::LESS, "HalfSine"),
            ("numerics.step_us", Step::MORE, "1.24"),
            ("numerics.step_us", Step::MUCH_LESS, "1.2"),
        ] {
            let changed = nudged(&Scenario::default(), field(path), step, Some(1.234)).unwrap();
            assert_eq!(field(path).text(&changed).unwrap(), expected, "{path}");
        }
    }

    #[test]
    fn a_recorded_curve_is_left_by_name_and_not_by_an_arrow() {
        let shape = field("impact.shape");
        let typed = "Table([(0, 0), (0.1, 1), (0.3, 0)])";
        let recorded = with_text(&Scenario::default(), shape, typed).unwrap();
        assert_eq!(shape.text(&recorded).unwrap(), "Table");
        assert_eq!(with_text(&recorded, shape, "Table"), Ok(recorded.clone()));
        let refused = nudged(&recorded, shape, Step::MORE, None).unwrap_err();
        assert!(refused.contains("Enter"), "{refused}");
        let other = with_text(&recorded, shape, "HalfSine").unwrap();
        assert_eq!(shape.text(&other).unwrap(), "HalfSine");
    }

    #[test]
    fn every_number_can_be_stepped_to_its_bounds_and_no_further() {
        for field in FIELDS {
            let Kind::Number(_, place) = &field.kind else { continue };
            let has = |scenario: &Scenario| (place.get)(scenario).is_some();
            let holder = every_variant().into_iter().rfind(has).unwrap();
            let bounds = field.bounds_in(&holder).unwrap();
            for (end, step) in [(bounds.max, Step::MUCH_MORE), (bounds.min, Step::MUCH_LESS)] {
                let mut scenario = holder.clone();
                *(place.get_mut)(&mut scenario).unwrap() = end;
                let next = nudged(&scenario, field, step, None).unwrap_or(scenario);
                assert_eq!((place.get)(&next), Some(&end), "{}", field.path);
            }
        }
    }

    #[test]
    fn an_object_brings_the_model_that_takes_it_and_keeps_off_the_one_that_does_not() {
        let object = nudged(&Scenario::default(), field("impact"), Step::MORE, None).unwrap();
        assert_eq!(field("model").text(&object).unwrap(), "Physiological");
        let refused = nudged(&object, field("model"), Step::MORE, None).unwrap_err();
        assert!(refused.starts_with("Paper takes no object"), "{refused}");
        let pulse = nudged(&object, field("impact"), Step::MORE, None).unwrap();
        assert!(nudged(&pulse, field("model"), Step::MORE, None).is_ok());
    }

    #[test]
    fn rows_follow_the_variant_and_the_fold() {
        let mut scenario = Scenario::default();
        let paths = |scenario: &Scenario, advanced| -> Vec<&str> {
            rows(scenario, advanced).into_iter().map(FormRow::path).collect()
        };
        let basic = paths(&scenario, false);
        assert!(basic.contains(&"impact.shape.edge_fraction") && basic.contains(&"window_ms"));
        assert!(!basic.contains(&"eye.level") && paths(&scenario, true).contains(&"eye.level"));
        let Impact::ForcePulse(pulse) = &mut scenario.impact else { panic!() };
        pulse.shape = PulseShape::Triangle;
        assert!(!paths(&scenario, true).contains(&"impact.shape.edge_fraction"));
    }
}
