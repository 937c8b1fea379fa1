//! Made-up answers: nothing is simulated, so no picture of one changes when the physics does.
//!
//! The mesh is that of the scenario, at rest; every course is a few humps in the share of the
//! window that has gone, and what a blow does grows with its size: a force of 300 N has size 1.
//! Humps are polynomials, which give the same digits on every machine.

use std::sync::OnceLock;
use std::time::Duration;

use contrecoup::answer::brief::{BriefAnswer, Check};
use contrecoup::answer::compiled::Compiled;
use contrecoup::answer::solve::{Answer, Errors};
use contrecoup::answer::uncertain::inputs;
use contrecoup::many::ensemble::{Ensemble, Sample, Timing};
use contrecoup::many::map::{Grid, PointResults, SIDE, Spot};
use contrecoup::models::axisymmetric::case::AxisymmetricCase;
use contrecoup::models::paper::case::PaperCase;
use contrecoup::run::flags::{Flag, FlagKind};
use contrecoup::run::fold::Fold;
use contrecoup::run::kept::{Frame, Peak, Traces};
use contrecoup::run::model::{Detail, Run, Shown};
use contrecoup::run::places::{GLOBE_RADIUS_M, Region};
use contrecoup::run::plan::{Cost, LOCAL_TOLERANCE, Plan};
use contrecoup::run::quantity::{Family, Quantity};
use contrecoup::run::readings::{Reading, Readings};
use contrecoup::run::rules::Element;
use contrecoup::scenario::{Geometry, Impact, Model, Projectile, Scenario};
use nalgebra::{Point2, Vector2};

/// Rows of the traces, and the frames among them.
const ROWS: usize = 240;
const EVERY_FRAME: usize = 6;
/// The size from which the mesh folds.
const FOLDING: f64 = 2.0;
/// What a blow of size 1 does: N at the monitored nodes, m, shares, J, Pa.
const FORCES_N: [f64; 4] = [12.0, 70.0, 10.0, 11.0];
const APEX_M: f64 = 2.2e-3;
const SHELL: f64 = 0.0025;
const MERIDIAN: f64 = 0.03;
const ENERGY_J: f64 = 0.5;
const PRESSURE_PA: f64 = 0.4e6;
const STRESS_PA: f64 = 8e6;
/// What its tissues feel: shares, then m; and J/m2 at the cornea.
const TISSUE: [f64; 5] = [0.03, 0.02, 0.08, 1.2e-3, 1.8e-3];
const CORNEA_J_M2: f64 = 2e3;

/// From 0 up to 1 in the `middle` and down to 0, both `reach` away from it.
fn hump(at: f64, middle: f64, reach: f64) -> f64 {
    let away = (at - middle) / reach;
    let left = (1.0 - away * away).max(0.0);
    left * left
}

/// From 0 at 0 to 1 at `end`, and then 1.
fn rise(at: f64, end: f64) -> f64 {
    let share = (at / end).min(1.0);
    share * share * (3.0 - 2.0 * share)
}

/// The object that hits, if one does.
fn object(scenario: &Scenario) -> Option<&Projectile> {
    match &scenario.impact {
        Impact::ForcePulse(_) => None,
        Impact::Projectile(object) => Some(object),
    }
}

/// How large a blow is.
fn size(scenario: &Scenario) -> f64 {
    match &scenario.impact {
        Impact::ForcePulse(pulse) => pulse.force_n / 300.0,
        Impact::Projectile(object) => (object.energy_j() / 0.2).sqrt(),
    }
}

/// How much further than by size 1 it moves the eye: never as far as through it.
fn give(size: f64) -> f64 {
    1.25 * size / (1.0 + 0.25 * size)
}

/// How far the eye is pushed in, from 0 to 1.
fn pushed(share: f64) -> f64 {
    hump(share, 0.1, 0.1) + 0.25 * hump(share, 0.35, 0.2)
}

/// The force at a monitored node, from 0 to 1: each has a time of its own.
fn shaken(node: usize, share: f64) -> f64 {
    let later = 0.02 * node as f64;
    hump(share, 0.04 + later, 0.03)
        + 0.6 * hump(share, 0.13 + later, 0.05)
        + 0.2 * hump(share, 0.4, 0.25)
}

fn touch(share: f64) -> f64 {
    hump(share, 0.06, 0.06)
}

/// The centre of an object of this radius: it comes, pushes the cornea `deep` and goes.
fn centre(radius: f64, deep: f64, share: f64) -> Point2<f64> {
    let away = 3e-3 * (1.0 - rise(share, 0.1)) + 6e-3 * rise((share - 0.15).max(0.0), 0.8);
    Point2::new(deep - away - GLOBE_RADIUS_M - radius, 0.0)
}

fn traces(case: &Compiled, scenario: &Scenario, size: f64) -> Traces {
    let shares: Vec<f64> = (0..=ROWS).map(|row| row as f64 / ROWS as f64).collect();
    let over = |of: &dyn Fn(f64) -> f64| -> Vec<f64> { shares.iter().map(|s| of(*s)).collect() };
    let (give, energy) = (give(size), ENERGY_J * size * size);
    let force = match &scenario.impact {
        Impact::ForcePulse(pulse) => pulse.force_n,
        Impact::Projectile(_) => 0.0,
    };
    let blow = object(scenario);
    let (radius, speed) = blow.map_or((0.0, 0.0), |b| (0.5 * b.diameter_m(), b.speed_m_s));
    let whole = case.rules().element == Element::Cell;
    let some = |there: bool, of: &dyn Fn(f64) -> f64| if there { over(of) } else { Vec::new() };
    Traces {
        time: over(&|s| s * lasts(case)),
        load: over(&|s| force * touch(s)),
        force: std::array::from_fn(|n| over(&|s| size * FORCES_N[n] * shaken(n, s))),
        apex: over(&|s| give * APEX_M * pushed(s)),
        shell_growth: over(&|s| give * SHELL * pushed(s - 0.02)),
        meridian_growth: over(&|s| give * MERIDIAN * (pushed(s - 0.04) - 0.1 * hump(s, 0.6, 0.2))),
        kinetic: over(&|s| 0.6 * energy * hump(s, 0.06, 0.06)),
        elastic: over(&|s| 0.4 * energy * pushed(s - 0.06)),
        dissipated: over(&|s| 0.9 * energy * rise(s, 0.8)),
        work: over(&|s| energy * rise(s, 0.1)),
        pressure: some(whole, &|s| size * PRESSURE_PA * pushed(s)),
        back_pressure: some(whole, &|s| 1.2 * size * PRESSURE_PA * pushed(s)),
        scleral_stress: some(whole, &|s| size * STRESS_PA * pushed(s - 0.01)),
        shortening: some(whole, &|s| 0.1 * give * pushed(s - 0.02)),
        lens: some(whole, &|s| 0.4 * give * APEX_M * pushed(s - 0.03)),
        intrusion: some(whole && blow.is_some(), &|s| 0.9 * give * APEX_M * pushed(s)),
        contact_force: some(blow.is_some(), &|s| 700.0 * size * touch(s)),
        projectile: some(blow.is_some(), &|s| centre(radius, give * APEX_M, s).x),
        tissue: TISSUE.map(|most| some(whole, &|s| give * most * pushed(s - 0.02))),
        projectile_velocity: some(blow.is_some(), &|s| speed * (1.0 - 2.0 * s)),
    }
}

/// The axisymmetric eye of a scenario, if its model is that.
fn axisymmetric(scenario: &Scenario) -> Option<AxisymmetricCase> {
    match &scenario.model {
        Model::Physiological(model) => {
            Some(AxisymmetricCase::new(&scenario.check().unwrap(), model))
        }
        Model::Paper => None,
    }
}

/// Where each node rests, and whether it never moves.
fn nodes(scenario: &Scenario) -> Vec<(Point2<f64>, bool)> {
    if let Some(case) = axisymmetric(scenario) {
        let place = |n: usize| Point2::new(case.eye.at(n).0, case.eye.at(n).1);
        let fixed = case.eye.fixed.iter().enumerate();
        fixed.map(|(n, fixed)| (place(n), *fixed)).collect()
    } else {
        let case = PaperCase::new(&scenario.check().unwrap());
        let nodes = case.eye.nodes.iter();
        nodes.map(|n| (n.position, n.fixed())).collect()
    }
}

/// Nodes are pushed back the more, the nearer they are to the cornea; a ring of force runs from
/// it.
fn frame(scenario: &Scenario, traces: &Traces, row: usize, diameter: Option<f64>) -> Frame {
    let share = row as f64 / ROWS as f64;
    let apex = traces.apex[row];
    let deep = peak(&traces.time, &traces.apex).value;
    let push = |at: Point2<f64>| {
        let from = (at - Point2::new(-GLOBE_RADIUS_M, 0.0)).norm();
        apex * (1.0 - from / (2.5 * GLOBE_RADIUS_M)).max(0.0)
    };
    let heat = |at: Point2<f64>| {
        let from = (at - Point2::new(-GLOBE_RADIUS_M, 0.0)).norm() / (2.0 * GLOBE_RADIUS_M);
        traces.force[1][row] * hump(from, 2.0 * share, 0.5)
    };
    let nodes = nodes(scenario);
    Frame {
        front: None,
        aside: Vec::new(),
        time: traces.time[row],
        positions: (nodes.iter())
            .map(|&(at, fixed)| at + Vector2::new(if fixed { 0.0 } else { push(at) }, 0.0))
            .collect(),
        forces: (nodes.iter()).map(|&(at, fixed)| if fixed { 0.0 } else { heat(at) }).collect(),
        projectile: diameter.map(|diameter| centre(0.5 * diameter, deep, share)),
        squeezed: 0.0,
        cells: match axisymmetric(scenario) {
            Some(case) => (case.eye.cells.iter())
                .map(|cell| {
                    let (x, r) = case.eye.at(cell.corners[0]);
                    let from = (Point2::new(x, r) - Point2::new(-GLOBE_RADIUS_M, 0.0)).norm();
                    traces.pressure[row] * hump(from / GLOBE_RADIUS_M, 3.0 * share, 3.0)
                })
                .collect(),
            None => Vec::new(),
        },
        pressure: traces.pressure.get(row).copied(),
    }
}

/// The largest value of a course.
fn peak(times: &[f64], values: &[f64]) -> Peak {
    let mut peak = Peak::floor(0.0);
    for (time, value) in times.iter().zip(values) {
        peak.offer(*value, *time);
    }
    peak
}

/// What a model reads off its eye: the peak of each trace that there is, and the numbers.
fn readings(scenario: &Scenario, traces: &Traces, size: f64) -> Readings {
    let speed = object(scenario).map(|object| 0.5 * object.speed_m_s);
    let of_section = traces.pressure.is_empty();
    Readings::from_fn(|of| {
        let trace = of.row().trace?;
        let values = (trace.values)(traces);
        match of {
            Quantity::Energy => Some((ENERGY_J * size * size).into()),
            Quantity::StoredEnergy if !of_section => None,
            _ => (!values.is_empty()).then(|| peak(&traces.time, values).into()),
        }
    })
    .map(|of, reading| match of {
        Quantity::Rebound => speed.map(Reading::from),
        Quantity::CornealEnergy if !of_section => Some((CORNEA_J_M2 * size * size).into()),
        _ => *reading,
    })
}

/// Figures beside them.
fn details(case: &Compiled, size: f64) -> Vec<Detail> {
    match case.rules().element {
        Element::Spring => {
            let at = 0.1 * lasts(case) * 1e3;
            vec![Detail {
                key: "largest_spring_strain_percent",
                value: 20.0 * size,
                shown: Shown::OnLine("Spring strain", format!("%  at {at:.4} ms, the largest")),
            }]
        }
        Element::Cell => vec![Detail {
            key: "scleral_stress_angle_deg",
            value: 34.0,
            shown: Shown::Behind(Quantity::ScleralStress, "34 deg from the front".to_owned()),
        }],
    }
}

/// A mesh that folds early, by the front, and stays so.
fn fold(case: &Compiled, size: f64) -> Option<Fold> {
    (size >= FOLDING).then(|| Fold {
        since: 0.05 * lasts(case),
        lasted: 0.95 * lasts(case),
        stays: true,
        quads: 14,
        of: 193,
        at: Point2::new(-0.0107, 0.0),
        part: Region::Interior,
        both_sides: false,
    })
}

fn flags(fold: Option<Fold>) -> Vec<Flag> {
    let folded = fold.map(|fold| fold.since).map(|time| Flag {
        kind: FlagKind::MeshFolded,
        message: "made up: the mesh folded, beyond the model's validity".to_owned(),
        detail: None,
        time: Some(time),
    });
    folded.into_iter().collect()
}

/// Simulated time, in s.
fn lasts(case: &Compiled) -> f64 {
    if case.ends_by_itself() { 3e-3 } else { case.window() }
}

/// The answer to a scenario, with traces and frames; of a round eye where it asks for one in three
/// dimensions.
pub fn answer(scenario: &Scenario) -> Answer {
    let mut round = scenario.clone();
    if scenario.is_spatial() {
        round.numerics.geometry = Geometry::Axisymmetric;
    }
    let scenario = &round;
    let case = Compiled::new(&scenario.check().unwrap());
    let size = size(scenario);
    let traces = traces(&case, scenario, size);
    let fold = fold(&case, size);
    let diameter = object(scenario).map(Projectile::diameter_m);
    let frames = (0..=ROWS).step_by(EVERY_FRAME);
    let frames = frames.map(|row| frame(scenario, &traces, row, diameter)).collect();
    let stated = |of: Quantity| of.row().family != Family::Unstated;
    let error = |of: Quantity, value: &Option<f64>| {
        let error = if of.row().unit == "N" { 0.08 } else { 0.004 };
        value.is_some().then_some(error).filter(|_| stated(of))
    };
    let step = scenario.numerics.step_us.map_or(2e-6, |us| us * 1e-6);
    let run = Run {
        sectors: None,
        readings: readings(scenario, &traces, size),
        details: details(&case, size),
        flags: Vec::new(),
        fold,
        missed: false,
        energy_residual: 1e-5,
        simulated: lasts(&case),
        traces: Some(traces),
        frames,
        cost: Cost { steps: 1500, evaluations: 9000 },
    };
    Answer {
        plan: Plan {
            integrator: (scenario.numerics.integrator).unwrap_or(case.rules().answer.integrator),
            step,
            window: lasts(&case),
            multiple: 1.0,
            local_tolerance: LOCAL_TOLERANCE,
        },
        step,
        step_limit: 8e-6,
        errors: Errors {
            time_step: case.results(&run).map(error),
            mesh: None,
            limits: None,
            energy_balance: 1e-3,
        },
        others: Vec::new(),
        assessed: OnceLock::new(),
        flags: flags(fold),
        element_evaluations: 8_000_000,
        solve_time: Duration::from_millis(10),
        total_time: Duration::from_millis(25),
        run,
        case,
    }
}

/// Samples over what is not known of a scenario: the first input drives the most, the second less.
/// Where the mesh of the scenario folds, that of five in six samples does.
pub fn ensemble(scenario: &Scenario, count: u32) -> Ensemble {
    let answer = answer(scenario);
    let nominal = answer.results();
    let inputs = inputs(scenario);
    let folds = answer.run.fold.is_some();
    let sample = |index: u32| {
        // Steps of numbers without common factors: every input in another order.
        let shares = (0..inputs.len() as u32).map(|input| {
            (f64::from((index * (5 + 2 * input) + input) % count) + 0.5) / f64::from(count)
        });
        let shares: Vec<f64> = shares.collect();
        let weights = [0.6, 0.2, 0.1];
        let moved = shares.iter().zip(weights).map(|(share, weight)| weight * (share - 0.5));
        let factor = 1.0 + moved.sum::<f64>();
        let folded = folds && index % 6 != 5;
        let drawn =
            inputs.iter().zip(&shares).map(|(input, u)| input.value(*u)).collect::<Vec<_>>();
        let sample = Sample {
            outcome: Ok(BriefAnswer {
                ranges: None,
                values: nominal.map(|of, value| {
                    let most = if of.is_risk() { 100.0 } else { f64::INFINITY };
                    value.map(|value| (value * factor).min(most))
                }),
                flags: folded.then_some(FlagKind::MeshFolded).into_iter().collect(),
                check: (index < 8).then_some(Check {
                    first: 0.02,
                    last: 0.02,
                    leading: 0.02,
                    missed: false,
                    tried: 2e-6,
                    good_step: 3e-6,
                }),
            }),
        };
        (sample, drawn)
    };
    let (samples, drawn): (Vec<_>, Vec<_>) = (0..count).map(sample).unzip();
    Ensemble {
        nominal: Some(nominal),
        samples,
        drawn: drawn.concat(),
        inputs: inputs.clone(),
        asked: count,
        seed: 1,
        cap: Some(2e-6),
        promise: 0.1,
        timing: Timing { wall: 0.5, cores: 1.0, single: Some(0.02), threads: 2 },
    }
}

/// A map that rises to the upper right, where the mesh folds; one corner is not allowed. So many
/// points of it are known.
pub fn grid(known: usize) -> Grid {
    let mut grid = Grid::new(SIDE);
    let last = (SIDE - 1) as f64;
    for (x, y) in grid.order().into_iter().take(known) {
        let (across, up) = (x as f64 / last, y as f64 / last);
        let damage = 160.0 * across * (0.2 + 0.8 * up);
        let point = PointResults { values: damage_only(damage), ranges: None };
        let spot = match () {
            () if across < 0.2 && up > 0.8 => Spot::Refused,
            () if damage > 90.0 => Spot::Folded(point),
            () => Spot::Known(point),
        };
        grid.put((x, y), spot);
    }
    grid
}

fn damage_only(damage: f64) -> contrecoup::answer::results::Results {
    let own = |q| (q == contrecoup::run::quantity::Quantity::Damage).then_some(damage);
    contrecoup::run::readings::PerQuantity::from_fn(own)
}
