//! Reading a scenario from a file.
//!
//! A file may come from anywhere, so it is read with a limit, only if it is a regular file, and
//! what it holds reaches a message only escaped.

use std::fs::{self, File};
use std::io::{self, Read};
use std::path::Path;

use super::Scenario;
use super::check::check;
use super::locate::locate;
use super::problem::{Problem, ScenarioError};
use super::ron_text::read;

pub use super::ron_text::to_ron;

/// The greatest size of a scenario file, in bytes. The longest useful one is a hundredth of it.
pub const LIMIT: u64 = 64 * 1024;

/// Reads a scenario from RON text; `origin` is what messages call the text.
///
/// # Errors
/// Gives the first problem of syntax or type, or else every value that is out of range, each with
/// its line and column.
pub fn parse(text: &str, origin: &str) -> Result<Scenario, ScenarioError> {
    // Editors on some systems put a byte order mark before the text.
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    let scenario: Scenario = read(text, "").map_err(|error: ScenarioError| error.of(origin))?;
    check(&scenario).map_err(|mut error| {
        for problem in &mut error.problems {
            let (line, column) = locate(text, &problem.field);
            (problem.line, problem.column) = (Some(line), Some(column));
        }
        error.of(origin)
    })?;
    Ok(scenario)
}

/// Reads a scenario from a file.
///
/// # Errors
/// As [`parse`], and where the file cannot be read.
pub fn load(path: &Path) -> Result<Scenario, ScenarioError> {
    parse(&read_text(path)?, &path.display().to_string())
}

/// The text of a scenario file, without looking into it.
///
/// # Errors
/// Says why the file cannot be read: missing, too large, no regular file, not UTF-8.
pub fn read_text(path: &Path) -> Result<String, ScenarioError> {
    let complain = |message: String| Problem::new("", message).of(&path.display().to_string());
    let failed = |error: io::Error| complain(reason(&error));
    // Opening a pipe would wait for somebody to write to it, so its kind is asked for first.
    let kind = fs::metadata(path).map_err(failed)?;
    if kind.is_dir() {
        return Err(complain("is a directory, not a scenario file".to_owned()).into());
    }
    if !kind.is_file() {
        return Err(complain("is not a regular file".to_owned()).into());
    }
    let mut bytes = Vec::new();
    File::open(path)
        .and_then(|file| file.take(LIMIT + 1).read_to_end(&mut bytes))
        .map_err(failed)?;
    if bytes.len() as u64 > LIMIT {
        return Err(complain(format!("is larger than {} KiB", LIMIT / 1024)).into());
    }
    String::from_utf8(bytes).map_err(|error| {
        let valid = error.utf8_error().valid_up_to();
        let before = &error.as_bytes()[..valid];
        let line = before.split(|byte| *byte == b'\n').count();
        complain(format!("is not UTF-8 text (line {line})")).into()
    })
}

fn reason(error: &io::Error) -> String {
    match error.kind() {
        io::ErrorKind::NotFound => "there is no such file".to_owned(),
        io::ErrorKind::PermissionDenied => "may not be read (permission denied)".to_owned(),
        _ => format!("cannot be read: {error}"),
    }
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
        assert_eq!(
            lines[1],
            "x.ron:4:12: impact.force_n: -5 is out of range: allowed 0 to 100000 N"
        );
        assert!(lines[2].starts_with("x.ron:6:13: window_ms: NaN is not a finite number"));
    }

    #[test]
    fn deep_nesting_is_refused_and_does_not_exhaust_the_stack() {
        for unit in ["(", "[", "{", "(eye:", "Some(", "/*", "(name:("] {
            assert!(complaint(&unit.repeat(100_000)).len() < 500);
            assert!(complaint(&format!("(eye: {}", unit.repeat(100_000))).len() < 500);
        }
    }

    #[test]
    fn content_is_escaped_in_messages() {
        for text in [
            "(\u{1b}[2J: 1)",
            "(name: \u{1b}]0;x\u{7})",
            "(na\u{9b}me: 1)",
            "\u{0}",
        ] {
            assert!(
                !complaint(text).contains(|c: char| c.is_control()),
                "{text:?}"
            );
        }
    }

    #[test]
    fn the_physiological_model_may_stand_without_brackets() {
        for model in [
            "Physiological",
            "Physiological()",
            "Physiological (slab: true)",
        ] {
            for end in [",", "\n,"] {
                let text = format!(
                    "(name: \"x\",\n  model: {model}{end} impact: Projectile(mass_g: 1, diameter_mm: 6, \
                     speed_m_s: 5))"
                );
                let scenario = parse(&text, "here").unwrap();
                assert_eq!(
                    scenario.model,
                    Model::Physiological(Physiological::default())
                );
                assert_eq!(parse(&to_ron(&scenario), "here").unwrap(), scenario);
            }
        }
        let error = complaint("(name: \"x\", impact: Projectile(mass_g: 1, speed_m_s: 5))");
        assert!(error.contains("diameter_mm"), "{error}");
    }

    #[test]
    fn a_byte_order_mark_is_passed_over() {
        assert!(parse(&format!("\u{feff}{}", to_ron(&Scenario::default())), "x").is_ok());
    }
}
