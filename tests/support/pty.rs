//! A terminal for tests: a pty, a screen that is read back, and replies to the app's questions.

use std::io::{Read, Write};
use std::sync::{Arc, Mutex};
use std::thread;
use std::time::{Duration, Instant};

use portable_pty::{Child, CommandBuilder, MasterPty, PtySize, native_pty_system};

/// How long anything may take before a test fails.
pub const PATIENCE: Duration = Duration::from_secs(20);

/// The question for the cursor's place.
const QUESTION: &[u8] = b"\x1b[6n";
/// The beginning of a frame.
const FRAME: &[u8] = b"\x1b[?2026h";

/// The home of tests that need none of their own.
pub const HOME: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/support/home");

/// Keys as a terminal sends them.
pub const RIGHT: &str = "\x1b[C";
/// From the first row of the form to the peak force.
pub const TO_FORCE: &str = "\x1b[B\x1b[A";
pub const UP: &str = "\x1b[A";
pub const DOWN: &str = "\x1b[B";

/// How the terminal treats questions.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Replies {
    /// At once.
    Prompt,
    /// After this long.
    Late(Duration),
    /// Never.
    Never,
}

/// What came from the program so far.
struct Seen {
    parser: vt100::Parser,
    raw: Vec<u8>,
    /// Questions without a reply yet, and the most there ever were at once.
    open: usize,
    most_open: usize,
    /// Whether nobody answers for now, and what was asked meanwhile.
    stopped: bool,
    unanswered: Vec<String>,
}

/// A program in a terminal.
pub struct Term {
    seen: Arc<Mutex<Seen>>,
    master: Box<dyn MasterPty + Send>,
    writer: Arc<Mutex<Box<dyn Write + Send>>>,
    child: Box<dyn Child + Send + Sync>,
    /// The modes of the terminal before the program came.
    modes: String,
}

/// The modes of a terminal, such as whether it waits for whole lines.
fn modes(master: &(dyn MasterPty + Send)) -> String {
    let termios = master.get_termios().expect("a terminal has modes");
    let flags = (termios.input_flags, termios.output_flags, termios.local_flags);
    format!("{flags:?}")
}

fn size(columns: u16, rows: u16) -> PtySize {
    PtySize { rows, cols: columns, pixel_width: 0, pixel_height: 0 }
}

fn cells(count: u16) -> std::num::NonZero<u16> {
    std::num::NonZero::new(count).unwrap()
}

fn count(haystack: &[u8], needle: &[u8]) -> usize {
    haystack.windows(needle.len()).filter(|w| *w == needle).count()
}

/// The program under test with these arguments, on a terminal of 16 colours.
pub fn app(arguments: &[&str]) -> CommandBuilder {
    let mut command = CommandBuilder::new(env!("CARGO_BIN_EXE_contrecoup"));
    command.args(arguments);
    plain(&mut command);
    command
}

/// The app on the paper's blow, once it shows its first result, with the cursor on the force.
pub fn started() -> Term {
    let term = Term::start(app(&["tui", "paper-300n"]));
    term.wait_for("damage 26 %");
    term.keys(TO_FORCE);
    term.wait_for("▸Peak force");
    term
}

/// Takes out of the environment what would change the screen.
pub fn plain(command: &mut CommandBuilder) {
    for name in ["COLORTERM", "NO_COLOR", "XDG_CONFIG_HOME"] {
        command.env_remove(name);
    }
    command.env("TERM", "xterm");
    // A home whose config file computes nothing ahead.
    command.env("XDG_CONFIG_HOME", HOME);
}

impl Term {
    /// Starts a command in a terminal of 80 by 24 that answers at once.
    pub fn start(command: CommandBuilder) -> Self {
        Self::open(command, (80, 24), Replies::Prompt)
    }

    /// Starts a command.
    pub fn open(command: CommandBuilder, (columns, rows): (u16, u16), replies: Replies) -> Self {
        let pair = native_pty_system().openpty(size(columns, rows)).unwrap();
        let modes = modes(&*pair.master);
        let child = pair.slave.spawn_command(command).unwrap();
        drop(pair.slave);
        let reader = pair.master.try_clone_reader().unwrap();
        let writer = Arc::new(Mutex::new(pair.master.take_writer().unwrap()));
        let seen = Arc::new(Mutex::new(Seen {
            parser: vt100::Parser::new(cells(rows), cells(columns), 0),
            raw: Vec::new(),
            open: 0,
            most_open: 0,
            stopped: false,
            unanswered: Vec::new(),
        }));
        let (own_seen, own_writer) = (Arc::clone(&seen), Arc::clone(&writer));
        thread::spawn(move || listen(reader, &own_seen, &own_writer, replies));
        Self { seen, master: pair.master, writer, child, modes }
    }

    /// Stops answering, like a client that is stopped.
    pub fn stop(&self) {
        self.seen.lock().unwrap().stopped = true;
    }

    /// Answers everything that was asked since, and from now on at once.
    pub fn go_on(&self) {
        let mut seen = self.seen.lock().unwrap();
        seen.stopped = false;
        seen.open -= seen.unanswered.len();
        let replies: String = seen.unanswered.drain(..).collect();
        drop(seen);
        self.keys(&replies);
    }

    /// The text on the screen.
    pub fn text(&self) -> String {
        self.seen.lock().unwrap().parser.screen().contents()
    }

    /// Waits until the screen is as it should be.
    pub fn wait(&self, what: &str, is_so: impl Fn(&str) -> bool) -> Duration {
        let begun = Instant::now();
        while begun.elapsed() < PATIENCE {
            if is_so(&self.text()) {
                return begun.elapsed();
            }
            thread::sleep(Duration::from_millis(5));
        }
        panic!("waited in vain for {what}; the screen is\n{}", self.text());
    }

    /// Waits for a text to be there.
    pub fn wait_for(&self, text: &str) -> Duration {
        self.wait(text, |screen| screen.contains(text))
    }

    /// Waits for a text to be gone.
    pub fn wait_without(&self, text: &str) -> Duration {
        self.wait(&format!("no {text}"), |screen| !screen.contains(text))
    }

    /// Sends keys.
    pub fn keys(&self, keys: &str) {
        let mut writer = self.writer.lock().unwrap();
        writer.write_all(keys.as_bytes()).unwrap();
        writer.flush().unwrap();
    }

    /// What types on another thread, whether or not anybody reads it any more.
    pub fn typist(&self) -> impl Fn(&str) + Send + use<> {
        let writer = Arc::clone(&self.writer);
        move |keys| {
            let _ = writer.lock().unwrap().write_all(keys.as_bytes());
        }
    }

    /// Changes the size of the terminal.
    pub fn resize(&self, columns: u16, rows: u16) {
        let mut seen = self.seen.lock().unwrap();
        seen.parser.screen_mut().set_size(cells(rows), cells(columns));
        self.master.resize(size(columns, rows)).unwrap();
    }

    /// Bytes and frames that came so far.
    pub fn traffic(&self) -> (usize, usize) {
        let seen = self.seen.lock().unwrap();
        (seen.raw.len(), count(&seen.raw, FRAME))
    }

    /// Everything that came.
    pub fn raw(&self) -> Vec<u8> {
        self.seen.lock().unwrap().raw.clone()
    }

    /// The most questions that were ever open at once.
    pub fn most_open(&self) -> usize {
        self.seen.lock().unwrap().most_open
    }

    /// Waits until nothing has come for a while.
    pub fn settle(&self) {
        let begun = Instant::now();
        let (mut last, mut since) = (self.traffic().0, Instant::now());
        while since.elapsed() < Duration::from_millis(400) {
            assert!(begun.elapsed() < PATIENCE, "never quiet");
            thread::sleep(Duration::from_millis(20));
            let now = self.traffic().0;
            if now != last {
                (last, since) = (now, Instant::now());
            }
        }
    }

    /// The process.
    pub fn pid(&self) -> u32 {
        self.child.process_id().unwrap()
    }

    /// Sends a signal by name to the process.
    pub fn signal(&self, name: &str) {
        signal(name, self.pid());
    }

    /// Waits for the end and gives the exit code.
    pub fn exit_code(&mut self) -> u32 {
        let begun = Instant::now();
        while begun.elapsed() < PATIENCE {
            if let Some(status) = self.child.try_wait().unwrap() {
                // What it wrote last is still on its way.
                thread::sleep(Duration::from_millis(100));
                return status.exit_code();
            }
            thread::sleep(Duration::from_millis(10));
        }
        panic!("still running; the screen is\n{}", self.text());
    }

    /// Fails unless the app has left the screen to others.
    pub fn assert_left(&self) {
        let seen = self.seen.lock().unwrap();
        let screen = seen.parser.screen();
        assert!(!screen.alternate_screen(), "alternate screen left on");
        assert!(!screen.hide_cursor(), "cursor left hidden");
    }

    /// Fails unless the terminal is as it was before the app.
    pub fn assert_restored(&self) {
        self.assert_left();
        let seen = self.seen.lock().unwrap();
        let pasting = seen.parser.screen().bracketed_paste();
        assert!(!pasting, "bracketed paste left on");
        drop(seen);
        self.assert_mouse(false);
        assert_eq!(modes(&*self.master), self.modes, "terminal left in other modes");
    }

    /// Fails unless the terminal reports the mouse, or does not.
    pub fn assert_mouse(&self, on: bool) {
        let seen = self.seen.lock().unwrap();
        let mode = seen.parser.screen().mouse_protocol_mode();
        assert_eq!(mode != vt100::MouseProtocolMode::None, on, "{mode:?}");
    }
}

impl Drop for Term {
    fn drop(&mut self) {
        // The process that this test started, and no other.
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

/// Sends a signal by name to a process.
pub fn signal(name: &str, pid: u32) {
    let status =
        std::process::Command::new("kill").args([&format!("-{name}"), &pid.to_string()]).status();
    assert!(status.unwrap().success());
}

/// The replies to the questions that end after `from`: each question follows the place it asks
/// for.
fn replies_to(raw: &[u8], from: usize) -> Vec<String> {
    let ends = (from + QUESTION.len()..=raw.len()).filter(|end| raw[..*end].ends_with(QUESTION));
    ends.map(|end| {
        let before = String::from_utf8_lossy(&raw[end.saturating_sub(16)..end - QUESTION.len()])
            .into_owned();
        let place = before.rsplit_once("\x1b[").map_or("", |(_, place)| place);
        format!("\x1b[{}R", place.strip_suffix('H').unwrap_or("1;1"))
    })
    .collect()
}

fn listen(
    mut reader: Box<dyn Read + Send>,
    seen: &Arc<Mutex<Seen>>,
    writer: &Arc<Mutex<Box<dyn Write + Send>>>,
    replies: Replies,
) {
    let mut bytes = [0; 8192];
    while let Ok(got @ 1..) = reader.read(&mut bytes) {
        let asked = {
            let mut seen = seen.lock().unwrap();
            seen.parser.process(&bytes[..got]);
            let from = seen.raw.len().saturating_sub(QUESTION.len() - 1);
            seen.raw.extend_from_slice(&bytes[..got]);
            let asked = replies_to(&seen.raw, from);
            seen.open += asked.len();
            seen.most_open = seen.most_open.max(seen.open);
            if seen.stopped {
                seen.unanswered.extend(asked);
                continue;
            }
            asked
        };
        for reply in asked {
            let (seen, writer) = (Arc::clone(seen), Arc::clone(writer));
            let reply = move || {
                seen.lock().unwrap().open -= 1;
                let mut writer = writer.lock().unwrap();
                let _ = writer.write_all(reply.as_bytes());
                let _ = writer.flush();
            };
            match replies {
                Replies::Prompt => reply(),
                Replies::Late(delay) => {
                    thread::spawn(move || {
                        thread::sleep(delay);
                        reply();
                    });
                }
                Replies::Never => {}
            }
        }
    }
}
