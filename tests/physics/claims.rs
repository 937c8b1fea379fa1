//! Whether what is claimed holds in random scenes.
//!
//! The reference of a step error takes literally a hundred times as many steps as the answer, in
//! every segment of the load. A sixth-order one with fewer steps is cheaper, but no substitute: its
//! peaks are searched in longer steps, and so differ from the finer one's by more than many true
//! errors.

use crate::program::{json, program};
use contrecoup::run::quantity::{Leads, Quantity};
use contrecoup::run::refusal::Refusal;
use contrecoup::verify::claims::{Claim, Fault, Findings, Study, Subject, check};
use contrecoup::verify::scenes::{MAX_SCENES, Scenes};
use std::ops::ControlFlow;
use std::sync::Mutex;

const SEED: u32 = 1;
const STEPS: Study = Study::Steps(Scenes::Pulses);

fn unwatched(_: f64) -> ControlFlow<()> {
    ControlFlow::Continue(())
}

/// The result that a claim is about.
fn result(subject: Subject) -> Quantity {
    match subject {
        Subject::Result(quantity) => quantity,
        Subject::Tolerance(_) => panic!("a tolerance"),
    }
}

#[test]
fn nineteen_of_twenty_claims_hold_and_are_no_more_than_ten_times_the_truth() {
    // Without optimisation so many would take an hour.
    let scenes = if cfg!(debug_assertions) { 4 } else { 120 };
    let found = check(STEPS, scenes, SEED, &unwatched).unwrap();
    let folded = found.folded().len() as u32;
    assert!(2 * folded < scenes, "{folded} scenes fold");
    println!("{:?}", found.misses());
    let leads = |of: Subject| result(of).row().leads != Leads::Never;
    let rows = found.coverage().into_iter().filter(|row| leads(row.subject));
    let rows: Vec<_> = rows.collect();
    assert_eq!(rows.len(), 6, "damage, apex and four node forces");
    for row in rows {
        println!("{row:?}");
        // Four are too few to speak of percent.
        if !cfg!(debug_assertions) {
            assert!(row.within.unwrap() >= 95.0, "{row:?}");
            assert!(row.median_ratio.unwrap() <= 10.0, "{row:?}");
        }
    }
}

#[test]
fn nineteen_of_twenty_claims_about_objects_hold() {
    let scenes = if cfg!(debug_assertions) { 1 } else { 12 };
    let found = check(Study::Steps(Scenes::Objects), scenes, SEED, &unwatched).unwrap();
    let leads = |claim: &&Claim| result(claim.subject).row().leads == Leads::Always;
    let leading = |claims: &[Claim]| claims.iter().filter(leads).copied().collect::<Vec<_>>();
    let claims: Vec<Vec<Claim>> = found
        .scenes
        .iter()
        .map(|scene| leading(scene.claims.as_ref().expect("none folds or goes through")))
        .collect();
    let claimed = claims.iter().flatten().filter(|claim| claim.claimed.is_some()).count();
    assert!(claimed >= 6 * claims.len(), "{claimed}");
    let missed: Vec<Claim> = found.misses().into_iter().map(|(_, claim)| claim).collect();
    let missed = leading(&missed);
    assert!(20 * missed.len() <= claimed, "{missed:?}");
    let worst = |claims: &Vec<Claim>| claims.iter().filter_map(|c| c.claimed).fold(0.0, f64::max);
    let stated: Vec<f64> = claims.iter().map(worst).collect();
    let coarse = stated.iter().filter(|stated| **stated >= 2.0).count();
    assert!(
        // A shell that buckles under a flat face goes another way at every step, however short.
        coarse <= 1,
        "steps were shortened to step errors of {stated:?} %"
    );
}

#[test]
fn blows_from_the_side_fold_nothing_unsaid_and_nine_of_ten_of_their_claims_hold() {
    let found = check(Study::Steps(Scenes::Sides), 1, SEED, &unwatched).unwrap();
    for unsaid in
        [Fault::FoldedUnflagged, Fault::NoNumber, Fault::EnergyUnflagged, Fault::NotFinite]
    {
        assert_eq!(found.count(unsaid), 0, "{unsaid:?}");
    }
    let claims: usize = found.coverage().iter().map(|row| row.claims).sum();
    let misses = found.misses();
    assert!(claims >= 22 && 10 * misses.len() <= claims, "{misses:?}");
}

#[test]
fn mesh_errors_and_tolerances_are_checked_until_as_many_scenes_as_asked_for_fold_nowhere() {
    let meshes = check(Study::Meshes(Scenes::Pulses, 1), 1, 3, &unwatched).unwrap();
    let kept = check(Study::Tolerances, 1, 3, &unwatched).unwrap();
    for found in [&meshes, &kept] {
        assert_eq!(found.scenes.len() - found.folded().len(), 1);
        assert!(found.scenes.last().unwrap().claims.is_some());
    }
    assert_eq!(meshes.folded(), kept.folded(), "they look at the same meshes");
    let tightest = kept.coverage().pop().unwrap();
    assert_eq!(tightest.claims + tightest.without_claim, 1);
    assert!(kept.coverage()[0].median_cost.unwrap() > 1.0);
}

#[test]
fn the_number_of_threads_changes_no_bit() {
    let on = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads);
        let pool = pool.build().unwrap();
        let found: Findings = pool.install(|| check(STEPS, 3, 7, &unwatched)).unwrap();
        found
    };
    assert_eq!(on(1), on(3));
}

#[test]
fn the_watch_hears_of_every_scene_and_may_stop() {
    let heard = Mutex::new(Vec::new());
    check(STEPS, 2, SEED, &|share| {
        heard.lock().unwrap().push(share);
        ControlFlow::Continue(())
    })
    .unwrap();
    let mut heard = heard.into_inner().unwrap();
    heard.sort_by(f64::total_cmp);
    assert_eq!(heard, [0.5, 1.0]);
    let stopped = check(STEPS, MAX_SCENES, SEED, &|_| ControlFlow::Break(()));
    assert_eq!(stopped.unwrap_err(), Refusal::Cancelled);
}

#[test]
fn the_command_prints_the_table_and_every_miss() {
    let steps = ["verify", "steps", "--scenes", "2", "--seed", "5"];
    let text = program(&steps).assert().success().stderr("");
    let text = String::from_utf8(text.get_output().stdout.clone()).unwrap();
    let found = json(&steps);
    let rows = found["coverage"].as_array().unwrap();
    assert!(rows.len() >= 9, "all that a force pulse has");
    for (row, quantity) in rows.iter().zip(Quantity::ALL) {
        assert_eq!(row["subject"], quantity.key());
        let within = row["within_percent"].as_f64().unwrap();
        assert!((0.0..=100.0).contains(&within));
        assert!(text.contains(quantity.label()));
    }
    let missed: u64 = rows.iter().map(|r| r["misses"].as_u64().unwrap()).sum();
    let misses = found["misses"].as_array().unwrap();
    assert_eq!(missed, misses.len() as u64);
    for miss in misses {
        assert!(miss["scenario"]["impact"].is_object());
    }
    for line in text.lines() {
        assert!(line.chars().count() <= 80, "{line}");
    }
    for wrong in [["--scenes", "0"], ["--scenes", "65537"], ["--seed", "-1"]] {
        let typed = [&["verify", "steps"], &wrong[..]].concat();
        program(&typed).assert().code(2).stdout("");
    }
}
