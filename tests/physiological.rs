//! The physiological model: pressure, slab and dashpots, alone and together.

use contrecoup::dynamics::{Fluid, PA_PER_MMHG, State, area};
use contrecoup::eye::SpringKind;
use contrecoup::recording::{Keep, Spacing};
use contrecoup::scenario::{Impact, Lens, Model, Physiological, Projectile, Scenario};
use contrecoup::study::{Answer, Case, solve, unwatched};
use nalgebra::{Point2, Vector2};

fn physiological(change: impl FnOnce(&mut Physiological)) -> Scenario {
    let mut parts = Physiological::default();
    change(&mut parts);
    Scenario {
        model: Model::Physiological(parts),
        ..Scenario::default()
    }
}

fn answer(scenario: &Scenario) -> Answer {
    solve(&scenario.check().unwrap(), Keep::default(), &mut unwatched).unwrap()
}

fn without_force(mut scenario: Scenario) -> Scenario {
    if let Impact::ForcePulse(pulse) = &mut scenario.impact {
        pulse.force_n = 0.0;
    }
    scenario
}

#[test]
fn pressure_forces_are_the_gradient_of_their_energy() {
    let rest: Vec<Point2<f64>> = (0..36)
        .map(|i| {
            let angle = f64::from(i) * 10f64.to_radians();
            Point2::new(12e-3 * angle.cos(), 12e-3 * angle.sin())
        })
        .collect();
    let fluid = Fluid::new(2e3, 60e6, 0.016, &rest);
    let mut ring = rest;
    for (i, p) in ring.iter_mut().enumerate() {
        let i = i as f64;
        *p += Vector2::new((1.3 * i).sin(), (2.1 * i).cos()) * 4e-4;
    }
    let mut forces = vec![Vector2::zeros(); ring.len()];
    let ratio = fluid.apply(&ring, &mut forces);
    let energy = |ring: &[Point2<f64>]| fluid.energy(area(ring) / fluid.rest_area);
    assert!((ratio - area(&ring) / fluid.rest_area).abs() < 1e-15);
    let largest = forces.iter().map(Vector2::norm).fold(0.0, f64::max);
    assert!(largest > 1.0);
    for node in 0..ring.len() {
        for axis in [Vector2::x(), Vector2::y()] {
            let moved = |shift: f64| {
                let mut ring = ring.clone();
                ring[node] += axis * shift;
                energy(&ring)
            };
            let slope = (moved(1e-7) - moved(-1e-7)) / 2e-7;
            assert!((slope + forces[node].dot(&axis)).abs() < 1e-6 * largest);
        }
    }
    // A uniform pressure pushes the eye nowhere.
    assert!(forces.iter().sum::<Vector2<f64>>().norm() < 1e-12 * largest);
}

#[test]
fn the_eye_at_rest_stays_at_rest() {
    for level in 1..=2 {
        let mut scenario = without_force(physiological(|_| ()));
        scenario.eye.level = level;
        let keep = Keep {
            traces: false,
            frames: Some(Spacing::even(3e-3)),
        };
        let answer = solve(&scenario.check().unwrap(), keep, &mut unwatched).unwrap();
        let last = answer.frames.last().unwrap();
        assert!((last.time - 3e-3).abs() < 1e-12);
        for (place, node) in last
            .positions
            .iter()
            .zip(&answer.case.section().unwrap().eye.nodes)
        {
            assert!((place - node.position).norm() < 1e-12);
        }
        let fluid = answer.left.section().unwrap().fluid.unwrap();
        let rest = 15.0 * PA_PER_MMHG;
        assert_eq!(fluid.rest_pressure, rest);
        assert!((fluid.pressure.value / rest - 1.0).abs() < 1e-6);
    }
}

#[test]
fn a_ring_under_pressure_carries_p_r_over_t() {
    let mut scenario = without_force(physiological(|parts| {
        parts.sclera_stiffening = 1.0;
        parts.fat_stiffening = 1.0;
        parts.globe_damping_ratio = 0.5;
    }));
    // The shell alone: hardly anything inside, outside or across.
    scenario.eye.rest_kpa = 1e-3;
    scenario.eye.fat_kpa = 1e-3;
    scenario.eye.lens = Lens::Soft;
    scenario.eye.filament_hops = Vec::new();
    scenario.window_ms = 60.0;
    let mut case = Case::new(&scenario.check().unwrap());
    let mut coupled = case.system.coupled().unwrap().clone();
    // A globe filled with more than fits.
    coupled.fluid.as_mut().unwrap().rest_area *= 1.01;
    case.system = case.system.with(Some(coupled));
    case.start = State::at_rest(&case.system);
    let plan = case.plan(&scenario).unwrap();
    let keep = Keep {
        traces: false,
        frames: Some(Spacing::even(60e-3)),
    };
    let solved = case.run(&plan, keep, &mut unwatched).unwrap();
    let last = solved.recording.frames.last().unwrap();
    let over = last.pressure.unwrap() - 15.0 * PA_PER_MMHG;
    assert!(over > 1e3, "{over}");
    // Four corners of the mesh join next but one nodes of the shell too, so one ring's tension is not
    // all. The tensions times lengths of whatever carries the load add up to 2 p h A, which is
    // T 2 pi r = 2 p h pi r^2, or sigma = p r / t, where one thin ring carries it.
    let sclera = case
        .eye
        .springs
        .iter()
        .filter(|s| s.kind == SpringKind::Sclera);
    let carried: f64 = sclera
        .map(|s| {
            let length = (last.positions[s.b] - last.positions[s.a]).norm();
            s.stiffness * (length - s.rest_length) * length
        })
        .sum();
    let shell: Vec<Point2<f64>> = case
        .eye
        .landmarks
        .shell
        .iter()
        .map(|&node| last.positions[node])
        .collect();
    let expected = 2.0 * over * 0.016 * area(&shell);
    assert!(
        (carried / expected - 1.0).abs() < 0.01,
        "{carried} {expected}"
    );
}

#[test]
fn each_part_has_its_own_switch_and_does_no_work_when_off() {
    let off = |parts: &mut Physiological| {
        parts.slab = false;
        parts.pressure = false;
        parts.dashpots = false;
        parts.sclera_stiffening = 1.0;
        parts.fat_stiffening = 1.0;
    };
    // All off is the paper's model, to the last bit and by the same path.
    let bare = answer(&physiological(off));
    let paper = answer(&Scenario::default());
    assert_eq!((bare.left, &bare.frames), (paper.left, &paper.frames));
    assert_eq!(bare.cost, paper.cost);

    let slab = answer(&physiological(|parts| {
        off(parts);
        parts.slab = true;
    }));
    assert!(slab.case.section().unwrap().system.coupled().is_none());
    let ratio = slab.case.section().unwrap().eye.springs[0].stiffness
        / paper.case.section().unwrap().eye.springs[0].stiffness;
    assert!((ratio - 0.016).abs() < 1e-15);

    let pressure = answer(&physiological(|parts| {
        off(parts);
        parts.pressure = true;
    }));
    assert!(pressure.cost.pressure_evaluations > 0);
    assert_eq!(pressure.cost.dashpot_evaluations, 0);
    assert_eq!(pressure.cost.contact_tests, 0);
    // The fluid keeps the globe from being squeezed.
    let squeeze = |answer: &Answer| answer.left.section().unwrap().apex.value;
    assert!(squeeze(&pressure) < squeeze(&paper));

    let dashpots = answer(&physiological(|parts| {
        off(parts);
        parts.dashpots = true;
    }));
    assert!(dashpots.cost.dashpot_evaluations > 0);
    assert_eq!(dashpots.cost.pressure_evaluations, 0);
    assert!(dashpots.left.section().unwrap().fluid.is_none());
    assert!(dashpots.left.section().unwrap().energy_residual < 1e-2);
}

/// The prototype: a BB at 62.5 m/s makes the eye about 20 % shorter and wider, with peaks of 0.6 to
/// 1.4e6 Pa for bulk moduli of 20e6 to 200e6 Pa.
#[test]
fn a_bb_does_about_what_was_seen() {
    let mut before = 0.0;
    for (bulk_modulus_mpa, least, most) in [(20.0, 0.5, 1.0), (60.0, 0.6, 1.2), (200.0, 1.0, 2.0)] {
        let mut scenario = physiological(|parts| parts.bulk_modulus_mpa = bulk_modulus_mpa);
        scenario.impact = Impact::Projectile(Projectile {
            mass_g: 0.345,
            diameter_mm: 4.5,
            speed_m_s: 62.5,
            ..Projectile::default()
        });
        let answer = answer(&scenario);
        let extremes = &answer.left.section().unwrap();
        let pressure = extremes.fluid.unwrap().pressure.value * 1e-6;
        assert!(pressure > least && pressure < most, "{pressure}");
        assert!(pressure > before);
        before = pressure;
        assert!(extremes.apex.value > 3.5e-3 && extremes.apex.value < 6e-3);
        assert!(extremes.meridian_growth.value > 0.07 && extremes.meridian_growth.value < 0.25);
        let (shrunk, grown) = extremes.fluid.unwrap().area_ratio;
        assert!(shrunk > 0.96 && grown < 1.01, "{shrunk} {grown}");
    }
}

#[test]
fn integrators_that_cannot_solve_it_are_refused_by_name() {
    let mut scenario = physiological(|_| ());
    scenario.numerics.integrator = Some(contrecoup::scenario::Integrator::Srkn6b);
    let refusal = solve(&scenario.check().unwrap(), Keep::default(), &mut unwatched).unwrap_err();
    assert!(refusal.to_string().contains("srkn6b does not solve"));
    scenario.numerics.integrator = Some(contrecoup::scenario::Integrator::VelocityVerlet);
    assert!(solve(&scenario.check().unwrap(), Keep::default(), &mut unwatched).is_ok());
}
