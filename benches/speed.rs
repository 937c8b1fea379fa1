//! Speed against the plain edge list, and each target with its ratio, in one run, interleaved.
//!
//! `cargo bench` prints the fastest of many interleaved rounds, which other work on the machine
//! disturbs least, and the ratios between them; at the end a table of the targets.

use contrecoup::answer::compiled::Compiled;
use contrecoup::answer::solve::solve;
use contrecoup::many::statistics::median;
use contrecoup::models::paper::case::PaperCase;
use contrecoup::models::paper::forces::kernel::{name as kernel_name, vector_sets, vectors_name};
use contrecoup::models::paper::forces::plain::Plain;
use contrecoup::models::paper::forces::state::State;
use contrecoup::models::paper::time::march::march;
use contrecoup::run::kept::Keep;
use contrecoup::run::model::EyeModel;
use contrecoup::run::plan::{LOCAL_TOLERANCE, Plan};
use contrecoup::run::quantity::Quantity;
use contrecoup::run::watch::unwatched;
use contrecoup::scenario::Integrator;
use contrecoup::scenario::{CheckedScenario, Impact, Scenario};
use rayon::prelude::*;
use std::hint::black_box;
use std::ops::ControlFlow;
use std::process::Command;
use std::sync::Arc;
use std::time::Instant;

mod outside;

/// Rounds of evaluations at level 1, at the finer levels, of whole runs, and of many scenes.
const ROUNDS: (usize, usize, usize, usize) = (200, 15, 30, 7);
/// Share of the stability limit that both sides take where only evaluations are timed.
const SHARE: f64 = 0.9;
/// Shares of the two runs of an answer.
const SHARES: [f64; 2] = [0.95, 0.8];

/// What was measured, its ratio, and the least and the most it should be.
#[derive(Default)]
struct Targets(Vec<(String, f64, f64, f64)>);

impl Targets {
    fn least(&mut self, what: impl Into<String>, ratio: f64, least: f64) {
        self.0.push((what.into(), ratio, least, f64::INFINITY));
    }

    fn most(&mut self, what: impl Into<String>, ratio: f64, most: f64) {
        self.0.push((what.into(), ratio, 0.0, most));
    }

    fn print(&self) {
        println!("\n| target | ratio | wanted | met |\n|---|---|---|---|");
        for (what, ratio, least, most) in &self.0 {
            let wanted = if most.is_finite() {
                format!("at most {most:.3}")
            } else {
                format!("at least {least:.1}")
            };
            let met = if ratio >= least && ratio <= most { "yes" } else { "no" };
            println!("| {what} | {ratio:.3} | {wanted} | {met} |");
        }
    }
}

fn seconds(work: impl FnOnce()) -> f64 {
    let start = Instant::now();
    work();
    start.elapsed().as_secs_f64()
}

/// Times of several forms of one thing, of which the fastest counts.
struct Fastest<const N: usize>([f64; N]);

impl<const N: usize> Fastest<N> {
    fn new() -> Self {
        Self([f64::INFINITY; N])
    }

    fn time(&mut self, form: usize, work: impl FnOnce()) {
        self.0[form] = self.0[form].min(seconds(work));
    }
}

fn row(what: &str, seconds: f64, error: Option<f64>) {
    let error = error.map_or_else(String::new, |e| format!("{e:>12.4} %"));
    println!("{what:<62}{:>9.3} ms{error}", seconds * 1e3);
}

fn case(level: u32, whole: bool, portable: bool) -> PaperCase {
    let mut scenario = Scenario::default();
    scenario.eye.level = level;
    PaperCase::with(&scenario.check().unwrap(), whole, portable)
}

fn plain(case: &PaperCase) -> Plain {
    Plain::new(&case.eye, case.system.pulse.clone(), &case.load)
}

fn plan(case: &PaperCase, integrator: Integrator, share: f64) -> Plan {
    Plan {
        integrator,
        step: share * case.step_limit(integrator),
        window: case.window,
        multiple: 1.0,
        local_tolerance: LOCAL_TOLERANCE,
    }
}

/// Seconds an evaluation of some forms and of the plain loop, which comes last.
fn evaluation_times<const N: usize>(cases: &[&PaperCase], window: f64, rounds: usize) -> [f64; N] {
    let mut edges = plain(cases[0]);
    let step = SHARE * cases[0].step_limit(Integrator::VelocityVerlet);
    let mut times = Fastest::<N>::new();
    let mut counts = [1; N];
    for _ in 0..rounds {
        for (i, case) in cases.iter().enumerate() {
            let plan = Plan { window, ..plan(case, Integrator::Srkn6b, SHARE) };
            let mut state = State::at_rest(&case.system);
            times.time(i, || {
                let cost = march(&case.system, &plan, &mut state, |_| ControlFlow::Continue(()));
                counts[i] = cost.map_or(0, |c| c.evaluations);
            });
        }
        times.time(cases.len(), || {
            counts[cases.len()] = edges.run(window, step, |p, _| {
                black_box(&p.position);
            });
        });
    }
    std::array::from_fn(|i| times.0[i] / counts[i] as f64)
}

fn evaluations(targets: &mut Targets) {
    println!("Force evaluation with its share of the update and the surveys, nothing recorded");
    println!("{:>5}  {:<30}{:>12}{:>14}{:>10}", "level", "form", "us/eval", "ns/spring", "ratio");
    let print = |level: u32, name: &str, time: f64, springs: usize, base: f64| {
        let ns = time * 1e9 / springs as f64;
        let (us, ratio) = (time * 1e6, base / time);
        println!("{level:>5}  {name:<30}{us:>12.3}{ns:>14.3}{ratio:>10.2}");
        ns
    };
    let mut each = Vec::new();
    for level in [1, 3, 5] {
        let forms = [
            ("rows, whole eye", case(level, true, false)),
            ("rows, whole, portable", case(level, true, true)),
            ("rows, mirrored half", case(level, false, false)),
        ];
        let cases = [&forms[0].1, &forms[1].1, &forms[2].1];
        let rounds = if level == 1 { ROUNDS.0 } else { ROUNDS.1 };
        let times = evaluation_times::<4>(&cases, 2e-4 / f64::from(level), rounds);
        each.push(std::array::from_fn::<f64, 3, _>(|i| {
            let springs = cases[i].system.springs_per_evaluation;
            print(level, forms[i].0, times[i], springs, times[3])
        }));
        let springs = cases[0].eye.springs.len();
        print(level, "plain edge list", times[3], springs, times[3]);
    }
    for level in vector_sets() {
        let mut forms = [case(1, true, false), case(1, true, true)];
        for form in &mut forms {
            form.system.set_level(level);
        }
        let times = evaluation_times::<3>(&[&forms[0], &forms[1]], 2e-4, ROUNDS.0);
        let name = vectors_name(level);
        for (i, form) in ["whole", "whole, portable"].iter().enumerate() {
            let springs = forms[i].system.springs_per_evaluation;
            print(1, &format!("{name}, {form}"), times[i], springs, times[2]);
        }
        let narrow = matches!(name.as_str(), "sse2" | "neon");
        let most = if narrow { 0.5 } else { 1.0 / 3.0 };
        let what = format!("one evaluation against plain, level 1, whole, {name}");
        targets.most(what, times[0] / times[2], most);
    }
    let flat = |form: usize| each[0][form] / each[2][form];
    targets.most("a spring at level 1 against 5, whole eye", flat(0), 1.25);
    targets.most("a spring at level 1 against 5, mirrored half", flat(2), 1.25);
}

/// Largest error in % of the four peak forces and the apex displacement of a plain run, as sampled
/// at its steps, against the reference values.
fn plain_error(case: &PaperCase, step: f64, truth: &[f64; 5]) -> f64 {
    let marks = &case.eye.landmarks;
    let rest: Vec<f64> = marks.apex.iter().map(|&n| case.eye.nodes[n].position.x).collect();
    let mut found = [0.0f64; 5];
    plain(case).run(case.window, step, |p, _| {
        for (i, &n) in marks.monitors.iter().enumerate() {
            let drag = case.eye.nodes[n].drag;
            found[i] = found[i].max((p.force[n] - p.velocity[n] * drag).norm());
        }
        let apex =
            marks.apex.iter().zip(&rest).map(|(&n, x)| p.position[n].x - x).sum::<f64>() / 2.0;
        found[4] = found[4].max(apex);
    });
    (0..5).map(|i| 100.0 * (found[i] / truth[i] - 1.0).abs()).fold(0.0, f64::max)
}

/// Whole runs of the standard case, each with its true error.
fn standard_case(targets: &mut Targets) {
    println!("\nStandard case: 300 N, 0.2 ms, window 3 ms, level 1; time and true error");
    let quick = case(1, false, false);
    let fine = plan(&quick, Integrator::Srkn11b, 0.05);
    let run = |plan: &Plan| {
        let run = quick.run(plan, Keep::default(), &mut unwatched);
        run.expect("a stable step")
    };
    let compiled = Compiled::with(Arc::new(quick.clone()), &Scenario::default());
    let reference = run(&fine);
    let truth = compiled.results(&reference);
    let value = |of| reference.readings.value(of).expect("a reading");
    let [a, b, c, d] = Quantity::FORCES.map(value);
    let sampled = [a, b, c, d, value(Quantity::Apex)];
    // The largest step from which on every shorter one will do: a single one may be lucky.
    let limit = quick.step_limit(Integrator::VelocityVerlet);
    let step = (0..20)
        .map(|i| limit * 0.2 * 1.08f64.powi(i))
        .take_while(|&step| plain_error(&quick, step, &sampled) <= 0.1)
        .last()
        .expect("a fifth of the limit is within 0.1 %");
    let scenario = Scenario::default();
    let plans = [quick.plan_alone(&scenario), quick.plan(&scenario)].map(|p| p.expect("runs"));
    let mut times = Fastest::<4>::new();
    let mut in_c = outside::PlainC::new(&quick, step);
    let mut fastest_in_c = f64::INFINITY;
    for _ in 0..ROUNDS.2 {
        if let Some((seconds, sum)) = in_c.as_mut().and_then(outside::PlainC::solve) {
            fastest_in_c = fastest_in_c.min(seconds);
            let mut edges = plain(&quick);
            edges.run(quick.window, step, |_, _| {});
            let here: f64 = edges.position.iter().map(|p| p.x + p.y).sum();
            assert!((sum - here).abs() < 1e-9, "C ends elsewhere: {sum} {here}");
        }
        for (i, plan) in plans.iter().enumerate() {
            times.time(i, || {
                black_box(run(plan));
            });
        }
        for (i, step) in [(2, limit), (3, step)] {
            let mut edges = plain(&quick);
            times.time(i, || {
                edges.run(quick.window, step, |p, _| {
                    black_box(&p.position);
                });
            });
        }
    }
    let time = times.0;
    let error = |plan| Some(compiled.results(&run(plan)).difference_percent(&truth).headline());
    for (i, name) in ["one run alone", "the run of an answer"].iter().enumerate() {
        let (method, step) = (plans[i].integrator, plans[i].step);
        let share = step / quick.step_limit(method);
        let what = format!("{name}: {} at {share:.2} of its limit", method.name());
        row(&what, time[i], error(&plans[i]));
    }
    let at_limit = plain_error(&quick, limit, &sampled);
    let within = plain_error(&quick, step, &sampled);
    row("plain Verlet at its limit, nothing recorded", time[2], Some(at_limit));
    let what = format!("plain Verlet within 0.1 %: {:.3} us, the same", step * 1e6);
    row(&what, time[3], Some(within));
    let mut within_error = |what: &str, time_of_it: f64| {
        let ratio = |form: usize| time_of_it / time[form];
        targets.least(format!("{what} against one run alone"), ratio(0), 12.0);
        targets.least(format!("{what} against the run of an answer"), ratio(1), 12.0);
    };
    within_error("plain within 0.1 %", time[3]);
    if fastest_in_c.is_finite() {
        row("the same in C, cc -O3 -march=native", fastest_in_c, Some(within));
        within_error("the same in C", fastest_in_c);
    } else {
        println!("no C compiler here: the plain loop in C is left out");
    }
    let what = "plain at its limit against one run alone";
    targets.least(what, time[2] / time[0], 2.0);
}

/// Both runs of an answer, one after the other: the work of one core.
fn on_one_core(scenario: &CheckedScenario) {
    let case = PaperCase::new(scenario);
    for share in SHARES {
        let plan = plan(&case, Integrator::Srkn6b, share);
        black_box(case.record(&plan, Keep::default(), &mut unwatched).is_ok());
    }
}

/// Answers on finer meshes, for which a person waits: the run and that for its step error side by
/// side.
fn finer_meshes(targets: &mut Targets) {
    println!("\nOne answer on a finer mesh, with its step error");
    for level in [3, 5] {
        let mut scenario = Scenario::default();
        scenario.eye.level = level;
        let scenario = scenario.check().unwrap();
        let mut times = Fastest::<2>::new();
        for _ in 0..ROUNDS.3 {
            times.time(0, || {
                black_box(solve(&scenario, Keep::default(), &mut unwatched).is_ok());
            });
            times.time(1, || on_one_core(&scenario));
        }
        let [wall, work] = times.0;
        row(&format!("level {level}, wall"), wall, None);
        row(&format!("level {level}, time of one core"), work, None);
        let what = format!("an answer at level {level} on all cores against one");
        targets.least(what, work / wall, 1.6);
    }
}

/// One run of a scene with its eye, results only.
fn one_run(scenario: &CheckedScenario) -> bool {
    let case = PaperCase::new(scenario);
    let plan = case.plan_alone(scenario).expect("runs");
    case.run(&plan, Keep::default(), &mut unwatched).is_ok()
}

fn many_scenes(targets: &mut Targets) {
    const COUNT: u32 = 200;
    println!("\nMany: {COUNT} head-on scenes, results only, no frames");
    let scenarios: Vec<CheckedScenario> = (0..COUNT)
        .map(|i| {
            let mut scenario = Scenario::default();
            let Impact::ForcePulse(pulse) = &mut scenario.impact else { panic!() };
            pulse.force_n = 100.0 + 2.0 * f64::from(i);
            scenario.check().unwrap()
        })
        .collect();
    let some = &scenarios[80..120];
    let cores = rayon::current_num_threads() as f64;
    let mut times = Fastest::<5>::new();
    for _ in 0..ROUNDS.3 {
        times.time(0, || {
            for scenario in some {
                black_box(solve(scenario, Keep::default(), &mut unwatched).is_ok());
            }
        });
        times.time(1, || {
            for scenario in some {
                on_one_core(scenario);
            }
        });
        times.time(2, || {
            for scenario in some {
                black_box(one_run(scenario));
            }
        });
        times.time(3, || {
            black_box(scenarios.par_iter().filter(|one| one_run(one)).count());
        });
        times.time(4, || {
            for scenario in some {
                black_box(PaperCase::new(scenario));
            }
        });
    }
    let [wall, work, alone, all, build] = times.0;
    let [wall, work, alone, build] = [wall, work, alone, build].map(|t| t / some.len() as f64);
    let many = all * cores / f64::from(COUNT);
    row("one answer with its step error, wall", wall, None);
    row("one answer with its step error, time of one core", work, None);
    row("one run alone and its eye, the other cores idle", alone, None);
    row(&format!("a scene among many on {cores} cores, time of one core"), many, None);
    row("of it, building the eye", build, None);
    let what = "a scene among many, throughput per core against";
    targets.least(format!("{what} an answer"), work / many, 1.5);
    targets.least(format!("{what} one run alone"), alone / many, 1.4);
}

/// The program from its start to its end.
fn process(targets: &mut Targets) {
    const RUNS: usize = 41;
    println!("\nThe program: run paper-300n --quick --json");
    let mut solves = Vec::new();
    let mut walls = Vec::new();
    let mut ratios = Vec::new();
    for _ in 0..RUNS {
        let mut output = Vec::new();
        let wall = seconds(|| {
            output = Command::new(env!("CARGO_BIN_EXE_contrecoup"))
                .args(["run", "paper-300n", "--quick", "--json"])
                .env("XDG_CONFIG_HOME", "/nonexistent")
                .output()
                .expect("the program starts")
                .stdout;
        });
        let object: serde_json::Value = serde_json::from_slice(&output).expect("it prints JSON");
        let solve = object["numerics"]["solve_ms"].as_f64().expect("a time") * 1e-3;
        walls.push(wall);
        solves.push(solve);
        ratios.push(wall / solve);
    }
    row("process start to end, median", median(walls).unwrap(), None);
    row("the solve itself, as printed, median", median(solves).unwrap(), None);
    targets.most("process start to printed result against the solve", median(ratios).unwrap(), 2.5);
}

fn main() {
    println!("kernel: {}\n", kernel_name(false));
    let mut targets = Targets::default();
    evaluations(&mut targets);
    standard_case(&mut targets);
    finer_meshes(&mut targets);
    many_scenes(&mut targets);
    process(&mut targets);
    targets.print();
}
