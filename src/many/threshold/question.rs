//! What is asked of a search: the field that it varies, and the result and value that it looks for.

use crate::run::{flags::PRESSED_FLAT, quantity::Quantity};
use crate::scenario::{
    Impact, Model, Scenario, fields, fields::Bounds, fields::Field, fields::Kind,
};
use crate::scenario::{problem::Problem, problem::ScenarioError, problem::suggestion};
use crate::scenario::{set::full_path, set::set};

/// The field of a path and its bounds, where it holds a number.
pub(super) fn bounds(
    scenario: &Scenario,
    path: &str,
) -> Result<(&'static Field, Bounds), ScenarioError> {
    let path = full_path(scenario, path);
    let Some(field) = fields::find(path) else {
        // The words for a field that is not there; a group has none that fit.
        let error = set(&mut scenario.clone(), path, "()").err();
        let error = error.filter(|e| e.problems.iter().any(|p| p.line.is_none()));
        let group = || Problem::new(path, "holds several fields: name one of them").into();
        return Err(error.unwrap_or_else(group));
    };
    let Some(present) = field.text(scenario) else {
        set(&mut scenario.clone(), path, "0")?;
        return Err(Problem::new(path, "there is no such field in this scenario").into());
    };
    let Some(bounds) = field.bounds_in(scenario) else {
        let message = match field.kind {
            Kind::Integer(..) => {
                format!("is a whole number, now {present}: `contrecoup sweep` lists its results")
            }
            _ => format!("is no number but {present}"),
        };
        return Err(Problem::new(path, message).into());
    };
    Ok((field, bounds))
}

/// Reads `FROM:TO` within the bounds of a field.
pub(super) fn range(
    scenario: &Scenario,
    field: &Field,
    bounds: &Bounds,
    ends: &str,
) -> Result<(f64, f64), ScenarioError> {
    let allowed = || format!("FROM:TO within {}", field.allowed_in(scenario));
    let refused = |complaint| Problem::refused(field.path, ends.trim(), complaint, allowed());
    let (from, to) = ends.split_once(':').ok_or_else(|| refused("is no range"))?;
    let (Ok(from), Ok(to)) = (from.trim().parse::<f64>(), to.trim().parse::<f64>()) else {
        return Err(refused("is no range of numbers").into());
    };
    if from.partial_cmp(&to) != Some(std::cmp::Ordering::Less) {
        return Err(refused("goes from no lower to no higher value").into());
    }
    if from < bounds.min || to > bounds.max {
        return Err(refused("is out of range").into());
    }
    Ok((from, to))
}

/// The field that is varied, and the result with its value, unless a person asks for others.
pub fn usual(scenario: &Scenario) -> (&'static str, (Quantity, f64)) {
    let field = match scenario.impact {
        Impact::ForcePulse(_) => "impact.force_n",
        Impact::Projectile(_) => "impact.speed_m_s",
    };
    let result = match scenario.model {
        Model::Paper => Quantity::Damage,
        Model::Physiological(_) => Quantity::GlobeRupture,
    };
    (field, (result, 50.0))
}

/// A name of a result as in its key, however it is spelled.
fn bare(name: &str) -> String {
    name.to_lowercase().replace([' ', '-', '\''], "_")
}

/// The result that is called so: by its key, with or without the unit, or as people read it.
pub fn meant(name: &str) -> Option<Quantity> {
    let name = bare(name);
    let called = |quantity: &&Quantity| {
        let (key, label) = (quantity.key(), bare(quantity.label()));
        let unit = key.strip_prefix(name.as_str());
        let units = ["", "_percent", "_mm", "_n", "_j", "_mpa", "_m_s", "_kj_m2"];
        label == name || unit.is_some_and(|unit| units.contains(&unit))
    };
    Quantity::ALL.iter().find(called).copied()
}

/// Reads `RESULT = VALUE`; the unit may follow the value.
///
/// # Errors
/// Says what makes no sense, and what would.
pub fn wanted(text: &str) -> Result<(Quantity, f64), ScenarioError> {
    let refused = |value: &str, complaint: &str, allowed: &str| {
        ScenarioError::from(Problem::refused("", value, complaint, allowed.to_owned()))
    };
    let example = "RESULT = VALUE, as in damage_percent = 50";
    let (key, value) = text.split_once('=').ok_or_else(|| refused(text, "has no =", example))?;
    let (key, value) = (key.trim().trim_end_matches('='), value.trim_start_matches('=').trim());
    let Some(quantity) = meant(key) else {
        let near = suggestion(&bare(key), Quantity::ALL.iter().map(|q| q.key()));
        let allowed = "any of the results that contrecoup run --json lists";
        return Err(refused(key, &format!("is no result{near}"), allowed));
    };
    // The index is no percentage for a reader, but its key says so.
    let unit = quantity.row().unit;
    let unit = if unit.is_empty() { "%" } else { unit };
    let number = value.strip_suffix(unit).unwrap_or(value);
    match number.trim().parse::<f64>() {
        Ok(target) if target < 0.0 && quantity != Quantity::Rebound => {
            let complaint = format!("is below 0, where {} never is", quantity.label());
            Err(refused(value, &complaint, "0 or more"))
        }
        Ok(target) if quantity == Quantity::Shortening && target > 100.0 * PRESSED_FLAT => {
            let complaint = "is beyond where the eye is pressed flat, at which a run ends";
            let allowed = format!("up to {} %", 100.0 * PRESSED_FLAT);
            Err(refused(value, complaint, &allowed))
        }
        Ok(target) if target.is_finite() => Ok((quantity, target)),
        _ => Err(refused(value, "is no number", example)),
    }
}
