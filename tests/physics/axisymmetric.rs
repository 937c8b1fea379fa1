//! What must hold of the axisymmetric eye whatever its parameters are.

use contrecoup::injury::DamageIndex;
use contrecoup::models::axisymmetric::eye::parameters::{Parameters, ShellParameters, Surround};
use contrecoup::models::axisymmetric::eye::{AxisymmetricEye, Tissue};
use contrecoup::models::axisymmetric::forces::object::{
    BallSpring, Object, ObjectOutline, ObjectSurface,
};
use contrecoup::models::axisymmetric::readings;
use contrecoup::models::axisymmetric::recording::results::EngineRun;
use contrecoup::models::axisymmetric::time::march::{CellLoop, STEP_SHARE, Scheme, Steps, Stop};
use contrecoup::models::axisymmetric::time::run::{AxisymmetricLoad, run, run_as};
use contrecoup::run::kept::{Keep, Spacing};
use contrecoup::scenario::{FASTEST_M_S, ForcePulse, MOST_ENERGY_J};
use std::ops::ControlFlow;

fn ball(mass_g: f64, diameter_mm: f64, speed: f64) -> Object {
    Object {
        outline: ObjectOutline::Sphere(0.5e-3 * diameter_mm),
        mass: mass_g * 1e-3,
        speed,
        surface: ObjectSurface::RIGID,
        spring: None,
    }
}

fn soft(object: Object, stiffness: f64) -> Object {
    let surface = ObjectSurface::foundation(stiffness, object.reach());
    Object { surface, ..object }
}

fn eye(level: u32, surround: Option<Surround>) -> AxisymmetricEye {
    let parameters = Parameters { surround, ..Parameters::default() };
    AxisymmetricEye::new(&parameters, level)
}

fn try_hit(
    eye: &AxisymmetricEye,
    object: Object,
    window_ms: f64,
    share: f64,
) -> Result<EngineRun, Stop> {
    let mut watch = |_| ControlFlow::Continue(());
    let blow = AxisymmetricLoad::Object(object);
    run(eye, &blow, window_ms * 1e-3, share, Keep::default(), &mut watch)
}

fn hit(eye: &AxisymmetricEye, object: Object, window_ms: f64) -> EngineRun {
    try_hit(eye, object, window_ms, STEP_SHARE).expect("a run")
}

fn leading(run: &EngineRun) -> [(&'static str, f64); 11] {
    let e = &run.extremes;
    [
        ("back", e.mean_back_pressure.value),
        ("apex", e.apex.value),
        ("lens", e.lens.value),
        ("damage", DamageIndex::of(&readings::of(e)).damage()),
        ("pressure", e.pressure.value),
        ("stress", e.scleral_stress.value),
        ("shortening", e.shortening.value),
        ("equator", e.equator_growth.value),
        ("intrusion", e.intrusion.value),
        ("energy", e.energy_imparted),
        ("force", e.mean_force.value),
    ]
}

#[test]
fn a_free_eye_keeps_momentum_and_every_eye_its_energy() {
    let free = eye(2, None);
    let pig = Parameters {
        shell: ShellParameters::pig(),
        surround: Some(Surround::gelatin()),
        ..Parameters::default()
    };
    let object = ball(0.345, 4.5, 62.5);
    let run = hit(&free, object, 1.5);
    let before = object.mass * object.speed;
    assert!((run.momentum / before - 1.0).abs() < 1e-9);
    for eye in [free, eye(2, Some(Surround::orbit())), AxisymmetricEye::new(&pig, 2)] {
        let run = hit(&eye, object, 1.5);
        assert!(run.extremes.energy_residual < 1e-3, "{}", run.extremes.energy_residual);
    }
}

#[test]
fn a_quarter_of_the_step_gives_the_same_results() {
    let eye = eye(1, Some(Surround::orbit()));
    for object in [ball(0.345, 4.5, 60.0), soft(ball(45.9, 42.7, 30.0), 4.6e9)] {
        let coarse = hit(&eye, object, 1.0);
        let fine = try_hit(&eye, object, 1.0, 0.25 * STEP_SHARE).expect("a run");
        for ((what, a), (_, b)) in leading(&coarse).into_iter().zip(leading(&fine)) {
            println!("{what} {a} {b} {:+.3} %", 100.0 * (a / b - 1.0));
            let within = if what == "force" { 0.02 } else { 0.004 };
            assert!((a / b - 1.0).abs() < within, "{what} {a} {b}");
        }
    }
}

#[test]
fn neighbouring_speeds_give_neighbouring_results() {
    let eye = eye(1, Some(Surround::orbit()));
    let runs: Vec<_> = (0..20)
        .map(|i| leading(&hit(&eye, ball(0.345, 4.5, 60.0 * (1.0 + 0.0005 * f64::from(i))), 0.8)))
        .collect();
    for pair in runs.windows(2) {
        for ((what, a), (_, b)) in pair[0].into_iter().zip(pair[1]) {
            assert!((a / b - 1.0).abs() < 0.02, "{what} {a} {b}");
        }
    }
}

#[test]
fn nothing_hard_folds_a_cell_at_any_level_or_goes_through() {
    let objects = [
        ("BB", ball(0.345, 4.5, 150.0)),
        ("airsoft", ball(0.2, 6.0, 130.0)),
        ("paintball", ball(3.0, 17.3, 90.0)),
        ("golf ball", ball(45.9, 42.7, 60.0)),
        ("squash ball", ball(24.0, 40.0, 60.0)),
        ("steel", ball(1.05, 6.35, 66.5)),
        ("puck", ball(170.0, 76.0, 30.0)),
        ("pellet", ball(0.5, 4.5, 120.0)),
    ];
    for level in [1, 2] {
        for surround in [Some(Surround::orbit()), Some(Surround::gelatin()), None] {
            let eye = eye(level, surround);
            for (what, object) in objects {
                match try_hit(&eye, object, 0.6, STEP_SHARE) {
                    Ok(run) => {
                        let e = &run.extremes;
                        println!(
                            "{level} {what}: triangle {:.3} p {:.2} stress {:.1} short {:.1} % residual {:.1e} steps {}",
                            e.least_triangle,
                            e.pressure.value * 1e-6,
                            e.scleral_stress.value * 1e-6,
                            e.shortening.value * 100.0,
                            e.energy_residual,
                            run.steps
                        );
                        assert!(e.fold.is_none(), "{level} {what}");
                        assert!(e.energy_residual < 0.02, "{level} {what} {}", e.energy_residual);
                    }
                    Err(refusal) => panic!("{level} {what}: {refusal:?}"),
                }
            }
        }
    }
}

#[test]
fn the_plain_loop_and_the_rows_give_the_same_run() {
    let eye = eye(1, Some(Surround::orbit()));
    let blow = AxisymmetricLoad::Object(ball(0.345, 4.5, 60.0));
    let runs = [CellLoop::Plain, CellLoop::Rows].map(|form| {
        let mut watch = |_| ControlFlow::Continue(());
        run_as(form, &eye, &blow, 0.3e-3, STEP_SHARE, Keep::default(), &mut watch).expect("a run")
    });
    for ((what, a), (_, b)) in leading(&runs[0]).into_iter().zip(leading(&runs[1])) {
        assert!((a / b - 1.0).abs() < 1e-5, "{what} {a} {b}");
    }
}

/// Soft, hollow and bursting things, with the surfaces that published tests give them.
fn soft_objects() -> Vec<(&'static str, Object)> {
    let surface = |object: Object, stiffness: f64, cap: Option<f64>, restitution: f64| {
        let surface = match cap {
            Some(cap) => ObjectSurface::capped(stiffness, cap, object.reach()),
            None => ObjectSurface::foundation(stiffness, object.reach()),
        };
        Object { surface: surface.losing(restitution), ..object }
    };
    vec![
        ("baseball", surface(ball(145.0, 73.0, 40.0), 1.4e9, None, 0.5)),
        ("softball", surface(ball(185.0, 97.0, 30.0), 2e9, None, 0.44)),
        ("golf", surface(ball(45.9, 42.7, 60.0), 4.6e9, None, 0.78)),
        ("tennis", surface(ball(58.0, 66.0, 50.0), 1e9, Some(200e3), 0.55)),
        ("squash", surface(ball(24.0, 40.0, 60.0), 1e9, Some(150e3), 0.4)),
        ("racquet", surface(ball(40.0, 57.0, 50.0), 1e9, Some(120e3), 0.75)),
        ("pickle", surface(ball(25.0, 74.0, 25.0), 1.6e8, Some(150e3), 0.6)),
        ("soccer", surface(ball(430.0, 220.0, 25.0), 1e9, Some(110e3), 0.78)),
        ("paintball", surface(ball(3.0, 17.3, 90.0), 1e10, Some(4.5e6), 0.0)),
        ("gel ball", surface(ball(0.25, 7.5, 60.0), 5e6, Some(1.8e6), 0.3)),
        ("cork", surface(ball(9.0, 25.0, 20.0), 1.1e9, Some(800e3), 0.4)),
        ("shuttlecock", surface(ball(5.0, 25.0, 70.0), 1.4e9, Some(800e3), 0.4)),
        ("foam dart", surface(ball(1.2, 13.0, 25.0), 5e7, Some(150e3), 0.4)),
        ("sponge", surface(ball(28.0, 40.0, 61.0), 1e8, None, 0.3)),
        ("airbag foam", surface(ball(0.03, 6.0, 30.0), 3e8, None, 0.3)),
        ("fist", surface(ball(500.0, 80.0, 8.0), 1.3e8, None, 0.4)),
    ]
}

#[test]
fn soft_things_stop_before_the_eye_does_and_fold_nothing() {
    for level in [1, 2] {
        let eye = eye(level, Some(Surround::orbit()));
        for (what, object) in soft_objects() {
            let run = try_hit(&eye, object, 1.5, STEP_SHARE);
            let run = run.unwrap_or_else(|refusal| panic!("{level} {what}: {refusal:?}"));
            let e = &run.extremes;
            println!(
                "{level} {what}: F {:.0} N p {:.2} MPa stress {:.1} intrusion {:.1} mm rebound {:.1} given {:.2} J of {:.2} triangle {:.3} residual {:.1e} steps {}",
                e.mean_force.value,
                e.pressure.value * 1e-6,
                e.scleral_stress.value * 1e-6,
                e.intrusion.value * 1e3,
                e.rebound.unwrap_or(0.0),
                e.energy_imparted,
                0.5 * object.mass * object.speed.powi(2),
                e.least_triangle,
                e.energy_residual,
                run.steps
            );
            assert!(e.fold.is_none(), "{level} {what}");
            assert!(e.energy_residual < 0.01, "{level} {what} {}", e.energy_residual);
        }
    }
}

#[test]
fn a_ball_on_a_spring_gives_back_what_its_restitution_says() {
    let eye = eye(1, Some(Surround::orbit()));
    let rebound = |restitution: f64| {
        let spring = Some(BallSpring { stiffness: 2e4, restitution });
        let object = Object { spring, ..soft(ball(24.0, 40.0, 10.0), 1e9) };
        let run = hit(&eye, object, 4.0);
        assert!(run.extremes.energy_residual < 0.01, "{}", run.extremes.energy_residual);
        run.extremes.rebound.expect("an object")
    };
    let (lively, dull) = (rebound(0.9), rebound(0.3));
    assert!(lively > dull, "{lively} {dull}");
}

#[test]
fn a_run_that_ends_early_has_the_extremes_of_its_whole_window() {
    let eye = eye(1, Some(Surround::orbit()));
    let mut objects = soft_objects();
    objects.push(("BB", ball(0.345, 4.5, 60.0)));
    objects.push(("airsoft", ball(0.2, 6.0, 100.0)));
    objects.push(("steel", ball(1.05, 6.35, 30.0)));
    let (mut count, objects_in_all) = (0, objects.len());
    for (what, object) in objects {
        let runs = [None, Some(Spacing::even(1e-3))].map(|frames| {
            let keep = Keep { traces: false, frames };
            let mut watch = |_| ControlFlow::Continue(());
            run(&eye, &AxisymmetricLoad::Object(object), 4e-3, STEP_SHARE, keep, &mut watch)
                .expect("a run")
        });
        for ((name, early), (_, whole)) in leading(&runs[0]).into_iter().zip(leading(&runs[1])) {
            assert!((early / whole - 1.0).abs() < 1e-5, "{what} {name} {early} {whole}");
        }
        assert_eq!(runs[0].extremes.lens, runs[1].extremes.lens);
        assert_eq!(runs[0].extremes.node_force, runs[1].extremes.node_force);
        assert!(!runs[1].settled);
        count += usize::from(runs[0].settled);
    }
    assert!(count > objects_in_all / 2, "{count} of {objects_in_all} ended early");
}

#[test]
fn a_scene_is_computed_for_what_it_has_alone() {
    // A free eye has nothing around it.
    let (held, free) = (eye(1, Some(Surround::orbit())), eye(1, None));
    assert!(free.cells.len() < held.cells.len() && free.mesh.wall.is_empty());
    assert!(free.cells.iter().all(|cell| cell.region == Tissue::Globe));
}

#[test]
fn another_integrator_comes_to_the_same_as_steps_get_shorter_and_is_worse_at_long_ones() {
    let eye = eye(1, Some(Surround::orbit()));
    let at = |scheme, share| {
        let blow = AxisymmetricLoad::Object(ball(0.345, 4.5, 60.0));
        let steps = Steps { share, scheme };
        let mut watch = |_| ControlFlow::Continue(());
        run(&eye, &blow, 0.5e-3, steps, Keep::default(), &mut watch).expect("a run")
    };
    let (verlet, euler) = (Scheme::Leapfrog, Scheme::SemiImplicitEuler);
    let exact = leading(&at(verlet, 0.05));
    let worst = |integrator, share| {
        let pairs = leading(&at(integrator, share)).into_iter().zip(exact);
        pairs.fold(0.0, |worst: f64, ((_, a), (_, b))| worst.max((a / b - 1.0).abs()))
    };
    let [long, short] = [0.6, 0.15].map(|share| [worst(verlet, share), worst(euler, share)]);
    println!("{long:?} {short:?}");
    assert!(short[1] < 0.5 * long[1] && short[1] < 0.02, "{long:?} {short:?}");
    assert!(long[0] < long[1], "{long:?}");
}

#[test]
fn a_ball_that_bone_stops_comes_back_at_its_coefficient_of_restitution() {
    let eye = eye(1, Some(Surround::orbit()));
    for restitution in [0.3, 0.8] {
        let object = Object {
            surface: ObjectSurface::capped(1e9, 110e3, 0.11).losing(restitution),
            ..ball(430.0, 220.0, 25.0)
        };
        let rebound = hit(&eye, object, 15.0).extremes.rebound.expect("an object");
        assert!((rebound / 25.0 - restitution).abs() < 0.03, "{restitution} {rebound}");
    }
}

#[test]
fn a_pulse_gives_the_eye_its_work_and_balances() {
    let eye = eye(1, Some(Surround::orbit()));
    let pulse = contrecoup::models::pulse::Pulse::new(&ForcePulse {
        force_n: 100.0,
        duration_ms: 0.2,
        ..ForcePulse::default()
    });
    let blow = AxisymmetricLoad::Pulse(pulse, 20f64.to_radians());
    let mut watch = |_| ControlFlow::Continue(());
    let run = run(&eye, &blow, 1.5e-3, STEP_SHARE, Keep::default(), &mut watch).expect("a run");
    let e = &run.extremes;
    assert!((e.force.value - 100.0).abs() < 1.0, "{:?}", e.force);
    assert!(e.energy_imparted > 0.01 && e.energy_residual < 0.02, "{e:?}");
    assert!(e.rebound.is_none() && e.apex.value > 1e-4);
}

#[test]
fn two_hundred_objects_by_a_seed_fold_nothing_go_through_nothing_and_balance() {
    let eyes = [eye(1, Some(Surround::orbit())), eye(2, Some(Surround::gelatin())), eye(1, None)];
    // A low-discrepancy sequence: shares of the golden ratio's kin.
    let share = |i: usize, k: usize| {
        let step = [0.819_172_5, 0.671_043_6, 0.549_700_5, 0.450_299_5, 0.368_875_3][k];
        (0.5 + step * (i as f64 + 1.0)).fract()
    };
    let mut worst = 0.0_f64;
    for i in 0..200 {
        let between = |low: f64, high: f64, k| low * f64::powf(high / low, share(i, k));
        let diameter = between(3.0, 240.0, 0);
        let density = between(0.1, 8.0, 1);
        let mass = density * std::f64::consts::PI / 6.0 * (0.1 * diameter).powi(3);
        // As fast as gives it from 1 mJ to the most that a scenario takes, and no faster than one
        // takes.
        let energy = between(1e-3, MOST_ENERGY_J, 2);
        let speed = (2.0 * energy / (mass * 1e-3)).sqrt().min(FASTEST_M_S);
        let object = ball(mass, diameter, speed);
        let (radius, stiffness) = (object.reach(), between(1e4, 1e11, 4));
        // Hard, solid, hollow or crushable, liquid: a third of the last three on a spring.
        let surface = match (4.0 * share(i, 3)) as usize {
            0 => ObjectSurface::RIGID,
            1 => ObjectSurface::foundation(stiffness, radius),
            2 => ObjectSurface::capped(stiffness, between(1e3, 1e8, 1), radius),
            _ => ObjectSurface::splashing(500.0 * density * speed * speed, radius),
        };
        let restitution = share(i, 1);
        let spring = (i % 3 == 0 && surface.depth.is_some())
            .then_some(BallSpring { stiffness: between(1e3, 1e6, 2), restitution });
        let object = Object { surface: surface.losing(restitution), spring, ..object };
        match try_hit(&eyes[i % 3], object, 1.0, STEP_SHARE) {
            Ok(run) => {
                let e = &run.extremes;
                assert!(e.fold.is_none(), "{i} {object:?}");
                worst = worst.max(e.energy_residual);
            }
            Err(refusal) => panic!("{i} {object:?}: {refusal:?}"),
        }
    }
    // The worst are hard flakes of some 10 mg at the greatest speed.
    assert!(worst < 0.08, "{worst}");
}
