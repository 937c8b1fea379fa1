use super::*;
use crate::answer::solve::tests::answered;
use crate::scenario::{library::tests::preset, set::set};

#[test]
fn a_result_is_found_by_its_key_and_by_what_it_is_called() {
    for name in ["globe_rupture_percent", "globe rupture", "Globe-Rupture"] {
        assert_eq!(meant(name), Some(Quantity::GlobeRupture), "{name}");
    }
    for quantity in Quantity::ALL {
        assert_eq!(meant(quantity.label()), Some(*quantity));
    }
    assert_eq!(meant("globe"), None);
    let told = wanted("globe ruptur = 50").unwrap_err().to_string();
    assert!(told.contains("globe_rupture_percent") && told.len() < 200, "{told}");
}

fn found(scenario: Scenario, vary: &str, until: &str) -> Threshold {
    let question = ThresholdSearch::read(scenario, vary, wanted(until).unwrap()).unwrap();
    question.answer(&AtomicBool::new(false), |_| {}).unwrap()
}

fn short() -> Scenario {
    Scenario { window_ms: Some(0.3), ..Scenario::default() }
}

#[test]
fn a_crossing_is_where_the_result_has_the_value_and_its_errors_follow_the_slope() {
    let threshold = found(short(), "impact.force_n=50:800", "apex_displacement_mm = 2");
    let [crossing] = &threshold.crossings[..] else { panic!("{threshold:?}") };
    let mut there = short();
    set(&mut there, "impact.force_n", &plain(crossing.at)).unwrap();
    let answer = answered(&there);
    let apex = answer.results()[Quantity::Apex].unwrap();
    assert!((apex / 2.0 - 1.0).abs() < 2e-4, "{apex} at {}", crossing.at);
    // The apex is nearly proportional to the force, so their errors are of one share.
    let error = answer.errors.time_step[Quantity::Apex].unwrap() / 100.0;
    let share = crossing.step.unwrap() / crossing.at;
    assert!((0.5..2.0).contains(&(share / error)), "{share} {error}");
    assert!(crossing.mesh.unwrap() > crossing.step.unwrap());
    assert!(crossing.rising && crossing.jump.is_none());
}

#[test]
fn one_that_falls_again_is_crossed_twice_and_one_beyond_reach_never() {
    let angles = "impact.angle_deg=-40:40";
    let below = found(short(), angles, "apex_displacement_mm = 1.5");
    let ways: Vec<bool> = below.crossings.iter().map(|c| c.rising).collect();
    assert_eq!(ways, [true, false], "{below:?}");
    // The section is the same above and below.
    let ends = below.crossings[0].at + below.crossings[1].at;
    assert!(ends.abs() < 0.1, "{below:?}");
    let never = found(short(), angles, "apex_displacement_mm = 50");
    assert!(never.crossings.is_empty() && never.seen.len() > 20);
}

#[test]
fn a_risk_carries_what_is_said_of_it_and_the_speeds_at_which_its_range_holds_the_target() {
    let bb = preset("bb-56", &[]);
    let until = "globe_rupture_percent = 50";
    let anywhere = found(bb.clone(), "impact.speed_m_s", until);
    let between = found(bb, "impact.speed_m_s=50:75", until);
    let [one, other] = [&anywhere, &between].map(|found| &found.crossings[0]);
    assert!((one.at / other.at - 1.0).abs() < 2.0 * crossing::WIDTH, "{one:?} {other:?}");
    let there = one.risk.as_ref().unwrap();
    assert!((there.risk.hit.told - 0.5).abs() < 1e-3, "{there:?}");
    let (from, to) = (there.range.0.unwrap(), there.range.1.unwrap());
    assert!(from < 0.98 * one.at && to > 1.02 * one.at, "{there:?}");
    // The coarse look leaves out what is far away.
    assert!(anywhere.seen.len() < 20 && between.seen.len() > 20);
}

#[test]
fn what_is_refused_on_the_way_is_told_and_does_not_end_the_search() {
    let mut beside = short();
    set(&mut beside, "impact.angle_deg", "20").unwrap();
    let threshold = found(beside, "eye.opening_deg", "apex_displacement_mm = 1.5");
    let refused = threshold.seen.iter().filter(|(_, r)| r.is_err()).count();
    assert!(refused > 0 && refused < threshold.seen.len());
}

#[test]
fn questions_that_make_no_sense_are_refused_in_words() {
    let refused = |vary: &str| {
        let question = ThresholdSearch::read(short(), vary, (Quantity::Damage, 50.0));
        question.err().unwrap().to_string()
    };
    assert!(refused("impact.farce_n").contains("did you mean"));
    assert!(refused("impact.shape").contains("is no number"));
    assert!(refused("eye").contains("holds several fields"));
    let by_end = ThresholdSearch::read(short(), "force", (Quantity::Damage, 50.0)).unwrap();
    assert_eq!(by_end.field.path, "impact.force_n");
    assert!(refused("eye.level").contains("whole number"));
    assert!(refused("impact.speed_m_s").contains("which has no"));
    assert!(refused("impact.force_n=9:1").contains("goes from"));
    assert!(refused("impact.force_n=9").contains("is no range"));
    assert!(refused("impact.force_n=0:1e9").contains("out of range"));
    let unread = |until: &str| wanted(until).unwrap_err().to_string();
    assert!(unread("damge=50").contains("did you mean damage_percent"));
    assert!(unread("damage_percent>50").contains("has no ="));
    assert!(unread("damage_percent=x").contains("is no number"));
    assert_eq!(wanted("peak_pressure_mpa = 1 MPa").unwrap().1, 1.0);
    // What no blow can bring is not looked for.
    assert!(unread("peak_pressure_mpa = -3").contains("never is"));
    assert!(unread("shortening_percent = 90").contains("up to 85 %"));
    assert!(wanted("rebound_speed = -3").is_ok());
    let until = (Quantity::Pressure, 1.0);
    let question = ThresholdSearch::read(short(), "impact.force_n=100:200", until).unwrap();
    let error = question.answer(&AtomicBool::new(false), |_| {}).unwrap_err();
    let error = error.to_string();
    assert!(error.contains("the nearest that it has: peak_force_") && error.len() < 250, "{error}");
}
