//! Force curves as they were recorded: a table that samples a known pulse answers like it, a noisy
//! one keeps its stated errors, and the program takes a CSV file from wherever a person has it.

use std::fs;
use std::path::Path;

use assert_cmd::Command;
use contrecoup::answer::solve::{Answer, solve};
use contrecoup::run::kept::Keep;
use contrecoup::run::quantity::Quantity;
use contrecoup::run::watch::unwatched;
use contrecoup::scenario::load::{load, parse, to_ron};
use contrecoup::scenario::set::set;
use contrecoup::scenario::{Curve, ForcePulse, Impact, Integrator, PulseShape, Scenario};

/// 300 N over 0.2 ms in the given shape.
fn blow(shape: PulseShape) -> Scenario {
    Scenario {
        impact: Impact::ForcePulse(ForcePulse { shape, ..ForcePulse::default() }),
        ..Scenario::default()
    }
}

fn table(knots: impl IntoIterator<Item = (f64, f64)>) -> PulseShape {
    PulseShape::Table(Curve::new(knots).unwrap())
}

/// Half a sine, sampled at `n` equal times.
fn sampled(n: u32) -> PulseShape {
    table((0..n).map(|i| {
        let s = f64::from(i) / f64::from(n - 1);
        (0.2 * s, (std::f64::consts::PI * s).sin())
    }))
}

/// Numbers between -1 and 1 that look like noise and are the same for good.
fn noise(n: u32) -> impl Iterator<Item = f64> {
    let mut state = 0x2545_F491_4F6C_DD1D_u64;
    (0..n).map(move |_| {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        (state >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    })
}

/// Half a sine of `n` knots at uneven times under 10 % of noise.
fn noisy(n: u32) -> PulseShape {
    let mut time = 0.0;
    let values: Vec<f64> = noise(2 * n).collect();
    table(values.chunks_exact(2).map(|pair| {
        let knot = (time, (std::f64::consts::PI * time / 0.2).sin() + 0.1 * pair[0]);
        time += 0.2 / f64::from(n - 1) * (1.0 + 0.8 * pair[1]);
        knot
    }))
}

fn answer(scenario: &Scenario) -> Answer {
    solve(&scenario.check().unwrap(), Keep::default(), &mut unwatched).unwrap()
}

/// The largest relative difference of any leading result.
fn apart(a: &Answer, b: &Answer) -> f64 {
    a.results().difference_percent(&b.results()).headline() / 100.0
}

#[test]
fn a_table_of_two_or_three_knots_answers_like_the_shape_it_draws() {
    for (knots, shape) in [
        (&[(0.0, 0.0), (0.1, 1.0), (0.2, 0.0)][..], PulseShape::Triangle),
        (&[(0.0, 1.0), (0.2, 1.0)], PulseShape::SmoothRectangle { edge_fraction: 0.0 }),
    ] {
        let table = answer(&blow(table(knots.iter().copied())));
        let apart = apart(&table, &answer(&blow(shape)));
        assert!(apart < 1e-9, "{apart}");
    }
}

#[test]
fn finer_samples_of_a_half_sine_come_to_it_at_second_order() {
    let exact = answer(&blow(PulseShape::HalfSine));
    let missed = [26, 51, 101].map(|n| apart(&answer(&blow(sampled(n))), &exact));
    println!("missed by {missed:?}");
    for pair in missed.windows(2) {
        let ratio = pair[0] / pair[1];
        assert!((3.0..5.5).contains(&ratio), "{missed:?}");
    }
    assert!(missed[2] < 3e-4, "{missed:?}");
}

#[test]
fn a_noisy_recording_keeps_its_stated_errors_and_costs_a_few_steps_a_knot() {
    let mut scenario = blow(noisy(200));
    let plain = answer(&blow(PulseShape::HalfSine));
    for integrator in [None, Some(Integrator::VelocityVerlet)] {
        scenario.numerics.integrator = integrator;
        let coarse = answer(&scenario);
        let mut fine = scenario.clone();
        fine.numerics.integrator = Some(Integrator::Srkn11b);
        fine.numerics.step_us = Some(0.2);
        let (missed, stated) =
            (100.0 * apart(&coarse, &answer(&fine)), coarse.errors.time_step_percent().unwrap());
        println!(
            "{integrator:?}: missed {missed:.2e} %, stated {stated:.2e} %, {} steps, {} for the shape",
            coarse.run.cost.steps, plain.run.cost.steps
        );
        assert!(missed <= stated, "{missed} > {stated}");
        if integrator.is_none() {
            assert!(coarse.run.cost.steps < plain.run.cost.steps + 5 * 200);
        }
    }
}

#[test]
fn the_most_knots_in_the_shortest_time_stay_affordable_and_are_honest() {
    let knots = (0..Curve::MAX_KNOTS).zip(noise(2000));
    let mut scenario = blow(table(knots.map(|(i, noise)| (i as f64 * 1e-6, 1.0 + noise))));
    let Impact::ForcePulse(pulse) = &mut scenario.impact else { panic!() };
    pulse.duration_ms = 0.002;
    let crowded = answer(&scenario);
    assert!(crowded.run.cost.steps < 4 * 2000 + 5000, "{}", crowded.run.cost.steps);
    let mut fine = scenario.clone();
    fine.numerics.step_us = Some(0.05);
    let missed = 100.0 * apart(&crowded, &answer(&fine));
    assert!(missed <= crowded.errors.time_step_percent().unwrap(), "{missed}");
}

#[test]
fn only_the_impulse_of_a_very_short_recording_moves_the_eye() {
    let short = |knots: &[(f64, f64)]| {
        let mut scenario = blow(table(knots.iter().copied()));
        set(&mut scenario, "impact.duration_ms", "0.0005").unwrap();
        set(&mut scenario, "impact.force_n", "20000").unwrap();
        answer(&scenario).peak(Quantity::Apex).unwrap().value
    };
    let spike = short(&[(0.0, 0.0), (0.2, 1.0), (0.4, -0.5), (0.6, 0.5), (0.8, 1.0), (1.0, 0.0)]);
    let even = short(&[(0.0, 0.4), (1.0, 0.4)]);
    assert!((spike / even - 1.0).abs() < 1e-3, "{spike} {even}");
}

#[test]
fn a_curve_in_a_file_is_part_of_the_scenario_once_it_is_read() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("blow.csv"), "t_ms,share\n0,0\n0.05,1\n0.3,0\n").unwrap();
    let file = folder.path().join("blow.ron");
    fs::write(&file, "(name: \"x\", impact: ForcePulse(force_n: 120, shape: Csv(\"blow.csv\")))")
        .unwrap();
    let scenario = load(&file).unwrap();
    let Impact::ForcePulse(pulse) = &scenario.impact else { panic!() };
    assert_eq!(pulse.duration_ms, 0.3);
    assert_eq!(pulse.shape, table([(0.0, 0.0), (0.05, 1.0), (0.3, 0.0)]));
    // What is saved needs the file no longer.
    let saved = to_ron(&scenario);
    assert!(!saved.contains("Csv"), "{saved}");
    assert_eq!(parse(&saved, "elsewhere").unwrap(), scenario);
    // A text without a place can name no file.
    let text = fs::read_to_string(&file).unwrap();
    let error = parse(&text, "here").unwrap_err().to_string();
    assert!(error.contains("only a scenario file can name a file"), "{error}");
}

#[test]
fn the_longest_curve_that_is_allowed_can_be_saved_and_read_back() {
    let knots = (0..Curve::MAX_KNOTS).map(|i| {
        let time = 100.0 * (i + 1) as f64 / 2003.0;
        (time, 1e-29 * (1.0 + time.sin() / 3.0))
    });
    let scenario = blow(table(knots));
    let text = to_ron(&scenario);
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("long.ron");
    fs::write(&file, &text).unwrap();
    assert_eq!(load(&file).unwrap(), scenario, "{} bytes", text.len());
}

fn program(folder: &Path, arguments: &[&str]) -> assert_cmd::assert::Assert {
    let mut command = Command::cargo_bin("contrecoup").unwrap();
    command.env("XDG_CONFIG_HOME", folder).env("HOME", folder);
    command.current_dir(folder).args(arguments).assert()
}

fn printed(done: &assert_cmd::assert::Assert) -> (String, String) {
    let output = done.get_output();
    let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
    (text(&output.stdout), text(&output.stderr))
}

#[test]
fn the_command_line_takes_a_curve_from_a_file_or_from_a_flag() {
    let folder = tempfile::tempdir().unwrap();
    fs::create_dir(folder.path().join("trial")).unwrap();
    let csv = folder.path().join("trial/blow.csv");
    fs::write(&csv, "0,0\n0.05,1\n0.3,0\n").unwrap();
    let text = "(\n name: \"x\",\n impact: ForcePulse(force_n: 120, shape: Csv(\"blow.csv\")))";
    fs::write(folder.path().join("trial/blow.ron"), text).unwrap();
    let run = |arguments: &[&str]| {
        let (out, _) = printed(&program(folder.path(), arguments).success());
        let json: serde_json::Value = serde_json::from_str(&out).unwrap();
        (json["scenario"]["impact"]["ForcePulse"].clone(), json["results"].clone())
    };
    let beside = run(&["run", "trial/blow.ron", "--json"]);
    assert_eq!(beside.0["shape"]["Table"][1], serde_json::json!([0.05, 1.0]));
    assert_eq!(beside.0["duration_ms"], 0.3);
    // A flag names a path from the working directory, and the curve brings its own duration.
    let flag = "impact.shape=Csv(\"trial/blow.csv\")";
    let set = ["run", "paper-300n", "--json", "--set", "impact.force_n=120", "--set", flag];
    assert_eq!(run(&set), beside);
    let longer = [&set[..], &["--set", "impact.duration_ms=0.6"]].concat();
    assert_eq!(run(&longer).0["duration_ms"], 0.6);

    let refused = |arguments: &[&str], said: &str| {
        let (out, error) = printed(&program(folder.path(), arguments).code(2));
        assert!(out.is_empty() && error.contains(said), "{error}");
    };
    refused(&["run", "paper-300n", "--set", "impact.shape=Table"], "Table([(t_ms, share), ...])");
    refused(
        &["run", "paper-300n", "--set", "impact.shape=Csv(\"no.csv\")"],
        "no.csv: there is no such file",
    );
    refused(
        &["run", "trial/blow.ron", "--set", "impact.shape.edge_fraction=0.2"],
        "impact.shape is Table, which has no edge_fraction",
    );
    fs::write(&csv, "0,0\n0.05,1\n0.04,0\n").unwrap();
    refused(
        &["run", "trial/blow.ron"],
        "trial/blow.ron:3:47: impact.shape: blow.csv:3: time 0.04 does not come after 0.05",
    );
}

#[test]
fn a_preset_of_ones_own_finds_its_curve_and_is_shown_as_it_stands() {
    let folder = tempfile::tempdir().unwrap();
    let presets = folder.path().join("contrecoup/presets");
    fs::create_dir_all(&presets).unwrap();
    fs::write(presets.join("blow.csv"), "0,0\n0.05,1\n0.3,0\n").unwrap();
    let text = "// Mine.\n(name: \"my recording\", impact: ForcePulse(force_n: 120, shape: Csv(\"blow.csv\")))\n";
    fs::write(presets.join("mine.ron"), text).unwrap();
    let (list, _) = printed(&program(folder.path(), &["presets"]).success());
    assert!(list.contains("my recording"), "{list}");
    let (shown, _) = printed(&program(folder.path(), &["presets", "show", "mine"]).success());
    assert_eq!(shown, text);
    program(folder.path(), &["run", "mine"]).success();
}

#[test]
fn sweeps_and_ensembles_vary_what_stands_beside_a_table() {
    let folder = tempfile::tempdir().unwrap();
    let text = "(name: \"x\", impact: ForcePulse(force_n: 120, shape: Table([(0, 0), (0.05, 1), (0.3, 0)])), \
                doubt: {\"impact.duration_ms\": 0.03})";
    fs::write(folder.path().join("x.ron"), text).unwrap();
    let vary = "impact.duration_ms=0.3,0.6";
    let (rows, _) =
        printed(&program(folder.path(), &["sweep", "x.ron", "--vary", vary, "--json"]).success());
    let damage: Vec<f64> = rows
        .lines()
        .map(|row| serde_json::from_str::<serde_json::Value>(row).unwrap())
        .filter_map(|row| row["results"]["damage_percent"].as_f64())
        .collect();
    assert!(damage.len() == 2 && damage[0] < damage[1], "{rows}");
    let ensemble = ["ensemble", "x.ron", "--samples", "16", "--json"];
    let (out, _) = printed(&program(folder.path(), &ensemble).success());
    assert!(out.contains("impact.duration_ms"), "{out}");
}

#[test]
fn a_sweep_over_recorded_curves_runs_each_of_them() {
    let folder = tempfile::tempdir().unwrap();
    for (name, text) in [("a.csv", "0,0\n0.1,1\n0.2,0\n"), ("b.csv", "0,0\n0.2,1\n0.4,0\n")] {
        fs::write(folder.path().join(name), text).unwrap();
    }
    // Beside another pulse the word Table would be refused; beside a table it would mean that
    // table.
    let own = "(name: \"x\", impact: ForcePulse(force_n: 300, shape: Csv(\"a.csv\")))";
    fs::write(folder.path().join("x.ron"), own).unwrap();
    let vary = "impact.shape=Csv(\"a.csv\"),Csv(\"b.csv\"),half-sine";
    for preset in ["x.ron", "paper-300n"] {
        let done = program(folder.path(), &["sweep", preset, "--vary", vary, "--json"]).success();
        let (rows, _) = printed(&done);
        let rows: Vec<serde_json::Value> = rows
            .lines()
            .map(|row| serde_json::from_str(row).unwrap())
            .filter(|row: &serde_json::Value| row["row"].is_number())
            .collect();
        let damage = |i: usize| rows[i]["results"]["damage_percent"].as_f64().unwrap();
        assert!(rows.len() == 3 && damage(1) > 1.2 * damage(0), "{rows:?}");
        assert!(rows[1].to_string().contains("b.csv") && rows[2].to_string().contains("HalfSine"));
    }
}
