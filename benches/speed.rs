//! The row kernel against the plain edge list, in one run, interleaved.
//!
//! `cargo bench` prints medians of repeated runs and the ratios between them.

use contrecoup::dynamics::plain::Plain;
use contrecoup::dynamics::{
    Integrator, LOCAL_TOLERANCE, Observer, Piece, Plan, State, Survey, System, kernel_name, march,
};
use contrecoup::recording::Keep;
use contrecoup::scenario::{Impact, Scenario};
use contrecoup::study::batch::solve_all;
use contrecoup::study::{Case, solve, unwatched};
use std::hint::black_box;
use std::time::Instant;

const ROUNDS: usize = 15;
/// Share of the stability limit that both sides take.
const SHARE: f64 = 0.9;

struct Nobody;

impl Observer for Nobody {
    fn begin(&mut self, _: &System, _: &State, _: Piece, _: &Survey) {}
    fn step(&mut self, _: &System, _: &State, _: Piece, _: &Survey) {}
}

fn seconds(work: impl FnOnce()) -> f64 {
    let start = Instant::now();
    work();
    start.elapsed().as_secs_f64()
}

fn median(mut times: Vec<f64>) -> f64 {
    times.sort_by(f64::total_cmp);
    times[times.len() / 2]
}

fn case(level: u32, whole: bool, portable: bool) -> Case {
    let mut scenario = Scenario::default();
    scenario.eye.level = level;
    Case::with(&scenario, whole, portable)
}

fn plain(case: &Case) -> Plain {
    Plain::new(&case.eye, case.system.load().pulse, &case.load)
}

fn evaluations() {
    println!("Force evaluation with its share of the update, velocity-stage march, no recording");
    println!(
        "{:>5}  {:<22}{:>12}{:>14}{:>10}",
        "level", "form", "us/eval", "ns/spring", "ratio"
    );
    for level in [1, 3, 5] {
        let forms = [
            ("rows, whole eye", case(level, true, false)),
            ("rows, whole, portable", case(level, true, true)),
            ("rows, mirrored half", case(level, false, false)),
        ];
        let mut edges = plain(&forms[0].1);
        let springs = edges.springs();
        let window = 2e-4 / f64::from(level);
        let mut times = vec![Vec::new(); forms.len() + 1];
        let mut counts = vec![0; forms.len() + 1];
        for _ in 0..ROUNDS {
            for (i, (_, case)) in forms.iter().enumerate() {
                let plan = Plan {
                    integrator: Integrator::Srkn6b,
                    step: SHARE * case.step_limit(Integrator::Srkn6b),
                    window,
                    multiple: 1.0,
                    local_tolerance: LOCAL_TOLERANCE,
                };
                let mut state = State::at_rest(&case.system);
                times[i].push(seconds(|| {
                    let cost = march(&case.system, &plan, &mut state, &mut Nobody);
                    counts[i] = cost.map_or(0, |c| c.evaluations);
                }));
            }
            let step = SHARE * forms[0].1.step_limit(Integrator::VelocityVerlet);
            times[forms.len()].push(seconds(|| {
                counts[forms.len()] = edges.run(window, step, |p, _| {
                    black_box(&p.x);
                });
            }));
        }
        let each: Vec<f64> = times
            .into_iter()
            .zip(&counts)
            .map(|(t, &n)| median(t) / n as f64)
            .collect();
        let base = each[forms.len()];
        for (i, (name, case)) in forms.iter().enumerate() {
            let ns = each[i] * 1e9 / case.system.springs_per_evaluation() as f64;
            let (us, ratio) = (each[i] * 1e6, base / each[i]);
            println!("{level:>5}  {name:<22}{us:>12.3}{ns:>14.3}{ratio:>10.2}");
        }
        let (us, ns) = (base * 1e6, base * 1e9 / springs as f64);
        println!(
            "{level:>5}  {:<22}{us:>12.3}{ns:>14.3}{:>10.2}",
            "plain edge list", 1.0
        );
    }
}

fn standard_case() {
    println!("\nStandard case: 300 N, 0.2 ms, window 3 ms, level 1");
    let quick = case(1, false, false);
    let mut edges = plain(&quick);
    let auto = quick.plan(&Scenario::default()).expect("the default runs");
    let limit = quick.step_limit(Integrator::VelocityVerlet);
    let (mut ours, mut theirs) = (Vec::new(), Vec::new());
    for _ in 0..ROUNDS {
        ours.push(seconds(|| {
            black_box(quick.run(&auto, Keep::default(), &mut unwatched).is_ok());
        }));
        theirs.push(seconds(|| {
            edges.run(quick.window, limit, |p, _| {
                black_box(&p.x);
            });
        }));
    }
    let (ours, theirs) = (median(ours), median(theirs));
    println!(
        "{:<52}{:>9.3} ms",
        "automatic integrator and step, recorded",
        ours * 1e3
    );
    println!(
        "{:<52}{:>9.3} ms",
        "plain velocity Verlet at its limit, nothing recorded",
        theirs * 1e3
    );
    println!("ratio {:.2}", theirs / ours);
}

/// Largest error in % of the four peak forces and the apex displacement of a plain run, as sampled
/// at its steps, against the reference values.
fn plain_error(case: &Case, edges: &mut Plain, step: f64, truth: &[f64; 5]) -> f64 {
    let marks = &case.eye.landmarks;
    let rest: Vec<f64> = marks
        .apex
        .iter()
        .map(|&n| case.eye.nodes[n].position.x)
        .collect();
    let mut found = [0.0f64; 5];
    edges.run(case.window, step, |p, _| {
        for (i, &n) in marks.monitors.iter().enumerate() {
            let drag = case.eye.nodes[n].drag;
            let force = (p.fx[n] - drag * p.vx[n]).hypot(p.fy[n] - drag * p.vy[n]);
            found[i] = found[i].max(force);
        }
        let apex = marks
            .apex
            .iter()
            .zip(&rest)
            .map(|(&n, x)| p.x[n] - x)
            .sum::<f64>()
            / 2.0;
        found[4] = found[4].max(apex);
    });
    (0..5)
        .map(|i| 100.0 * (found[i] / truth[i] - 1.0).abs())
        .fold(0.0, f64::max)
}

/// The plain loop at the largest step that brings every result within 0.1 %.
fn same_error() {
    let quick = case(1, false, false);
    let fine = Plan {
        step: 0.05 * quick.step_limit(Integrator::Srkn11b),
        integrator: Integrator::Srkn11b,
        ..quick.plan(&Scenario::default()).expect("the default runs")
    };
    let reference = quick
        .run(&fine, Keep::default(), &mut unwatched)
        .expect("a stable step");
    let extremes = reference.recording.extremes;
    let force = extremes.force.map(|p| p.value);
    let truth = [force[0], force[1], force[2], force[3], extremes.apex.value];
    // The largest step from which on every shorter one will do: a single one may be lucky.
    let limit = quick.step_limit(Integrator::VelocityVerlet);
    let step = (0..20)
        .map(|i| limit * 0.2 * 1.08f64.powi(i))
        .take_while(|&step| plain_error(&quick, &mut plain(&quick), step, &truth) <= 0.1)
        .last()
        .expect("a fifth of the limit is within 0.1 %");
    let auto = quick.plan(&Scenario::default()).expect("the default runs");
    let mut edges = plain(&quick);
    let longest = Plan {
        step: 0.95 * quick.step_limit(Integrator::Srkn11b),
        ..fine
    };
    let (mut ours, mut sixth, mut theirs) = (Vec::new(), Vec::new(), Vec::new());
    for _ in 0..7 {
        ours.push(seconds(|| {
            black_box(quick.run(&auto, Keep::default(), &mut unwatched).is_ok());
        }));
        sixth.push(seconds(|| {
            black_box(quick.run(&longest, Keep::default(), &mut unwatched).is_ok());
        }));
        // A fresh start each time: the plain loop goes on from where it stands.
        edges = plain(&quick);
        theirs.push(seconds(|| {
            edges.run(quick.window, step, |p, _| {
                black_box(&p.x);
            });
        }));
    }
    let (ours, sixth, plain_time) = (median(ours), median(sixth), median(theirs));
    let what = format!(
        "plain velocity Verlet within 0.1 %, step {:.3} us",
        step * 1e6
    );
    println!("{what:<52}{:>9.3} ms", plain_time * 1e3);
    println!(
        "{:<52}{:>9.3} ms",
        "srkn11b at 0.95 of its limit, recorded",
        sixth * 1e3
    );
    println!("ratio to the automatic run {:.1}", plain_time / ours);
    println!("ratio to srkn11b {:.1}", plain_time / sixth);
    black_box(&edges.x);
}

fn batches() {
    const COUNT: u32 = 200;
    println!("\nBatches: {COUNT} head-on scenes, results only, no frames");
    let scenarios: Vec<Scenario> = (0..COUNT)
        .map(|i| {
            let mut scenario = Scenario::default();
            let Impact::ForcePulse(pulse) = &mut scenario.impact else {
                panic!()
            };
            pulse.force_n = 100.0 + 2.0 * f64::from(i);
            scenario
        })
        .collect();
    let cores = rayon::current_num_threads();
    let (mut single, mut batch, mut built) = (Vec::new(), Vec::new(), Vec::new());
    for _ in 0..5 {
        single.push(
            seconds(|| {
                for scenario in &scenarios[..40] {
                    black_box(solve(scenario, Keep::default(), &mut unwatched).is_ok());
                }
            }) / 40.0,
        );
        batch.push(
            seconds(|| {
                black_box(solve_all(&scenarios));
            }) * cores as f64
                / f64::from(COUNT),
        );
        built.push(seconds(|| {
            black_box(Case::new(&scenarios[0]));
        }));
    }
    let (single, batch) = (median(single), median(batch));
    println!(
        "{:<52}{:>9.3} ms",
        "one answer with its step error, wall",
        single * 1e3
    );
    println!(
        "{:<52}{:>9.3} ms",
        format!("batch on {cores} cores, core time a scene"),
        batch * 1e3
    );
    println!(
        "{:<52}{:>9.3} ms",
        "of it, building the eye",
        median(built) * 1e3
    );
    println!("ratio {:.2}", single / batch);
}

fn main() {
    println!("kernel: {}\n", kernel_name(false));
    evaluations();
    standard_case();
    same_error();
    batches();
}
