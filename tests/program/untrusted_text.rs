//! Text that somebody else wrote never does anything to a terminal, and never floods it.

use crate::program;
use std::fs;
use std::io::Read;
use std::path::Path;
use std::process::Output;

use portable_pty::{CommandBuilder, PtySize, native_pty_system};
use tempfile::TempDir;

/// Escape, C1, DEL, bidirectional, zero width, byte order mark and tag characters.
const HOSTILE: &str =
    "\u{1b}[31m\u{9b}2J\u{7f}\u{61c}\u{202e}\u{2066}\u{200b}\u{ad}\u{feff}\u{e0041}";

fn config_with(presets: &[(&str, &str)]) -> TempDir {
    let config = tempfile::tempdir().unwrap();
    let folder = config.path().join("contrecoup/presets");
    fs::create_dir_all(&folder).unwrap();
    for (name, text) in presets {
        fs::write(folder.join(name), text).unwrap();
    }
    config
}

fn run(config: &Path, arguments: &[&str]) -> Output {
    let mut command = program::program(arguments);
    command.env("XDG_CONFIG_HOME", config).current_dir(config);
    command.output().unwrap()
}

/// Everything that is said, which must be safe.
fn said(output: &Output) -> String {
    let both = [&output.stdout[..], &output.stderr].concat();
    let text = String::from_utf8(both).unwrap();
    let bad = |c: &char| {
        *c != '\n' && HOSTILE.chars().chain(['\r']).any(|h| h == *c) && !"[31m2J".contains(*c)
    };
    let found: Vec<char> = text.chars().filter(bad).collect();
    assert!(found.is_empty(), "{found:?} in {text:?}");
    text
}

const OWN: &str = "(name: \"Mine\", impact: ForcePulse(force_n: 42))";

#[test]
fn a_preset_is_shown_verbatim_to_a_program_and_safely_on_a_terminal() {
    let text = format!("// {HOSTILE}\n{OWN}\n");
    let config = config_with(&[("mine.ron", &text)]);
    let shown = run(config.path(), &["presets", "show", "mine"]);
    assert_eq!(shown.stdout, text.as_bytes());

    let size = PtySize { rows: 24, cols: 200, pixel_width: 0, pixel_height: 0 };
    let pty = native_pty_system().openpty(size).unwrap();
    let mut command = CommandBuilder::new(env!("CARGO_BIN_EXE_contrecoup"));
    command.args(["presets", "show", "mine"]);
    command.env("XDG_CONFIG_HOME", config.path());
    let mut child = pty.slave.spawn_command(command).unwrap();
    drop(pty.slave);
    let mut bytes = Vec::new();
    let mut reader = pty.master.try_clone_reader().unwrap();
    // The end of a pty may come as an error.
    let _ = reader.read_to_end(&mut bytes);
    assert!(child.wait().unwrap().success());
    let seen = String::from_utf8(bytes).unwrap().replace("\r\n", "\n");
    assert!(seen.contains("\\u{1b}[31m\\u{9b}2J\\u{7f}\\u{61c}\\u{202e}"), "{seen:?}");
    assert!(seen.contains("force_n: 42"));
    assert!(!seen.chars().any(|c| HOSTILE.contains(c) && !c.is_ascii_graphic()), "{seen:?}");
}

#[test]
fn file_names_are_safe_in_lists_and_messages() {
    let file = format!("a{}.ron", HOSTILE.replace('/', ""));
    let config = config_with(&[(&file, OWN)]);
    let list = run(config.path(), &["presets"]);
    assert!(said(&list).contains("\\u{202e}"));
    let json = run(config.path(), &["presets", "--json"]);
    assert!(said(&json).contains("\\u202e"));
    let rows: serde_json::Value = serde_json::from_slice(&json.stdout).unwrap();
    let names = rows.as_array().unwrap().iter().map(|row| row["name"].as_str().unwrap());
    assert!(names.into_iter().any(|name| format!("{name}.ron") == file));

    let name = file.strip_suffix(".ron").unwrap();
    for form in ["--csv", "--md", "--json"] {
        let table = run(config.path(), &["compare", name, "paper-300n", form]);
        assert!(table.status.success());
        assert!(said(&table).contains("202e}") || form == "--json");
    }
    let page = format!("r{HOSTILE}.md");
    let report = run(config.path(), &["report", name, "-o", &page]);
    assert!(said(&report).contains("\\u{202e}"));
    assert!(config.path().join(&page).exists());

    let traces = format!("t{HOSTILE}.csv");
    let export = run(config.path(), &["export", "paper-300n", "--traces", &traces]);
    assert!(export.status.success());
    assert!(said(&export).contains("\\u{202e}"));
    assert!(config.path().join(&traces).exists());
    let nowhere = format!("no{HOSTILE}/x.csv");
    said(&run(config.path(), &["export", "paper-300n", "--traces", &nowhere]));
    said(&run(
        config.path(),
        &["sweep", "paper-300n", "--vary", "impact.force_n=1,2", "--out", &nowhere],
    ));
}

#[test]
fn arguments_are_safe_in_what_the_parser_of_arguments_says() {
    let config = config_with(&[]);
    for arguments in [
        &["run", "paper-300n", HOSTILE][..],
        &["run", "paper-300n", "--set", HOSTILE],
        &["run", HOSTILE],
        &["run", "paper-300n", "--level", HOSTILE],
        &["tui", HOSTILE],
        &[HOSTILE],
        &["generate", "man", HOSTILE],
        &["presets", "show", HOSTILE],
        &["sweep", "paper-300n", "--vary", HOSTILE],
        &["ensemble", "paper-300n", "--drives", HOSTILE],
    ] {
        let output = run(config.path(), arguments);
        assert_eq!(output.status.code(), Some(2), "{arguments:?}");
        said(&output);
    }
}

#[test]
fn messages_are_bounded_and_say_how_much_they_leave_out() {
    let config = config_with(&[]);
    let long = "x".repeat(60_000);
    let write = |name: &str, text: &str| {
        let path = config.path().join(name);
        fs::write(&path, text).unwrap();
        path.to_str().unwrap().to_owned()
    };
    let field = write("field.ron", &format!("({long}: 1)"));
    let wrong: Vec<String> = (0..5000).map(|i| format!("\"a{i}\":1")).collect();
    let wrong = wrong.join(",");
    let doubts =
        write("doubts.ron", &format!("(name: \"a\", impact: ForcePulse(), doubt: {{{wrong}}})"));
    let set = format!("impact=({}", "force_n: 1, ".repeat(9_000));
    for (arguments, cut) in [
        (vec!["run", &field], "characters more"),
        (vec!["run", &doubts], "and 4980 more like these"),
        (vec!["run", "paper-300n", "--set", &set], "characters more"),
        (vec!["run", "paper-300n", "--set", &long], "characters more"),
        (vec!["run", "paper-300n", &long], "characters more"),
        (vec!["sweep", "paper-300n", "--vary", &long], "characters more"),
    ] {
        let output = run(config.path(), &arguments);
        assert_eq!(output.status.code(), Some(2));
        let text = said(&output);
        assert!(text.len() < 6_000, "{} bytes", text.len());
        assert!(text.contains(cut), "{text}");
    }
}

#[test]
fn an_own_preset_opens_by_any_name_that_its_file_suggests() {
    let config = config_with(&[("mine.ron", OWN), ("odd.ron.ron", OWN), ("-rf.ron", OWN)]);
    for arguments in
        [&["run", "mine.ron"][..], &["run", "odd.ron"], &["run", "mine"], &["run", "--", "-rf"]]
    {
        let output = run(config.path(), arguments);
        assert!(output.status.success(), "{arguments:?}: {output:?}");
    }
    // A file of that name in the folder one works in comes first.
    fs::write(config.path().join("mine.ron"), "(").unwrap();
    assert_eq!(run(config.path(), &["run", "mine.ron"]).status.code(), Some(2));
}

#[test]
fn names_are_no_formulas_in_a_table_and_no_links_on_a_page() {
    let named = OWN.replacen("name: \"", "name: \"=cmd|' /C calc'!A0 ![x](http://a.example) ", 1);
    let config = config_with(&[("mine.ron", &named)]);
    let compared = |form: &str| {
        let output = run(config.path(), &["compare", "mine", "paper-100n", form]);
        assert!(output.status.success());
        String::from_utf8(output.stdout).unwrap()
    };
    let csv = compared("--csv");
    assert!(csv.contains("'=cmd"), "{csv}");
    assert!(!csv.contains(",=") && !csv.contains(",\"="), "{csv}");
    let report = run(config.path(), &["report", "mine", "-o", "mine.md"]);
    assert!(report.status.success());
    let page = fs::read_to_string(config.path().join("mine.md")).unwrap();
    for text in [page, compared("--md")] {
        assert!(!text.contains("x](") && !text.contains("http://a"), "{text}");
    }
}
