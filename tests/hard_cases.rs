//! The hard cases: nothing may be silently wrong.
//!
//! A build without optimization takes minutes over them, so only one of them runs there.

#![cfg(feature = "app")]

use assert_cmd::Command;
use contrecoup::run::flags::FlagKind;
use contrecoup::verify::hard_cases;
use contrecoup::verify::hard_cases::Verdict;
use serde_json::Value;

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
    let case = cases
        .iter()
        .find(|case| case.name == "srkn6b at 1.01 of its limit")
        .unwrap();
    let outcome = case.run();
    assert_eq!(outcome.verdict, Verdict::Refused);
    assert_eq!((outcome.true_error, outcome.claimed_error), (None, None));
    assert!(outcome.note.contains("allowed up to"), "{}", outcome.note);
}

#[test]
#[cfg_attr(debug_assertions, ignore = "takes minutes without optimization")]
fn no_hard_case_is_silently_wrong() {
    let outcomes = hard_cases::run(|_, _| {});
    assert_eq!(outcomes.len(), hard_cases::cases().len());
    for (outcome, case) in outcomes.iter().zip(hard_cases::cases()) {
        assert_eq!(outcome.name, case.name, "the order is that of the table");
        assert_ne!(outcome.verdict, Verdict::Wrong, "{outcome:?}");
        let numbers = [
            outcome.true_error,
            outcome.claimed_error,
            outcome.energy_balance,
        ];
        for number in numbers.into_iter().flatten() {
            assert!(number.is_finite(), "{outcome:?}");
        }
        let refused = outcome.verdict == Verdict::Refused;
        assert_eq!(refused, case.name.contains("1.01"), "{outcome:?}");
        if outcome.verdict == Verdict::Accurate {
            assert!(outcome.flags.is_empty() && outcome.true_error.is_some());
        }
    }
    let of = |name: &str| outcomes.iter().find(|o| o.name == name).unwrap();
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
        assert!(of(name).flags.contains(&flag), "{:?}", of(name));
    }
    let chaotic = of("3 kN without damping");
    assert_eq!(chaotic.verdict, Verdict::NotPredictable, "{chaotic:?}");
    assert_eq!(chaotic.true_error, None, "{chaotic:?}");
    for name in [
        "zero rise time",
        "pulse of 1 us",
        "lens x1000",
        "filaments off",
        "filaments x100",
        "srkn6b at 0.99 of its limit",
        "1 s of simulated time",
    ] {
        assert_eq!(of(name).verdict, Verdict::Accurate, "{:?}", of(name));
    }
    // Without drag the energy has nowhere to go.
    assert!(of("no damping for 50 ms").energy_balance.unwrap() < 1e-3);
}

#[test]
#[cfg_attr(debug_assertions, ignore = "takes minutes without optimization")]
fn json_has_the_agreed_names() {
    let output = Command::cargo_bin("contrecoup")
        .unwrap()
        .args(["stability", "--json"])
        .output()
        .unwrap();
    assert!(output.status.success(), "{output:?}");
    let object: Value = serde_json::from_slice(&output.stdout).unwrap();
    let cases = object["cases"].as_array().unwrap();
    assert_eq!(cases.len(), hard_cases::cases().len());
    for case in cases {
        assert!(case["name"].is_string() && case["note"].is_string());
        assert!(case["flags"].is_array());
        assert_ne!(case["verdict"], "WRONG");
        for name in ["true_error_percent", "claimed_error_percent"] {
            assert!(case.get(name).is_some(), "{name}: {case}");
        }
    }
}
