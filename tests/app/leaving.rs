//! Leaving the app by every door, and coming back: the terminal is as it was.

use crate::{pty, skip};
use std::fs;
use std::io::Write;
use std::path::Path;
use std::process::Command;
use std::thread;
use std::time::{Duration, Instant};

use crate::pty::{PATIENCE, RIGHT, Replies, TO_FORCE, Term, app, plain, started};
use portable_pty::{CommandBuilder, PtySize, native_pty_system};

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
    let asked = [("TERM", 143), ("INT", 130), ("HUP", 129), ("USR1", 138), ("USR2", 140)];
    let clocks = [("ALRM", 142), ("XCPU", 152), ("PROF", 155)];
    for (name, code) in asked.into_iter().chain(clocks) {
        let mut term = started();
        term.signal(name);
        assert_eq!(term.exit_code(), code);
        term.assert_restored();
    }
}

#[test]
fn an_abort_leaves_a_clean_terminal_and_says_so() {
    let mut term = Term::start(app(&["tui", "paper-300n", "--mouse"]));
    term.wait_for("damage 26 %");
    term.signal("ABRT");
    term.exit_code();
    term.assert_restored();
    term.wait_for("contrecoup: aborted");
}

/// Memory of a process by its name in `/proc`, in bytes.
#[cfg(target_os = "linux")]
fn memory(pid: u32, name: &str) -> u64 {
    let status = fs::read_to_string(format!("/proc/{pid}/status")).unwrap();
    let line = status.lines().find_map(|line| line.strip_prefix(name));
    let kilobytes = line.unwrap().trim_matches([':', ' ', '\t', 'k', 'B']);
    1024 * kilobytes.parse::<u64>().unwrap()
}

#[cfg(target_os = "linux")]
#[test]
fn a_failed_allocation_leaves_a_clean_terminal_and_says_so() {
    let mut term = started();
    term.wait_for("damage 26 %");
    term.settle();
    // As by `ulimit -d`, once everything has begun.
    let limit = memory(term.pid(), "VmData");
    let done = Command::new("prlimit")
        .args([format!("--pid={}", term.pid()), format!("--data={limit}")])
        .status()
        .unwrap();
    assert!(done.success());
    // A screen of so many cells takes megabytes.
    term.resize(500, 200);
    let code = term.exit_code();
    term.assert_restored();
    term.wait_for("memory ran out");
    assert_ne!(code, 0);
}

#[test]
fn a_signal_ends_the_app_while_the_terminal_does_not_read() {
    for twice in [false, true] {
        let size = PtySize { rows: 200, cols: 500, pixel_width: 0, pixel_height: 0 };
        let pair = native_pty_system().openpty(size).unwrap();
        let command = app(&["tui", "paper-300n", "--color", "256", "--symbols", "block"]);
        let mut child = pair.slave.spawn_command(command).unwrap();
        drop(pair.slave);
        let pid = child.process_id().unwrap();
        let mut writer = pair.master.take_writer().unwrap();
        // Help comes and goes over the whole screen until a write has no room left.
        let begun = Instant::now();
        let held_up = || {
            let wait = fs::read_to_string(format!("/proc/{pid}/wchan")).unwrap_or_default();
            wait.contains("tty") || wait.contains("wait_woken") || wait == "n_tty_write"
        };
        while begun.elapsed() < Duration::from_secs(6)
            && !(held_up() && begun.elapsed() > Duration::from_secs(4))
        {
            let _ = writer.write_all(b"2 ?\x0c?\x0c");
            thread::sleep(Duration::from_millis(100));
        }
        let told = Instant::now();
        pty::signal("TERM", pid);
        if twice {
            thread::sleep(Duration::from_millis(100));
            pty::signal("TERM", pid);
        }
        let status = child.wait().unwrap();
        assert_eq!(status.exit_code(), 143);
        assert!(told.elapsed() < PATIENCE, "{:?}", told.elapsed());
    }
}

#[test]
fn a_panic_leaves_a_clean_terminal_and_says_what_happened() {
    let mut command = app(&["tui", "paper-300n", "--fail-on", "X"]);
    command.env("RUST_BACKTRACE", "0");
    let mut term = Term::start(command);
    term.wait_for("damage 26 %");
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
    term.keys(&format!("{} tui paper-300n\r", env!("CARGO_BIN_EXE_contrecoup")));
    term.wait_for("damage 26 %");
    term.keys(&format!("{TO_FORCE}{RIGHT}"));
    term.wait_for("310 N");
    term.keys("\x1a");
    term.wait_for("Stopped");
    term.assert_left();
    term.keys("fg\r");
    term.wait_for("310 N");
    term.keys(RIGHT);
    term.wait_for("320 N");
    // The terminal's answer to the last frame would else come to the shell, as keys.
    term.settle();
    // A stop from outside leaves no time to tidy up, but going on does.
    let app = children(term.pid());
    pty::signal("STOP", app[0]);
    // What is typed before the shell has taken over would still go to the app.
    term.wait_for("Stopped");
    term.keys("fg\r");
    term.wait_without("Stopped");
    term.keys(RIGHT);
    term.wait_for("330 N");
}

fn children(pid: u32) -> Vec<u32> {
    let text = fs::read_to_string(format!("/proc/{pid}/task/{pid}/children")).unwrap();
    text.split_whitespace().map(|p| p.parse().unwrap()).collect()
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
        skip::skip("there is no script(1)");
        return;
    }
    for before in ["", "trap '' HUP;"] {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("pid");
        let line = format!(
            "{before} stty cols 80 rows 24; echo $$ > {}; exec {} tui paper-300n",
            file.display(),
            env!("CARGO_BIN_EXE_contrecoup")
        );
        let mut holder = Command::new("script")
            .args(["-qfc", &line, "/dev/null"])
            .env("TERM", "xterm")
            .env("SHELL", "/bin/sh")
            .env("XDG_CONFIG_HOME", folder.path())
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
            assert!(begun.elapsed() < PATIENCE, "still running");
            thread::sleep(Duration::from_millis(20));
        }
    }
}

#[test]
fn no_reply_is_left_for_whoever_reads_the_terminal_next() {
    let mut shell = CommandBuilder::new("sh");
    let line = format!("{} tui paper-300n; echo over; cat", env!("CARGO_BIN_EXE_contrecoup"));
    shell.args(["-c", &line]);
    plain(&mut shell);
    let late = Replies::Late(Duration::from_millis(250));
    let term = Term::open(shell, (80, 24), late);
    term.wait_for("damage 26 %");
    term.keys("\x1b2");
    term.wait_for("Node force");
    term.keys("1q");
    term.wait_for("over");
    thread::sleep(Duration::from_millis(500));
    assert!(!term.text().contains("1R"), "{}", term.text());
}

/// A mouse report as a terminal sends it.
fn mouse(button: u16, column: u16, row: u16) -> String {
    format!("\x1b[<{button};{column};{row}M")
}

#[test]
fn the_mouse_is_switched_off_by_every_way_out() {
    let start = || {
        let mut command = app(&["tui", "paper-300n", "--mouse", "--fail-on", "X"]);
        command.env("RUST_BACKTRACE", "0");
        let term = Term::start(command);
        term.wait_for("damage 26 %");
        term.assert_mouse(true);
        term
    };
    for (keys, code) in [("q", 0), ("\x03", 130), ("X", 101)] {
        let mut term = start();
        term.keys(keys);
        assert_eq!(term.exit_code(), code);
        term.assert_restored();
    }
    let mut term = start();
    term.signal("TERM");
    assert_eq!(term.exit_code(), 143);
    term.assert_restored();
    // And by its own key, after which a report that is still on its way does nothing.
    let term = start();
    term.keys("M");
    term.wait_for("mouse off");
    term.assert_mouse(false);
    term.keys(&mouse(0, 10, 2));
    term.keys("M");
    term.wait_for("mouse on");
    term.assert_mouse(true);
}

#[test]
fn suspending_gives_the_mouse_back_and_loses_no_key() {
    let mut shell = CommandBuilder::new("bash");
    shell.args(["--norc", "--noprofile", "-i"]);
    plain(&mut shell);
    shell.env("PS1", "ready> ");
    let late = Replies::Late(Duration::from_millis(600));
    let term = Term::open(shell, (80, 24), late);
    term.wait_for("ready> ");
    term.keys(&format!("{} tui paper-300n --mouse\r", env!("CARGO_BIN_EXE_contrecoup")));
    term.wait_for("damage 26 %");
    term.settle();
    term.keys(&format!("{TO_FORCE}{RIGHT}"));
    term.wait_for("310 N");
    // The reply to that frame is still to come, so the terminal is not handed over yet.
    term.keys("\x1a");
    thread::sleep(Duration::from_millis(20));
    term.keys(&RIGHT.repeat(2));
    term.wait_for("Stopped");
    term.assert_left();
    term.assert_mouse(false);
    // Nor is anything lost that is typed before the app is back.
    term.keys(&format!("fg\r{RIGHT}"));
    term.wait_for("340 N");
    term.assert_mouse(true);
}
