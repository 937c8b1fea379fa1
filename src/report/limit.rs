//! What finer meshes tend to, in one wording for every page and screen.

use crate::answer::{results::Limit, solve::Answer};
use crate::report::figure::{with_unit, within};
use crate::report::format::{digits, significant};
use crate::run::quantity::Quantity;

/// A result on the answer's mesh and in the limit of finer ones, as in
/// `12.40 N on this mesh, 12.3 ±1.0 N in the limit`; none where no limit is known.
pub fn here_and_in_the_limit(answer: &Answer, of: Quantity) -> Option<String> {
    let limit = alone(answer, of)?;
    let value = within(answer.result(of)?, answer.errors.time_step[of]);
    let here = with_unit(&value, of.row().unit);
    Some(format!("{here} on this mesh, {limit} in the limit"))
}

/// What a result tends to alone, as in `12.3 ±1.0 N`.
pub fn alone(answer: &Answer, of: Quantity) -> Option<String> {
    let limit = answer.errors.limits.as_ref()?[of]?;
    Some(with_unit(&with_error(&limit), of.row().unit))
}

/// A limit and how far it may be off, both to the second digit of that.
fn with_error(limit: &Limit) -> String {
    let Limit { value, error } = *limit;
    let error_text = digits(error, 2);
    if error_text.contains('e') || error <= 0.0 {
        return format!("{} ±{error_text}", significant(value));
    }
    let after = error_text.split_once('.').map_or(0, |(_, after)| after.len());
    format!("{value:.after$} ±{error_text}")
}

/// The results that finer meshes do not agree on, in a sentence; none where the mesh error was
/// not estimated or all have one.
pub fn unknown(answer: &Answer) -> Option<String> {
    let names: Vec<&str> = answer.errors.without_limit().map(Quantity::label).collect();
    let known = answer.errors.mesh.as_ref()?.present().next().is_some();
    match (known, names.is_empty()) {
        _ if answer.pressed_flat() => {
            Some("No eye was tested so hard, so no error is stated".to_owned())
        }
        (false, _) => Some("Finer meshes agree on no result".to_owned()),
        (true, true) => None,
        (true, false) => Some(format!("Finer meshes do not agree on {}", names.join("; "))),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_limit_has_no_finer_digits_than_its_error() {
        let said = |value, error| with_error(&Limit { value, error });
        assert_eq!(said(18.4123, 1.04), "18.4 ±1.0");
        assert_eq!(said(18.4123, 0.1234), "18.41 ±0.12");
        assert_eq!(said(184.123, 12.3), "184 ±12");
        assert_eq!(said(0.0, 0.0), "0 ±0");
        assert_eq!(said(1.234e-7, 1.2e-8), "1.234e-7 ±1.2e-8");
    }
}
