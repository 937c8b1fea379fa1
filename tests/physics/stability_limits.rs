//! The stated stability limits against the spectral radius of one step of a damped oscillator.

use contrecoup::answer::solve::solve;
use contrecoup::models::paper::case::PaperCase;
use contrecoup::models::paper::eye::Eye;
use contrecoup::models::paper::eye::landmarks::Landmarks;
use contrecoup::models::paper::eye::mesh::Node;
use contrecoup::models::paper::eye::springs::{Spring, SpringKind};
use contrecoup::models::paper::forces::load::ArcLoad;
use contrecoup::models::paper::forces::state::State;
use contrecoup::models::paper::forces::system::System;
use contrecoup::models::paper::time::march::march;
use contrecoup::models::paper::time::method::Method;
use contrecoup::models::paper::time::stepper::Drag;
use contrecoup::models::pulse::Pulse;
use contrecoup::run::kept::Keep;
use contrecoup::run::model::EyeModel;
use contrecoup::run::places::Region;
use contrecoup::run::plan::Plan;
use contrecoup::run::quantity::Quantity;
use contrecoup::run::watch::unwatched;
use contrecoup::scenario::Integrator;
use contrecoup::scenario::set::set;
use contrecoup::scenario::{ForcePulse, Scenario};
use nalgebra::{Matrix2, Point2, Vector2};
use std::ops::ControlFlow;

/// A mass on a spring of frequency `omega` with drag rate `rate`, steps of 1 s.
fn oscillator(omega: f64, rate: f64) -> System {
    let node = |i, region| Node {
        grid: (i, 1),
        position: Point2::new(i as f64, 0.0),
        region,
        mass: 1.0,
        drag: rate,
    };
    let eye = Eye {
        level: 1,
        side: 3,
        opening_rad: 1.0,
        nodes: vec![node(0, Region::Orbit), node(1, Region::Interior)],
        quads: Vec::new(),
        springs: vec![Spring {
            a: 0,
            b: 1,
            stiffness: omega * omega,
            rest_length: 1.0,
            kind: SpringKind::Rest,
        }],
        landmarks: Landmarks {
            shell: Vec::new(),
            monitors: [0; 4],
            apex: [0; 2],
            meridian: [0; 2],
            monitor_hats: Default::default(),
            shell_hats: Vec::new(),
            apex_hats: Default::default(),
            meridian_hats: Default::default(),
        },
    };
    let pulse =
        Pulse::new(&ForcePulse { force_n: 0.0, duration_ms: 1e-9, ..ForcePulse::default() });
    let load =
        ArcLoad { shares: Vec::new(), direction: Vector2::x(), shielded: 0.0, arc: (0.0, 0.1) };
    System::new(&eye, pulse, &load, true, true)
}

/// Spectral radius of 100 steps, per step.
fn growth(integrator: Integrator, omega: f64, rate: f64) -> f64 {
    const STEPS: f64 = 100.0;
    let system = oscillator(omega, rate);
    let place = system.place(1);
    let column = |x: f64, v: f64| {
        let mut state = State::at_rest(&system);
        state.set(place, Point2::new(1.0 + x, 0.0), Vector2::new(v, 0.0));
        let plan = Plan {
            integrator,
            step: 1.0,
            window: STEPS,
            multiple: 1.0,
            local_tolerance: f64::INFINITY,
        };
        if march(&system, &plan, &mut state, |_| ControlFlow::Continue(())).is_err() {
            return Vector2::repeat(f64::INFINITY);
        }
        Vector2::new(state.position(place).x - 1.0, state.velocity(place).x)
    };
    // Small enough to stay linear: the spring must not turn inside out.
    let unit = 1e-6;
    let (a, b) = (column(unit, 0.0) / unit, column(0.0, unit) / unit);
    let map = Matrix2::from_columns(&[a, b]);
    let (trace, determinant) = (map.trace(), map.determinant());
    let root = trace * trace / 4.0 - determinant;
    let radius =
        if root < 0.0 { determinant.abs().sqrt() } else { trace.abs() / 2.0 + root.sqrt() };
    radius.powf(1.0 / STEPS)
}

#[test]
fn below_its_limit_no_damped_oscillator_grows_and_above_it_one_does() {
    for &integrator in Integrator::ALL {
        let limit = Method::of(integrator).stability_limit;
        let explicit_drag = Method::of(integrator).drag == Drag::WithKick;
        let rate = if explicit_drag { 0.0 } else { 0.01 };
        for i in 1..=60 {
            let omega = limit * f64::from(i) / 60.0 * (1.0 - 1e-4);
            let found = growth(integrator, omega, rate);
            assert!(found < 1.0 + 2e-4, "{integrator:?} at {omega}: {found}");
        }
        if !integrator.chooses_its_steps() {
            assert!(growth(integrator, 1.01 * limit, 0.0) > 1.001, "{integrator:?}");
        }
    }
}

#[test]
fn the_gaps_of_the_compositions_are_where_they_are_said_to_be() {
    // The first gap of SRKN6b lies just above the stated value and closes with a little drag.
    assert!(growth(Integrator::Srkn6b, 3.166, 0.0) > 1.001);
    assert!(growth(Integrator::Srkn6b, 3.166, 0.006) < 1.0 + 1e-5);
    for integrator in [Integrator::Srkn6b, Integrator::Srkn11b] {
        let gap = Method::of(integrator).first_gap.unwrap();
        for i in 1..=40 {
            let omega = gap * f64::from(i) / 40.0;
            assert!(growth(integrator, omega, 0.0) < 1.0 + 2e-4, "{integrator:?} at {omega}");
        }
    }
}

#[test]
fn an_undamped_eye_takes_steps_below_the_first_gap() {
    let mut scenario = Scenario::default();
    set(&mut scenario, "eye.globe_drag_ns_m", "0").unwrap();
    let case = PaperCase::new(&scenario.check().unwrap());
    let limit = case.step_limit(Integrator::Srkn6b) * case.system.omega_bound;
    assert!(limit <= 3.163 * (1.0 + 1e-12));
}

#[test]
fn extreme_drag_is_solved_and_not_blown_up() {
    for settings in [
        &["eye.fat_drag_ns_m=1000"][..],
        &["eye.globe_drag_ns_m=1000"],
        &["eye.globe_drag_ns_m=1000", "numerics.integrator=VelocityVerlet"],
        &[
            "eye.globe_drag_ns_m=10",
            "eye.sclera_kpa=0.001",
            "eye.fat_kpa=0.001",
            "eye.lens_kpa=0.001",
            "eye.rest_kpa=0.001",
        ],
    ] {
        let mut scenario = Scenario { window_ms: Some(0.5), ..Scenario::default() };
        for setting in settings {
            let (path, value) = setting.split_once('=').unwrap();
            set(&mut scenario, path, value).unwrap();
        }
        let answer = solve(&scenario.check().unwrap(), Keep::default(), &mut unwatched).unwrap();
        assert!(answer.index().damage().is_finite() && answer.index().damage() < 100.0);
        assert!(answer.errors.energy_balance < 1.0, "{settings:?}");
    }
}

#[test]
fn a_step_error_is_never_zero_because_both_runs_took_the_same_steps() {
    let mut scenario = Scenario::default();
    for (path, value) in [("window_ms", "0.001"), ("numerics.integrator", "SemiImplicitEuler")] {
        set(&mut scenario, path, value).unwrap();
    }
    let coarse = solve(&scenario.check().unwrap(), Keep::default(), &mut unwatched).unwrap();
    set(&mut scenario, "numerics.step_us", "0.0001").unwrap();
    let fine = solve(&scenario.check().unwrap(), Keep::default(), &mut unwatched).unwrap();
    let truth = (coarse.index().energy / fine.index().energy - 1.0).abs() * 100.0;
    assert!(coarse.errors.time_step[Quantity::Energy].unwrap() >= truth, "{truth}");
}

#[test]
fn nothing_moves_without_force() {
    let mut scenario = Scenario::default();
    set(&mut scenario, "impact.force_n", "0").unwrap();
    let answer = solve(&scenario.check().unwrap(), Keep::default(), &mut unwatched).unwrap();
    assert!(answer.flags.is_empty(), "{:?}", answer.flags);
    assert!(answer.index().damage() < 1e-9);
    assert!(answer.errors.time_step_percent().unwrap() < 1e-5);
}

/// Each stated error of a scenario beside the difference from a run of short steps, in %.
fn stated_and_true(settings: &[(&str, &str)]) -> Vec<(f64, f64)> {
    let mut scenario = Scenario::default();
    for (path, value) in settings {
        set(&mut scenario, path, value).unwrap();
    }
    let answer = solve(&scenario.check().unwrap(), Keep::default(), &mut unwatched).unwrap();
    for (path, value) in [("numerics.integrator", "Srkn11b"), ("numerics.step_us", "0.2")] {
        set(&mut scenario, path, value).unwrap();
    }
    let fine = solve(&scenario.check().unwrap(), Keep::default(), &mut unwatched).unwrap();
    let truth = answer.results().difference_percent(&fine.results());
    let stated = answer.errors.time_step;
    let pairs = truth.present().map(|(of, truth)| (stated[of].unwrap(), truth));
    pairs.collect()
}

#[test]
fn the_step_error_of_a_short_pulse_holds_where_a_longer_step_would_cut_it_alike() {
    for integrator in ["VelocityVerlet", "SemiImplicitEuler", "Srkn6b"] {
        for duration in ["0.003", "0.00075"] {
            let pairs = stated_and_true(&[
                ("impact.shape", "HalfSine"),
                ("impact.duration_ms", duration),
                ("numerics.integrator", integrator),
                ("window_ms", "0.4"),
            ]);
            for (stated, truth) in pairs {
                assert!(stated >= truth, "{integrator} {duration}: {stated} {truth}");
            }
        }
    }
}

#[test]
fn the_step_error_of_a_weak_blow_is_no_smaller_a_share_than_that_of_a_strong_one() {
    for force in ["10", "1", "0.01"] {
        let pairs = stated_and_true(&[("impact.force_n", force)]);
        for (stated, truth) in pairs {
            assert!(stated >= truth, "{force} N: {stated} {truth}");
        }
    }
}
