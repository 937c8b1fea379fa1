//! The app in a terminal: a pty, real keys, real signals.

use std::fs;
use std::thread;
use std::time::Duration;

use crate::pty::{RIGHT, Replies, Term, UP, app, started};

#[test]
fn the_first_screen_answers_the_question() {
    let term = Term::start(app(&["tui", "paper-300n"]));
    for text in [
        "damage 26 %",
        "Peak force",
        "300 N",
        "centre",
        "N ±",
        "of 1.5 %",
        "Errors of",
        "Paper model, unit depth",
        "Not a diagnosis",
        "q quit",
    ] {
        term.wait_for(text);
    }
    let is_braille = |c: char| ('\u{2801}'..='\u{28ff}').contains(&c);
    assert!(term.text().contains(is_braille), "no mesh");
}

#[test]
fn every_edit_simulates_at_once_and_can_be_undone_and_redone() {
    let term = started();
    term.keys(RIGHT);
    term.wait_for("310 N");
    term.wait_without("damage 26 %");
    term.keys("u");
    term.wait_for("damage 26 %");
    term.keys("r");
    term.wait_for("310 N");
    term.keys("\x1b[1;2C");
    term.wait_for("400 N");
}

#[test]
fn a_typed_value_is_taken_restored_or_explained() {
    let term = started();
    term.keys("\r\x15450\r");
    term.wait_for("450 N");
    term.wait_without("damage 26 %");
    term.keys("u");
    term.wait_for("damage 26 %");
    // What is typed changes nothing until it is accepted, and Escape restores.
    term.keys("\r\x1560");
    term.wait_for("Esc restore");
    assert!(term.text().contains("damage 26 %"));
    term.keys("\x1b");
    term.wait_for("300 N");
    term.keys("\r\x15-5");
    term.wait_for("-5 is out of range");
    term.keys("\r");
    term.wait_for("Esc restore");
    assert!(term.text().contains("damage 26 %"));
    term.keys("\x1b");
    term.wait_without("out of range");
    // Pasted text goes into the field.
    term.keys("\r\x15\x1b[200~250\x1b[201~\r");
    term.wait_for("250 N");
}

#[test]
fn the_dial_turns_the_blow_and_bone_is_explained() {
    let term = started();
    term.keys("\t");
    term.wait_for("turn");
    term.keys(UP);
    term.wait_for("1 deg");
    for _ in 0..5 {
        term.keys("\x1b[1;2A");
    }
    term.wait_for("bone shields");
    assert!(!term.text().contains("last good result"));
}

#[test]
fn number_keys_switch_screens_and_the_keys_can_be_listed() {
    let term = started();
    term.keys("\x1b2");
    term.wait_for("Node force");
    term.keys("g");
    term.wait_for("peak ");
    term.keys("zz");
    term.wait_for("shown 5x larger");
    term.keys("3");
    term.wait_for("cursor 0.");
    term.keys("v");
    term.wait_for("centre, N");
    term.keys("?");
    term.wait_for("show or hide the keys");
    term.keys("?");
    term.wait_without("show or hide the keys");
}

#[test]
fn presets_are_compared_in_a_table_and_side_by_side() {
    let term = Term::start(app(&["tui", "paper-300n", "paper-100n", "paper-600n"]));
    term.wait_for("damage 26 %");
    term.keys("\x1b4");
    // All are simulated, and then their mesh errors are estimated.
    term.wait_for("3 marked");
    term.wait_for("±");
    let first = |text: &str| text.find("paper-600n").unwrap() < text.find("paper-100n").unwrap();
    assert!(!first(&term.text()));
    term.keys(&format!("{RIGHT}\r"));
    term.wait("the table sorted by damage", first);
    term.keys("\t");
    term.wait_for("3 paper-600n");
}

#[test]
fn a_long_run_shows_progress_and_can_be_cancelled() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("long.ron");
    let text = "(name: \"long\", impact: ForcePulse(()), window_ms: 900.0, eye: (level: 6))";
    fs::write(&file, text.replace("(())", "()")).unwrap();
    let term = Term::start(app(&["tui", file.to_str().unwrap()]));
    term.wait_for("simulating");
    term.wait_for("Esc cancels");
    term.keys("\x1b");
    term.wait_for("cancelled");
}

#[test]
fn a_storm_of_sizes_ends_in_a_clean_screen() {
    let term = started();
    for i in 0..60 {
        term.resize(20 + (i * 37) % 200, 5 + (i * 17) % 80);
        if i % 7 == 0 {
            term.keys("\x1b2");
        }
        thread::sleep(Duration::from_millis(3));
    }
    term.resize(80, 24);
    term.keys("\x1b1");
    let untouched = started();
    for term in [&term, &untouched] {
        term.wait_for("damage 26 %");
        term.settle();
    }
    let lines = |term: &Term| -> Vec<String> {
        term.text().lines().map(|line| line.trim_end().to_owned()).collect()
    };
    assert_eq!(lines(&term), lines(&untouched));
}

#[test]
fn very_small_and_very_large_terminals_are_served() {
    let term = Term::open(app(&["tui", "paper-300n"]), (20, 5), Replies::Prompt);
    term.wait_for("terminal too small");
    term.wait_for("need 60x20");
    term.resize(60, 20);
    term.wait_for("damage 26 %");
    term.resize(300, 100);
    term.wait_for("damage 26 %");
    term.keys("\x1b234");
    term.resize(1, 1);
    term.resize(80, 24);
    term.wait_for("mark two to six");
}

#[test]
fn a_replay_starts_where_it_is_after_any_wait() {
    let term = started();
    term.keys("\x1b2-----");
    thread::sleep(Duration::from_millis(1500));
    term.keys(" ");
    term.wait_for("playing");
    // At 0.01 ms a second, a second and a half would show.
    term.wait_for("0.00");
    term.keys(" ");
    term.wait_for("paused");
    assert!(term.text().contains(" 0.00"), "{}", term.text());
}

#[test]
fn without_a_terminal_the_app_says_so() {
    for arguments in [&[][..], &["tui"]] {
        assert_cmd::Command::new(env!("CARGO_BIN_EXE_contrecoup"))
            .args(arguments)
            .assert()
            .code(2)
            .stderr(predicates::str::contains("needs a terminal"));
    }
    let mut command = app(&["tui", "paper-300n"]);
    command.env("TERM", "dumb");
    let mut term = Term::start(command);
    assert_eq!(term.exit_code(), 2);
    let mut term = Term::start(app(&["tui", "no-such-preset"]));
    assert_eq!(term.exit_code(), 2);
    term.wait_for("there is no such preset");
}
