//! The app through a real secure shell server on the loopback, also over a narrow link.

use crate::pty;
use std::fs;
use std::io::{Read, Write};
use std::net::{Ipv4Addr, TcpListener, TcpStream};
use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::mpsc::channel;
use std::thread;
use std::time::{Duration, Instant};

use crate::pty::{HOME, Replies, TO_FORCE, Term};
use crate::ssh::Server;

/// A client that compresses, or not, by way of a port that counts what comes from the server.
fn counted(server: &Server, compressed: bool) -> (Term, Arc<AtomicUsize>) {
    let count = Arc::new(AtomicUsize::new(0));
    let port = link(server.port, None, Duration::ZERO, Arc::clone(&count));
    let term = Term::start(server.client(port, compressed));
    term.wait_for("damage 26 %");
    (term, count)
}

fn app_server() -> Option<Server> {
    Server::start(&format!(
        "XDG_CONFIG_HOME={HOME} {} tui paper-300n",
        env!("CARGO_BIN_EXE_contrecoup")
    ))
}

/// Passes bytes on after `delay`, at no more than `rate` bytes a second.
fn pass(
    mut from: TcpStream,
    mut to: TcpStream,
    (rate, delay): (Option<f64>, Duration),
    passed: &AtomicUsize,
) {
    let (send, parcels) = channel::<(Instant, Vec<u8>)>();
    thread::spawn(move || {
        for (due, bytes) in parcels {
            thread::sleep(due.saturating_duration_since(Instant::now()));
            if to.write_all(&bytes).is_err() {
                return;
            }
        }
        let _ = to.shutdown(std::net::Shutdown::Both);
    });
    let mut free = Instant::now();
    let mut bytes = [0; 256];
    while let Ok(count @ 1..) = from.read(&mut bytes) {
        passed.fetch_add(count, Ordering::Relaxed);
        let now = Instant::now();
        if let Some(rate) = rate {
            free = free.max(now) + Duration::from_secs_f64(count as f64 / rate);
        }
        if send.send((free.max(now) + delay, bytes[..count].to_vec())).is_err() {
            return;
        }
    }
}

/// A port that leads to the server over a link of `rate` bytes a second towards the client, whose
/// bytes are counted.
fn link(server: u16, rate: Option<f64>, round_trip: Duration, passed: Arc<AtomicUsize>) -> u16 {
    let listener = TcpListener::bind((Ipv4Addr::LOCALHOST, 0)).unwrap();
    let port = listener.local_addr().unwrap().port();
    thread::spawn(move || {
        let (client, _) = listener.accept().unwrap();
        let server = TcpStream::connect((Ipv4Addr::LOCALHOST, server)).unwrap();
        for stream in [&client, &server] {
            stream.set_nodelay(true).unwrap();
        }
        let (from, to) = (client.try_clone().unwrap(), server.try_clone().unwrap());
        let uphill = AtomicUsize::new(0);
        thread::spawn(move || pass(from, to, (None, round_trip / 2), &uphill));
        pass(server, client, (rate, round_trip / 2), &passed);
    });
    port
}

#[test]
fn the_app_starts_answers_keys_and_leaves_through_ssh() {
    let Some(server) = app_server() else { return };
    let mut term = server.open();
    term.keys(&format!("{TO_FORCE}\x1b[C"));
    term.wait_for("310 N");
    term.resize(120, 40);
    term.keys("\x1b2");
    term.wait_for("Node force");
    term.resize(80, 24);
    // Without a shell there is nothing to stop for: the app stays.
    term.keys("1");
    term.wait_for("damage ");
    term.keys("\x1a");
    // No key is lost while the app finds that out.
    term.keys("u");
    term.wait_for("damage 26 %");
    term.keys("q");
    assert_eq!(term.exit_code(), 0);
    term.assert_restored();
}

#[test]
fn a_dropped_connection_leaves_no_process_behind() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("pid");
    let app = env!("CARGO_BIN_EXE_contrecoup");
    let command =
        format!("echo $$ > {}; XDG_CONFIG_HOME={HOME} exec {app} tui paper-300n", file.display());
    let Some(server) = Server::start(&command) else {
        return;
    };
    let term = server.open();
    let pid = fs::read_to_string(&file).unwrap();
    let process = Path::new("/proc").join(pid.trim());
    assert!(process.exists());
    drop(term);
    let begun = Instant::now();
    while process.exists() {
        assert!(begun.elapsed() < pty::PATIENCE, "still running");
        thread::sleep(Duration::from_millis(10));
    }
}

#[test]
fn through_ssh_an_idle_screen_is_silent() {
    let Some(server) = app_server() else { return };
    let term = server.open();
    term.keys("\x1b2");
    term.wait_for("Node force");
    term.settle();
    let before = term.traffic();
    thread::sleep(Duration::from_secs(2));
    assert_eq!(term.traffic(), before, "not silent");
}

#[test]
fn a_stopped_client_gets_no_old_frames_and_goes_on_with_its_first_reply() {
    let Some(server) = app_server() else { return };
    let (term, wire) = counted(&server, false);
    // So slowly that it plays all the while.
    term.keys("\x1b2---");
    term.wait_for("Node force");
    term.settle();
    term.keys(" ");
    term.wait_for("playing");
    term.signal("STOP");
    let before = wire.load(Ordering::Relaxed);
    thread::sleep(Duration::from_secs(3));
    let kept = wire.load(Ordering::Relaxed) - before;
    let frames = term.traffic().1;
    term.signal("CONT");
    thread::sleep(Duration::from_secs(1));
    let frames = term.traffic().1 - frames;
    println!("ssh: {kept} bytes for a client stopped for 3 s, then {frames} frames in 1 s");
    // The frames under way and a question now and then; unpaced, three seconds take 30 kB.
    assert!(kept < 5000, "{kept} bytes");
    assert!(frames >= 4, "only {frames} frames after it went on");
    assert!(!term.text().contains("slow link"));
}

#[test]
fn through_ssh_replay_frames_keep_their_budget_in_every_number_of_colours() {
    // Most of the time each only plays: all do so at once.
    thread::scope(|all| {
        for colours in ["never", "16", "256"] {
            let app = env!("CARGO_BIN_EXE_contrecoup");
            let command = format!("XDG_CONFIG_HOME={HOME} {app} tui paper-300n --color {colours}");
            all.spawn(move || {
                let Some(server) = Server::start(&command) else {
                    return;
                };
                for compressed in [false, true] {
                    replay_keeps_its_budget(&server, colours, compressed);
                }
            });
        }
    });
}

fn replay_keeps_its_budget(server: &Server, colours: &str, compressed: bool) {
    let (term, wire) = counted(server, compressed);
    // Slowly, so that the frames show the blow and not the rest after it.
    term.keys("\x1b2-");
    term.wait_for("Node force");
    term.settle();
    let (before, sent) = (term.traffic(), wire.load(Ordering::Relaxed));
    term.keys(" ");
    thread::sleep(Duration::from_secs(3));
    term.keys(" ");
    term.settle();
    let after = term.traffic();
    let frames = after.1 - before.1;
    let mean = (after.0 - before.0) / frames.max(1);
    let wire = (wire.load(Ordering::Relaxed) - sent) / frames.max(1);
    let how = if compressed { " with -C" } else { "" };
    println!(
        "ssh, replay, colours {colours}, 80x24: {mean} bytes a frame, {wire} on the wire{how}, \
         {frames} frames"
    );
    assert!(frames >= 3, "only {frames} frames");
    assert!(mean <= 3500, "{mean} bytes a frame");
}

#[test]
fn over_a_narrow_link_a_key_is_answered_while_a_replay_plays() {
    let Some(server) = app_server() else { return };
    let round_trip = Duration::from_millis(200);
    let port = link(server.port, Some(8000.0), round_trip, Arc::default());
    let term = Term::open(server.client(port, false), (80, 24), Replies::Prompt);
    term.wait_for("damage 26 %");
    term.keys("\x1b2--");
    term.wait_for("Node force");
    term.keys(" ");
    term.wait_for("playing");
    thread::sleep(Duration::from_secs(1));
    // What a key has to wait for is told in bytes: a busy machine makes them later and not more.
    // Two seconds of this link; without pacing, buffers would fill with many times that.
    let most = 16_000;
    let before = term.traffic();
    for shown in ["2x", "5x", "10x"] {
        let sent = term.traffic().0;
        term.keys("z");
        let delay = term.wait_for(&format!("shown {shown}"));
        let bytes = term.traffic().0 - sent;
        println!("8 kB/s, 200 ms: a key answered after {delay:.2?} and {bytes} bytes");
        assert!(bytes <= most, "a key waited for {bytes} bytes");
        thread::sleep(Duration::from_millis(1370));
    }
    assert!(term.traffic().1 > before.1, "the replay goes on");
}
