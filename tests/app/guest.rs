//! A guest through a real secure shell server: looks, tries, and leaves nothing behind.

#![cfg(target_os = "linux")]

use crate::pty;
use std::fs;
use std::path::{Path, PathBuf};
use std::time::Duration;

use crate::pty::{RIGHT, Replies, TO_FORCE, Term};
use crate::ssh::Server;

const APP: &str = env!("CARGO_BIN_EXE_contrecoup");

/// A home with presets and a config file that a guest must not see.
fn home() -> tempfile::TempDir {
    let home = tempfile::tempdir().unwrap();
    let own = home.path().join("contrecoup");
    fs::create_dir_all(own.join("presets")).unwrap();
    let preset = "(name: \"secret\", impact: ForcePulse(force_n: 1))";
    fs::write(own.join("presets/aaa-secret.ron"), preset).unwrap();
    fs::write(own.join("config.ron"), "(symbols: Ascii)").unwrap();
    fs::write(home.path().join("curve.csv"), "0,0\n0.1,1\n").unwrap();
    home
}

/// Everything below a folder, with its size and the time of its last change.
fn listing(folder: &Path) -> Vec<(PathBuf, u64, std::time::SystemTime)> {
    let mut all = Vec::new();
    for entry in fs::read_dir(folder).unwrap() {
        let entry = entry.unwrap();
        let about = entry.metadata().unwrap();
        all.push((entry.path(), about.len(), about.modified().unwrap()));
        if about.is_dir() {
            all.extend(listing(&entry.path()));
        }
    }
    all.sort();
    all
}

/// A server whose every visitor is a guest in `home`, told from others by how long it may sleep.
fn server(home: &Path, minutes: &str) -> Option<Server> {
    let home = home.display();
    Server::start(&format!(
        "cd {home} && HOME={home} XDG_CONFIG_HOME={home} exec {APP} tui paper-300n --guest --idle-minutes {minutes}"
    ))
}

/// The processes of guests that may sleep so long.
fn guests(minutes: &str) -> Vec<u32> {
    let pids = fs::read_dir("/proc").unwrap().flatten();
    let pids = pids.filter_map(|entry| entry.file_name().to_str()?.parse::<u32>().ok());
    let is_guest = |pid: &u32| {
        let words = fs::read(format!("/proc/{pid}/cmdline")).unwrap_or_default();
        let words: Vec<&[u8]> = words.split(|byte| *byte == 0).collect();
        words.first().is_some_and(|program| *program == APP.as_bytes())
            && words.contains(&minutes.as_bytes())
    };
    pids.filter(is_guest).collect()
}

/// A line of `/proc/PID/status`.
fn status(pid: u32, name: &str) -> String {
    let status = fs::read_to_string(format!("/proc/{pid}/status")).unwrap();
    let line = status.lines().find_map(|line| line.strip_prefix(name));
    line.unwrap().trim_start_matches(':').trim().to_owned()
}

/// The fields of `/proc/PID/stat` behind the name, which may hold anything.
fn stat(pid: u32) -> Vec<i128> {
    let stat = fs::read_to_string(format!("/proc/{pid}/stat")).unwrap();
    let rest = stat.rsplit_once(')').unwrap().1;
    rest.split_whitespace().skip(1).map(|n| n.parse().unwrap()).collect()
}

#[test]
fn a_guest_tries_everything_and_no_file_appears_and_none_is_read() {
    let home = home();
    let Some(server) = server(home.path(), "9.01") else {
        return;
    };
    let before = listing(home.path());
    // Whatever else is asked for, the app is what runs.
    let mut client = server.client(server.port, false);
    client.arg(format!("touch {}/touched", home.path().display()));
    let mut term = Term::open(client, (120, 40), Replies::Prompt);
    term.wait_for("damage 26 %");
    let is_braille = |c: char| ('\u{2801}'..='\u{28ff}').contains(&c);
    assert!(term.text().contains(is_braille), "the config file was read");
    term.keys("\x13");
    term.wait_for("a guest saves nothing");
    term.keys("p");
    term.wait_for("air-rifle-pellet");
    assert!(!term.text().contains("aaa-secret"), "{}", term.text());
    term.keys("\x1b");
    term.wait_without("air-rifle-pellet");
    // A curve that is pasted.
    term.keys(&"\x1b[B".repeat(4));
    term.wait_for("▸Pulse shape");
    for curve in ["curve.csv", "/etc/passwd"] {
        term.keys(&format!("\x1b[200~Csv(\"{curve}\")\x1b[201~"));
        term.wait_for("a guest has no");
        term.keys("\x1b");
        term.wait_for("Smooth rectangle");
    }
    // Too long a time is refused, a shorter one is not.
    term.keys("\x1b[B\x1b[B");
    term.wait_for("▸Simulated time");
    term.keys("\r\x1521");
    term.wait_for("not for guests");
    term.keys("\x1b");
    term.keys("\x1b2 \x1b3\x1b4\x1b8wy\x13\x0f\x1a");
    term.settle();
    term.keys("\x03");
    assert_eq!(term.exit_code(), 130);
    assert_eq!(listing(home.path()), before);
    // A file on the command line is none of a guest's either.
    for source in ["curve.csv", "./contrecoup/presets/aaa-secret.ron", "aaa-secret"] {
        let mut command = pty::app(&["tui", "--guest", source]);
        command.cwd(home.path());
        command.env("XDG_CONFIG_HOME", home.path());
        let mut term = Term::start(command);
        assert_eq!(term.exit_code(), 2, "{source}");
    }
}

#[test]
fn a_guest_is_held_to_its_limits_by_the_system_and_sent_away_when_it_sleeps() {
    let home = home();
    let Some(server) = server(home.path(), "0.0501") else {
        return;
    };
    let mut term = server.open();
    let [pid] = guests("0.0501")[..] else { panic!("no guest") };
    // Everything that it began, too.
    for task in fs::read_dir(format!("/proc/{pid}/task")).unwrap() {
        let task: u32 = task.unwrap().file_name().to_str().unwrap().parse().unwrap();
        assert_eq!(stat(task)[15], 19, "not of the lowest priority");
        let core = status(task, "Cpus_allowed_list");
        assert!(core.parse::<usize>().is_ok(), "more than one core: {core}");
    }
    let limits = fs::read_to_string(format!("/proc/{pid}/limits")).unwrap();
    for (name, most) in
        [("Max file size", 0), ("Max core file size", 0), ("Max data size", 256 << 20)]
    {
        let line = limits.lines().find_map(|line| line.strip_prefix(name));
        let most = format!("{most} {most}");
        let found: Vec<_> = line.unwrap().split_whitespace().take(2).collect();
        assert_eq!(found.join(" "), most, "{name}");
    }
    term.wait_for("no key was pressed");
    assert_eq!(term.exit_code(), 0);
    term.assert_restored();
}

#[test]
fn twenty_guests_at_once_stay_within_what_the_guide_says() {
    // As in the guide.
    const MEGABYTES: f64 = 400.0;
    const SECONDS: f64 = 5.0;
    let home = home();
    let Some(server) = server(home.path(), "9.02") else {
        return;
    };
    let client = || Term::start(server.client(server.port, false));
    let terms: Vec<Term> = (0..20).map(|_| client()).collect();
    for term in &terms {
        term.wait_for("damage 26 %");
        term.keys(&format!("{TO_FORCE}{RIGHT}"));
    }
    for term in &terms {
        term.wait_for("310 N");
        term.keys("\x1b2 ");
    }
    for term in &terms {
        term.wait_for("playing");
    }
    let pids = guests("9.02");
    assert_eq!(pids.len(), 20);
    std::thread::sleep(Duration::from_secs(1));
    let used = |pid: &u32| stat(*pid)[10..12].iter().sum::<i128>() as f64 / 100.0;
    let kilobytes =
        |pid: &u32| -> f64 { status(*pid, "VmHWM").trim_end_matches(" kB").parse().unwrap() };
    let seconds: f64 = pids.iter().map(used).sum();
    let megabytes: f64 = pids.iter().map(kilobytes).sum::<f64>() / 1000.0;
    println!("20 guests: {megabytes:.0} MB and {seconds:.1} s of one core");
    assert!(megabytes < MEGABYTES && seconds < SECONDS);
}

#[test]
fn a_guest_who_types_without_end_sees_frames_stays_small_and_leaves_at_once() {
    const GUESTS: usize = 3;
    let command = || pty::app(&["tui", "--guest", "paper-300n"]);
    let mut terms: Vec<Term> = (0..GUESTS).map(|_| Term::start(command())).collect();
    for term in &terms {
        term.wait_for("damage 26 %");
    }
    let kilobytes = |term: &Term| -> u64 {
        let used = status(term.pid(), "VmRSS");
        used.trim_end_matches(" kB").parse().unwrap()
    };
    let before: Vec<u64> = terms.iter().map(kilobytes).collect();
    for term in &terms {
        let keys = term.typist();
        // Nobody waits for it: what is written to a terminal without a reader may take for ever.
        std::thread::spawn(move || {
            loop {
                keys(&"\x1b[B\x1b[C\x1b[A".repeat(20));
            }
        });
    }
    std::thread::sleep(Duration::from_secs(2));
    let frames = || terms.iter().map(|term| term.traffic().1);
    let first: Vec<usize> = frames().collect();
    std::thread::sleep(Duration::from_secs(2));
    let drawn: Vec<usize> = frames().zip(first).map(|(now, then)| now - then).collect();
    let grown = terms.iter().map(kilobytes).zip(&before);
    let grown: Vec<u64> = grown.map(|(now, then)| now.saturating_sub(*then)).collect();
    let is_there = |term: &Term| {
        fs::read_to_string(format!("/proc/{}/stat", term.pid()))
            .is_ok_and(|stat| !stat.contains(") Z "))
    };
    for term in &terms {
        term.signal("HUP");
    }
    let begun = std::time::Instant::now();
    while terms.iter().any(is_there) && begun.elapsed() < pty::PATIENCE {
        std::thread::sleep(Duration::from_millis(5));
    }
    let left = begun.elapsed();
    println!("frames {drawn:?} in 2 s, {grown:?} kB more, left after {left:?}");
    assert!(drawn.iter().all(|frames| *frames > 1), "{drawn:?} frames in two seconds");
    assert!(grown.iter().all(|kilobytes| *kilobytes < 15_000), "{grown:?} kB more");
    assert!(left < Duration::from_secs(1), "left after {left:?}");
    for term in &mut terms {
        assert_eq!(term.exit_code(), 129);
    }
}
