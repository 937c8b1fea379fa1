//! The hard cases: nothing may be silently wrong.
//!
//! A build without optimization takes minutes over them, so only one of them runs there.

use crate::program::json;
use contrecoup::run::flags::FlagKind;
use contrecoup::verify::hard_cases;
use contrecoup::verify::hard_cases::CaseVerdict;
use serde_json::json;

#[test]
fn every_hard_case_may_be_asked_for_and_has_a_name_of_its_own() {
    let cases = hard_cases::cases();
    for (i, case) in cases.iter().enumerate() {
        assert_eq!(case.scenario.check().err(), None, "{}", case.name);
        assert!(cases[..i].iter().all(|other| other.name != case.name));
    }
}

#[test]
fn a_step_above_the_limit_is_refused_without_an_answer() {
    let cases = hard_cases::cases();
    let case = cases.iter().find(|case| case.name == "srkn6b at 1.01 of its limit").unwrap();
    let outcome = case.run();
    assert_eq!(outcome.verdict, CaseVerdict::Refused);
    assert_eq!((outcome.true_error, outcome.claimed_error), (None, None));
    assert!(outcome.note.contains("allowed up to"), "{}", outcome.note);
}

#[test]
#[cfg_attr(debug_assertions, ignore = "takes minutes without optimization")]
fn no_hard_case_is_silently_wrong() {
    // As the command prints them, which ends with 1 where one is wrong.
    let printed = json(&["verify", "hard-cases"]);
    let outcomes = printed["cases"].as_array().unwrap();
    assert_eq!(outcomes.len(), hard_cases::cases().len());
    for (outcome, case) in outcomes.iter().zip(hard_cases::cases()) {
        assert_eq!(outcome["name"], case.name, "the order is that of the table");
        assert_ne!(outcome["verdict"], CaseVerdict::Wrong.name(), "{outcome}");
        assert!(outcome["note"].is_string() && outcome["flags"].is_array());
        for name in ["true_error_percent", "claimed_error_percent", "energy_balance_percent"] {
            // JSON has no number that is not finite.
            assert!(outcome.get(name).is_some(), "{name}: {outcome}");
        }
        let refused = outcome["verdict"] == CaseVerdict::Refused.name();
        assert_eq!(refused, case.name.contains("1.01"), "{outcome}");
        assert_eq!(refused, outcome["claimed_error_percent"].is_null(), "{outcome}");
        if outcome["verdict"] == CaseVerdict::Accurate.name() {
            assert_eq!(outcome["flags"], json!([]), "{outcome}");
            assert!(outcome["true_error_percent"].is_number(), "{outcome}");
        }
    }
    let of = |name: &str| outcomes.iter().find(|o| o["name"] == name).unwrap();
    for (name, flag) in [
        ("10 kN", FlagKind::MeshFolded),
        ("5 kN for 0.3 ms", FlagKind::MeshFolded),
        ("1.5 kN", FlagKind::MeshFolded),
        ("100 kN", FlagKind::NotPredictable),
        ("3 kN without damping", FlagKind::NotPredictable),
        ("two nodes driven together", FlagKind::MeshFolded),
        ("force on a single node", FlagKind::ArcUnresolved),
        ("at the edge, +40 deg", FlagKind::BoneShields),
        ("at the edge, -40 deg", FlagKind::BoneShields),
        ("no damping for 50 ms", FlagKind::WindowShort),
    ] {
        let flags = of(name)["flags"].as_array().unwrap();
        assert!(flags.contains(&json!(flag.name())), "{}", of(name));
    }
    let chaotic = of("3 kN without damping");
    assert_eq!(chaotic["verdict"], CaseVerdict::NotPredictable.name(), "{chaotic}");
    assert!(chaotic["true_error_percent"].is_null(), "{chaotic}");
    for name in [
        "zero rise time",
        "pulse of 1 us",
        "lens x1000",
        "filaments off",
        "filaments x100",
        "srkn6b at 0.99 of its limit",
        "1 s of simulated time",
    ] {
        assert_eq!(of(name)["verdict"], CaseVerdict::Accurate.name(), "{}", of(name));
    }
    // Without drag the energy has nowhere to go.
    let balance = of("no damping for 50 ms")["energy_balance_percent"].as_f64();
    assert!(balance.unwrap() < 1e-3);
}
