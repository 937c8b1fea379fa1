//! Whole blows: what must be kept, what must be the same, and the axisymmetric eye straight on.

use crate::models::axisymmetric::eye::parameters::{Parameters, ShellParameters, Surround};
use crate::models::axisymmetric::forces::object::{Object, ObjectOutline, ObjectSurface};
use crate::models::axisymmetric::time::march::{CellLoop, STEP_SHARE};
use crate::models::axisymmetric::time::run::{self as axisymmetric, AxisymmetricLoad};
use crate::models::axisymmetric::time::until::Until;
use crate::models::axisymmetric::{eye::AxisymmetricEye, recording::results::Extremes};
use crate::models::spatial::case::{Scene, SpatialCase};
use crate::models::spatial::eye::{SpatialEye, mesh::Extent, orbit::OrbitRim};
use crate::models::spatial::forces::object::Aim;
use crate::models::spatial::recording::results::{self, EngineRun};
use crate::models::spatial::time::run::{SpatialBlow, run, run_as};
use crate::run::kept::{Frame, Keep, Spacing};
use crate::run::model::{EyeModel, Run};
use crate::run::plan::Plan;
use crate::run::{flags::FlagKind, quantity::Quantity, watch::unwatched};
use crate::scenario::{Integrator, Rim, library::tests::preset, set::set};
use nalgebra::Vector2;

const BB: Object = Object {
    outline: ObjectOutline::Sphere(2.25e-3),
    mass: 0.345e-3,
    speed: 62.5,
    surface: ObjectSurface::RIGID,
    spring: None,
};

fn parameters(surround: Option<Surround>) -> Parameters {
    Parameters { surround, ..Parameters::default() }
}

/// A blow from an angle and azimuth in degrees, beside the middle by some mm towards another.
fn aim(angle: f64, from: f64, offset: f64, towards: f64) -> Aim {
    Aim {
        angle: angle.to_radians(),
        from: from.to_radians(),
        offset: offset * 1e-3,
        towards: towards.to_radians(),
    }
}

fn hit(eye: &SpatialEye, object: Object, aim: Aim, ms: f64) -> EngineRun {
    let up = if eye.extent == Extent::Half { aim.plane() } else { 0.0 };
    let blow = SpatialBlow { object, aim, up };
    run(eye, &blow, ms * 1e-3, STEP_SHARE, Keep::default(), &mut unwatched).unwrap()
}

#[test]
fn a_free_eye_that_is_hit_aside_keeps_momentum_and_angular_momentum_and_energy() {
    let eye = SpatialEye::new(&parameters(None), None, Extent::Full, 1);
    let aim = aim(35.0, 20.0, 4.0, 130.0);
    let hit = hit(&eye, BB, aim, 0.35);
    let brought = aim.way() * (BB.mass * BB.speed);
    assert!((hit.momentum[0] - brought).norm() < 1e-11 * brought.norm());
    let turning = aim.passes().cross(&brought);
    let off = (hit.momentum[1] - turning).norm() / turning.norm();
    assert!(off < 1e-10, "{off:e}");
    assert!(hit.extremes.common.energy_residual < 8e-3);
    assert!(hit.extremes.turn.value > 0.0);
}

#[test]
fn half_and_whole_and_both_loops_give_the_same_where_the_blow_has_a_plane() {
    let gelatin = parameters(Some(Surround::gelatin()));
    let of = |extent| SpatialEye::new(&gelatin, None, extent, 1);
    // In a plane that both meshes share.
    let aim = aim(30.0, 0.0, 2.0, 180.0);
    let (half, whole) = (of(Extent::Half), of(Extent::Full));
    let (a, b) = (hit(&half, BB, aim, 0.25), hit(&whole, BB, aim, 0.25));
    assert_eq!(a.steps, b.steps);
    let (x, y) = (&a.extremes, &b.extremes);
    let near = |a: f64, b: f64| (a - b).abs() <= 1e-7 * a.abs().max(1e-12);
    let of = |e: &results::Extremes| {
        let common = &e.common;
        let peaks = [common.pressure, common.scleral_stress, common.energy_given];
        let peaks = peaks.into_iter().chain(common.tissue).map(|peak| peak.value);
        peaks.chain(e.sectors.lens).chain([common.contact_radius]).collect::<Vec<f64>>()
    };
    for (a, b) in of(x).into_iter().zip(of(y)) {
        assert!(near(a, b), "{a} {b}");
    }
    let blow = SpatialBlow { object: BB, aim, up: 0.0 };
    let keep = Keep::default();
    let [plain, rows] = [CellLoop::Plain, CellLoop::Rows].map(|form| {
        let run = run_as(form, &half, &blow, 1e-4, STEP_SHARE, keep, &mut unwatched).unwrap();
        run.extremes.common.pressure.value
    });
    assert!(near(plain, rows));
}

#[test]
fn a_mirrored_orbit_and_blow_give_the_mirror_image() {
    let rim = OrbitRim::from(&Rim::CAUCASIAN);
    let mirrored = |of: [f64; 4]| [of[0], of[3], of[2], of[1]];
    let other = OrbitRim { depth: mirrored(rim.depth), gap: mirrored(rim.gap) };
    let fat = parameters(Some(Surround::orbit()));
    let of = |rim| SpatialEye::new(&fat, Some(rim), Extent::Full, 1);
    let a = hit(&of(rim), BB, aim(40.0, 120.0, 0.0, 0.0), 0.12);
    let b = hit(&of(other), BB, aim(40.0, -120.0, 0.0, 0.0), 0.12);
    let (a, b) = (a.extremes, b.extremes);
    assert!((a.common.pressure.value / b.common.pressure.value - 1.0).abs() < 1e-9);
    for hour in 0..12 {
        let (x, y) = (a.sectors.edge[hour], b.sectors.edge[(12 - hour) % 12]);
        assert!((x - y).abs() < 1e-8, "{hour}: {x} {y}");
    }
}

#[test]
fn a_constant_rim_is_a_ring_and_does_not_know_where_a_blow_comes_from() {
    let fat = parameters(Some(Surround::orbit()));
    let ring = SpatialEye::new(&fat, None, Extent::Half, 1);
    let rim = ring.rim.unwrap();
    let curve = SpatialEye::new(&fat, Some(rim), Extent::Full, 1);
    let of = |eye: &SpatialEye, from| {
        let hit = hit(eye, BB, aim(30.0, from, 0.0, 0.0), 0.2);
        hit.extremes.common.pressure.value
    };
    let (a, b, c) = (of(&ring, 0.0), of(&curve, 0.0), of(&curve, 37.0));
    assert!((a / b - 1.0).abs() < 1e-4, "{a} {b}");
    assert!((c / b - 1.0).abs() < 0.02, "{b} {c}");
}

#[test]
fn an_eye_that_is_alike_on_all_sides_hardly_knows_its_mesh() {
    let mut alike = parameters(None);
    alike.shell.limbus = 0.0;
    for point in &mut alike.shell.sclera_thickness {
        point.1 = 0.5e-3;
    }
    alike.lens.half_axes = (1e-9, 1e-9);
    let eye = SpatialEye::new(&alike, None, Extent::Half, 1);
    let pressure = |angle| {
        let hit = hit(&eye, BB, aim(angle, 0.0, 0.0, 0.0), 0.25);
        hit.extremes.common.pressure.value
    };
    // From the front to the side: from the middle of a patch of the mesh to that of the next.
    let pressures = [0.0, 15.0, 25.0, 35.0, 45.0, 60.0, 75.0, 85.0, 90.0].map(pressure);
    let most = pressures.into_iter().fold(0.0, f64::max);
    let least = pressures.into_iter().fold(f64::INFINITY, f64::min);
    assert!((most - least) / (most + least) < 0.031, "{pressures:?}");
    let of_front = |i: usize| (pressures[i] / pressures[0] - 1.0).abs();
    assert!(of_front(2) < 0.03 && of_front(4) < 0.03, "{pressures:?}");
}

#[test]
fn straight_on_it_is_the_axisymmetric_eye_within_the_error_of_its_mesh() {
    let pig = Parameters { shell: ShellParameters::pig(), ..parameters(None) };
    for (of, speed) in [
        (parameters(Some(Surround::gelatin())), 56.0),
        (parameters(Some(Surround::orbit())), 62.5),
        (pig, 62.5),
    ] {
        let object = Object { speed, ..BB };
        let (flat, load) = (AxisymmetricEye::new(&of, 1), AxisymmetricLoad::Object(object));
        let keep = Keep::default();
        let flat = axisymmetric::run(&flat, &load, 0.45e-3, STEP_SHARE, keep, &mut unwatched);
        let flat = flat.unwrap();
        let eye = SpatialEye::new(&of, None, Extent::Half, 1);
        let hit = hit(&eye, object, aim(0.0, 0.0, 0.0, 0.0), 0.45);
        let (a, b) = (&hit.extremes.common, &flat.extremes);
        let near = |what: &str, value: fn(&Extremes) -> f64, error: f64| {
            let ratio = value(a) / value(b);
            assert!((ratio - 1.0).abs() < error, "{what} {ratio}");
        };
        near("pressure", |e| e.pressure.value, 0.06);
        near("force", |e| e.mean_force.value, 0.07);
        near("shortening", |e| e.shortening.value, 0.06);
        near("intrusion", |e| e.intrusion.value, 0.06);
        near("stress", |e| e.scleral_stress.value, 0.15);
        near("equator", |e| e.tissue[0].value, 0.15);
        near("edge", |e| e.tissue[2].value, 0.12);
        near("back", |e| e.tissue[1].value, 0.25);
        near("cornea", Extremes::energy_over_contact, 0.15);
        assert!(a.energy_residual < 8e-3 && a.fold.is_none());
        assert!(hit.extremes.turn.value < 1e-6);
    }
}

fn scene(rim: Option<OrbitRim>, aim: Aim, window: Until) -> Scene {
    Scene {
        parameters: parameters(Some(Surround::orbit())),
        rim,
        object: BB,
        aim,
        window,
        level: 1,
        extent: Extent::Half,
    }
}

fn case(rim: Option<OrbitRim>, aim: Aim, window: Until) -> SpatialCase {
    SpatialCase::new(&scene(rim, aim, window))
}

#[test]
fn only_what_a_scene_needs_is_computed() {
    let of = |rim, aim| case(rim, aim, Until::Time(1e-4)).eye.extent;
    let measured = Some(OrbitRim::from(&Rim::CAUCASIAN));
    assert_eq!(of(None, aim(40.0, 77.0, 0.0, 0.0)), Extent::Half);
    assert_eq!(of(None, aim(40.0, 77.0, 3.0, 257.0)), Extent::Half);
    assert_eq!(of(None, aim(0.0, 0.0, 3.0, 50.0)), Extent::Half);
    assert_eq!(of(None, aim(40.0, 77.0, 3.0, 90.0)), Extent::Full);
    assert_eq!(of(measured, aim(0.0, 0.0, 0.0, 0.0)), Extent::Full);
}

#[test]
fn the_socket_gives_readings_places_frames_and_a_picture_that_belong_together() {
    let rim = OrbitRim::from(&Rim::CAUCASIAN);
    let case = case(Some(rim), aim(40.0, 180.0, 0.0, 0.0), Until::Time(0.2e-3));
    let integrator = Integrator::VelocityVerlet;
    let step = STEP_SHARE * case.step_limit(integrator);
    let plan = Plan { integrator, step, window: 0.2e-3, multiple: 1.0, local_tolerance: 1e-5 };
    let keep = Keep { traces: true, frames: Some(Spacing::even(5e-5)) };
    let run = case.run(&plan, keep, &mut unwatched).unwrap();
    for of in [Quantity::Pressure, Quantity::EquatorStretch, Quantity::LensPull] {
        assert!(run.readings.value(of).unwrap() > 0.0, "{}", of.label());
    }
    assert!(run.sectors.unwrap().edge.iter().all(|stretch| *stretch >= 0.0));
    let traces = run.traces.as_ref().unwrap();
    assert_eq!(traces.time.len(), traces.tissue[4].len());
    assert_eq!(run.frames.len(), 5);
    let (drawing, regions) = (case.drawing(), case.regions());
    let (first, last) = (&run.frames[0], &run.frames[4]);
    assert_eq!(regions.len(), first.positions.len());
    assert_eq!(drawing.cells.len(), first.cells.len());
    for line in &drawing.lines {
        assert!(line.ends.0.max(line.ends.1) < drawing.nodes.len());
    }
    // The object comes from below and lies outside of the globe.
    let (object, core) = drawing.object(first).unwrap();
    let gap = core.coords.norm() - object.radius - 12e-3;
    assert!(gap.abs() < 2e-4, "{gap}");
    let angle = libm::atan2(core.y, -core.x).to_degrees();
    assert!((angle + 40.0).abs() < 5.0, "{angle}");
    // By the end it has dented what it hit.
    let dent = |frame: &Frame| {
        let shell = (0..drawing.nodes.len()).filter(|i| regions[*i].on_shell());
        let along = shell.map(|i| frame.positions[i].coords.dot(&Vector2::new(0.766, 0.643)));
        along.fold(f64::INFINITY, f64::min)
    };
    assert!(dent(last) > dent(first) + 1e-3);
    let detail = run.detail("globe_turn_deg").unwrap();
    assert!((0.0..20.0).contains(&detail));
}

#[test]
fn frames_tell_how_far_nodes_leave_the_plane_that_is_shown() {
    // From below, and beside the middle on the nose's side or the temple's.
    let aside = |towards: f64| -> Vec<f64> {
        let case = case(None, aim(30.0, 180.0, 4.0, towards), Until::Time(0.2e-3));
        let integrator = Integrator::VelocityVerlet;
        let step = STEP_SHARE * case.step_limit(integrator);
        let plan = Plan { integrator, step, window: 0.2e-3, multiple: 1.0, local_tolerance: 1e-5 };
        let keep = Keep { traces: false, frames: Some(Spacing::even(1e-4)) };
        let run = case.run(&plan, keep, &mut unwatched).unwrap();
        assert_eq!(run.frames[0].aside.len(), run.frames[0].positions.len());
        assert!(run.frames[0].aside.iter().all(|aside| aside.abs() < 1e-12));
        run.frames[2].aside.clone()
    };
    let (nose, temple) = (aside(90.0), aside(270.0));
    // It pushes nodes to the other side: those seen from the nose away from who looks.
    let farthest = nose.iter().copied().fold(0.0, f64::min);
    assert!(farthest < -1e-4, "{farthest}");
    for (a, b) in nose.iter().zip(&temple) {
        assert!((a + b).abs() < 0.02 * farthest.abs(), "{a} {b}");
    }
}

/// A paintball from 10 o'clock, which bone flattens as it goes by the globe.
fn splash(speed: f64, window: Until) -> SpatialCase {
    let (radius, rim) = (8.65e-3, OrbitRim::from(&Rim::CAUCASIAN));
    let surface = ObjectSurface::splashing(0.5 * 1.1e3 * speed * speed, radius).losing(0.0);
    let outline = ObjectOutline::Sphere(radius);
    let object = Object { outline, mass: 3e-3, speed, surface, spring: None };
    SpatialCase::new(&Scene {
        object,
        extent: Extent::Full,
        ..scene(Some(rim), aim(25.0, 300.0, 5.0, 330.0), window)
    })
}

fn answered(case: &SpatialCase, keep: Keep) -> Run {
    let integrator = Integrator::VelocityVerlet;
    let step = STEP_SHARE * case.step_limit(integrator);
    let window = case.window.most();
    let plan = Plan { integrator, step, window, multiple: 1.0, local_tolerance: 1e-5 };
    case.run(&plan, keep, &mut unwatched).unwrap()
}

#[test]
fn what_bursts_and_goes_by_ends_and_keeps_its_energy() {
    let run = answered(&splash(60.0, Until::Settled(19e-3)), Keep::default());
    assert!(run.simulated < 5e-3, "{}", run.simulated);
    assert!(run.cost.steps < 12_000, "{}", run.cost.steps);
    assert!(run.energy_residual < 0.05, "{}", run.energy_residual);
}

/// What injuries are told from.
const FELT: [Quantity; 6] = [
    Quantity::EquatorStretch,
    Quantity::BackStretch,
    Quantity::EdgeGrowth,
    Quantity::LensPull,
    Quantity::IrisPull,
    Quantity::CornealEnergy,
];

#[test]
fn what_ends_early_reads_what_three_times_as_long_does() {
    let rim = OrbitRim::from(&Rim::CAUCASIAN);
    let soft = |mass, radius, speed| Object {
        outline: ObjectOutline::Sphere(radius),
        surface: ObjectSurface::elastic(2e6, radius).losing(0.5),
        ..Object { mass, speed, ..BB }
    };
    for (object, aim) in [
        (BB, aim(30.0, 240.0, 6.0, 240.0)),
        (soft(9e-3, 15e-3, 25.0), aim(20.0, 225.0, 4.0, 180.0)),
        (soft(24e-3, 20e-3, 20.0), aim(15.0, 120.0, 3.0, 90.0)),
    ] {
        let of = |window| {
            let scene = Scene { object, extent: Extent::Full, ..scene(Some(rim), aim, window) };
            SpatialCase::new(&scene)
        };
        let own = answered(&of(Until::Settled(19e-3)), Keep::default());
        // What keeps traces goes on to the end of its window.
        let keep = Keep { traces: true, frames: None };
        let long = answered(&of(Until::Time(3.0 * own.simulated)), keep);
        assert!(own.simulated < 15e-3 && long.simulated > 2.9 * own.simulated);
        for of in FELT {
            let (a, b) = (own.readings.value(of).unwrap(), long.readings.value(of).unwrap());
            assert!((a - b).abs() <= 0.02 * b, "{}: {a} {b}", of.label());
        }
    }
}

#[test]
fn what_lies_at_the_eye_ends_when_nothing_grows() {
    // Slow and heavy, and gives nothing back: bone holds it where it presses the eye.
    let surface = ObjectSurface::elastic(1e6, 40e-3).losing(0.1);
    let outline = ObjectOutline::Sphere(40e-3);
    let object = Object { outline, mass: 1.0, speed: 4.0, surface, spring: None };
    let rim = OrbitRim::from(&Rim::CAUCASIAN);
    let window = Until::Settled(19e-3);
    let aim = aim(12.0, 270.0, 2.0, 270.0);
    let case =
        SpatialCase::new(&Scene { object, extent: Extent::Full, ..scene(Some(rim), aim, window) });
    let run = answered(&case, Keep::default());
    let kinds: Vec<FlagKind> = run.flags.iter().map(|flag| flag.kind).collect();
    assert!(kinds.contains(&FlagKind::Stays), "{kinds:?} {}", run.simulated);
    assert!(!kinds.contains(&FlagKind::ContactCut) && run.simulated < 19e-3);
}

#[test]
fn straight_on_the_hour_means_nothing() {
    let scene = |changes: &[(&str, &str)]| {
        let bb = preset("bb-62", &[("numerics.geometry", "Full")]);
        let bb = changes.iter().fold(bb, |mut bb, (path, text)| {
            set(&mut bb, path, text).unwrap();
            bb
        });
        let bb = bb.check().unwrap();
        Scene::new(&bb, bb.physiological().unwrap(), bb.projectile().unwrap())
    };
    let (angle, offset) = (("angle_clock", "3"), ("offset_clock", "7:30"));
    assert_eq!(scene(&[angle, offset]), scene(&[]));
    assert_ne!(scene(&[("angle_deg", "5"), angle]), scene(&[("angle_deg", "5")]));
    assert_ne!(scene(&[("offset_mm", "2"), offset]), scene(&[("offset_mm", "2")]));
}
