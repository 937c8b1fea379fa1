//! Reading a scenario from a file, which may come from anywhere.

use crate::plain_text::MAX_LINES;
use crate::scenario::curve_file::{PathBase, with_files};
use crate::scenario::problem::{Problem, ScenarioError};
use crate::scenario::{Scenario, locate::locate, ron_text::read};
use crate::scenario::{text_file, text_file::without_mark};
use std::path::Path;

pub use crate::scenario::ron_text::to_ron;

/// Reads a scenario from RON text, which can name no file of a curve; messages call it `origin`.
///
/// # Errors
/// The first problem of syntax or type, or else every value out of range, with line and column.
pub fn parse(text: &str, origin: &str) -> Result<Scenario, ScenarioError> {
    parse_with_base(text, origin, &PathBase::Nowhere)
}

/// Reads a scenario from the text of the file at `path`, which may name curves in its folder.
///
/// # Errors
/// As [`parse`], and where such a curve cannot be read.
pub fn parse_file(text: &str, path: &Path) -> Result<Scenario, ScenarioError> {
    let folder = path.parent().unwrap_or(Path::new("")).to_owned();
    parse_with_base(text, &path.display().to_string(), &PathBase::Scenario(folder))
}

fn parse_with_base(text: &str, origin: &str, base: &PathBase) -> Result<Scenario, ScenarioError> {
    let text = without_mark(text);
    let scenario: Scenario =
        with_files(base, || read(text, "")).map_err(|error: ScenarioError| error.of(origin))?;
    let checked = scenario.check().map_err(|mut error| {
        // Each place is looked for from the beginning, and no more of them are ever read.
        for problem in error.problems.iter_mut().take(MAX_LINES) {
            let at = locate(text, &problem.field);
            *problem = std::mem::take(problem).at(at);
        }
        error.of(origin)
    })?;
    Ok(checked.into())
}

/// Reads a scenario from a file.
///
/// # Errors
/// As [`parse_file`], and where the file cannot be read.
pub fn load(path: &Path) -> Result<Scenario, ScenarioError> {
    parse_file(&read_text(path)?, path)
}

/// The text of a scenario file, or why it cannot be read.
pub(crate) fn read_text(path: &Path) -> Result<String, ScenarioError> {
    text_file::read(path)
        .map_err(|why| Problem::new("", why).of(&path.display().to_string()).into())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scenario::{Model, Physiological};

    fn complaint(text: &str) -> String {
        parse(text, "x.ron").unwrap_err().to_string()
    }

    #[test]
    fn every_value_out_of_range_is_reported_with_its_place() {
        let text =
            "(\n name: \"\",\n impact: ForcePulse(\n  force_n: -5,\n ),\n window_ms: NaN,\n)";
        let complaint = complaint(text);
        let lines: Vec<_> = complaint.lines().collect();
        assert_eq!(lines.len(), 3);
        assert!(lines[0].starts_with("x.ron:2:8: name: \"\" is empty: allowed"));
        let out_of_range = "x.ron:4:12: impact.force_n: -5 is out of range: allowed 0 to 100000 N";
        assert_eq!(lines[1], out_of_range);
        assert!(lines[2].starts_with("x.ron:6:13: window_ms: NaN is not a finite number"));
    }

    #[test]
    fn ten_thousand_unknown_fields_are_refused_in_no_time() {
        let doubts = (0..10_000).map(|i| format!("\"impact.farce_{i}\": 1.0, "));
        let doubts = doubts.collect::<Vec<_>>().concat();
        let text = format!("(name: \"x\", impact: ForcePulse(), doubt: {{{doubts}}})");
        let begun = std::time::Instant::now();
        assert!(complaint(&text).contains("and 9980 more like these"));
        assert!(begun.elapsed().as_millis() < 500, "{:?}", begun.elapsed());
    }

    #[test]
    fn deep_nesting_is_refused_and_does_not_exhaust_the_stack() {
        for unit in ["(", "[", "{", "(eye:", "Some(", "/*", "(name:("] {
            assert!(complaint(&unit.repeat(100_000)).len() < 500);
            assert!(complaint(&format!("(eye: {}", unit.repeat(100_000))).len() < 500);
        }
    }

    #[test]
    fn the_physiological_model_may_stand_without_brackets_and_a_byte_order_mark_before_all() {
        let object = "impact: Projectile(mass_g: 1, diameter_mm: 6, speed_m_s: 5)";
        for model in ["Physiological", "Physiological()", "Physiological (species: Human)"] {
            for end in [",", "\n,"] {
                let text = format!("(name: \"x\",\n  model: {model}{end} {object})");
                let scenario = parse(&text, "here").unwrap();
                assert_eq!(scenario.model, Model::Physiological(Physiological::default()));
                assert_eq!(parse(&to_ron(&scenario), "here").unwrap(), scenario);
            }
        }
        let scenario = parse(&format!("(name: \"x\", {object})"), "here").unwrap();
        assert_eq!(scenario.model, Model::Physiological(Physiological::default()));
        let error = complaint("(name: \"x\", impact: Projectile(mass_g: 1, speed_m_s: 5))");
        assert!(error.contains("diameter_mm"), "{error}");
        assert!(parse(&format!("\u{feff}{}", to_ron(&Scenario::default())), "x").is_ok());
    }
}
