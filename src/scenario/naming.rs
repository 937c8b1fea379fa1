//! The numbers that a scenario's name holds, which follow its fields.

use crate::scenario::fields::{Field, Kind, LONGEST_NAME};
use crate::scenario::{Scenario, problem::plain};

/// The number of a field with its unit, as names have it: `40 m/s`.
fn written(scenario: &Scenario, field: &Field) -> Option<String> {
    let Kind::Number(_, place) = &field.kind else { return None };
    let value = (place.get)(scenario)?;
    (!field.unit.is_empty()).then(|| format!("{} {}", plain(*value), field.unit))
}

/// Where a field has changed whose number stands in the name, it is the new one there.
pub(super) fn follow(scenario: &mut Scenario, before: &Scenario, field: &Field) {
    let (Some(old), Some(new)) = (written(before, field), written(scenario, field)) else { return };
    let outside =
        |sign: Option<char>| !sign.is_some_and(|sign| sign.is_ascii_alphanumeric() || sign == '.');
    let name = &before.name;
    let whole = |at: &usize| {
        let after = name[at + old.len()..].chars().next();
        outside(name[..*at].chars().next_back()) && outside(after.filter(|sign| *sign != '.'))
    };
    let mut places = name.match_indices(&old).map(|(at, _)| at).filter(whole);
    if let Some(at) = places.next() {
        scenario.name.replace_range(at..at + old.len(), &new);
        // A number of many digits may leave no room for the end.
        scenario.name = scenario.name.chars().take(LONGEST_NAME).collect();
    }
}

#[cfg(test)]
mod tests {
    use crate::scenario::{library::find, set::set};

    #[test]
    fn a_name_says_the_speed_that_was_set_and_keeps_what_is_no_field_of_it() {
        let mut ball = find("squash-ball").unwrap().scenario().unwrap();
        set(&mut ball, "impact.speed_m_s", "30").unwrap();
        assert_eq!(ball.name, "Squash ball at 30 m/s");
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
