//! The results against an independent solution, stored: fourth-order Runge-Kutta in first-order
//! form with a step of 50 ns, level 1, window 3 ms.

use contrecoup::answer::solve::{Answer, solve};
use contrecoup::run::flags::FlagKind;
use contrecoup::run::kept::{Keep, Spacing};
use contrecoup::run::model::EyeModel;
use contrecoup::run::quantity::Quantity;
use contrecoup::run::watch::unwatched;
use contrecoup::scenario::Integrator;
use contrecoup::scenario::{ForcePulse, Impact, PulseShape, Scenario};

struct Row {
    force_n: f64,
    duration_ms: f64,
    angle_deg: f64,
    half_width_deg: f64,
    shape: PulseShape,
    /// Value and time.
    apex: (f64, f64),
    shell: f64,
    meridian: f64,
    energy: f64,
    damage: f64,
    /// Centre, front, right, top.
    peaks: [f64; 4],
}

fn head_on(force_n: f64, duration_ms: f64) -> Row {
    Row {
        force_n,
        duration_ms,
        angle_deg: 0.0,
        half_width_deg: 20.0,
        shape: PulseShape::SmoothRectangle { edge_fraction: 0.1 },
        apex: (0.0, 0.0),
        shell: 0.0,
        meridian: 0.0,
        energy: 0.0,
        damage: 0.0,
        peaks: [0.0; 4],
    }
}

fn rows() -> [Row; 4] {
    [
        Row {
            apex: (0.4983, 0.195),
            shell: 0.005,
            meridian: 0.937,
            energy: 0.0448,
            damage: 6.36,
            peaks: [3.199, 19.35, 3.568, 4.061],
            ..head_on(100.0, 0.2)
        },
        Row {
            apex: (2.157, 0.199),
            shell: 0.209,
            meridian: 2.883,
            energy: 0.5212,
            damage: 26.42,
            peaks: [12.40, 72.93, 9.926, 11.71],
            ..head_on(300.0, 0.2)
        },
        Row {
            apex: (5.308, 0.290),
            shell: 0.588,
            meridian: 8.921,
            energy: 2.856,
            damage: 92.50,
            peaks: [20.20, 102.97, 17.58, 34.67],
            ..head_on(600.0, 0.3)
        },
        Row {
            force_n: 200.0,
            duration_ms: 0.1,
            angle_deg: 20.0,
            half_width_deg: 10.0,
            shape: PulseShape::Triangle,
            apex: (0.2640, 0.115),
            shell: 0.018,
            meridian: 0.549,
            energy: 0.0858,
            damage: 4.54,
            peaks: [6.682, 21.11, 3.737, 8.839],
        },
    ]
}

fn scenario(row: &Row) -> Scenario {
    Scenario {
        impact: Impact::ForcePulse(ForcePulse {
            force_n: row.force_n,
            duration_ms: row.duration_ms,
            angle_deg: row.angle_deg,
            half_width_deg: row.half_width_deg,
            shape: row.shape.clone(),
        }),
        ..Scenario::default()
    }
}

fn answer(scenario: &Scenario) -> Answer {
    solve(&scenario.check().unwrap(), Keep::default(), &mut unwatched).unwrap()
}

/// Half a unit in the last printed digit, and a little for the digit before.
fn printed(found: f64, wanted: f64, unit: f64, what: &str) {
    let difference = (found - wanted).abs();
    assert!(difference <= 0.55 * unit, "{what}: {found} for {wanted}");
}

fn agrees(row: &Row, answer: &Answer) {
    let apex = answer.peak(Quantity::Apex).unwrap();
    let unit = |value: f64| 10f64.powf(value.log10().floor() - 3.0);
    printed(apex.value * 1e3, row.apex.0, unit(row.apex.0), "apex");
    printed(apex.time * 1e3, row.apex.1, 1e-3, "apex time");
    printed(answer.index().shell_growth, row.shell, 1e-3, "S");
    printed(answer.index().meridian_growth, row.meridian, 1e-3, "M");
    printed(answer.index().energy, row.energy, unit(row.energy).max(1e-4), "E");
    printed(answer.index().damage(), row.damage, 1e-2, "damage");
    for (found, wanted) in Quantity::FORCES.map(|of| answer.peak(of).unwrap()).iter().zip(row.peaks)
    {
        let relative = (found.value / wanted - 1.0).abs();
        assert!(relative < 1e-3, "peak {} for {wanted}", found.value);
    }
}

#[test]
fn the_automatic_step_gives_the_stored_figures() {
    for row in rows() {
        agrees(&row, &answer(&scenario(&row)));
    }
}

#[test]
fn every_integrator_gives_the_stored_figures_with_a_step_small_enough() {
    // First order needs a step so small that one case must do.
    let steps = [
        (Integrator::VelocityVerlet, 0.2, 4),
        (Integrator::Srkn6b, 1.5, 4),
        (Integrator::Srkn11b, 2.0, 4),
        (Integrator::SemiImplicitEuler, 0.02, 1),
    ];
    for (integrator, step_us, cases) in steps {
        for row in rows().iter().take(cases) {
            let mut scenario = scenario(row);
            scenario.numerics.integrator = Some(integrator);
            scenario.numerics.step_us = Some(step_us);
            agrees(row, &answer(&scenario));
        }
    }
}

#[test]
fn a_mirrored_angle_gives_the_mirrored_result() {
    let at = |angle_deg| {
        answer(&scenario(&Row { angle_deg, half_width_deg: 7.0, ..head_on(250.0, 0.15) }))
    };
    let (up, down) = (at(13.0), at(-13.0));
    let close = |a: f64, b: f64| assert!((a / b - 1.0).abs() < 1e-9, "{a} {b}");
    close(up.index().shell_growth, down.index().shell_growth);
    close(up.index().meridian_growth, down.index().meridian_growth);
    close(up.index().energy, down.index().energy);
    close(up.result(Quantity::Apex).unwrap(), down.result(Quantity::Apex).unwrap());
    assert!(
        (up.result(Quantity::ForceTop).unwrap() - down.result(Quantity::ForceTop).unwrap()).abs()
            > 0.1
    );
}

#[test]
fn the_whole_eye_and_its_mirrored_half_agree() {
    use contrecoup::models::paper::case::PaperCase;
    for level in 1..=2 {
        let mut scenario = Scenario::default();
        scenario.eye.level = level;
        scenario.window_ms = Some(0.6);
        let half = PaperCase::new(&scenario.check().unwrap());
        let whole = PaperCase::with(&scenario.check().unwrap(), true, false);
        assert!(half.system.mirrored() && !whole.system.mirrored());
        let run = |case: &PaperCase| {
            let plan = case.plan(&scenario).unwrap();
            let keep = Keep { traces: true, frames: Some(Spacing::even(5e-5)) };
            case.run(&plan, keep, &mut unwatched).unwrap()
        };
        let (a, b) = (run(&half), run(&whole));
        for (of, p) in a.readings.iter() {
            let Some(p) = p.map(|reading| reading.value) else {
                continue;
            };
            let q = b.readings.value(of).unwrap();
            assert!((p - q).abs() <= 1e-9 * q.abs(), "{p} {q}");
        }
        assert!((a.energy_residual - b.energy_residual).abs() < 1e-9);
        let (s, t) = (a.traces.unwrap(), b.traces.unwrap());
        for (p, q) in [(s.kinetic, t.kinetic), (s.elastic, t.elastic), (s.dissipated, t.dissipated)]
        {
            for (x, y) in p.iter().zip(&q) {
                assert!((x - y).abs() < 1e-10, "{x} {y}");
            }
        }
        for (f, g) in a.frames.iter().zip(&b.frames) {
            for (p, q) in f.positions.iter().zip(&g.positions) {
                assert!((p - q).norm() < 1e-12);
            }
            for (p, q) in f.forces.iter().zip(&g.forces) {
                assert!((p - q).abs() < 1e-7 * (1.0 + q), "{p} {q}");
            }
        }
    }
}

#[test]
fn the_front_node_shows_the_papers_two_peaks() {
    let scenario = scenario(&head_on(100.0, 0.2));
    let keep = Keep { traces: true, frames: None };
    let answer = solve(&scenario.check().unwrap(), keep, &mut unwatched).unwrap();
    let traces = answer.run.traces.unwrap();
    let largest = |from: f64, to: f64| {
        traces
            .time
            .iter()
            .zip(&traces.force[1])
            .filter(|(t, _)| (from..to).contains(*t))
            .map(|(_, f)| *f)
            .fold(0.0, f64::max)
    };
    let (rise, between, fall) =
        (largest(0.0, 4e-5), largest(9e-5, 1.6e-4), largest(1.8e-4, 2.4e-4));
    assert!(rise > 1.3 * between && fall > 1.3 * between, "{rise} {between} {fall}");
}

#[test]
fn energies_add_up_and_nothing_is_flagged_in_the_papers_range() {
    for row in rows() {
        let answer = answer(&scenario(&row));
        assert!(answer.errors.energy_balance < 0.01);
        assert_eq!(answer.plan.integrator, Integrator::Srkn6b);
        let kinds: Vec<FlagKind> = answer.flags.iter().map(|f| f.kind).collect();
        assert!(kinds.is_empty(), "{kinds:?}");
    }
}

#[test]
fn a_folded_mesh_is_flagged_with_its_time() {
    let answer = answer(&scenario(&head_on(3000.0, 0.2)));
    let flag =
        answer.flags.iter().find(|f| f.kind == FlagKind::MeshFolded).expect("3 kN folds the mesh");
    assert!(flag.message.contains("beyond the model's validity"));
    let time = flag.time.unwrap();
    assert!(time > 0.0 && time < 3e-3);
}

#[test]
fn a_mesh_that_opens_again_is_told_from_one_that_stays_folded() {
    for (force, stays, says) in
        [(1000.0, false, "and open again at the end"), (1200.0, true, "and still at the end")]
    {
        let answer = answer(&scenario(&head_on(force, 0.2)));
        let fold = answer.run.fold.expect("1 kN folds the mesh");
        assert_eq!(fold.stays, stays, "{fold:?}");
        // By the front, where the blow falls, and a few of many quads.
        assert!(fold.front_angle().abs() < 0.5 && fold.radius() < 12e-3);
        assert!(fold.quads > 0 && fold.quads < fold.of / 5);
        let open = answer.run.simulated - fold.since - fold.lasted;
        assert_eq!(open.abs() > 1e-12, !stays, "{open}");
        let flag = &answer.flags[0];
        assert_eq!(flag.kind, FlagKind::MeshFolded);
        assert!(flag.whole().contains(says), "{}", flag.whole());
        assert!(flag.message.contains(&format!("{} of {} quads", fold.quads, fold.of)));
    }
}

#[test]
fn a_blow_that_rounding_swallows_does_nothing_and_says_so() {
    for level in [1, 3] {
        let mut tiny = scenario(&head_on(1e-300, 0.2));
        tiny.eye.level = level;
        let answer = answer(&tiny);
        let kinds: Vec<FlagKind> = answer.flags.iter().map(|f| f.kind).collect();
        assert_eq!(kinds, [FlagKind::LostInRounding]);
        assert!(answer.results().present().all(|(_, value)| value == 0.0));
        tiny.impact = scenario(&head_on(1e-5, 0.2)).impact;
        let answer = self::answer(&tiny);
        assert!(answer.flags.is_empty() && answer.index().damage() > 0.0);
    }
}

#[test]
fn stopping_early_changes_no_result_in_random_scenes() {
    use contrecoup::models::paper::case::PaperCase;
    use contrecoup::verify::scenes::Scenes;
    let mut stopped = [0, 0];
    // The second mesh has its own proof for the shell.
    for (index, level) in (0..40).map(|i| (i, 1)).chain((0..16).map(|i| (i, 2))) {
        let mut scenario = Scenes::Pulses.scene(index, 7);
        scenario.eye.level = level;
        let case = PaperCase::new(&scenario.check().unwrap());
        let plan = case.plan(&scenario).unwrap();
        let whole = Keep { traces: true, frames: None };
        let early = case.run(&plan, Keep::default(), &mut unwatched).unwrap();
        let full = case.run(&plan, whole, &mut unwatched).unwrap();
        assert_eq!(early.readings, full.readings, "scene {index}");
        assert_eq!(early.details, full.details, "scene {index}");
        assert_eq!(early.fold, full.fold, "scene {index}");
        assert!(early.cost.steps <= full.cost.steps);
        assert!(full.simulated > 2.999_999e-3, "traces are kept to the end of the window");
        stopped[level as usize - 1] += usize::from(early.simulated < 2.9e-3);
    }
    assert!(
        stopped[0] > 20 && stopped[1] > 6,
        "only {stopped:?} of 40 and 16 scenes stopped early"
    );
}
