//! How much a person doubts the numbers of a scenario: `300 ± 20`.
//!
//! A doubt is one standard deviation of a normal distribution about the value, cut off at the
//! field's own bounds. An ensemble draws from it, each input by itself. A doubt of 0 says that the
//! value is known, which also keeps published spreads away. Only numbers that are always there can
//! be doubted: no choices, whole numbers or optional ones.

use crate::plain_text::{MAX_LINES, quoted};
use crate::scenario::fields::{Bounds, Field, Kind};
use crate::scenario::problem::{Problem, ScenarioError, plain, suggestion};
use crate::scenario::{Scenario, fields};
use serde::Deserializer;
use serde::de::{Error, MapAccess, Visitor};
use std::collections::BTreeMap;
use std::fmt;

/// Reads the doubts of a file and refuses a second one of a field.
pub(super) fn once<'de, D: Deserializer<'de>>(
    source: D,
) -> Result<BTreeMap<String, f64>, D::Error> {
    source.deserialize_map(Once)
}

struct Once;

impl<'de> Visitor<'de> for Once {
    type Value = BTreeMap<String, f64>;

    fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str("fields with their doubts")
    }

    fn visit_map<A: MapAccess<'de>>(self, mut source: A) -> Result<Self::Value, A::Error> {
        let mut doubts = BTreeMap::new();
        while let Some((path, doubt)) = source.next_entry::<String, f64>()? {
            let said = quoted(&path);
            if doubts.insert(path, doubt).is_some() {
                return Err(A::Error::custom(format!("{said} is given twice")));
            }
        }
        Ok(doubts)
    }
}

/// What may stand between a value and its doubt; the first is what the program writes.
const SIGNS: [&str; 3] = ["±", "+-", "+/-"];

/// The number that a field holds now and its bounds there.
pub fn number(field: &Field, scenario: &Scenario) -> Option<(f64, Bounds)> {
    let number = match &field.kind {
        Kind::Number(_, place) => *(place.get)(scenario)?,
        Kind::OptionalNumber(_, place) => (*(place.get)(scenario)?)?,
        _ => return None,
    };
    Some((number, field.bounds_in(scenario)?))
}

/// ` ± 20`, or nothing where the field is not doubted.
pub(super) fn suffix(field: &Field, scenario: &Scenario) -> String {
    let doubt = scenario.doubt.get(field.path);
    doubt.map_or_else(String::new, |d| format!(" {} {}", SIGNS[0], plain(*d)))
}

/// The value of a text whose doubt is still to come, as in `40 +-`; none of any other text.
#[cfg(feature = "app")]
pub(crate) fn begun(text: &str) -> Option<&str> {
    let text = text.trim_end();
    let ends = |sign: &str| (1..=sign.len()).find_map(|end| text.strip_suffix(sign.get(..end)?));
    SIGNS.iter().find_map(|sign| ends(sign)).map(str::trim_end)
}

/// Splits typed text such as `300 +- 20` into its value and its doubt.
pub(super) fn split(text: &str) -> (&str, Option<&str>) {
    let parts = SIGNS.iter().find_map(|sign| text.split_once(sign));
    parts.map_or((text, None), |(value, doubt)| (value.trim(), Some(doubt.trim())))
}

/// Takes what was typed after the sign; without a sign an older doubt is dropped.
pub(super) fn put(
    scenario: &mut Scenario,
    field: &Field,
    typed: Option<&str>,
) -> Result<(), ScenarioError> {
    let Some(typed) = typed else {
        scenario.doubt.remove(field.path);
        return Ok(());
    };
    let doubt = typed.parse().map_err(|_| refused(field, typed, "is not a number"))?;
    scenario.doubt.insert(field.path.to_owned(), doubt);
    Ok(())
}

/// Everything that is wrong with the doubts, in the order of their paths.
pub(super) fn check(scenario: &Scenario) -> Vec<Problem> {
    let mut problems = Vec::new();
    for (path, doubt) in &scenario.doubt {
        // Nobody reads more proposals than there are lines.
        let proposes = problems.len() < MAX_LINES;
        problems.extend(check_one(scenario, path, *doubt, proposes));
    }
    problems
}

fn check_one(scenario: &Scenario, path: &str, doubt: f64, proposes: bool) -> Option<Problem> {
    let problem = |message: String| Some(Problem::new(format!("doubt.{path}"), message));
    let Some(field) = fields::find(path) else {
        let numbers = fields::FIELDS.iter().filter(|field| matches!(field.kind, Kind::Number(..)));
        let near = proposes.then(|| suggestion(path, numbers.map(|field| field.path)));
        return problem(format!("there is no such field{}", near.unwrap_or_default()));
    };
    if !matches!(field.kind, Kind::Number(..)) {
        return problem("is not a number that can be doubted".to_owned());
    }
    let Some((_, bounds)) = number(field, scenario) else {
        return problem("this scenario has no such field".to_owned());
    };
    let range = Bounds { min: 0.0, max: bounds.max - bounds.min, ..bounds };
    range.refuse(doubt).map(|complaint| refused(field, &plain(doubt), complaint))
}

fn refused(field: &Field, value: &str, complaint: &str) -> Problem {
    let Kind::Number(bounds, _) = &field.kind else { return Problem::new(field.path, complaint) };
    let allowed = format!("± 0 to {} {}", plain(bounds.max - bounds.min), field.unit);
    let path = format!("doubt.{}", field.path);
    let value = format!("± {value}");
    Problem::refused(&path, &value, complaint, allowed.trim_end().to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scenario::load::{parse, to_ron};
    use crate::scenario::set::{put_number, set};

    fn doubtful(text: &str) -> Scenario {
        let mut scenario = Scenario::default();
        set(&mut scenario, "impact.force_n", text).unwrap();
        scenario
    }

    #[test]
    fn a_doubt_is_typed_behind_the_value_read_back_kept_by_a_step_and_dropped_without() {
        for text in ["310 +- 20", "310±20", "310 +/- 2e1", " 310  ±  20 "] {
            let scenario = doubtful(text);
            assert_eq!(scenario.doubt["impact.force_n"], 20.0, "{text}");
            let field = fields::find("impact.force_n").unwrap();
            assert_eq!(field.text(&scenario).unwrap(), "310 ± 20");
            assert_eq!(doubtful(&field.text(&scenario).unwrap()), scenario);
            assert_eq!(parse(&to_ron(&scenario), "x").unwrap(), scenario);
        }
        let mut scenario = doubtful("300 +- 20");
        let field = fields::find("impact.force_n").unwrap();
        put_number(&mut scenario, field, 310.0);
        assert_eq!(field.text(&scenario).unwrap(), "310 ± 20");
        set(&mut scenario, "impact.force_n", "310").unwrap();
        assert!(scenario.doubt.is_empty());
    }

    #[test]
    fn bad_doubts_are_refused_with_what_is_allowed() {
        let said = |text: &str| {
            set(&mut Scenario::default(), "impact.force_n", text).unwrap_err().to_string()
        };
        let allowed = "allowed ± 0 to 100000 N";
        for text in ["300 +- -1", "300 +- nan", "300 ± inf", "300 ± 1e6", "300 ± x", "300 ±"] {
            assert!(said(text).contains(allowed), "{}", said(text));
        }
        assert!(said("x ± 3").contains("is not a number"));
        for path in ["eye.level", "numerics.step_us", "window_ms"] {
            assert!(set(&mut Scenario::default(), path, "1 ± 1").is_err());
        }
    }

    #[test]
    fn a_file_is_told_the_line_of_an_unknown_doubt_and_what_may_be_meant() {
        let text = "(name: \"a\", impact: ForcePulse(force_n: 300.0),\n doubt: {\n  \
                    \"impact.duration_ms\": 0.1,\n  \"impact.force\": 20.0,\n})";
        let error = parse(text, "f.ron").unwrap_err().to_string();
        assert!(error.starts_with("f.ron:4:"), "{error}");
        assert!(error.contains("did you mean impact.force_n"), "{error}");
    }
}
