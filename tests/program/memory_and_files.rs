//! Files of any size and readers that do not read take little memory, and what is interrupted
//! leaves nothing behind.
#![cfg(unix)]

use std::fs::{self, File};
use std::os::unix::fs::symlink;
use std::os::unix::process::ExitStatusExt;
use std::path::Path;
use std::process::{Child, Command, Output, Stdio};
use std::thread::sleep;
use std::time::{Duration, Instant};

use crate::program::program;

const PATIENCE: Duration = Duration::from_secs(60);

/// Runs the program under limits of the shell, as in `ulimit -d 200000`.
fn limited(limits: &str, arguments: &[&str]) -> Command {
    let mut command = Command::new("sh");
    command
        .arg("-c")
        .arg(format!("{limits}; exec \"$0\" \"$@\""))
        .arg(env!("CARGO_BIN_EXE_contrecoup"))
        .args(arguments)
        .env("XDG_CONFIG_HOME", "/nonexistent");
    command
}

fn names(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).unwrap();
    let mut names: Vec<String> =
        entries.map(|e| e.unwrap().file_name().into_string().unwrap()).collect();
    names.sort();
    names
}

fn failed(output: &Output, code: i32, words: &str) {
    let said = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(code), "{said}");
    assert!(said.contains(words), "{said}");
}

const SWEEP: [&str; 4] = ["sweep", "paper-300n", "--vary", "impact.force_n=1:100:5"];

#[test]
fn a_huge_file_of_something_else_is_refused_by_its_first_bytes() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("huge.csv");
    // Holes take no disk; reading them would take 8 GB of memory.
    File::create(&path).unwrap().set_len(8 << 30).unwrap();
    let out = ["--out", path.to_str().unwrap()];
    let refused = limited("ulimit -d 200000", &[&SWEEP[..], &out].concat()).output().unwrap();
    failed(&refused, 2, "holds something else");
    assert_eq!(path.metadata().unwrap().len(), 8 << 30);

    // The right heading, then one endless line.
    let sound = folder.path().join("sound.csv");
    let out = ["--out", sound.to_str().unwrap()];
    program(&[&SWEEP[..], &out].concat()).assert().success();
    File::options().write(true).open(&sound).unwrap().set_len(8 << 30).unwrap();
    let refused = limited("ulimit -d 200000", &[&SWEEP[..], &out].concat()).output().unwrap();
    failed(&refused, 2, "line 8");
}

#[test]
fn the_largest_export_takes_less_than_200_mb() {
    // 14,641 nodes in a thousand frames: kept in memory these are 350 MB.
    let arguments = [
        "export",
        "paper-300n",
        "--level=8",
        "--frames=/dev/null",
        "--every-us=0.2",
        "--set=window_ms=0.2",
        "--set=impact.duration_ms=0.1",
        "--integrator=semi-implicit-euler",
    ];
    let output = limited("ulimit -d 200000", &arguments).output().unwrap();
    let said = String::from_utf8_lossy(&output.stdout);
    assert!(output.status.success(), "{output:?}");
    assert!(said.contains("1001 frames"), "{said}");
}

#[test]
fn rows_that_nobody_reads_hold_the_work_up() {
    let arguments = [
        "sweep",
        "paper-300n",
        "--vary",
        "impact.force_n=0:1:20001",
        "--vary",
        "window_ms=0.01,0.011",
    ];
    let arguments =
        [&arguments[..], &["--set", "impact.duration_ms=0.01", "--step-us", "5"]].concat();
    let mut child = Command::new(env!("CARGO_BIN_EXE_contrecoup"))
        .args(arguments)
        .stdout(Stdio::piped())
        .spawn()
        .unwrap();
    let ticks = |child: &Child| {
        let stat = fs::read_to_string(format!("/proc/{}/stat", child.id())).unwrap();
        let fields: Vec<&str> = stat.rsplit(')').next().unwrap().split(' ').collect();
        fields[12].parse::<u64>().unwrap() + fields[13].parse::<u64>().unwrap()
    };
    // Until the work stands still: all 40,002 rows would be far more.
    let begun = Instant::now();
    let mut before = u64::MAX;
    while ticks(&child) != before || before < 2 {
        before = ticks(&child);
        sleep(Duration::from_millis(700));
        assert!(begun.elapsed() < PATIENCE);
    }
    assert!(child.try_wait().unwrap().is_none(), "it waits for its reader");
    let used = ticks(&child);
    assert!(used < 1500, "{used} ticks for a thousand rows");
    child.kill().unwrap();
    child.wait().unwrap();
}

#[test]
fn an_interrupted_export_leaves_no_file_and_a_killed_one_goes_at_the_next() {
    let folder = tempfile::tempdir().unwrap();
    let target = folder.path().join("frames.csv");
    let start = || {
        let mut command = Command::new(env!("CARGO_BIN_EXE_contrecoup"));
        let arguments = ["export", "paper-300n", "--level=8", "--every-us=1", "--frames"];
        command.args(arguments).arg(&target).stderr(Stdio::piped());
        let mut child = command.spawn().unwrap();
        let begun = Instant::now();
        while names(folder.path()).is_empty() {
            assert!(begun.elapsed() < PATIENCE && child.try_wait().unwrap().is_none());
            sleep(Duration::from_millis(5));
        }
        child
    };
    let tell = |child: &Child, signal: &str| {
        let status = Command::new("kill").args([signal, &child.id().to_string()]).status();
        assert!(status.unwrap().success());
    };
    for signal in ["-TERM", "-HUP", "-INT"] {
        let child = start();
        tell(&child, signal);
        let output = child.wait_with_output().unwrap();
        failed(&output, 130, "interrupted: nothing was written");
        assert_eq!(names(folder.path()), [""; 0], "{signal}");
    }
    let child = start();
    tell(&child, "-KILL");
    assert_eq!(child.wait_with_output().unwrap().status.signal(), Some(9));
    assert_eq!(names(folder.path()).len(), 1);
    let traces = folder.path().join("traces.csv");
    program(&["export", "paper-300n", "--traces", traces.to_str().unwrap()]).assert().success();
    assert_eq!(names(folder.path()), ["traces.csv"]);
}

#[test]
fn two_outputs_on_one_file_are_refused_however_it_is_written() {
    let folder = tempfile::tempdir().unwrap();
    fs::create_dir(folder.path().join("d")).unwrap();
    fs::write(folder.path().join("b.csv"), "old").unwrap();
    symlink("b.csv", folder.path().join("link.csv")).unwrap();
    for (frames, traces) in [
        ("a.csv", "a.csv"),
        ("a.csv", "./a.csv"),
        ("a.csv", "d/../a.csv"),
        ("b.csv", "link.csv"),
        ("/dev/stdout", "/dev/./stdout"),
    ] {
        let arguments = ["export", "paper-300n", "--frames", frames, "--traces", traces];
        let mut command = program(&arguments);
        let output = command.current_dir(folder.path()).output().unwrap();
        failed(&output, 2, "name the same file");
    }
    assert_eq!(fs::read_to_string(folder.path().join("b.csv")).unwrap(), "old");
}

#[test]
fn a_full_disk_and_a_limit_on_files_give_a_message_and_a_code() {
    let folder = tempfile::tempdir().unwrap();
    let file = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    let (export, sweep, page) = (file("x.csv"), file("y.csv"), file("p.html"));
    let report = ["report", "paper-300n", "-o", &page];
    let export = ["export", "paper-300n", "--traces", &export];
    let sweep = [&SWEEP[..], &["--out", &sweep]].concat();
    // A block of 512 bytes is less than either writes.
    for (arguments, name) in [(&export[..], "x.csv"), (&sweep, "y.csv"), (&report, "p.html")] {
        let output = limited("ulimit -f 1", arguments).output().unwrap();
        failed(&output, 1, name);
        failed(&output, 1, "large");
    }
    let run = ["run", "paper-300n"];
    let printed = File::create(file("z.txt")).unwrap();
    let output = limited("ulimit -f 1", &run).stdout(printed).output().unwrap();
    failed(&output, 1, "cannot write the output");
    if let Ok(full) = File::options().write(true).open("/dev/full") {
        let output = limited("true", &run).stdout(full).output();
        failed(&output.unwrap(), 1, "cannot write the output");
    }
}

#[test]
fn thousands_of_presets_are_listed_without_holding_their_texts() {
    let config = tempfile::tempdir().unwrap();
    let presets = config.path().join("contrecoup/presets");
    fs::create_dir_all(&presets).unwrap();
    let text =
        "(name: \"Mine\", impact: ForcePulse(force_n: 42))\n//".to_owned() + &"x".repeat(60_000);
    fs::write(presets.join("p0.ron"), text).unwrap();
    for i in 1..4000 {
        fs::hard_link(presets.join("p0.ron"), presets.join(format!("p{i}.ron"))).unwrap();
    }
    // All texts together are 240 MB.
    let mut command = limited("ulimit -d 100000", &["presets", "--json"]);
    let output = command.env("XDG_CONFIG_HOME", config.path()).output().unwrap();
    assert!(output.status.success(), "{output:?}");
    assert!(String::from_utf8_lossy(&output.stdout).contains("\"p3999\""));
}

#[cfg(target_os = "linux")]
#[test]
fn a_sample_of_an_ensemble_keeps_less_than_2_kb() {
    let sampled = |count: &str| {
        let short = ["ensemble", "paper-300n", "--set", "window_ms=0.05", "--samples", count];
        let mut child = Command::new(env!("CARGO_BIN_EXE_contrecoup"))
            .args(short)
            .stdout(Stdio::piped())
            .env("RAYON_NUM_THREADS", "2")
            .spawn()
            .unwrap();
        // It prints less than a pipe holds, so it is looked at when it has done so and is no more.
        let mut most = 0;
        while child.try_wait().unwrap().is_none() {
            let status = fs::read_to_string(format!("/proc/{}/status", child.id()));
            let peak = status.unwrap_or_default();
            let peak = peak.lines().find_map(|line| line.strip_prefix("VmHWM:").map(str::to_owned));
            let peak = peak.and_then(|kb| kb.trim().trim_end_matches(" kB").parse::<u64>().ok());
            most = most.max(peak.unwrap_or(0));
            sleep(Duration::from_millis(5));
        }
        most
    };
    let (few, many) = (sampled("500"), sampled("4000"));
    assert!(few > 1000 && many < few + 7000, "{few} kB of 500 samples, {many} kB of 4000");
}
