//! Many runs as a shell sees them: what is refused, what a kill leaves, and that shards are the
//! whole.

use std::fs;
use std::path::Path;
use std::process::{Child, Command, Output, Stdio};
use std::thread;
use std::time::{Duration, Instant};

use serde_json::Value;

const PATIENCE: Duration = Duration::from_secs(60);
/// Short runs, so that many are quick.
const SHORT: [&str; 3] = ["paper-300n", "--set", "window_ms=0.3"];

fn program(folder: &Path) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_contrecoup"));
    command.current_dir(folder);
    command.env("XDG_CONFIG_HOME", folder).env("HOME", folder);
    command
}

fn run(folder: &Path, arguments: &[&str]) -> Output {
    program(folder).args(arguments).output().unwrap()
}

fn sweep(folder: &Path, more: &[&str]) -> Output {
    let mut arguments = vec!["sweep"];
    arguments.extend(SHORT);
    arguments.extend(more);
    run(folder, &arguments)
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8(bytes.to_vec()).unwrap()
}

/// Two inputs, 24 rows, of which some are refused.
const GRID: [&str; 4] = ["--vary", "impact.force_n=50:600:8", "--vary", "impact.angle_deg=0,20,60"];

fn grid<'a>(more: &[&'a str]) -> Vec<&'a str> {
    GRID.iter().chain(more).copied().collect()
}

#[test]
fn shards_put_together_are_the_whole() {
    let folder = tempfile::tempdir().unwrap();
    for (kind, comment) in [("--csv", "#"), ("--json", "{\"sweep")] {
        let whole = sweep(folder.path(), &grid(&[kind]));
        assert_eq!(whole.status.code(), Some(0), "{}", text(&whole.stderr));
        let whole = text(&whole.stdout);
        let heading = whole.lines().take_while(|l| l.starts_with(comment) || l.starts_with("row"));
        let heading: Vec<&str> = heading.collect();
        let rows: Vec<&str> = whole.lines().skip(heading.len()).collect();
        assert_eq!(rows.len(), 24);
        let mut together: Vec<Option<String>> = vec![None; 24];
        for i in 1..=5_usize {
            let part = sweep(folder.path(), &grid(&[kind, "--shard", &format!("{i}/5")]));
            let part = text(&part.stdout);
            let lines: Vec<&str> = part.lines().collect();
            assert_eq!(&lines[..heading.len()], heading);
            for (at, line) in lines[heading.len()..].iter().enumerate() {
                let row = i - 1 + 5 * at;
                assert!(together[row].replace((*line).to_owned()).is_none());
            }
        }
        let together: Vec<String> = together.into_iter().map(Option::unwrap).collect();
        assert_eq!(together, rows);
    }
}

#[test]
fn rows_hold_results_or_the_reason_why_not() {
    let folder = tempfile::tempdir().unwrap();
    let lines = text(&sweep(folder.path(), &grid(&["--json"])).stdout);
    let rows: Vec<Value> =
        lines.lines().skip(1).map(|l| serde_json::from_str(l).unwrap()).collect();
    for (number, row) in rows.iter().enumerate() {
        assert_eq!(row["row"], number);
        assert_eq!(row["varied"]["impact.angle_deg"], [0.0, 20.0, 60.0][number % 3]);
        if number % 3 == 2 {
            assert!(row["refused"].as_str().unwrap().contains("bone shields"));
            assert!(row["results"].is_null());
        } else {
            assert!(row["results"]["damage_percent"].as_f64().unwrap() > 0.0);
            assert!(
                row["step_error_percent"].as_f64().unwrap() <= 0.1
                    || row["flags"] != Value::Array(vec![])
            );
        }
    }
    // The same as a single run says.
    let mut single = vec!["run"];
    single.extend(SHORT);
    single.extend(["--set", "impact.force_n=50", "--json"]);
    let single: Value = serde_json::from_slice(&run(folder.path(), &single).stdout).unwrap();
    let (a, b) = (&single["results"]["damage_percent"], &rows[0]["results"]["damage_percent"]);
    assert!((a.as_f64().unwrap() / b.as_f64().unwrap() - 1.0).abs() < 1e-3);
}

fn lines(path: &Path) -> usize {
    fs::read_to_string(path).map_or(0, |text| text.lines().count())
}

fn wait_for(mut what: impl FnMut() -> bool) {
    let begun = Instant::now();
    while !what() {
        assert!(begun.elapsed() < PATIENCE, "it did not come");
        thread::sleep(Duration::from_millis(2));
    }
}

/// Enough rows that a kill finds it at work.
const LONG: [&str; 8] = [
    "sweep",
    "paper-300n",
    "--vary",
    "impact.force_n=50:450:40",
    "--vary",
    "impact.duration_ms=0.1,0.2,0.3",
    "--out",
    "table.csv",
];

fn start(folder: &Path) -> Child {
    program(folder).args(LONG).stdout(Stdio::null()).stderr(Stdio::piped()).spawn().unwrap()
}

#[test]
fn what_a_kill_leaves_is_gone_on_with_and_nothing_is_lost_or_repeated() {
    let (one, other) = (tempfile::tempdir().unwrap(), tempfile::tempdir().unwrap());
    assert_eq!(run(one.path(), &LONG).status.code(), Some(0));
    let whole = fs::read(one.path().join("table.csv")).unwrap();
    let table = other.path().join("table.csv");
    for rows in [5, 40] {
        let mut child = start(other.path());
        wait_for(|| lines(&table) > rows);
        // What cannot be caught: SIGKILL.
        child.kill().unwrap();
        child.wait().unwrap();
        let left = fs::read(&table).unwrap();
        assert!(left.len() < whole.len(), "the kill came too late to try anything");
        assert!(whole.starts_with(&left));
        // A torn last line is what a full disk or a lost machine leaves.
        fs::write(&table, &left[..left.len() - 7]).unwrap();
    }
    assert_eq!(run(other.path(), &LONG).status.code(), Some(0));
    assert_eq!(fs::read(&table).unwrap(), whole);
    let again = run(other.path(), &LONG);
    assert!(text(&again.stdout).contains("nothing to do"));
    assert_eq!(fs::read(&table).unwrap(), whole);
}

#[test]
fn a_torn_heading_is_written_again_and_another_file_is_left_alone() {
    let folder = tempfile::tempdir().unwrap();
    let table = folder.path().join("t.csv");
    let small = ["--vary", "impact.force_n=100,200", "--out", "t.csv"];
    assert_eq!(sweep(folder.path(), &small).status.code(), Some(0));
    let whole = fs::read(&table).unwrap();
    for length in [0, 1, 30, 100] {
        fs::write(&table, &whole[..length]).unwrap();
        assert_eq!(sweep(folder.path(), &small).status.code(), Some(0));
        assert_eq!(fs::read(&table).unwrap(), whole);
    }
    let refused = |arguments: &[&str], word: &str| {
        let output = sweep(folder.path(), arguments);
        assert_eq!(output.status.code(), Some(2));
        let said = text(&output.stderr);
        assert!(said.contains(word) && said.contains("t.csv"), "{said}");
    };
    let other = ["--vary", "impact.force_n=100,300", "--out", "t.csv"];
    refused(&other, "something else");
    let shard = [&small[..], &["--shard", "2/2"]].concat();
    refused(&shard, "not the next row");
    let json = [&small[..], &["--json"]].concat();
    refused(&json, "something else");
    assert_eq!(fs::read(&table).unwrap(), whole);
    fs::write(&table, "my diary\n").unwrap();
    refused(&small, "my diary");
    assert_eq!(fs::read(&table).unwrap(), b"my diary\n");
}

#[test]
fn a_row_has_the_range_of_each_risk() {
    let folder = tempfile::tempdir().unwrap();
    let blow = ["sweep", "bb-62", "--set", "window_ms=0.2", "--json"];
    let vary = ["--vary", "impact.speed_m_s=20,60"];
    let output = run(folder.path(), &[&blow[..], &vary].concat());
    let said = text(&output.stdout);
    let rows = said.lines().skip(1).map(|row| serde_json::from_str::<Value>(row).unwrap());
    for row in rows {
        for injury in ["globe_rupture", "retina_back", "hyphema"] {
            let percent = |end: &str| {
                let value = &row["results"][format!("{injury}{end}_percent")];
                value.as_f64().unwrap()
            };
            let (low, middle, high) = (percent("_low"), percent(""), percent("_high"));
            assert!(low <= middle && middle <= high && low < high, "{injury}: {row}");
        }
    }
}

#[test]
fn damaged_rows_are_computed_again_and_that_is_said() {
    let folder = tempfile::tempdir().unwrap();
    let table = folder.path().join("t.csv");
    for form in ["--csv", "--json"] {
        let _ = fs::remove_file(&table);
        let small = ["--vary", "impact.force_n=100,200,300", "--out", "t.csv", form];
        assert_eq!(sweep(folder.path(), &small).status.code(), Some(0));
        let whole = fs::read_to_string(&table).unwrap();
        let last = whole.lines().nth_back(1).unwrap();
        let is_result =
            |cell: &&str| cell.contains('.') && cell.parse().is_ok_and(|v: f64| v != 200.0);
        let figure = last.split([',', ':', '}']).find(is_result).unwrap();
        for damaged in [
            // Another value of the varied field, one digit of a figure, no figure, a column less.
            last.replacen("200", "250", 1),
            last.replacen(figure, &one_digit_off(figure), 1),
            last.replacen("0.", "x.", 1),
            last.replacen(figure, "NaN", 1),
            last.replacen(',', "", 1),
        ] {
            fs::write(&table, whole.replace(last, &damaged)).unwrap();
            let output = sweep(folder.path(), &small);
            assert_eq!(output.status.code(), Some(0), "{damaged}");
            let said = text(&output.stderr);
            assert!(said.contains("is damaged: from there on"), "{said} {damaged}");
            assert_eq!(fs::read_to_string(&table).unwrap(), whole, "{damaged}");
        }
    }
}

/// A number whose last digit is another.
fn one_digit_off(figure: &str) -> String {
    let (rest, last) = figure.split_at(figure.len() - 1);
    format!("{rest}{}", if last == "1" { "2" } else { "1" })
}

#[test]
fn a_curve_that_changed_is_another_sweep() {
    let folder = tempfile::tempdir().unwrap();
    let curve = folder.path().join("c.csv");
    let vary = ["--vary", "impact.shape=Triangle,Csv(\"c.csv\")", "--out", "t.csv"];
    fs::write(&curve, "0,0\n0.1,1\n0.2,0\n").unwrap();
    let first = sweep(folder.path(), &vary);
    assert_eq!(first.status.code(), Some(0), "{}", text(&first.stderr));
    fs::write(&curve, "0,0\n0.1,2\n0.3,0\n").unwrap();
    let other = sweep(folder.path(), &vary);
    assert_eq!(other.status.code(), Some(2));
    assert!(text(&other.stderr).contains("something else"));
}

#[test]
fn two_runs_do_not_write_one_table_at_once() {
    let folder = tempfile::tempdir().unwrap();
    let mut first = start(folder.path());
    wait_for(|| lines(&folder.path().join("table.csv")) > 3);
    let second = run(folder.path(), &LONG);
    assert_eq!(second.status.code(), Some(1));
    assert!(text(&second.stderr).contains("is being written by another run"));
    first.kill().unwrap();
    first.wait().unwrap();
}

#[test]
fn bad_grids_are_refused_with_2() {
    let folder = tempfile::tempdir().unwrap();
    for (arguments, word) in [
        (&["--vary", "impact.force_n=1:2"][..], "expected FIELD=FROM:TO:COUNT"),
        (&["--vary", "impact.farce=1:2:3"], "did you mean"),
        (&["--vary", "impact.force_n=-5:2:3"], "allowed 0 to 100000 N"),
        (&["--vary", "window_ms=1,2", "--shard", "3/2"], "expected I/N"),
        (&["--vary", "window_ms=1,2", "--out", "."], "not a regular file"),
        (&[], "--vary"),
    ] {
        let output = sweep(folder.path(), arguments);
        assert_eq!(output.status.code(), Some(2), "{arguments:?}");
        assert!(text(&output.stderr).contains(word), "{}", text(&output.stderr));
    }
}

fn ensemble(folder: &Path, threads: &str, more: &[&str]) -> Value {
    let mut arguments = vec!["ensemble"];
    arguments.extend(SHORT);
    arguments.extend(["--json", "--samples", "40"]);
    arguments.extend(more);
    let mut command = program(folder);
    let output = command.env("RAYON_NUM_THREADS", threads).args(&arguments).output().unwrap();
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    let mut object: Value = serde_json::from_slice(&output.stdout).unwrap();
    object.as_object_mut().unwrap().remove("timing").unwrap();
    object
}

#[test]
fn an_ensemble_is_the_same_on_one_two_and_three_threads() {
    let folder = tempfile::tempdir().unwrap();
    let doubt = ["--set", "impact.force_n=300 +- 20"];
    let one = ensemble(folder.path(), "1", &doubt);
    assert_eq!(one, ensemble(folder.path(), "2", &doubt));
    assert_eq!(one, ensemble(folder.path(), "3", &doubt));
    let other = ensemble(folder.path(), "2", &["--set", "impact.force_n=300 +- 20", "--seed", "2"]);
    assert_ne!(one["results"], other["results"]);
    let band = &one["results"]["damage_percent"];
    let value = |key: &str| band[key].as_f64().unwrap();
    assert!(value("p05") < value("median") && value("median") < value("p95"));
    assert_eq!(one["inputs"][0]["field"], "impact.force_n");
    assert_eq!(one["inputs"][0]["sd"], 20.0);
    assert!(band["rank_correlation"]["impact.force_n"].as_f64().unwrap() > 0.0);
    assert!(one["step_error"]["worst_percent"].as_f64().unwrap() <= 0.1);
}

#[test]
fn more_doubt_gives_a_wider_band() {
    let folder = tempfile::tempdir().unwrap();
    // Everything else is held to be known.
    let wide = |sd: &str| {
        let force = format!("impact.force_n=300 ± {sd}");
        let known = [
            "eye.sclera_kpa=2600 ± 0",
            "eye.lens_kpa=6880 ± 0",
            "eye.fat_kpa=47 ± 0",
            "eye.globe_mass_g=7.5 ± 0",
            "eye.globe_drag_ns_m=0.705 ± 0",
            "eye.fat_drag_ns_m=1.44 ± 0",
        ];
        let mut arguments = vec!["--set", &force];
        for setting in known {
            arguments.extend(["--set", setting]);
        }
        let band = &ensemble(folder.path(), "2", &arguments)["results"]["damage_percent"];
        band["p95"].as_f64().unwrap() - band["p05"].as_f64().unwrap()
    };
    let (narrow, wide) = (wide("5"), wide("20"));
    assert!((wide / narrow - 4.0).abs() < 0.5, "{}", wide / narrow);
}

#[test]
fn an_interrupted_ensemble_prints_what_is_done_and_ends_with_130() {
    let folder = tempfile::tempdir().unwrap();
    let child = program(folder.path())
        .args(["ensemble", "paper-300n", "--samples", "60000", "--json"])
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    thread::sleep(Duration::from_millis(1500));
    let interrupt = Command::new("kill").args(["-INT", &child.id().to_string()]).status();
    assert!(interrupt.unwrap().success());
    let output = child.wait_with_output().unwrap();
    assert_eq!(output.status.code(), Some(130));
    assert!(text(&output.stderr).contains("interrupted"));
    let object: Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!(object["stopped"], true);
    let done = object["samples"].as_u64().unwrap();
    assert!((1..60000).contains(&done), "{done}");
}

#[test]
fn bad_doubts_and_numbers_of_samples_are_refused_with_2() {
    let folder = tempfile::tempdir().unwrap();
    let file = "(name: \"a\",\n impact: ForcePulse(force_n: 300.0),\n doubt: {\"impact.force_n\": -3.0})\n";
    fs::write(folder.path().join("bad.ron"), file).unwrap();
    for (arguments, word) in [
        (&["ensemble", "paper-300n", "--samples", "7"][..], "allowed 8 to 65536"),
        (&["ensemble", "paper-300n", "--samples", "65537"], "allowed 8 to 65536"),
        (&["ensemble", "paper-300n", "--drives", "damge"], "damage_percent"),
        (
            &["ensemble", "paper-300n", "--set", "impact.force_n=300 +- x"],
            "allowed ± 0 to 100000 N",
        ),
        (
            &["run", "bad.ron"],
            "bad.ron:3:28: doubt.impact.force_n: ± -3 is out of range: allowed ± 0 to 100000 N",
        ),
    ] {
        let output = run(folder.path(), arguments);
        assert_eq!(output.status.code(), Some(2), "{arguments:?}");
        assert!(text(&output.stderr).contains(word), "{}", text(&output.stderr));
    }
}

/// The rows of a sweep over sides of a free eye, which is quick, by the names of their columns.
fn sides(folder: &Path, axes: [&str; 2]) -> Vec<Value> {
    let free = ["sweep", "bb-62", "--set", "support=Free", "--set", "window_ms=0.02"];
    let vary = axes.iter().flat_map(|axis| ["--vary", axis]);
    let arguments: Vec<&str> = free.into_iter().chain(vary).chain(["--json"]).collect();
    let output = run(folder, &arguments);
    assert!(output.status.success(), "{}", text(&output.stderr));
    let rows = text(&output.stdout);
    rows.lines().skip(1).map(|line| serde_json::from_str(line).unwrap()).collect()
}

#[test]
fn rows_say_side_and_hour_and_are_the_same_whichever_axis_is_first() {
    let folder = tempfile::tempdir().unwrap();
    let (angles, hours) = ("impact.angle_deg=-30,30", "impact.angle_clock=3:00,9:00");
    let (one, other) =
        (sides(folder.path(), [angles, hours]), sides(folder.path(), [hours, angles]));
    let hour = |row: &Value| row["direction"]["hour"].as_str().unwrap().to_owned();
    assert_eq!(one.iter().map(hour).collect::<Vec<_>>(), ["9", "3", "3", "9"]);
    for (row, same) in [(0, 0), (1, 2), (2, 1), (3, 3)] {
        assert_eq!(one[row]["results"], other[same]["results"]);
    }
    assert_eq!(one[0]["results"], one[3]["results"]);
    let eyes = sides(folder.path(), ["impact.from=Temple", "model.eye_side=Right,Left"]);
    for (row, (eye, hour)) in eyes.iter().zip([("Right", "9"), ("Left", "3")]) {
        let said = serde_json::json!({ "eye_side": eye, "from": "Temple", "hour": hour });
        assert_eq!(row["direction"], said);
    }
}
