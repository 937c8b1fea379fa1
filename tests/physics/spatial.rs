//! Blows from the side, computed in three dimensions, as a person asks for them.

use contrecoup::answer::brief::{BriefAnswer, single};
use contrecoup::answer::mesh_error::add_mesh_error;
use contrecoup::answer::solve::{Answer, solve};
use contrecoup::injury::Injury;
use contrecoup::run::flags::FlagKind;
use contrecoup::run::kept::Keep;
use contrecoup::run::quantity::Quantity;
use contrecoup::run::sectors::Sectors;
use contrecoup::run::watch::unwatched;
use contrecoup::scenario::Scenario;
use contrecoup::scenario::library::find;
use contrecoup::scenario::set::set;

fn scene(name: &str, changes: &[(&str, &str)]) -> Scenario {
    let mut scenario = find(name).unwrap().scenario().unwrap();
    for (path, value) in changes {
        set(&mut scenario, path, value).unwrap();
    }
    scenario
}

fn run(name: &str, changes: &[(&str, &str)]) -> BriefAnswer {
    let scenario = scene(name, changes).check().unwrap();
    single(&scenario, None, &mut unwatched).unwrap()
}

fn answer(name: &str, changes: &[(&str, &str)]) -> Answer {
    let scenario = scene(name, changes).check().unwrap();
    solve(&scenario, Keep::default(), &mut unwatched).unwrap()
}

const FROM_BELOW_AND_TEMPLE: [(&str, &str); 2] =
    [("impact.angle_deg", "30"), ("impact.angle_clock", "7.5")];

#[test]
fn a_blow_from_below_and_the_temple_strains_the_retinas_edge_above_at_the_nose() {
    // Of 50 indirect ruptures most lay there (Arch Ophthalmol 1978;96:252).
    let answer = answer("bb-62", &FROM_BELOW_AND_TEMPLE);
    let edge = answer.run.sectors.unwrap().edge;
    assert!([1, 2].contains(&Sectors::strongest(&edge)), "{edge:?}");
    // What moved, and that it turned.
    assert!(answer.run.detail("globe_turn_deg").unwrap() > 0.1);
    assert!(answer.risk(Injury::GlobeRupture).unwrap().usable);
}

#[test]
fn what_a_ball_spends_at_the_rim_counts_its_own_squeezing_and_a_fracture_is_named() {
    let from_below = [("impact.from", "below"), ("window_ms", "1.2")];
    let answer = answer("baseball-34", &from_below);
    // Of 86 J; bone had stopped it, and its spring holds most of what it brought.
    let spent = answer.run.detail("energy_at_bone_j").unwrap();
    assert!((40.0..86.0).contains(&spent), "{spent}");
    assert!(answer.has(FlagKind::BoneMayBreak), "{:?}", answer.flags);
}

#[test]
fn a_left_eye_is_the_mirror_image_of_a_right_one() {
    let right = run("bb-62", &FROM_BELOW_AND_TEMPLE);
    let left = run(
        "bb-62",
        &[("model.eye_side", "Left"), FROM_BELOW_AND_TEMPLE[0], ("impact.angle_clock", "4.5")],
    );
    for of in [Quantity::Pressure, Quantity::EquatorStretch, Quantity::EdgeGrowth] {
        let (a, b) = (right.values[of].unwrap(), left.values[of].unwrap());
        assert!((a / b - 1.0).abs() < 1e-6, "{of:?} {a} {b}");
    }
}

#[test]
fn what_falls_on_the_sclera_alone_does_not_count_at_the_cornea() {
    let at = |angle: &str| {
        let from_temple = ("impact.angle_clock", "9");
        let answer = run("bb-62", &[from_temple, ("impact.angle_deg", angle)]);
        answer.values[Quantity::CornealEnergy].unwrap()
    };
    assert_eq!(at("75"), 0.0);
    assert!(at("40") > 10.0);
}

#[test]
fn straight_on_in_gelatin_both_eyes_agree() {
    let gelatin = ("model.support", "Gelatin");
    let of = |geometry| run("bb-56", &[gelatin, ("numerics.geometry", geometry)]);
    let (round, half) = (of("Axisymmetric"), of("Half"));
    for (of, within) in [
        (Quantity::Pressure, 0.06),
        (Quantity::EquatorStretch, 0.10),
        (Quantity::EdgeGrowth, 0.12),
        (Quantity::CornealEnergy, 0.15),
        (Quantity::BackStretch, 0.25),
        (Quantity::LensPull, 0.40),
        (Quantity::IrisPull, 0.45),
    ] {
        let (a, b) = (round.values[of].unwrap(), half.values[of].unwrap());
        assert!((b / a - 1.0).abs() < within, "{of:?}: {a} round, {b} half");
    }
    let beside = run("bb-56", &[gelatin, ("impact.angle_deg", "0.1")]);
    let apart = apart(&half, &beside);
    assert!(apart.iter().all(|share| *share < 0.02), "{apart:?}");
}

#[test]
fn neighbouring_angles_give_neighbouring_answers() {
    let gelatin = ("model.support", "Gelatin");
    let at = |angle: &str| {
        let answer = run("bb-62", &[gelatin, ("impact.angle_deg", angle)]);
        [Quantity::Pressure, Quantity::EdgeGrowth].map(|of| answer.values[of].unwrap())
    };
    let steps = ["6", "8", "10", "12", "14"].map(at);
    for pair in steps.windows(2) {
        for (a, b) in pair[0].iter().zip(&pair[1]) {
            assert!((b / a - 1.0).abs() < 0.05, "{steps:?}");
        }
    }
}

/// What injuries are read from, and the pressure.
const MEASURES: [Quantity; 7] = [
    Quantity::Pressure,
    Quantity::EquatorStretch,
    Quantity::BackStretch,
    Quantity::EdgeGrowth,
    Quantity::LensPull,
    Quantity::IrisPull,
    Quantity::CornealEnergy,
];

/// By what shares measures of two blows differ that should be nearly the same.
fn apart(a: &BriefAnswer, b: &BriefAnswer) -> [f64; 7] {
    MEASURES.map(|of| {
        let (a, b) = (a.values[of].unwrap(), b.values[of].unwrap());
        if a == b { 0.0 } else { (b / a - 1.0).abs() }
    })
}

#[test]
fn a_little_more_angle_or_offset_changes_no_measure_at_once() {
    // Where the pull on the lens depends on the angle most.
    let at = |angle: &str, offset: &str| {
        let from_temple = ("impact.angle_clock", "9");
        let aside = ("impact.offset_mm", offset);
        run("bb-62", &[from_temple, ("impact.angle_deg", angle), aside])
    };
    let here = at("47.2", "0");
    for there in [at("47.25", "0"), at("47.2", "0.01")] {
        let apart = apart(&here, &there);
        assert!(apart.iter().all(|share| *share < 0.02), "{apart:?}");
    }
}

#[test]
fn half_of_the_eye_is_the_whole_where_their_meshes_lie_alike_and_else_within_its_mesh_error() {
    let from = |clock, geometry| {
        [
            ("model.support", "Gelatin"),
            ("impact.angle_deg", "20"),
            ("impact.angle_clock", clock),
            ("numerics.geometry", geometry),
        ]
    };
    let of = |clock, geometry| run("bb-62", &from(clock, geometry));
    let alike = apart(&of("12", "Half"), &of("12", "Full"));
    assert!(alike.iter().all(|share| *share < 1e-6), "{alike:?}");
    // From here half of an eye has its mirror plane across the mesh of a whole one.
    let mut half = answer("bb-62", &from("7.5", "Half"));
    let scenario = scene("bb-62", &from("7.5", "Half"));
    add_mesh_error(&scenario, &mut half, &mut unwatched).unwrap();
    let whole = of("7.5", "Full");
    for of in MEASURES {
        let (a, b) = (half.result(of).unwrap(), whole.values[of].unwrap());
        let errors = &half.errors;
        let mesh = errors.mesh.and_then(|mesh| mesh[of]).unwrap_or(f64::INFINITY);
        let claimed = 0.01 * (errors.time_step[of].unwrap() + mesh);
        assert!((b / a - 1.0).abs() < claimed, "{of:?}: {a} {b} {claimed}");
    }
}

#[test]
fn what_does_not_fit_the_holder_of_the_gelatin_is_refused_by_the_eye_without_one() {
    let changes = [("model.support", "Gelatin"), ("impact.angle_deg", "20")];
    for (name, refused) in [("squash-ball", true), ("champagne-cork", true), ("paintball", false)] {
        let problem = scene(name, &changes).check().err().map(|error| error.to_string());
        let named = problem.is_some_and(|p| p.contains("impact.diameter_mm") && p.contains("25.7"));
        assert_eq!(named, refused, "{name}");
    }
}
