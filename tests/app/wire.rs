//! What goes over the wire: how much, how often, and in which colours.

use std::thread;
use std::time::Duration;

use crate::pty::{DOWN, RIGHT, Replies, TO_FORCE, Term, app, started};

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
    let mut command = app(&["tui", "paper-300n"]);
    command.env("NO_COLOR", "1");
    let term = Term::start(command);
    term.wait_for("damage 26 %");
    term.keys("\x1b2");
    term.wait_for("Node force");
    assert_eq!(colour_codes(&term.raw()), [] as [u32; 0]);
    let coloured = started();
    assert!(!colour_codes(&coloured.raw()).is_empty());
}

#[test]
fn plain_ascii_is_enough_where_the_locale_has_nothing_else() {
    let mut command = app(&["tui", "paper-300n"]);
    command.env("LC_ALL", "C");
    let term = Term::start(command);
    term.wait_for("damage 26 %");
    for screen in ["\x1b2", "3", "4", "?"] {
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
    term.wait_for("damage 26 %");
    term.settle();
    let before = term.traffic();
    thread::sleep(Duration::from_secs(2));
    assert_eq!(term.traffic(), before);
}

#[test]
fn a_replay_frame_takes_no_more_than_its_budget() {
    for screen in ["\x1b1", "\x1b2"] {
        let term = started();
        term.keys(screen);
        // Slowly, so that the frames show the blow and not the rest after it.
        term.keys("_");
        term.settle();
        let before = term.traffic();
        term.keys(" ");
        thread::sleep(Duration::from_secs(4));
        term.keys(" ");
        let after = term.traffic();
        let frames = after.1 - before.1;
        let mean = (after.0 - before.0) / frames.max(1);
        println!(
            "screen {}, 16 colours, 80x24: {mean} bytes a frame over {frames} frames",
            &screen[1..]
        );
        assert!(frames >= 10, "only {frames} frames");
        assert!(mean <= 3500, "{mean} bytes a frame");
    }
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
    term.wait_for("damage 26 %");
}

#[test]
fn two_frames_at_most_wait_for_their_replies() {
    let late = Replies::Late(Duration::from_millis(150));
    let term = Term::open(app(&["tui", "paper-300n"]), (80, 24), late);
    term.wait_for("damage 26 %");
    term.keys("\x1b2 ");
    term.keys(&RIGHT.repeat(20));
    term.keys(" ");
    thread::sleep(Duration::from_secs(2));
    assert_eq!(term.most_open(), 2);
}

#[test]
fn a_terminal_that_never_answers_is_served_all_the_same() {
    let term = Term::open(app(&["tui", "paper-300n"]), (80, 24), Replies::Never);
    term.wait_for("damage 26 %");
    term.keys(&format!("{TO_FORCE}{RIGHT}"));
    term.wait_for("310 N");
    // Two silences later nothing is asked any more, so that no frame waits for an answer.
    term.keys(DOWN);
    thread::sleep(Duration::from_secs(3));
    term.keys("\x1b2");
    term.wait_for("slow link");
    let asked = term.most_open();
    term.keys("1u");
    term.settle();
    term.keys("r");
    term.wait_for("310 N");
    assert_eq!(term.most_open(), asked);
}

#[test]
fn a_stopped_client_gets_one_old_frame_and_goes_on_with_its_first_reply() {
    let term = started();
    term.wait_for("damage 26 %");
    // So slowly that it plays all the while.
    term.keys("\x1b2--- ");
    term.wait_for("playing");
    term.stop();
    thread::sleep(Duration::from_millis(300));
    let before = term.traffic();
    thread::sleep(Duration::from_secs(5));
    let stopped = term.traffic();
    assert!(stopped.1 - before.1 <= 1, "{before:?} to {stopped:?}");
    assert!(stopped.0 - before.0 < 5000, "{before:?} to {stopped:?}");
    term.go_on();
    thread::sleep(Duration::from_secs(1));
    let frames = term.traffic().1 - stopped.1;
    assert!(frames >= 4, "only {frames} frames after it went on");
    assert!(!term.text().contains("slow link"));
}

#[test]
fn the_mouse_is_never_mentioned_unless_asked_for() {
    // Every mode in which a terminal reports the mouse.
    let modes = ["?1000", "?1002", "?1003", "?1005", "?1006", "?1015", "?9"];
    let mentions = |term: &Term| -> Vec<&str> {
        let raw = String::from_utf8_lossy(&term.raw()).into_owned();
        let said =
            |mode: &&&str| ['h', 'l'].iter().any(|c| raw.contains(&format!("\x1b[{mode}{c}")));
        modes.iter().filter(said).copied().collect()
    };
    let mut term = started();
    term.keys("\t?q\x1b2 3q");
    assert_eq!(term.exit_code(), 0);
    assert_eq!(mentions(&term), [] as [&str; 0]);
    let mut term = Term::start(app(&["tui", "paper-300n", "--mouse"]));
    term.wait_for("damage 26 %");
    term.keys("q");
    assert_eq!(term.exit_code(), 0);
    assert_eq!(mentions(&term), ["?1002", "?1006"]);
}

#[test]
fn plain_contrecoup_takes_the_flags_of_the_app() {
    let flags = ["--color", "never", "--symbols", "ascii", "--fps", "5"];
    let term = Term::start(app(&flags));
    term.wait_for("What hit the eye?");
    assert!(term.text().is_ascii());
    assert_eq!(colour_codes(&term.raw()), [] as [u32; 0]);
}
