//! How long a run lasts: as long as was asked, else until nothing can grow.

use crate::answer::solve::tests::{answered, answered_with};
use crate::answer::solve::{Answer, Cut, solve};
use crate::run::kept::{Keep, Spacing};
use crate::run::{flags::FlagKind, quantity::Quantity};
use crate::scenario::library::find;
use crate::scenario::{ForcePulse, Geometry, Impact, Model, Physiological, Scenario, Support};
use proptest::prelude::*;
use std::ops::ControlFlow;

const ALL: Keep = Keep {
    traces: true,
    frames: Some(Spacing { early: 20, early_every: 10e-6, every: 10e-6, doubles: true }),
};

fn preset(name: &str, window_ms: Option<f64>) -> Scenario {
    let mut scenario = find(name).unwrap().scenario().unwrap();
    scenario.numerics.geometry = Geometry::Axisymmetric;
    Scenario { window_ms, ..scenario }
}

#[test]
fn a_run_that_ends_by_itself_reads_what_a_long_one_does() {
    for (name, long) in [("bb-56", 9.0), ("squash-ball", 18.0)] {
        let own = answered(&preset(name, None));
        // What keeps traces goes on to the end of its window.
        let whole = answered_with(&preset(name, Some(long)), ALL);
        assert_eq!(whole.run.simulated, long * 1e-3);
        assert!(own.run.simulated < 0.5 * whole.run.simulated, "{name}");
        for &of in Quantity::ALL {
            // What is read at the end still rings a little, as the object does within itself.
            let near = if own.peak(of).is_some() { 0.0 } else { 1e-3 };
            let (a, b) = (own.result(of), whole.result(of));
            let (a, b) = (a.unwrap_or(0.0), b.unwrap_or(0.0));
            assert!((a - b).abs() <= near * b.abs(), "{name} {} {a} {b}", of.key());
            assert_eq!(own.cut(of), None, "{name} {}", of.key());
        }
        assert!(!own.flags.iter().any(|f| f.kind.name().contains("window")));
    }
}

#[test]
fn what_is_kept_changes_neither_the_end_nor_a_reading() {
    let scenario = preset("bb-56", None);
    let (bare, kept) = (answered(&scenario), answered_with(&scenario, ALL));
    assert_eq!(bare.run.simulated, kept.run.simulated);
    assert_eq!(bare.run.readings, kept.run.readings);
    assert_eq!(bare.errors, kept.errors);
    assert_eq!(kept.window(), kept.run.simulated);
    let times = &kept.run.traces.as_ref().unwrap().time;
    assert!((1000..=2000).contains(&times.len()), "{}", times.len());
    assert_eq!(times.last(), Some(&kept.run.simulated));
    let mut streamed = Vec::new();
    let take = &mut |frame| {
        streamed.push(frame);
        ControlFlow::Continue(())
    };
    let spacing = ALL.frames.unwrap();
    kept.case.frames(&kept.plan, spacing, take).unwrap();
    assert_eq!(streamed, kept.run.frames);
}

#[test]
fn what_never_settles_meets_a_cap_that_is_flagged() {
    let mut slow = preset("bb-62", None);
    slow.projectile_mut().unwrap().speed_m_s = 0.01;
    let answer = answered(&slow);
    assert!(answer.has(FlagKind::WindowCapped));
    assert_eq!(answer.run.simulated, 60e-3);
    assert_eq!(answer.cut(Quantity::Pressure), Some(Cut::AtLeast));
}

/// A pulse of so many N for so many ms, as a triangle, on the default eye held by something.
fn struck(support: Support, force_n: f64, duration_ms: f64) -> Answer {
    let scenario = Scenario {
        model: Model::Physiological(Physiological { support, ..Physiological::default() }),
        impact: Impact::ForcePulse(ForcePulse { force_n, duration_ms, ..ForcePulse::default() }),
        ..Scenario::default()
    };
    answered(&scenario)
}

#[test]
fn a_long_pulse_is_never_cut_and_what_shortens_an_eye_more_than_any_test_is_flagged() {
    let answer = struck(Support::Orbit, 20.0, 9.0);
    assert!(answer.run.simulated > 9e-3 && answer.flags.is_empty());
    assert!(!struck(Support::Orbit, 100.0, 0.7).has(FlagKind::BeyondTests));
    assert!(struck(Support::Orbit, 800.0, 0.7).has(FlagKind::BeyondTests));
}

#[test]
fn an_eye_that_is_pressed_flat_ends_the_run_and_all_is_at_least() {
    for (force_n, duration_ms) in [(1e3, 0.7), (5e3, 0.7), (1e5, 0.05)] {
        let answer = struck(Support::Orbit, force_n, duration_ms);
        assert!(answer.has(FlagKind::EyeFlat), "{force_n} N");
        // Meshes may agree on it, which says nothing of an eye.
        let mesh = answer.errors.mesh.unwrap();
        assert_eq!(mesh.present().count(), 0, "{force_n} N");
        assert_eq!(answer.cut(Quantity::Pressure), Some(Cut::AtLeast));
        assert!(answer.run.cost.steps < 30_000, "{} steps", answer.run.cost.steps);
    }
}

#[test]
fn how_a_free_eye_flies_off_as_a_whole_is_no_injury() {
    // 20 N for so long gives it 14 and 53 m/s.
    let [short, long] = [5.0, 20.0].map(|ms| struck(Support::Free, 20.0, ms));
    for quantity in [Quantity::Energy, Quantity::Damage, Quantity::CornealEnergy] {
        let [short, long] = [&short, &long].map(|answer| answer.result(quantity).unwrap());
        assert!(long < 1.2 * short, "{quantity:?}: {short} {long}");
    }
    assert!(long.result(Quantity::Apex).unwrap() < 10.0);
}

#[test]
fn the_watch_is_told_a_share_that_never_falls() {
    let checked = preset("bb-56", None).check().unwrap();
    let mut shares = Vec::new();
    let answer = solve(&checked, Keep::default(), &mut |share| {
        shares.push(share);
        ControlFlow::Continue(())
    });
    answer.unwrap();
    assert!(shares.len() > 10 && shares.is_sorted());
    assert!(shares.iter().all(|share| (0.0..1.0).contains(share)));
}

proptest! {
    #[test]
    fn frames_that_come_ever_more_slowly_double_their_spacing(early in 1_u32..300, share in 0.0..20.0_f64) {
        let n = 1 + (share * f64::from(early)) as usize;
        let spacing = Spacing::doubling(2 * early, 1e-6);
        let gap = |n: usize| (spacing.due(n + 1) - spacing.due(n)) * 1e6;
        let ratio = gap(n) / gap(n - 1);
        prop_assert!((ratio - 1.0).abs() < 1e-6 || (ratio - 2.0).abs() < 1e-6, "{}", ratio);
        let first = spacing.due(2 * early as usize) * 1e6;
        prop_assert!((first - f64::from(2 * early)).abs() < 1e-6);
    }
}
