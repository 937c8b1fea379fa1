//! The app in a terminal: a pty, real keys, real signals.

mod support;

use std::fs;
use std::path::Path;
use std::process::Command;
use std::thread;
use std::time::{Duration, Instant};

use portable_pty::CommandBuilder;
use support::{PATIENCE, Replies, Term, app, plain};

const RIGHT: &str = "\x1b[C";
const UP: &str = "\x1b[A";
const DOWN: &str = "\x1b[B";

fn started() -> Term {
    let term = Term::start(app(&[]));
    term.wait_for("26.42 %");
    term
}

#[test]
fn the_first_screen_answers_the_question() {
    let term = Term::start(app(&["tui"]));
    for text in [
        "26.42 %",
        "Peak force",
        "300 N",
        "centre",
        "72.93 N",
        "of 1.5 %",
        "Its error: step",
        "No flags raised",
        "Paper model, unit depth",
        "Research and education, not",
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
    term.wait_without("26.42 %");
    term.keys("u");
    term.wait_for("26.42 %");
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
    term.wait_without("26.42 %");
    term.keys("u");
    term.wait_for("26.42 %");
    // Escape restores, although the value was simulated while it was typed.
    term.keys("\r\x1560");
    term.wait_without("26.42 %");
    term.keys("\x1b");
    term.wait_for("26.42 %");
    term.wait_for("300 N");
    term.keys("\r\x15abc");
    term.wait_for("last good result");
    term.wait_for("allowed 0 to");
    assert!(term.text().contains("26.42 %"));
    term.keys("\r");
    term.wait_for("last good result");
    term.keys("\x1b");
    term.wait_without("last good result");
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
    term.wait_for("last good result");
}

#[test]
fn number_keys_switch_screens_and_the_keys_can_be_listed() {
    let term = started();
    term.keys("2");
    term.wait_for("Node force");
    term.keys("g");
    term.wait_for("peak ");
    term.keys("zz");
    term.wait_for("displacement ×5");
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
    term.wait_for("26.42 %");
    term.keys("4");
    term.wait_for("3 marked");
    term.wait_for("26.42");
    term.wait_for("6.36");
    term.wait_for("92.5");
    let first = |text: &str| text.find("paper-600n").unwrap() < text.find("paper-100n").unwrap();
    assert!(!first(&term.text()));
    term.keys(&format!("{RIGHT}\r"));
    term.wait("the table sorted by damage", first);
    term.keys("\t");
    term.wait_for("3 paper-600n");
}

#[test]
fn a_preset_is_saved_and_replaced_only_when_told() {
    let home = tempfile::tempdir().unwrap();
    let mut command = app(&[]);
    command.env("XDG_CONFIG_HOME", home.path());
    let mut term = Term::start(command);
    term.wait_for("26.42 %");
    term.keys(RIGHT);
    term.wait_for("(edited)");
    // Unsaved work is not lost without a question.
    term.keys("q");
    term.wait_for("not saved");
    term.keys("n");
    term.wait_without("not saved");
    term.keys("s");
    term.wait_for("Name");
    term.keys("\x15mine\r");
    term.wait_for("saved as mine");
    let file = home.path().join("contrecoup/presets/mine.ron");
    assert!(
        fs::read_to_string(&file)
            .unwrap()
            .contains("force_n: 310.0")
    );
    term.keys(RIGHT);
    term.wait_for("320 N");
    term.keys("s");
    term.wait_for("Name");
    term.keys("\r");
    term.wait_for("mine already");
    assert!(fs::read_to_string(&file).unwrap().contains("310"));
    term.keys("y");
    term.wait_for("saved as mine");
    assert!(
        fs::read_to_string(&file)
            .unwrap()
            .contains("force_n: 320.0")
    );
    term.keys("q");
    assert_eq!(term.exit_code(), 0);
    term.assert_restored();
}

#[test]
fn a_full_disk_is_explained_and_the_old_preset_survives() {
    let home = tempfile::tempdir().unwrap();
    let folder = home.path().join("contrecoup/presets");
    fs::create_dir_all(&folder).unwrap();
    let mount = Command::new("mount")
        .args(["-t", "tmpfs", "-o", "size=8k,nr_inodes=16", "tmpfs"])
        .arg(&folder)
        .output();
    if !mount.is_ok_and(|output| output.status.success()) {
        eprintln!("SKIPPED: a small file system cannot be mounted here");
        return;
    }
    let text = fs::read_to_string("presets/paper-300n.ron").unwrap();
    fs::write(folder.join("mine.ron"), &text).unwrap();
    // Whatever room is left is taken.
    let _ = fs::write(folder.join("filler"), vec![0; 1 << 20]);
    let mut command = app(&["tui", "mine"]);
    command.env("XDG_CONFIG_HOME", home.path());
    let term = Term::start(command);
    term.wait_for("26.42 %");
    term.keys(RIGHT);
    term.wait_for("(edited)");
    term.keys("s");
    term.wait_for("Name");
    term.keys("\r");
    term.wait_for("mine already");
    term.keys("y");
    term.wait_for("not saved");
    let kept = fs::read_to_string(folder.join("mine.ron")).unwrap();
    let names: Vec<_> = fs::read_dir(&folder)
        .unwrap()
        .map(|entry| entry.unwrap().file_name())
        .collect();
    drop(term);
    let unmounted = Command::new("umount").arg(&folder).status();
    assert!(unmounted.unwrap().success());
    assert_eq!(kept, text);
    assert_eq!(names.len(), 2, "{names:?}");
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
            term.keys("2");
        }
        thread::sleep(Duration::from_millis(3));
    }
    term.resize(80, 24);
    term.keys("1");
    term.settle();
    term.wait_for("26.42 %");
    let untouched = started();
    untouched.settle();
    let lines = |term: &Term| -> Vec<String> {
        term.text()
            .lines()
            .map(|line| line.trim_end().to_owned())
            .collect()
    };
    assert_eq!(lines(&term), lines(&untouched));
}

#[test]
fn very_small_and_very_large_terminals_are_served() {
    let term = Term::open(app(&[]), (20, 5), Replies::Prompt);
    term.wait_for("terminal too small");
    term.wait_for("need 60x20");
    term.resize(60, 20);
    term.wait_for("26.42 %");
    term.resize(300, 100);
    term.wait_for("26.42 %");
    term.keys("234");
    term.resize(1, 1);
    term.resize(80, 24);
    term.wait_for("mark two to six");
}

#[test]
fn q_and_control_c_leave_a_clean_terminal() {
    let mut term = started();
    term.keys("q");
    assert_eq!(term.exit_code(), 0);
    term.assert_restored();
    // Also while something is typed.
    let mut term = started();
    term.keys("\r12");
    term.wait_for("Esc restore");
    term.keys("\x03");
    assert_eq!(term.exit_code(), 130);
    term.assert_restored();
}

#[test]
fn a_termination_signal_leaves_a_clean_terminal() {
    for (name, code) in [("TERM", 143), ("INT", 130)] {
        let mut term = started();
        term.signal(name);
        assert_eq!(term.exit_code(), code);
        term.assert_restored();
    }
}

#[test]
fn a_panic_leaves_a_clean_terminal_and_says_what_happened() {
    let mut command = app(&["tui", "--fail-on", "X"]);
    command.env("RUST_BACKTRACE", "0");
    let mut term = Term::start(command);
    term.wait_for("26.42 %");
    term.keys("X");
    assert_eq!(term.exit_code(), 101);
    term.assert_restored();
    term.wait_for("failed on purpose");
}

#[test]
fn the_shell_can_stop_the_app_and_go_on_with_it() {
    let mut shell = CommandBuilder::new("bash");
    shell.args(["--norc", "--noprofile", "-i"]);
    plain(&mut shell);
    shell.env("PS1", "ready> ");
    let term = Term::start(shell);
    term.wait_for("ready> ");
    term.keys(&format!("{} tui\r", env!("CARGO_BIN_EXE_contrecoup")));
    term.wait_for("26.42 %");
    term.keys(RIGHT);
    term.wait_for("310 N");
    term.keys("\x1a");
    term.wait_for("Stopped");
    term.assert_left();
    term.keys("fg\r");
    term.wait_for("310 N");
    term.keys(RIGHT);
    term.wait_for("320 N");
    // A stop from outside leaves no time to tidy up, but going on does.
    let app = children(term.pid());
    support::signal("STOP", app[0]);
    // What is typed before the shell has taken over would still go to the app.
    term.wait_for("Stopped");
    term.keys("fg\r");
    term.wait_without("Stopped");
    term.keys(RIGHT);
    term.wait_for("330 N");
}

fn children(pid: u32) -> Vec<u32> {
    let text = fs::read_to_string(format!("/proc/{pid}/task/{pid}/children")).unwrap();
    text.split_whitespace()
        .map(|p| p.parse().unwrap())
        .collect()
}

/// The pid that a shell wrote before it became the app.
fn pid_in(file: &Path) -> u32 {
    let begun = Instant::now();
    loop {
        if let Ok(text) = fs::read_to_string(file)
            && let Ok(pid) = text.trim().parse()
        {
            return pid;
        }
        assert!(begun.elapsed() < PATIENCE, "never started");
        thread::sleep(Duration::from_millis(20));
    }
}

#[test]
fn a_hang_up_ends_the_app_even_where_the_signal_is_ignored() {
    if !Path::new("/usr/bin/script").exists() {
        eprintln!("SKIPPED: there is no script(1)");
        return;
    }
    for before in ["", "trap '' HUP;"] {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("pid");
        let line = format!(
            "{before} stty cols 80 rows 24; echo $$ > {}; exec {} tui",
            file.display(),
            env!("CARGO_BIN_EXE_contrecoup")
        );
        let mut holder = Command::new("script")
            .args(["-qfc", &line, "/dev/null"])
            .env("TERM", "xterm")
            .env("SHELL", "/bin/sh")
            .stdin(std::process::Stdio::piped())
            .stdout(std::process::Stdio::null())
            .spawn()
            .unwrap();
        let pid = pid_in(&file);
        thread::sleep(Duration::from_millis(700));
        holder.kill().unwrap();
        holder.wait().unwrap();
        let begun = Instant::now();
        while Path::new(&format!("/proc/{pid}")).exists() {
            assert!(begun.elapsed() < Duration::from_secs(5), "still running");
            thread::sleep(Duration::from_millis(20));
        }
    }
}

/// The numbers of every colour code in what was sent.
fn colour_codes(raw: &[u8]) -> Vec<u32> {
    let text = String::from_utf8_lossy(raw);
    let mut codes = Vec::new();
    for part in text.split("\x1b[").skip(1) {
        let end = part.find(|c: char| !(c.is_ascii_digit() || c == ';'));
        if let Some(end) = end
            && part[end..].starts_with('m')
        {
            codes.extend(part[..end].split(';').filter_map(|n| n.parse::<u32>().ok()));
        }
    }
    codes.retain(|n| (30..=49).contains(n) || (90..=107).contains(n));
    codes
}

#[test]
fn no_color_means_no_colour() {
    let mut command = app(&[]);
    command.env("NO_COLOR", "1");
    let term = Term::start(command);
    term.wait_for("26.42 %");
    term.keys("2");
    term.wait_for("Node force");
    assert_eq!(colour_codes(&term.raw()), [] as [u32; 0]);
    let coloured = started();
    assert!(!colour_codes(&coloured.raw()).is_empty());
}

#[test]
fn plain_ascii_is_enough() {
    let term = Term::start(app(&["tui", "--symbols", "ascii"]));
    term.wait_for("26.42 %");
    for screen in ["2", "3", "4", "?"] {
        term.keys(screen);
        term.settle();
        let text = term.text();
        assert!(text.is_ascii(), "{screen}: {text}");
    }
}

#[test]
fn an_idle_app_sends_nothing() {
    let term = started();
    // The last thing that is computed when nothing else is wanted.
    term.wait_for("5-95 %");
    term.settle();
    let before = term.traffic();
    thread::sleep(Duration::from_secs(2));
    assert_eq!(term.traffic(), before);
}

#[test]
fn a_replay_frame_takes_no_more_than_its_budget() {
    for screen in ["1", "2"] {
        let term = started();
        term.keys(screen);
        // Slowly, so that the frames show the blow and not the rest after it.
        term.keys("-");
        term.settle();
        let before = term.traffic();
        term.keys(" ");
        thread::sleep(Duration::from_secs(4));
        term.keys(" ");
        let after = term.traffic();
        let frames = after.1 - before.1;
        let mean = (after.0 - before.0) / frames.max(1);
        println!("screen {screen}, 16 colours, 80x24: {mean} bytes a frame over {frames} frames");
        assert!(frames >= 10, "only {frames} frames");
        assert!(mean <= 3500, "{mean} bytes a frame");
    }
}

#[test]
fn a_replay_starts_where_it_is_after_any_wait() {
    let term = started();
    term.keys("2-----");
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
fn queued_keys_go_into_few_frames() {
    let term = started();
    term.settle();
    let before = term.traffic().1;
    term.keys(&RIGHT.repeat(100));
    term.wait_for("1300 N");
    term.settle();
    let frames = term.traffic().1 - before;
    assert!(frames <= 20, "{frames} frames");
    term.keys("u");
    term.wait_for("26.42 %");
}

#[test]
fn two_frames_at_most_wait_for_their_replies() {
    let late = Replies::Late(Duration::from_millis(150));
    let term = Term::open(app(&[]), (80, 24), late);
    term.wait_for("26.42 %");
    term.keys("2 ");
    term.keys(&RIGHT.repeat(20));
    term.keys(" ");
    thread::sleep(Duration::from_secs(2));
    assert_eq!(term.most_open(), 2);
}

#[test]
fn no_reply_is_left_for_whoever_reads_the_terminal_next() {
    let mut shell = CommandBuilder::new("sh");
    let line = format!("{} tui; echo over; cat", env!("CARGO_BIN_EXE_contrecoup"));
    shell.args(["-c", &line]);
    plain(&mut shell);
    let late = Replies::Late(Duration::from_millis(250));
    let term = Term::open(shell, (80, 24), late);
    term.wait_for("26.42 %");
    term.keys("2");
    term.wait_for("Node force");
    term.keys("1q");
    term.wait_for("over");
    thread::sleep(Duration::from_millis(500));
    assert!(!term.text().contains("1R"), "{}", term.text());
}

#[test]
fn a_terminal_that_never_answers_is_served_all_the_same() {
    let term = Term::open(app(&[]), (80, 24), Replies::Never);
    term.wait_for("26.42 %");
    term.keys(RIGHT);
    term.wait_for("310 N");
    // Two silences later nothing is asked any more, and keys are answered at once.
    term.keys(DOWN);
    thread::sleep(Duration::from_secs(3));
    term.keys("2");
    term.wait_for("slow link");
    let asked = term.most_open();
    term.keys("1u");
    term.settle();
    term.keys("r");
    assert!(term.wait_for("310 N") < Duration::from_secs(1));
    assert_eq!(term.most_open(), asked);
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
    let mut command = app(&["tui"]);
    command.env("TERM", "dumb");
    let mut term = Term::start(command);
    assert_eq!(term.exit_code(), 2);
    let mut term = Term::start(app(&["tui", "no-such-preset"]));
    assert_eq!(term.exit_code(), 2);
    term.wait_for("there is no such preset");
}
