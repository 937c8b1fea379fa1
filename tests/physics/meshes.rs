//! Finer meshes against an independent solver, stored: fourth-order Runge-Kutta with a step of 0.8
//! us over the level, head-on smooth pulses unless said.
//!
//! It took the share of a spring that lies in the lens from samples, so its lens differs a little.

use contrecoup::injury::DamageIndex;
use contrecoup::models::paper::case::PaperCase;
use contrecoup::run::kept::Keep;
use contrecoup::run::model::EyeModel;
use contrecoup::run::quantity::Quantity;
use contrecoup::run::watch::unwatched;
use contrecoup::scenario::load::parse;
use contrecoup::scenario::{ForcePulse, Impact, Lens, PulseShape, Scenario};

fn pulse(force_n: f64, duration_ms: f64) -> ForcePulse {
    ForcePulse { force_n, duration_ms, ..ForcePulse::default() }
}

fn off_axis() -> ForcePulse {
    ForcePulse {
        angle_deg: 20.0,
        half_width_deg: 10.0,
        shape: PulseShape::Triangle,
        ..pulse(200.0, 0.1)
    }
}

struct Found {
    damage: f64,
    apex_mm: f64,
    meridian: f64,
    shell: f64,
    energy: f64,
    /// Centre, front, right, top.
    forces: [f64; 4],
}

fn found(blow: &ForcePulse, level: u32, lens: Lens) -> Found {
    let mut scenario = Scenario { impact: Impact::ForcePulse(blow.clone()), ..Scenario::default() };
    scenario.eye.level = level;
    scenario.eye.lens = lens;
    let case = PaperCase::new(&scenario.check().unwrap());
    let plan = case.plan_alone(&scenario).unwrap();
    let run = case.run(&plan, Keep::default(), &mut unwatched).unwrap();
    let value = |of| run.readings.value(of).unwrap();
    let index = DamageIndex::of(&run.readings);
    Found {
        damage: index.damage(),
        apex_mm: value(Quantity::Apex) * 1e3,
        meridian: index.meridian_growth,
        shell: index.shell_growth,
        energy: index.energy,
        forces: Quantity::FORCES.map(value),
    }
}

fn within(percent: f64, found: f64, wanted: f64, what: &str) {
    let off = 100.0 * (found / wanted - 1.0);
    assert!(off.abs() <= percent, "{what}: {found} for {wanted}, {off:.2} %");
}

#[test]
fn damage_at_levels_1_to_5_is_the_independent_solvers() {
    let off_axis_below = ForcePulse {
        angle_deg: -15.0,
        half_width_deg: 15.0,
        shape: PulseShape::HalfSine,
        ..pulse(400.0, 0.2)
    };
    for (blow, damage) in [
        (pulse(300.0, 0.2), [26.42, 18.52, 18.40, 18.96, 18.88]),
        (pulse(100.0, 0.2), [6.363, 5.240, 5.137, 5.217, 5.209]),
        (off_axis(), [4.539, 3.669, 3.660, 3.563, 3.549]),
        (pulse(600.0, 0.3), [92.5, 94.5, 126.8, 127.8, 127.3]),
        (off_axis_below, [30.7, 32.6, 31.6, 34.1, 33.4]),
    ] {
        for (level, damage) in (1..).zip(damage) {
            let what = format!("{blow:?}, level {level}");
            within(0.5, found(&blow, level, Lens::Auto).damage, damage, &what);
        }
    }
}

#[test]
fn the_parts_of_the_index_are_too() {
    let apex = [2.157, 1.261, 1.233, 1.324, 1.306];
    let meridian = [2.883, 2.415, 2.401, 2.464, 2.457];
    let shell = [0.209, 0.0061, 0.0000, 0.0012, 0.0000];
    let energy = [0.5212, 0.3525, 0.3592, 0.3749, 0.3731];
    for level in 1..=5 {
        let found = found(&pulse(300.0, 0.2), level, Lens::Auto);
        let i = level as usize - 1;
        within(0.5, found.apex_mm, apex[i], "apex");
        within(0.5, found.meridian, meridian[i], "M");
        within(0.5, found.energy, energy[i], "E");
        assert!((found.shell - shell[i]).abs() < 2e-4, "S: {}", found.shell);
    }
}

#[test]
fn the_forces_at_the_papers_nodes_are_too() {
    // With the lens by nodes at every level.
    let centre = [12.40, 12.01, 12.84, 12.31, 12.22];
    let front = [72.9, 67.6, 58.2, 57.2, 56.5];
    let right = [9.92, 7.11, 5.08, 5.42, 3.98];
    let top = [11.71, 9.88, 8.33, 7.35, 6.55];
    for level in 1..=5 {
        let i = level as usize - 1;
        let found = found(&pulse(300.0, 0.2), level, Lens::Nodes).forces;
        for (found, wanted) in found.into_iter().zip([centre, front, right, top]) {
            within(2.0, found, wanted[i], &format!("level {level}"));
        }
    }
}

#[test]
fn at_level_1_the_lens_is_the_papers_unless_it_is_asked_for_by_area() {
    let blow = off_axis();
    let [auto, nodes, area] = [Lens::Auto, Lens::Nodes, Lens::Area].map(|l| found(&blow, 1, l));
    assert_eq!(auto.damage, nodes.damage);
    within(0.5, area.damage, 4.301, "by area");
    within(1.0, found(&pulse(300.0, 0.2), 1, Lens::Area).damage, 18.72, "by area");
    assert_eq!(found(&blow, 2, Lens::Auto).damage, found(&blow, 2, Lens::Area).damage);
}

#[test]
fn a_file_may_say_yes_or_no_to_the_lens() {
    for (text, lens) in [("true", Lens::Auto), ("false", Lens::Soft), ("Area", Lens::Area)] {
        let text = format!("(name: \"a\", impact: ForcePulse(), eye: (lens: {text}))");
        assert_eq!(parse(&text, "a").unwrap().eye.lens, lens);
    }
}
