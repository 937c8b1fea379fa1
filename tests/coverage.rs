//! Whether the stated step errors hold on 200 random scenes.
//!
//! The reference of each scene takes literally a hundred times as many steps as the answer, in every
//! segment of the load. A sixth-order one with fewer steps is cheaper, but no substitute: its peaks
//! are searched in longer steps, and so differ from the finer one's by more than many true errors.

#![cfg(feature = "app")]

use contrecoup::run::quantity::Quantity;
use contrecoup::run::refusal::Refusal;
use contrecoup::verify::coverage::{Drawn, MAX_SCENES, check, coverage, misses};
use std::ops::ControlFlow;
use std::sync::Mutex;

const SEED: u32 = 1;

fn unwatched(_: f64) -> ControlFlow<()> {
    ControlFlow::Continue(())
}

#[test]
fn nineteen_of_twenty_claims_hold_and_are_no_more_than_ten_times_the_truth() {
    // Without optimisation two hundred would take an hour.
    let scenes = if cfg!(debug_assertions) { 4 } else { 200 };
    let checked = check(Drawn::Pulses, scenes, SEED, &unwatched).unwrap();
    let folded = checked.iter().filter(|c| c.folded).count();
    assert!(2 * folded < checked.len(), "{folded} scenes fold");
    for miss in misses(&checked) {
        println!("{miss:?}");
    }
    for row in coverage(&checked) {
        println!("{row:?}");
    }
    if cfg!(debug_assertions) {
        // Too few to speak of percent.
        return;
    }
    let leading: Vec<Quantity> = checked[0].claimed.leading().map(|(of, _)| of).collect();
    assert_eq!(leading.len(), 6, "damage, apex and four node forces");
    for row in coverage(&checked) {
        if !leading.contains(&row.quantity) {
            continue;
        }
        assert!(row.within >= 95.0, "{row:?}");
        assert!(row.median_ratio <= 10.0, "{row:?}");
    }
}

#[test]
fn nineteen_of_twenty_claims_about_objects_at_the_eye_of_revolution_hold() {
    let scenes = if cfg!(debug_assertions) { 1 } else { 12 };
    let checked = check(Drawn::Objects, scenes, SEED, &unwatched).unwrap();
    assert!(checked.iter().all(|c| !c.folded), "{checked:?}");
    let claims = checked.iter().flat_map(|c| c.claimed.leading());
    let claimed = claims.count();
    assert!(claimed >= 6 * checked.len(), "{claimed}");
    let leads = |of: Quantity| checked[0].claimed.leading().any(|(other, _)| other == of);
    let missed: Vec<_> = misses(&checked)
        .into_iter()
        .filter(|miss| leads(miss.quantity))
        .collect();
    assert!(20 * missed.len() <= claimed, "{missed:?}");
    let stated: Vec<f64> = checked.iter().map(|c| c.claimed.headline()).collect();
    let coarse = stated.iter().filter(|stated| **stated >= 2.0).count();
    assert!(
        // A shell that buckles under a flat face goes another way at every step, however short.
        coarse <= 1,
        "steps were shortened to step errors of {stated:?} %"
    );
}

#[test]
fn the_number_of_threads_changes_no_bit() {
    let on = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads);
        let checked = pool
            .build()
            .unwrap()
            .install(|| check(Drawn::Pulses, 3, 7, &unwatched));
        let bits = |c: contrecoup::verify::coverage::Checked| {
            let numbers = c.claimed.present().chain(c.truth.present());
            let bits: Vec<u64> = numbers.map(|(_, number)| number.to_bits()).collect();
            (c.index, bits, c.folded)
        };
        checked.unwrap().into_iter().map(bits).collect::<Vec<_>>()
    };
    assert_eq!(on(1), on(3));
}

#[test]
fn the_watch_hears_of_every_scene_and_may_stop() {
    let heard = Mutex::new(Vec::new());
    check(Drawn::Pulses, 2, SEED, &|share| {
        heard.lock().unwrap().push(share);
        ControlFlow::Continue(())
    })
    .unwrap();
    let mut heard = heard.into_inner().unwrap();
    heard.sort_by(f64::total_cmp);
    assert_eq!(heard, [0.5, 1.0]);
    let stopped = check(Drawn::Pulses, MAX_SCENES, SEED, &|_| ControlFlow::Break(()));
    assert_eq!(stopped.unwrap_err(), Refusal::Cancelled);
}

#[test]
fn the_command_prints_the_table_and_every_miss() {
    let program = |arguments: &[&str]| {
        let mut command = assert_cmd::Command::cargo_bin("contrecoup").unwrap();
        command.arg("coverage").args(arguments).assert()
    };
    let scenes = ["--scenes", "2", "--seed", "5"];
    let text = program(&scenes).success().stderr("").get_output().clone();
    let text = String::from_utf8(text.stdout).unwrap();
    let json = program(&[&scenes[..], &["--json"]].concat()).success();
    let json: serde_json::Value = serde_json::from_slice(&json.get_output().stdout).unwrap();
    let results = json["results"].as_array().unwrap();
    assert!(results.len() >= 9, "all that a force pulse has");
    for (row, quantity) in results.iter().zip(Quantity::ALL) {
        assert_eq!(row["result"], quantity.key());
        let within = row["within_percent"].as_f64().unwrap();
        assert!((0.0..=100.0).contains(&within));
        assert!(text.contains(quantity.label()));
    }
    let missed: u64 = results.iter().map(|r| r["misses"].as_u64().unwrap()).sum();
    let misses = json["misses"].as_array().unwrap();
    assert_eq!(missed, misses.len() as u64);
    for miss in misses {
        assert!(miss["scenario"]["impact"].is_object());
    }
    for line in text.lines() {
        assert!(line.chars().count() <= 80, "{line}");
    }
    for wrong in [["--scenes", "0"], ["--scenes", "65537"], ["--seed", "-1"]] {
        program(&wrong).code(2).stdout("");
    }
}
