//! Setting one field of a scenario, or a group of fields, from text that a person typed. It is read
//! more kindly than a file: names in any case, with or without dashes, and text without quotes.

use crate::scenario::check::{check_inside, near_zero_is_zero};
use crate::scenario::curve_file::{PathBase, with_files};
use crate::scenario::fields::{Choices, FIELDS, Field, Kind};
use crate::scenario::problem::{Problem, ScenarioError, suggestion, unknown_name};
use crate::scenario::ron_text::{not_a, read};
use crate::scenario::{Directions, PulseShape, Scenario, doubt, fields, naming};
use serde::Deserialize;
use serde::de::DeserializeOwned;
use std::collections::BTreeMap;

/// What replaces a part of the scenario by the text typed for its path, in the syntax of a file.
type Replace = fn(&mut Scenario, path: &str, text: &str) -> Result<(), ScenarioError>;

/// The groups of fields with their paths; fields that the text leaves out take their defaults.
static GROUPS: &[(&str, Replace)] = &[
    ("model", |s, path, text| put(Some(&mut s.model), path, text)),
    ("impact", |s, path, text| put(Some(&mut s.impact), path, text)),
    ("impact.shape", |s, path, text| {
        let mut shape = PulseShape::default();
        put(Some(&mut shape), path, text)?;
        match (s.pulse_mut(), shape) {
            // What was recorded keeps its times; a duration that is set later stretches it.
            (Some(pulse), PulseShape::Table(curve)) => pulse.follow(curve),
            (Some(pulse), shape) => pulse.shape = shape,
            (None, _) => {}
        }
        Ok(())
    }),
    ("impact.stiffness", |s, path, text| {
        put(s.projectile_mut().map(|object| &mut object.stiffness), path, text)
    }),
    ("impact.outline", |s, path, text| {
        put(s.projectile_mut().map(|object| &mut object.outline), path, text)
    }),
    ("impact.surface", |s, path, text| {
        put(s.projectile_mut().map(|object| &mut object.surface), path, text)
    }),
    ("eye", |s, path, text| put(Some(&mut s.eye), path, text)),
    ("numerics", |s, path, text| put(Some(&mut s.numerics), path, text)),
    ("doubt", |s, path, text| {
        let mut doubts = Doubts::default();
        put(Some(&mut doubts), path, text)?;
        s.doubt = doubts.0;
        Ok(())
    }),
];

fn put<T: DeserializeOwned>(
    place: Option<&mut T>,
    path: &str,
    text: &str,
) -> Result<(), ScenarioError> {
    if let Some(value) = place {
        *value = with_files(&PathBase::Typed, || read(text, path))?;
    }
    Ok(())
}

/// The group at a path.
fn group(path: &str) -> Option<Replace> {
    let mut groups = GROUPS.iter();
    groups.find_map(|(of, replace)| (*of == path).then_some(*replace))
}

/// The map of doubts alone, as a file holds it.
#[derive(Default, Deserialize)]
#[serde(transparent)]
struct Doubts(#[serde(deserialize_with = "doubt::once")] BTreeMap<String, f64>);

/// The dotted path that is meant by its end, with or without the unit: `speed` where only
/// `impact.speed_m_s` fits, in this scenario or at all. What fits none or several stays as typed.
pub fn full_path<'a>(scenario: &Scenario, typed: &'a str) -> &'a str {
    let typed = typed.trim();
    let is_known = |path: &str| fields::find(path).is_some() || group(path).is_some();
    if is_known(typed) {
        return typed;
    }
    if let [only] = fitting(scenario, typed)[..] { only.path } else { typed }
}

/// Fields of a direction that a word for it stands for.
const OF_DIRECTION: [&str; 4] =
    ["impact.angle_deg", "impact.angle_clock", "impact.offset_mm", "impact.offset_clock"];

/// Puts changes in the order in which they mean the same however they were given: the model first,
/// since a word such as the nose means a place of the eye in the end, and a word for a direction
/// before the numbers of it, which say more.
pub fn in_order<T>(scenario: &Scenario, changes: &mut [T], path: impl Fn(&T) -> &str) {
    let full = |change: &T| full_path(scenario, path(change)).to_owned();
    changes.sort_by_cached_key(|change| !full(change).starts_with("model"));
    let first = changes.iter().position(|change| OF_DIRECTION.contains(&full(change).as_str()));
    let word = changes.iter().rposition(|change| full(change) == "impact.from");
    if let (Some(first), Some(word)) = (first, word)
        && first < word
        && !changes[first..word].iter().any(|change| full(change) == "impact")
    {
        changes[first..=word].rotate_right(1);
    }
}

/// The fields that end as typed, else those that do but for their unit; first what is there.
fn fitting(scenario: &Scenario, typed: &str) -> Vec<&'static Field> {
    let ends = |path: &str, with_unit: bool| {
        let starts = path.match_indices('.').map(|(at, _)| at + 1).chain([0]);
        let mut rests = starts.filter_map(|at| path[at..].strip_prefix(typed));
        rests.any(|rest| rest.is_empty() || with_unit && rest.starts_with('_'))
    };
    let all = |with_unit| -> Vec<&'static Field> {
        let fits = |field: &&Field| ends(field.path, with_unit);
        FIELDS.iter().filter(fits).collect()
    };
    let mut fitting = all(false);
    if fitting.is_empty() && !typed.is_empty() {
        fitting = all(true);
    }
    let here = |field: &&Field| field.text(scenario).is_some();
    if fitting.iter().any(here) {
        fitting.retain(here);
    }
    fitting
}

/// Sets the field or group at a dotted path, as in `impact.force_n`, `450`; the path may be
/// [shortened](full_path). On an error the scenario is left as it was. Rules that join two fields
/// are not applied: see [`Scenario::check`]. A number may carry its unit and its doubt, as in
/// `450 ± 20` or `450 +- 20`; without a doubt it drops an older one.
///
/// # Errors
/// Says what is wrong with the path, or with the value and what would be accepted.
pub fn set(scenario: &mut Scenario, path: &str, text: &str) -> Result<(), ScenarioError> {
    set_one_of_several(scenario, path, text).map(|()| settle(scenario))
}

/// As [`set`] for one of several changes, [in their order](in_order), after which comes [`settle`].
///
/// # Errors
/// As [`set`].
pub fn set_one_of_several(
    scenario: &mut Scenario,
    path: &str,
    text: &str,
) -> Result<(), ScenarioError> {
    let path = full_path(scenario, path);
    let text = text.trim();
    let mut changed = scenario.clone();
    let field = fields::find(path);
    match (field, group(path)) {
        (Some(field), _) if field.text(scenario).is_none() => {
            return Err(absent(field, scenario).into());
        }
        (_, Some(replace)) if field.is_none() || !is_name(text) => {
            replace(&mut changed, path, text)?;
        }
        (Some(field), _) if matches!(field.kind, Kind::Number(..)) => {
            let (value, doubted) = doubt::split(without_unit(field, text));
            set_field(&mut changed, field, value)?;
            doubt::put(&mut changed, field, doubted)?;
        }
        (Some(field), _) => set_field(&mut changed, field, text)?,
        (None, _) => return Err(unknown(scenario, path).into()),
    }
    forget_doubts(&mut changed, scenario);
    check_inside(&changed, path)?;
    near_zero_is_zero(&mut changed);
    changed.mirror_from(scenario);
    confirm(&mut changed, path);
    if let Some(field) = field {
        naming::follow(&mut changed, scenario, field);
    }
    *scenario = changed;
    Ok(())
}

/// Turns an angle below 0 to the other side of the clock, once every change is made: the hour may
/// be one of them. Whoever gives an angle or an offset knows where the blow came from.
pub fn settle(scenario: &mut Scenario) {
    scenario.impact.by_the_clock();
    if let Some(projectile) = scenario.projectile_mut()
        && !projectile.is_straight_on()
    {
        projectile.directions = Directions::AsGiven;
    }
}

/// What a person has set is theirs, no longer an unverified figure of a preset.
fn confirm(scenario: &mut Scenario, path: &str) {
    let name = path.strip_prefix("impact.").and_then(|p| p.split('.').next());
    if let (Some(name), Some(projectile)) = (name, scenario.projectile_mut()) {
        projectile.unverified.retain(|field| field != name);
    }
}

/// Puts numbers, unchecked, into their fields as a person does; any doubts of them stay.
pub(crate) fn put_numbers<'a>(
    scenario: &mut Scenario,
    numbers: impl IntoIterator<Item = (&'a Field, f64)>,
) {
    for (field, value) in numbers {
        match &field.kind {
            Kind::Number(_, place) => store((place.get_mut)(scenario), Some(value)),
            Kind::OptionalNumber(_, place) => store((place.get_mut)(scenario), Some(Some(value))),
            _ => continue,
        };
        confirm(scenario, field.path);
    }
    settle(scenario);
}

/// Puts one number, unchecked, into its field as a person does; any doubt of it stays.
pub(crate) fn put_number(scenario: &mut Scenario, field: &Field, value: f64) {
    put_numbers(scenario, [(field, value)]);
}

/// Drops the doubts of fields that the scenario had `before` and has no longer.
fn forget_doubts(scenario: &mut Scenario, before: &Scenario) {
    let mut doubt = std::mem::take(&mut scenario.doubt);
    doubt.retain(|path, _| {
        let has = |scenario| fields::find(path).is_some_and(|field| field.text(scenario).is_some());
        has(scenario) || !has(before)
    });
    scenario.doubt = doubt;
}

fn set_field(scenario: &mut Scenario, field: &Field, text: &str) -> Result<(), ScenarioError> {
    let done = match &field.kind {
        Kind::Number(_, place) => {
            let hour = (field.unit == "h").then(|| clock(text)).flatten();
            store((place.get_mut)(scenario), hour.or_else(|| number(text)))
        }
        Kind::OptionalNumber(_, place) => store((place.get_mut)(scenario), optional(text).ok()),
        Kind::Integer(_, _, place) => store((place.get_mut)(scenario), text.parse().ok()),
        Kind::Integers(_, _, _, place) => store((place.get_mut)(scenario), list(text)),
        Kind::Text(_, place) => store((place.get_mut)(scenario), words(text, field.path)?),
        Kind::Choice(choices) => {
            named(*choices, scenario, text).is_some_and(|name| choices.set(scenario, name))
        }
    };
    if done {
        return Ok(());
    }
    let allowed = field.allowed_in(scenario);
    if text.is_empty() {
        return Err(Problem::lacking(field.path, "nothing is there", allowed).into());
    }
    let complaint = match &field.kind {
        Kind::Choice(choices) => {
            let Some(why) = choices.unclear(text) else {
                let names = choices.names().into_iter();
                return Err(unknown_name(field.path, text, names, allowed).into());
            };
            why
        }
        Kind::Number(..) | Kind::OptionalNumber(..) if text.contains(',') => {
            "is not a number (decimals follow a point, not a comma)"
        }
        kind => not_a(kind),
    };
    Err(Problem::refused(field.path, text, complaint, allowed).into())
}

fn store<T>(place: Option<&mut T>, value: Option<T>) -> bool {
    let both = place.zip(value);
    both.map(|(place, value)| *place = value).is_some()
}

/// What stands before a field's own unit, where it follows a number: 30 of `30 m/s`.
fn without_unit<'a>(field: &Field, text: &'a str) -> &'a str {
    let bare = text.strip_suffix(field.unit).map(str::trim_end);
    bare.filter(|bare| bare.ends_with(|last: char| last.is_ascii_digit())).unwrap_or(text)
}

fn number(text: &str) -> Option<f64> {
    text.parse().ok().or_else(|| read(text, "").ok())
}

/// An hour as a clock shows it: 7.5 of `7:30`.
fn clock(text: &str) -> Option<f64> {
    let (hour, minutes) = text.split_once(':')?;
    let (hour, minutes): (u8, u8) = (hour.trim().parse().ok()?, minutes.trim().parse().ok()?);
    // Half past twelve is half an hour of the first.
    let hour = if hour == 12 && minutes > 0 { 0 } else { hour };
    (minutes < 60).then(|| f64::from(hour) + f64::from(minutes) / 60.0)
}

fn optional(text: &str) -> Result<Option<f64>, ScenarioError> {
    match number(text) {
        _ if ["none", "auto"].iter().any(|word| text.eq_ignore_ascii_case(word)) => Ok(None),
        Some(number) => Ok(Some(number)),
        None => read(text, ""),
    }
}

fn list(text: &str) -> Option<Vec<u32>> {
    read(text, "").or_else(|_| read(&format!("[{text}]"), "")).ok()
}

/// Text as it stands, or the content of a RON string where it begins like one.
fn words(text: &str, path: &str) -> Result<Option<String>, ScenarioError> {
    let is_quoted = ["\"", "r\"", "r#"].iter().any(|start| text.starts_with(start));
    if is_quoted { read(text, path).map(Some) } else { Ok(Some(text.to_owned())) }
}

/// The variant meant by `VelocityVerlet`, `velocity-verlet`, `velocity_verlet` or another word.
fn named(choices: &dyn Choices, scenario: &Scenario, text: &str) -> Option<&'static str> {
    let bare = |name: &str| name.replace(['-', '_'], "").to_ascii_lowercase();
    let mut names = choices.names().into_iter().chain(choices.get(scenario));
    let alike = |name: &&str| bare(name) == bare(text);
    let synonym = || choices.synonyms().iter().find(|(word, _)| alike(word));
    names.find(alike).or_else(|| synonym().map(|(_, name)| *name))
}

fn is_name(text: &str) -> bool {
    text.chars().all(|c| c.is_alphanumeric() || matches!(c, '-' | '_'))
}

/// The field exists, but not in the variant that its parent holds now.
fn absent(field: &Field, scenario: &Scenario) -> Problem {
    if let Some(Field { kind: Kind::Choice(models), .. }) = fields::find("model") {
        let has = |model: &&str| {
            let mut other = scenario.clone();
            models.set(&mut other, model) && field.text(&other).is_some()
        };
        let path = field.path;
        // What is under `model` is told by its own path below.
        if !path.starts_with("model.")
            && let (Some(model), true) = (models.get(scenario), models.names().iter().any(has))
        {
            return Problem::new(path, format!("model is {model}, which has no {path}"));
        }
    }
    let mut path = field.path;
    while let Some((parent, _)) = path.rsplit_once('.') {
        let part = &field.path[parent.len() + 1..];
        if let Some(variant) = fields::find(parent).and_then(|parent| parent.text(scenario)) {
            return Problem::new(field.path, format!("{parent} is {variant}, which has no {part}"));
        }
        path = parent;
    }
    Problem::new(field.path, "there is no such field in this scenario")
}

fn unknown(scenario: &Scenario, path: &str) -> Problem {
    if let several @ [_, _, ..] = &fitting(scenario, path)[..] {
        let paths: Vec<_> = several.iter().map(|field| field.path).collect();
        let message = format!("fits several fields: {}", paths.join(", "));
        return Problem::new(path, message);
    }
    let groups = GROUPS.iter().map(|(path, _)| *path);
    let groups = groups.filter(|path| fields::find(path).is_none());
    let near = suggestion(path, FIELDS.iter().map(|field| field.path).chain(groups));
    Problem::new(path, format!("there is no such field{near}"))
}

#[cfg(test)]
mod tests;
