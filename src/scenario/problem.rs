//! What is wrong with a scenario, and where.
//!
//! A form puts the message of a [`Problem`] beside the right input, the command line prints one
//! line that an editor can jump to. Somebody else's text is made safe and cut on its way there.

use crate::plain_text;
use crate::plain_text::{LONGEST_QUOTE, quoted};
use std::fmt;

/// One thing that is wrong with a scenario.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Problem {
    /// The file or preset, as named by the person; empty when there is none.
    pub origin: String,
    /// Line in that file, from 1.
    pub line: Option<usize>,
    /// Column in that line, from 1, in characters.
    pub column: Option<usize>,
    /// Dotted path of the field; empty when the whole file is meant.
    pub field: String,
    /// The offending value, escaped for display.
    pub value: Option<String>,
    /// What would be accepted, as in "0 to 100000 N".
    pub allowed: Option<String>,
    /// The whole complaint in one line; it repeats the value and what is allowed.
    pub message: String,
}

impl Problem {
    /// A complaint about a field, without a place yet.
    pub fn new(field: impl Into<String>, message: impl Into<String>) -> Self {
        Self { field: field.into(), message: message.into(), ..Self::default() }
    }

    /// A complaint about one value of a field: "-5 is out of range: allowed 0 to 100000 N".
    pub fn refused(field: &str, value: &str, complaint: &str, allowed: String) -> Self {
        let value = quoted(value);
        let complaint = format!("{value} {complaint}");
        Self { value: Some(value), ..Self::lacking(field, &complaint, allowed) }
    }

    /// A complaint that there is no value.
    pub fn lacking(field: &str, complaint: &str, allowed: String) -> Self {
        let message = format!("{complaint}: allowed {allowed}");
        Self { allowed: Some(allowed), ..Self::new(field, message) }
    }

    /// The same problem, said of the given file or preset.
    #[must_use]
    pub fn of(mut self, origin: &str) -> Self {
        origin.clone_into(&mut self.origin);
        self
    }

    /// The same problem at a line and column.
    #[must_use]
    pub fn at(mut self, (line, column): (usize, usize)) -> Self {
        self.line = Some(line);
        self.column = Some(column);
        self
    }
}

impl fmt::Display for Problem {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let origin = plain_text::message(&self.origin);
        let position = self.line.zip(self.column).map(|(line, column)| format!("{line}:{column}"));
        let place = match position {
            Some(position) if origin.is_empty() => position,
            Some(position) => format!("{origin}:{position}"),
            None => origin,
        };
        let parts = [place, quoted(&self.field), plain_text::message(&self.message)];
        let parts: Vec<String> = parts.into_iter().filter(|part| !part.is_empty()).collect();
        f.write_str(&parts.join(": "))
    }
}

impl std::error::Error for Problem {}

/// Everything that is wrong with a scenario; displayed one problem a line.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{}", plain_text::lines(.problems.iter().map(Problem::to_string)))]
pub struct ScenarioError {
    /// At least one problem, in the order of the fields.
    pub problems: Vec<Problem>,
}

impl ScenarioError {
    /// The same problems, said of the given file or preset.
    #[must_use]
    pub fn of(mut self, origin: &str) -> Self {
        for problem in &mut self.problems {
            origin.clone_into(&mut problem.origin);
        }
        self
    }
}

impl From<Problem> for ScenarioError {
    fn from(problem: Problem) -> Self {
        Self { problems: vec![problem] }
    }
}

/// A number in the fewest digits without loss, with an exponent where they are hard to count.
pub fn plain(number: f64) -> String {
    let size = number.abs();
    let exponent = size != 0.0 && size.is_finite() && !(1e-7..1e15).contains(&size);
    if exponent { format!("{number:e}") } else { format!("{number}") }
}

/// Characters from which on a part of a name can stand for it.
const SHORTEST_PART: usize = 4;
/// From this likeness on, of 1 at most, one name is proposed for another.
pub const ALIKE: f64 = 0.8;

/// Up to three candidates that resemble a mistyped name, the nearest first.
pub fn nearest<'a>(typed: &str, candidates: impl Iterator<Item = &'a str>) -> Vec<&'a str> {
    let alike = by_likeness(typed, candidates).into_iter();
    let alike = alike.take_while(|(score, _)| *score > ALIKE).take(3);
    alike.map(|(_, candidate)| candidate).collect()
}

/// The five candidates that are most like a name, however little, in words.
pub fn five_nearest<'a>(typed: &str, candidates: impl Iterator<Item = &'a str>) -> String {
    let nearest = by_likeness(typed, candidates).into_iter().take(5);
    let names: Vec<&str> = nearest.map(|(_, candidate)| candidate).collect();
    names.join(", ")
}

/// Candidates with their likeness to a name, the nearest first.
fn by_likeness<'a>(typed: &str, candidates: impl Iterator<Item = &'a str>) -> Vec<(f64, &'a str)> {
    // Long enough to be told apart, short enough that a pasted novel costs nothing.
    let typed: String = typed.chars().take(LONGEST_QUOTE).collect();
    let mut scored: Vec<(f64, &str)> =
        candidates.map(|candidate| (likeness(&typed, candidate), candidate)).collect();
    scored.sort_by(|a, b| b.0.total_cmp(&a.0));
    scored
}

/// How much a mistyped name is like another, from 0 to 1, by its whole, its last part or any part:
/// `force_n` means `impact.force_n`, and `verlet` `VelocityVerlet`.
pub fn likeness(typed: &str, candidate: &str) -> f64 {
    let bare = |name: &str| name.to_lowercase();
    if typed.chars().count() >= SHORTEST_PART && bare(candidate).contains(&bare(typed)) {
        return 1.0;
    }
    let last = |path: &str| path.rsplit('.').next().unwrap_or_default().to_owned();
    strsim::jaro_winkler(typed, candidate).max(strsim::jaro_winkler(&last(typed), &last(candidate)))
}

/// "; did you mean a or b?", or nothing.
pub fn suggestion<'a>(typed: &str, candidates: impl Iterator<Item = &'a str>) -> String {
    meant(typed, candidates).map_or_else(String::new, |question| format!("; {question}"))
}

fn meant<'a>(typed: &str, candidates: impl Iterator<Item = &'a str>) -> Option<String> {
    let names = nearest(typed, candidates).join(" or ");
    (!names.is_empty()).then(|| format!("did you mean {names}?"))
}

/// The complaint about a name that is none of those allowed.
pub fn unknown_name<'a>(
    field: &str,
    typed: &str,
    names: impl Iterator<Item = &'a str>,
    allowed: String,
) -> Problem {
    let near = meant(typed, names).map_or_else(String::new, |question| format!(" ({question})"));
    Problem::refused(field, typed, &format!("is not known here{near}"), allowed)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_nearest_names_come_first() {
        let paths = ["impact.force_n", "eye.level", "window_ms"];
        assert_eq!(nearest("force_n", paths.into_iter()), ["impact.force_n"]);
        assert_eq!(nearest("eye.levle", paths.into_iter())[0], "eye.level");
        assert!(nearest("zzzz", paths.into_iter()).is_empty());
    }
}
