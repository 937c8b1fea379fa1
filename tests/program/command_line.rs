//! The program as a shell sees it: what it prints, where, and how it ends.

use crate::program;
use std::fs;
use std::io::Read;
use std::path::Path;
use std::process::Stdio;

use assert_cmd::Command;
use predicates::prelude::*;
use predicates::str::{contains, is_empty, starts_with};
use tempfile::TempDir;

const OWN: &str = "// Mine.\n(name: \"My own blow\", impact: ForcePulse(force_n: 42))\n";

/// The program with a configuration folder of its own, so that no test sees a person's presets.
fn program(config: &Path) -> Command {
    let mut command = Command::cargo_bin("contrecoup").unwrap();
    command.env("XDG_CONFIG_HOME", config).env("HOME", config);
    command
}

fn config_with(presets: &[(&str, &str)]) -> TempDir {
    let config = tempfile::tempdir().unwrap();
    let folder = config.path().join("contrecoup/presets");
    fs::create_dir_all(&folder).unwrap();
    for (name, text) in presets {
        fs::write(folder.join(name), text).unwrap();
    }
    config
}

/// Runs the program with no presets of one's own.
fn run(arguments: &[&str]) -> assert_cmd::assert::Assert {
    program(config_with(&[]).path()).args(arguments).assert()
}

#[test]
fn help_and_version_go_to_standard_output() {
    run(&["--help"]).success().stdout(contains("Research and education, not diagnosis.").count(1));
    let kernel = program::json(&["run", "paper-300n"])["numerics"]["kernel"].clone();
    let kernel = format!("kernel {})", kernel.as_str().unwrap());
    run(&["--version"]).success().stdout(
        starts_with(format!("contrecoup {} (commit ", env!("CARGO_PKG_VERSION")))
            .and(contains(kernel)),
    );
    run(&["generate", "man"]).success().stdout(contains("kernel ").not());
}

#[test]
fn without_a_command_it_says_what_to_run() {
    run(&[]).code(2).stdout(is_empty()).stderr(contains("contrecoup run paper-300n"));
}

#[test]
fn wrong_usage_ends_with_2() {
    for arguments in [
        &["jump"][..],
        &["run"],
        &["run", "paper-300n", "--set", "level"],
        &["export", "paper-300n"],
    ] {
        run(arguments).code(2).stdout(is_empty());
    }
    run(&["export", "paper-300n", "--traces", "x", "--every-us", "0"])
        .code(2)
        .stderr(contains("above 0"));
}

#[test]
fn presets_are_listed_with_their_titles() {
    run(&["presets"]).success().stdout(
        contains("paper-300n ").and(contains("300 N for 0.2 ms")).and(contains("yours").not()),
    );
    let json = run(&["presets", "--json"]).success().get_output().stdout.clone();
    let rows: serde_json::Value = serde_json::from_slice(&json).unwrap();
    let names: Vec<_> =
        rows.as_array().unwrap().iter().map(|row| row["name"].as_str().unwrap()).collect();
    assert!(names.len() >= 10 && names.is_sorted(), "{names:?}");
}

#[test]
fn the_settings_are_printed_and_a_file_that_is_refused_ends_with_2() {
    let config = config_with(&[]);
    let settings = || program(config.path()).arg("config").assert();
    let printed = settings().success().stdout(contains("where it is there"));
    let printed = printed.get_output().stdout.clone();
    let file = config.path().join("contrecoup/config.ron");
    fs::write(&file, &printed).unwrap();
    settings().success().stdout(contains("Read at every start"));
    // What is sent into the file that it reads finds it empty.
    fs::write(&file, "").unwrap();
    settings().success().stdout(printed);
    fs::write(&file, "(\n fps: 99,\n keys: (undo: \"s\"),\n)").unwrap();
    settings()
        .code(2)
        .stdout(is_empty())
        .stderr(contains("config.ron:2:7: fps: 99 is out of range: allowed whole numbers 1 to 60"));
}

#[test]
fn a_threshold_is_found_and_a_question_without_sense_ends_with_2() {
    let until = ["--until", "peak_scleral_stress_mpa = 17"];
    let vary = ["threshold", "bb-56", "--vary", "impact.speed_m_s"];
    let json = program::json(&[&vary[..], &until].concat());
    let at = json["crossings"][0]["at"].as_f64().unwrap();
    assert!((40.0..80.0).contains(&at), "{json}");
    assert_eq!(json["crossings"].as_array().unwrap().len(), 1);
    run(&["threshold", "bb-56", "--vary", "impact.speeed", until[0], until[1]]).code(2).stderr(
        starts_with("--vary impact.speeed: there is no such field").and(contains("speed_m_s")),
    );
    run(&[&vary[..], &["--until", "rupture=50"]].concat())
        .code(2)
        .stderr(starts_with("--until").and(contains("globe_rupture_percent")));
}

#[test]
fn a_preset_is_shown_as_it_stands() {
    run(&["presets", "show", "paper-300n"])
        .success()
        .stdout(include_str!("../../presets/paper-300n.ron"));
}

#[test]
fn an_unknown_preset_leads_to_the_nearest() {
    for arguments in [&["presets", "show", "paper-30n"], &["run", "paper-30n", "--json"]] {
        run(arguments).code(2).stderr(contains("did you mean").and(contains("paper-300n")));
    }
    run(&["presets", "show", "../../etc/passwd"]).code(2).stderr(contains("holds no path"));
    run(&["run", ".."]).code(2);
    run(&["run", "\u{1b}[31m"]).code(2).stderr(contains("\u{1b}").not());
}

#[test]
fn a_preset_of_ones_own_takes_the_place_of_a_built_in_one() {
    let config =
        config_with(&[("paper-300n.ron", OWN), ("own.ron", OWN), ("notes.txt", "no preset")]);
    let listed = program(config.path()).arg("presets").assert().success();
    listed.stdout(
        contains("My own blow  (yours)")
            .count(2)
            .and(contains("300 N for 0.2 ms\n").not())
            .and(contains("notes").not()),
    );
    program(config.path()).args(["presets", "show", "paper-300n"]).assert().success().stdout(OWN);
}

#[test]
fn a_broken_preset_is_listed_with_its_error_and_leaves_the_others_alone() {
    let config = config_with(&[("broken.ron", "(name: 3)"), ("paper-300n.ron", "(")]);
    fs::create_dir(config.path().join("contrecoup/presets/folder.ron")).unwrap();
    program(config.path()).arg("presets").assert().success().stdout(
        contains("broken.ron:1:8: name: 3 is not text")
            .and(contains("paper-100n"))
            .and(contains("is a directory")),
    );
    program(config.path())
        .args(["run", "paper-300n"])
        .assert()
        .code(2)
        .stderr(contains("paper-300n.ron:1:2"));
    program(config.path())
        .args(["presets", "show", "broken"])
        .assert()
        .success()
        .stdout("(name: 3)");
}

#[test]
fn files_and_presets_are_told_apart() {
    let config = config_with(&[]);
    let file = config.path().join("blow.ron");
    fs::write(&file, "(name: \"x\", impact: ForcePulse(force_n: -5))").unwrap();
    program(config.path())
        .current_dir(config.path())
        .args(["run", "blow.ron"])
        .assert()
        .code(2)
        .stderr("blow.ron:1:41: impact.force_n: -5 is out of range: allowed 0 to 100000 N\n");
    run(&["run", "none.ron"]).code(2).stderr("none.ron: there is no such file\n");
    run(&["run", "./paper-300n"]).code(2).stderr(contains("there is no such file"));
}

#[test]
fn a_tolerance_takes_no_level_under_any_name() {
    for set in ["eye.level=3", "level=3", "eye=(level: 3)", "step_us=1"] {
        run(&["run", "paper-300n", "--tolerance", "50", "--set", set])
            .code(2)
            .stderr(contains("--tolerance chooses mesh level"));
    }
}

#[test]
fn flags_are_refused_in_the_words_of_the_registry() {
    let refused = |flags: &[&str], words: &str| {
        let arguments = [&["run", "paper-300n"], flags].concat();
        run(&arguments).code(2).stdout(is_empty()).stderr(starts_with(words.to_owned()));
    };
    refused(
        &["--set", "impact.force_n=abc"],
        "--set impact.force_n=abc: abc is not a number: allowed 0 to 100000 N\n",
    );
    refused(
        &["--set", "impact.force_n=-1"],
        "--set impact.force_n=-1: -1 is out of range: allowed 0 to",
    );
    refused(&["--set", "eye=(level: 9)"], "--set eye=(level: 9): eye.level: 9 is out of range");
    refused(
        &["--set", "farce_n=1"],
        "--set farce_n=1: there is no such field; did you mean impact.force_n?",
    );
    // Wherever only one field fits, its end is enough; a refusal has the whole path.
    refused(
        &["--set", "force=-1"],
        "--set force=-1: impact.force_n: -1 is out of range: allowed 0 to",
    );
    refused(
        &["--set", "speed=45"],
        "--set speed=45: impact.speed_m_s: impact is ForcePulse, which has no speed_m_s",
    );
    refused(
        &["--set", "fat=3"],
        "--set fat=3: fits several fields: eye.fat_kpa, eye.fat_drag_ns_m\n",
    );
    refused(
        &["--set", "doubt={\"window_ms\": 0.1, \"window_ms\": 0.2}"],
        "--set doubt={\"window_ms\": 0.1, \"window_ms\": 0.2}: window_ms is given twice\n",
    );
    refused(&["--level", "9"], "--level 9: 9 is out of range: allowed whole numbers 1 to 8");
    refused(&["--level", "-1"], "--level -1: -1 is not a whole number");
    refused(
        &["--integrator", "leapfrog"],
        "--integrator leapfrog: leapfrog is not known here: allowed Auto",
    );
    refused(
        &["--integrator", "verlet"],
        "--integrator verlet: verlet is not known here (did you mean VelocityVerlet?): allowed Auto",
    );
    // What nobody has set is not to blame: the step is as long as the stiffest spring lets it be.
    refused(
        &["--level", "8", "--set", "window=1000", "--set", "eye.sclera_kpa=1e8"],
        "window_ms: 1000 would take ",
    );
    refused(
        &["--step-us", "1e-6"],
        "numerics.step_us: 0.000001 would take 3.000e9 steps, too many for half an hour: allowed from ",
    );
    refused(
        &["--set", "eye.sclera_kpa=1e8", "--step-us", "1", "--level", "8"],
        "numerics.step_us: 1 is above the stability limit of srkn6b on this mesh: allowed up to 0.00",
    );
    refused(&["--step-us", "0"], "--step-us 0: 0 is out of range: allowed Auto, or");
    refused(
        &["--set", "impact.angle_deg=60"],
        "paper-300n, as the flags change it, cannot be computed: impact.angle_deg: 60 is out of range, since bone",
    );
    refused(&["--level", "0"], "--level 0: 0 is out of range: allowed whole numbers 1 to 8");
    refused(
        &["--set", "model=Physiological", "--level", "0"],
        "--level 0: 0 is out of range: allowed whole numbers 1 to 5",
    );
}

#[test]
fn completions_and_manual_pages_are_printed() {
    for shell in ["bash", "zsh", "fish", "elvish", "powershell"] {
        run(&["generate", "completions", shell]).success().stdout(contains("contrecoup"));
    }
    run(&["generate", "completions", "cmd"]).code(2);
    run(&["generate", "man"]).success().stdout(contains(".TH contrecoup 1"));
    run(&["generate", "man", "run"])
        .success()
        .stdout(contains("contrecoup\\-run").and(contains("\\-\\-set")));
    run(&["generate", "man", "jump"]).code(2).stderr(contains("there is no such command"));
}

#[test]
fn one_line_installs_manual_pages_and_completions() {
    let folder = tempfile::tempdir().unwrap();
    let into = folder.path().join("share");
    let into = into.to_str().unwrap();
    for _ in 0..2 {
        run(&["generate", "into", into]).success().stdout(contains("man/man1/contrecoup-run.1"));
    }
    for (file, words) in [
        ("man/man1/contrecoup.1", ".TH contrecoup 1"),
        ("man/man1/contrecoup-compare.1", "FIELD=VALUE"),
        ("bash-completion/completions/contrecoup", "complete -F"),
        ("zsh/site-functions/_contrecoup", "#compdef contrecoup"),
        ("fish/vendor_completions.d/contrecoup.fish", "complete -c contrecoup"),
    ] {
        let text = fs::read_to_string(format!("{into}/{file}")).unwrap();
        assert!(text.contains(words), "{file}");
    }
    run(&["generate", "into", "/dev/null"]).code(1).stderr(contains("cannot write"));
}

#[test]
fn a_reader_that_stops_early_is_no_failure() {
    for arguments in [
        &["generate", "completions", "zsh"][..],
        &["presets", "--json"],
        &["generate", "man"],
        &["--help"],
    ] {
        let config = config_with(&[]);
        let mut child = std::process::Command::new(assert_cmd::cargo::cargo_bin!("contrecoup"))
            .args(arguments)
            .env("XDG_CONFIG_HOME", config.path())
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .unwrap();
        drop(child.stdout.take());
        let mut said = String::new();
        child.stderr.take().unwrap().read_to_string(&mut said).unwrap();
        assert!(child.wait().unwrap().success(), "{arguments:?}");
        assert_eq!(said, "", "{arguments:?}");
    }
}

#[cfg(target_os = "linux")]
#[test]
fn a_standard_output_that_is_closed_is_a_failure() {
    let contrecoup = env!("CARGO_BIN_EXE_contrecoup");
    let shell = |line: &str| {
        let mut shell = std::process::Command::new("sh");
        shell.args(["-c", line, contrecoup]).env("XDG_CONFIG_HOME", "/nonexistent");
        shell.output().unwrap()
    };
    for command in ["run paper-300n --quick", "presets", "guide model", "generate man"] {
        let lost = shell(&format!("\"$0\" {command} >&-"));
        let said = String::from_utf8_lossy(&lost.stderr).into_owned();
        assert_eq!(lost.status.code(), Some(1), "{command}: {said}");
        assert_eq!(said, "error: cannot write the output: it is closed\n", "{command}");
        // Who throws it away has asked for that.
        assert!(shell(&format!("\"$0\" {command} > /dev/null")).status.success());
        assert!(shell(&format!("\"$0\" {command} 1<> /dev/null")).status.success());
    }
    assert_eq!(shell("\"$0\" --help >&-").status.code(), Some(1));
    assert_eq!(shell("\"$0\" --no-such-flag >&-").status.code(), Some(2));
}

#[test]
fn a_share_of_eyes_beyond_100_percent_is_never_looked_for() {
    run(&["threshold", "bb-62", "--until", "globe_rupture_percent = 150"])
        .code(2)
        .stdout(is_empty())
        .stderr(contains("150 is beyond 100 %").and(contains("allowed 0 to 100 %")));
}
