//! The numbers that a scenario's name holds, which follow its fields.

use crate::scenario::fields::{Field, Kind, LONGEST_NAME};
use crate::scenario::{Scenario, problem::plain};

/// The number of a field with its unit, as names have it: `40 m/s`, and as they round it.
fn written(scenario: &Scenario, field: &Field) -> Option<[String; 3]> {
    let Kind::Number(_, place) = &field.kind else { return None };
    let value = *(place.get)(scenario)?;
    let tenths = (10.0 * value).round() / 10.0;
    let with_unit = |value: f64| format!("{} {}", plain(value), field.unit);
    (!field.unit.is_empty()).then(|| [value, tenths, value.round()].map(with_unit))
}

/// Where a field has changed whose number stands in the name, it is the new one there.
pub(super) fn follow(scenario: &mut Scenario, before: &Scenario, field: &Field) {
    let (Some(old), Some([new, ..])) = (written(before, field), written(scenario, field)) else {
        return;
    };
    if !old.iter().any(|old| replace(scenario, &before.name, old, &new)) {
        return;
    }
    // A number of many digits may leave no room for the end.
    scenario.name = scenario.name.chars().take(LONGEST_NAME).collect();
}

/// Puts a new number in place of the first that stands by itself; whether there was one.
fn replace(scenario: &mut Scenario, name: &str, old: &str, new: &str) -> bool {
    let outside =
        |sign: Option<char>| !sign.is_some_and(|sign| sign.is_ascii_alphanumeric() || sign == '.');
    let whole = |at: &usize| {
        let after = name[at + old.len()..].chars().next();
        outside(name[..*at].chars().next_back()) && outside(after.filter(|sign| *sign != '.'))
    };
    let mut places = name.match_indices(old).map(|(at, _)| at).filter(whole);
    let place = places.next();
    if let Some(at) = place {
        scenario.name.replace_range(at..at + old.len(), new);
    }
    place.is_some()
}

#[cfg(test)]
mod tests {
    use crate::scenario::{library::find, set::set};

    #[test]
    fn a_name_says_the_speed_that_was_set_and_keeps_what_is_no_field_of_it() {
        let mut ball = find("squash-ball").unwrap().scenario().unwrap();
        set(&mut ball, "impact.speed_m_s", "30").unwrap();
        assert_eq!(ball.name, "Squash ball at 30 m/s");
        let mut cork = find("champagne-cork").unwrap().scenario().unwrap();
        set(&mut cork, "impact.speed_m_s", "42").unwrap();
        assert_eq!(cork.name, "Champagne cork at 42 m/s");
        ball.name = "140 m/s or 30 m/s".to_owned();
        set(&mut ball, "impact.speed_m_s", "55.5").unwrap();
        assert_eq!(ball.name, "140 m/s or 55.5 m/s");
        ball.name = "A ball at 155.5 m/s".to_owned();
        set(&mut ball, "impact.speed_m_s", "20").unwrap();
        assert_eq!(ball.name, "A ball at 155.5 m/s");
        ball.name = format!("A ball at 20 m/s{}", "!".repeat(64));
        set(&mut ball, "impact.speed_m_s", "20.000000001").unwrap();
        assert!(ball.name.starts_with("A ball at 20.000000001 m/s!") && ball.check().is_ok());
    }
}
