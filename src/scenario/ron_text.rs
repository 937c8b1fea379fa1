//! RON to values and back, with errors that name the field, the place and what would do.
//!
//! The reader's own error knows where its cursor stood but not which field it was filling;
//! `serde_path_to_error` knows the field. Both go into one [`Problem`].

use crate::plain_text::quoted;
use crate::scenario::problem::{Problem, ScenarioError, suggestion, unknown_name};
use crate::scenario::{Scenario, fields, fields::Kind, locate::locate};
use ron::Options;
use ron::de::Deserializer;
use ron::error::{Error, SpannedError};
use ron::extensions::Extensions;
use ron::ser::PrettyConfig;
use serde::de::DeserializeOwned;
use serde_path_to_error::{Path, Segment, Track};

/// Lets a file say `step_us: 1.5` and `ForcePulse(force_n: 1)` without wrappers.
pub(super) fn options() -> Options {
    Options::default()
        .with_default_extension(Extensions::IMPLICIT_SOME)
        .with_default_extension(Extensions::UNWRAP_VARIANT_NEWTYPES)
}

/// `model: Physiological`, whose parts all have defaults, with the brackets that the reader wants.
fn completed(text: &str) -> Option<String> {
    let (line, column) = locate(text, "model");
    let value = rest_of_line(text, (line, column));
    let rest = value.strip_prefix("Physiological")?;
    let start = text.split_inclusive('\n').take(line - 1).map(str::len);
    let within: usize = rest_of_line(text, (line, 1)).len() - rest.len();
    let end = start.sum::<usize>() + within;
    let bare = !text[end..].trim_start().starts_with('(');
    bare.then(|| format!("{}(){}", &text[..end], &text[end..]))
}

/// What to say of a value of the wrong kind at a dotted path, and what is allowed there.
pub(crate) type Expected = fn(&str) -> Option<(&'static str, String)>;

/// Reads a value that stands at the dotted path `under` of a scenario (empty for a whole one).
pub(crate) fn read<T: DeserializeOwned>(text: &str, under: &str) -> Result<T, ScenarioError> {
    let completed = if under.is_empty() { completed(text) } else { None };
    read_with(completed.as_deref().unwrap_or(text), under, expected)
}

/// Reads any value, with what its fields may be.
pub(crate) fn read_with<T: DeserializeOwned>(
    text: &str,
    under: &str,
    expected: Expected,
) -> Result<T, ScenarioError> {
    let explain = |path: &str, error: &SpannedError| explain(text, under, path, error, expected);
    let mut source = Deserializer::from_str_with_options(text, &options())
        .map_err(|error| explain(under, &error))?;
    let mut track = Track::new();
    let value = T::deserialize(serde_path_to_error::Deserializer::new(&mut source, &mut track));
    let (value, path) = match value {
        Ok(value) => (source.end().map(|()| value), under.to_owned()),
        Err(code) => (Err(code), dotted(under, &track.path())),
    };
    value.map_err(|code| explain(&path, &source.span_error(code)).into())
}

/// The scenario as RON, one field a line; reading it back gives an equal scenario.
#[expect(clippy::missing_panics_doc, reason = "plain fields into a string cannot fail")]
pub fn to_ron(scenario: &Scenario) -> String {
    let layout = PrettyConfig::new().new_line("\n").compact_arrays(true);
    let text = options().to_string_pretty(scenario, layout);
    text.expect("a scenario holds nothing that RON cannot write") + "\n"
}

/// The path in a person's terms: variants are not fields.
fn dotted(under: &str, path: &Path) -> String {
    let mut dotted = under.to_owned();
    for segment in path {
        match segment {
            Segment::Map { key } => dotted = joined(&dotted, key),
            Segment::Seq { index } => dotted.extend(["[", &index.to_string(), "]"]),
            Segment::Enum { .. } | Segment::Unknown => {}
        }
    }
    dotted
}

fn joined(parent: &str, field: &str) -> String {
    match parent.rsplit('.').next() {
        Some("") => field.to_owned(),
        // The reader may or may not have entered the field before it complained.
        Some(last) if last == field => parent.to_owned(),
        _ => format!("{parent}.{field}"),
    }
}

fn explain(
    text: &str,
    under: &str,
    path: &str,
    error: &SpannedError,
    expected: Expected,
) -> Problem {
    let before = (error.span.start.line, error.span.start.col);
    let cursor = (error.span.end.line, error.span.end.col);
    match &error.code {
        Error::NoSuchStructField { expected, found, .. } => {
            let near = suggestion(found, expected.iter().copied());
            let allowed = expected.join(", ");
            let message = format!("there is no such field{near} (allowed: {allowed})");
            let problem = Problem::new(joined(path, found), message);
            Problem { value: Some(quoted(found)), allowed: Some(allowed), ..problem }.at(before)
        }
        Error::NoSuchEnumVariant { expected, found, .. } => {
            let names = expected.iter().copied();
            unknown_name(path, found, names, expected.join(", ")).at(before)
        }
        Error::MissingStructField { field, .. } => {
            Problem::new(joined(path, field), "is missing").at(cursor)
        }
        Error::DuplicateStructField { field, .. } => {
            Problem::new(joined(path, field), "is given twice").at(before)
        }
        // The rules of a curve, said at the knot or at the name of its file.
        Error::Message(message) => Problem::new(path, message).at(before),
        code => {
            // What precedes the error did parse, so the start of the value can be found in it.
            let inside = path.strip_prefix(under).unwrap_or(path).trim_start_matches('.');
            let start = if inside.contains('[') { cursor } else { locate(text, inside) };
            match expected(path).filter(|_| about_the_value(code, start == cursor)) {
                Some((complaint, allowed)) => match word_at(text, start) {
                    "" => Problem::lacking(path, "a value is missing", allowed),
                    word => Problem::refused(path, word, complaint, allowed),
                }
                .at(start),
                None => Problem::new(path, punctuation(code, text, cursor)).at(cursor),
            }
        }
    }
}

/// What to say of an error that is not about one value.
fn punctuation(code: &Error, text: &str, place: (usize, usize)) -> String {
    let found = match (word_at(text, place), rest_of_line(text, place).chars().next()) {
        ("", None) => "the end of the line".to_owned(),
        ("", Some(mark)) => mark.to_string(),
        (word, _) => quoted(word),
    };
    match code {
        Error::ExceededRecursionLimit => "is nested too deeply".to_owned(),
        Error::Eof => "the text ends too early".to_owned(),
        Error::ExpectedComma => format!("expected a comma or a closing bracket, found {found}"),
        Error::ExpectedStructLike | Error::ExpectedNamedStructLike(_) => {
            format!("expected `(`, found {found}")
        }
        Error::TrailingCharacters => format!("expected the end of the text, found {found}"),
        Error::ExpectedStringEnd => "the text in quotes does not end".to_owned(),
        Error::UnclosedBlockComment => "a block comment does not end".to_owned(),
        code => format!("{code}, found {found}"),
    }
}

/// Whether an error is about the value that stands there, not about what surrounds it.
fn about_the_value(code: &Error, at_start: bool) -> bool {
    match code {
        Error::ExpectedFloat
        | Error::ExpectedInteger
        | Error::ExpectedBoolean
        | Error::ExpectedString
        | Error::ExpectedArray
        | Error::ExpectedOption
        | Error::FloatUnderscore
        | Error::IntegerOutOfBounds
        | Error::InvalidIntegerDigit { .. }
        | Error::InvalidValueForType { .. }
        | Error::UnderscoreAtBeginning => true,
        // Within a variant the path is still the variant's own.
        Error::ExpectedIdentifier
        | Error::InvalidIdentifier(_)
        | Error::SuggestRawIdentifier(_) => at_start,
        _ => false,
    }
}

/// What to say of a value of the wrong kind in a scenario, and what is allowed there.
fn expected(path: &str) -> Option<(&'static str, String)> {
    let whole = path.split('[').next().unwrap_or(path);
    let field = fields::find(whole)?;
    Some(match field.kind {
        _ if whole == path => (not_a(&field.kind), field.allowed()),
        Kind::Integers(..) => ("is not a whole number in range", field.allowed()),
        Kind::OptionalNumber(..) => (not_a(&field.kind), field.allowed()),
        // Only a table has numbers inside.
        _ => ("is not a number", "knots (t_ms, share)".to_owned()),
    })
}

/// The complaint about text that is no value of this kind at all.
pub(super) fn not_a(kind: &Kind) -> &'static str {
    match kind {
        Kind::Number(..) | Kind::OptionalNumber(..) => "is not a number",
        Kind::Integer(..) => "is not a whole number in range",
        Kind::Choice(..) => "is not known here",
        Kind::Integers(..) => "is not a list of whole numbers",
        Kind::Text(..) => "is not text in quotes",
    }
}

/// The text at a place, up to where a value would end.
pub(crate) fn word_at(text: &str, place: (usize, usize)) -> &str {
    let rest = rest_of_line(text, place);
    let end = match rest.strip_prefix('"') {
        Some(inside) => inside.find('"').map_or(rest.len(), |at| at + 2),
        None => rest.find([',', ')', ']', '/']).unwrap_or(rest.len()),
    };
    rest[..end].trim()
}

fn rest_of_line(text: &str, (line, column): (usize, usize)) -> &str {
    let line = text.lines().nth(line.saturating_sub(1)).unwrap_or_default();
    let start = line.char_indices().nth(column.saturating_sub(1));
    start.map_or("", |(at, _)| &line[at..])
}
