//! Where in a RON text the value of a field stands.
//!
//! A range error is found after reading, when the reader no longer knows where the value came
//! from. This reads the text again up to the value and asks the reader where it stands.

use crate::scenario::ron_text::options;
use ron::de::Deserializer;
use serde::de::{DeserializeSeed, Error, IgnoredAny, MapAccess, Visitor};
use std::fmt;

/// Line and column (from 1, in characters) of the value at a dotted path, or of what holds it;
/// names of variants are passed through: `impact.force_n` lies in `impact: ForcePulse(...)`.
pub fn locate(text: &str, path: &str) -> (usize, usize) {
    // Doubts are a map by paths in quotes.
    let path: Vec<&str> = match path.strip_prefix("doubt.") {
        Some(of) => vec!["doubt", of],
        None => path.split('.').collect(),
    };
    (0..=path.len()).rev().find_map(|depth| place(text, &path[..depth])).unwrap_or((1, 1))
}

/// Whether there is nothing but white space and comments.
#[cfg(feature = "app")]
pub(crate) fn is_blank(text: &str) -> bool {
    Deserializer::from_str(text).is_ok_and(|mut source| source.end().is_ok())
}

/// Where exactly this value stands; none if it is not there.
fn place(text: &str, path: &[&str]) -> Option<(usize, usize)> {
    let mut source = Deserializer::from_str_with_options(text, &options()).ok()?;
    let mut found = false;
    let stopped = Seek { path, found: &mut found }.deserialize(&mut source).err()?;
    let at = source.span_error(stopped).span.end;
    found.then_some((at.line, at.col))
}

/// Reads up to the value at a path, and stops there by an error.
struct Seek<'a> {
    path: &'a [&'a str],
    found: &'a mut bool,
}

impl<'de> DeserializeSeed<'de> for Seek<'_> {
    type Value = ();

    fn deserialize<D: serde::Deserializer<'de>>(self, source: D) -> Result<(), D::Error> {
        if self.path.is_empty() {
            *self.found = true;
            return Err(D::Error::custom("here"));
        }
        source.deserialize_any(self)
    }
}

impl<'de> Visitor<'de> for Seek<'_> {
    type Value = ();

    fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str("fields")
    }

    fn visit_map<A: MapAccess<'de>>(self, mut fields: A) -> Result<(), A::Error> {
        let Some((field, path)) = self.path.split_first() else { return Ok(()) };
        while let Some(name) = fields.next_key::<String>()? {
            if name == *field {
                return fields.next_value_seed(Seek { path, found: self.found });
            }
            fields.next_value::<IgnoredAny>()?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The text with a mark before the expected place, which is taken out first.
    fn assert_found(path: &str, marked: &str) {
        let (before, after) = marked.split_once('@').unwrap();
        let last = before.rsplit('\n').next().unwrap();
        let expected = (before.split('\n').count(), last.chars().count() + 1);
        assert_eq!(locate(&format!("{before}{after}"), path), expected, "{path} in {marked}");
    }

    #[test]
    fn values_are_found_through_variants_and_structs_or_else_what_holds_them() {
        let path = "impact.force_n";
        assert_found(path, "(name: \"a\", impact: ForcePulse(duration_ms: 1, force_n: @-5))");
        assert_found(path, "Scenario(\n  eye: (force_n: 1),\n  impact:\n ForcePulse(force_n: @5)");
        assert_found("impact.shape.edge_fraction", "(impact: F(shape: S (edge_fraction: @9, ), ))");
        assert_found("eye.filament_hops", "(eye: (lens: true, filament_hops: @[1, 2], level: 1))");
        assert_found("r", "#![enable(implicit_some)]\n#![enable(unwrap_newtypes)] (r#r: @1)");
        assert_found("eye.level", "(impact: F(level: 1), eye: @(lens: true))");
        assert_found("eye.level", "(eye: @3, level: 4)");
        assert_found("window_ms", " // x\n @(name: \"a\")");
        assert_eq!(locate("", "a.b"), (1, 1));
    }

    #[test]
    fn what_looks_like_a_field_inside_text_or_comments_is_passed_over() {
        assert_found("a", "(b: \"a: 1, \\\" a: 2)\", a: @3)");
        assert_found("a", "(b: r#\"a: 1\" a: 2\"#, a: @3)");
        assert_found("a", "(b: r\"\\\", a: @3)");
        assert_found("a", "(b: '\"', c: '\\'', d: b'(', e: b\"(\", a: @3)");
        assert_found("a", "/* ( /* a: 1 */ ( */ (// a: 2, (\n a /* : 4 */ : /**/ @3)");
        assert_found("a", "(b: [a, (a: 1)], c: {\"a\": 2}, a: @3)");
        assert_found("a", "(ä: \"é€\", a: @3)");
    }

    #[test]
    fn deep_nesting_and_unfinished_text_end_quietly() {
        let deep = format!("(a: {}", "(".repeat(100_000));
        assert_eq!(locate(&deep, "b"), (1, 1));
        assert_eq!(locate(&"/*".repeat(100_000), "b").0, 1);
        for text in ["(a: \"", "(a: r##\"x\"#", "(a: '", "#![", "/*", "(a: '\\"] {
            locate(text, "b");
        }
    }
}
