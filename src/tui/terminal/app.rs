//! The loop: wait for something to happen, take all of it in, draw once.
//!
//! Keyboard, signals and workers send into one channel. The loop sleeps until something comes or
//! the replay wants its next frame; with nothing to show it writes nothing.

use std::any::TypeId;
use std::collections::{HashMap, hash_map::Entry};
use std::io::{self, Write};
use std::path::Path;
use std::sync::mpsc::{Receiver, RecvTimeoutError, SyncSender, sync_channel};
use std::time::{Duration, Instant};

use crossterm::{Command, clipboard::CopyToClipboard, event::KeyCode};
use ratatui::buffer::Buffer;
use ratatui::layout::Rect;

use crate::scenario::library;
use crate::tui::app::update::{Message, begin, update};
use crate::tui::app::{App, frame};
use crate::tui::save::{SaveError, page, remove, rename, save};
use crate::tui::terminal::event::{Event, leaving};
use crate::tui::terminal::input::{Parser, TerminalInput};
use crate::tui::terminal::pacer::{Cause, Pacer};
use crate::tui::terminal::paint::{BEGIN, END, Pen, question};
use crate::tui::terminal::{session::Session, system};
use crate::tui::{guest::LONGEST_ANSWER, outbox::Effect, picker::choices};
use crate::tui::{request::Request, worker::Worker};

/// How the app runs.
#[derive(Clone, Copy)]
pub struct Settings {
    /// Most frames a second of a replay.
    pub fps: u8,
    /// A key that makes the app fail, for a test.
    pub fail_on: Option<char>,
    /// How long a guest may touch no key; nobody else is sent away.
    pub guest_limit: Option<Duration>,
}

/// Events that wait at most: who types faster than is done is held up, not remembered.
const QUEUE: usize = 8;

/// The largest screen that is drawn; a terminal that claims more shows a part.
const LARGEST: (u16, u16) = (500, 200);

/// Runs the app until the person leaves; gives the exit code and what it was left as.
///
/// # Errors
/// Where the terminal fails.
pub fn run(app: App, settings: &Settings) -> io::Result<(u8, App)> {
    let (sender, events) = sync_channel(QUEUE);
    let signals = system::signals()?;
    let session = Session::enter()?;
    system::listen(&sender, signals)?;
    let event_loop = EventLoop {
        sender,
        workers: HashMap::new(),
        app,
        session,
        events,
        pacer: system::pacer(),
        parser: Parser::default(),
        escape_since: None,
        shown: Buffer::default(),
        pen: Pen::default(),
        dirty: true,
        started: Instant::now(),
        frame_time: Duration::from_secs(1) / u32::from(settings.fps.max(1)),
        last_frame: None,
        exit: None,
        settings: *settings,
        last_key: Instant::now(),
    };
    let (code, is_abandoned, app) = event_loop.run()?;
    if is_abandoned {
        // An error means that nobody reads any more.
        let _ = writeln!(io::stderr(), "The session ended: no key was pressed for a while.");
    }
    Ok((code, app))
}

/// Does something in the folder of the person's own presets.
fn in_folder<T>(act: impl FnOnce(&Path) -> Result<T, SaveError>) -> Result<T, SaveError> {
    let homeless = || SaveError::Failed("there is no home folder".to_owned());
    act(&library::folder().ok_or_else(homeless)?)
}

/// What came of something, in words.
fn said_of(outcome: Result<String, SaveError>) -> Message {
    Message::Said(outcome.unwrap_or_else(|error| error.to_string()))
}

/// The escape sequence (OSC 52) that puts a text on the clipboard of whoever sits at the terminal,
/// even over ssh; none for consoles that would print it. Nobody asks whether a terminal takes it,
/// most that do not pass over it; through tmux it goes both ways, as one may be passed on.
fn copied(text: &str, env: impl Fn(&str) -> Option<String>) -> Option<String> {
    let term = env("TERM").unwrap_or_default();
    // Consoles without a clipboard, and real terminals.
    if term == "linux" || term == "dumb" || term.starts_with("vt") {
        return None;
    }
    let mut plain = String::new();
    // A string takes whatever it is given.
    let _ = CopyToClipboard::to_clipboard_from(text).write_ansi(&mut plain);
    if env("TMUX").is_some_and(|tmux| !tmux.is_empty()) {
        // Within a passage through tmux every escape is doubled.
        let passed = plain.replace('\x1b', "\x1b\x1b");
        return Some(format!("{plain}\x1bPtmux;{passed}\x1b\\"));
    }
    Some(plain)
}

struct EventLoop {
    app: App,
    session: Session,
    events: Receiver<Event>,
    sender: SyncSender<Event>,
    /// A thread for each kind of question, begun when first asked.
    workers: HashMap<(TypeId, bool), Worker>,
    pacer: Pacer,
    parser: Parser,
    escape_since: Option<Instant>,
    /// What the terminal shows, and the pen that drew it.
    shown: Buffer,
    pen: Pen,
    dirty: bool,
    started: Instant,
    frame_time: Duration,
    last_frame: Option<Instant>,
    exit: Option<u8>,
    settings: Settings,
    last_key: Instant,
}

impl EventLoop {
    /// Runs until the person leaves, then gives the terminal back and stops all work; the exit
    /// code, whether a guest was sent away, and what was left.
    fn run(mut self) -> io::Result<(u8, bool, App)> {
        self.session.listen_to_mouse(self.app.model.mouse)?;
        let effects = begin(&mut self.app);
        self.perform(effects)?;
        loop {
            if let Some(code) = self.exit {
                let _ = self.wait_for_replies();
                return Ok((code, self.is_abandoned(), self.app));
            }
            self.draw_if_due()?;
            match self.events.recv_timeout(self.patience()) {
                Ok(event) => self.handle(event)?,
                Err(RecvTimeoutError::Timeout) => {}
                Err(RecvTimeoutError::Disconnected) => self.exit = Some(1),
            }
            // All that has come goes into one frame, unless it takes longer than a frame may.
            let until = Instant::now() + self.frame_time;
            while self.exit.is_none()
                && Instant::now() < until
                && let Ok(event) = self.events.try_recv()
            {
                self.handle(event)?;
            }
            let overdue = |since: Instant| since.elapsed() >= self.parser.patience();
            if self.escape_since.take_if(|since| overdue(*since)).is_some()
                && let Some(input) = self.parser.flush()
            {
                self.handle_input(input)?;
            }
            if self.is_abandoned() {
                self.exit = self.exit.or(Some(0));
            }
        }
    }

    /// Whether a guest has touched no key for too long.
    fn is_abandoned(&self) -> bool {
        self.settings.guest_limit.is_some_and(|limit| self.last_key.elapsed() >= limit)
    }

    /// When the next frame of a replay is due, if there was one before.
    fn next_frame(&self) -> Option<Instant> {
        self.last_frame.map(|last| last + self.frame_time)
    }

    /// How long nothing needs to be done if nothing happens.
    fn patience(&self) -> Duration {
        let escape = self.escape_since.map(|since| since + self.parser.patience());
        let guest = self.settings.guest_limit.map(|limit| self.last_key + limit);
        let changes = self.dirty || self.app.model.clock.playing;
        // None comes before all others.
        let frame = self.pacer.wake_at().max(self.next_frame()).filter(|_| changes);
        let wake = [escape, guest, frame].into_iter().flatten().min();
        let left = |time: Instant| time.saturating_duration_since(Instant::now());
        wake.map_or(Duration::from_secs(3600), left)
    }

    fn draw_if_due(&mut self) -> io::Result<()> {
        let now = Instant::now();
        let cause = if self.dirty {
            Cause::Event
        } else if self.app.model.clock.playing && self.next_frame().is_none_or(|due| now >= due) {
            Cause::Replay
        } else {
            return Ok(());
        };
        if !self.pacer.is_free(now, cause) {
            let probe = self.pacer.probe(now);
            return probe.map_or(Ok(()), |column| self.session.write(&question(column)));
        }
        self.tick();
        self.app.model.slow_link = self.pacer.is_slow();
        self.dirty = false;
        self.last_frame = Some(now);
        self.draw(now)
    }

    fn draw(&mut self, now: Instant) -> io::Result<()> {
        let (width, height) = crossterm::terminal::size().unwrap_or((80, 24));
        let area = Rect::new(0, 0, width.clamp(1, LARGEST.0), height.clamp(1, LARGEST.1));
        let mut next = Buffer::empty(area);
        frame::draw(&self.app, &mut next);
        let mut bytes = BEGIN.to_vec();
        if self.shown.area != area {
            (self.shown, self.pen) = (Buffer::empty(area), Pen::default());
            bytes.extend_from_slice(b"\x1b[0m\x1b[2J");
        }
        self.pen.draw(&self.shown, &next, &mut bytes);
        self.shown = next;
        if bytes.len() == BEGIN.len() {
            return Ok(());
        }
        bytes.extend_from_slice(END);
        if let Some(column) = self.pacer.sent(now, bytes.len()) {
            bytes.extend(question(column));
        }
        self.session.write(&bytes)
    }

    fn handle(&mut self, event: Event) -> io::Result<()> {
        match event {
            Event::Bytes(bytes) => {
                for input in self.parser.feed(&bytes) {
                    if let Some(code) = leaving() {
                        self.exit = Some(code);
                        break;
                    }
                    self.handle_input(input)?;
                }
                self.escape_since = self.parser.is_waiting().then(Instant::now);
            }
            Event::Input(input) => self.handle_input(input)?,
            Event::Resized => self.dirty = true,
            Event::Continued => {
                // Whoever stopped the app may have left the terminal in any state.
                self.session.resume()?;
                self.repaint();
            }
            Event::End(code) => self.exit = Some(code),
            Event::News(message) => self.send(message)?,
        }
        Ok(())
    }

    fn handle_input(&mut self, input: TerminalInput) -> io::Result<()> {
        if let TerminalInput::CursorReport(column) = input {
            // The loop looks afresh at what may be sent.
            self.pacer.replied(Instant::now(), column);
        } else {
            self.last_key = Instant::now();
        }
        let size = (self.shown.area.width, self.shown.area.height);
        match input {
            TerminalInput::Key(event) => {
                let fatal = self.settings.fail_on.map(KeyCode::Char);
                assert!(fatal != Some(event.code), "failed on purpose");
                self.send(Message::Key(event))
            }
            TerminalInput::Paste(text) => self.send(Message::Paste(text)),
            TerminalInput::Mouse(event) if self.app.model.mouse => {
                self.send(Message::Mouse(event, size))
            }
            // The mouse may have been switched off since.
            TerminalInput::Mouse(_) | TerminalInput::CursorReport(_) => Ok(()),
        }
    }

    /// Tells the model what time it is. It must know before a key starts the replay, or the replay
    /// would begin with all the time that passed since the last frame.
    fn tick(&mut self) {
        let effects = update(&mut self.app, Message::Tick(self.started.elapsed()));
        debug_assert!(effects.is_empty(), "time alone asks for nothing");
    }

    fn send(&mut self, message: Message) -> io::Result<()> {
        self.dirty = true;
        self.tick();
        let effects = update(&mut self.app, message);
        self.perform(effects)
    }

    /// Waits for the replies that are still under way: whoever reads the terminal next would take
    /// them for typed text. Everything else that comes meanwhile is returned.
    fn wait_for_replies(&mut self) -> Vec<Event> {
        let mut news = Vec::new();
        let until = Instant::now() + self.pacer.farewell();
        while self.pacer.awaits() {
            let left = until.saturating_duration_since(Instant::now());
            // A flood of keys always has one more.
            if left.is_zero() {
                break;
            }
            match self.events.recv_timeout(left) {
                Ok(Event::Bytes(bytes)) => {
                    for input in self.parser.feed(&bytes) {
                        if let TerminalInput::CursorReport(column) = input {
                            self.pacer.replied(Instant::now(), column);
                        } else {
                            news.push(Event::Input(input));
                        }
                    }
                }
                Ok(end @ Event::End(_)) => {
                    news.push(end);
                    break;
                }
                Ok(other) => news.push(other),
                Err(_) => break,
            }
        }
        news
    }

    fn repaint(&mut self) {
        // A screen of no size differs from any other.
        self.shown = Buffer::default();
        self.dirty = true;
    }

    fn perform(&mut self, effects: Vec<Effect>) -> io::Result<()> {
        for effect in effects {
            match effect {
                Effect::Save(name, text, replace) => {
                    let outcome = in_folder(|folder| save(folder, &name, &text, replace));
                    self.changed(Message::Saved(name, outcome))?;
                }
                Effect::Rename(from, to) => {
                    let outcome = in_folder(|folder| rename(folder, &from, &to));
                    self.changed(Message::Renamed(from, to, outcome))?;
                }
                Effect::Remove(name) => {
                    let outcome = in_folder(|folder| remove(folder, &name));
                    self.changed(Message::Removed(name, outcome))?;
                }
                Effect::Restore(name, text) => {
                    let outcome = in_folder(|folder| save(folder, &name, &text, false));
                    let said = outcome.map(|()| format!("{name} is back: p lists it"));
                    self.changed(said_of(said))?;
                }
                Effect::Page(stem, text) => {
                    let said = page(Path::new("."), &stem, &text).map(|path| {
                        let name = path.file_name().unwrap_or_default().to_string_lossy();
                        let folder = std::env::current_dir().unwrap_or_default();
                        format!("written: {name} in {}", folder.display())
                    });
                    self.send(said_of(said))?;
                }
                Effect::Copy(text) => {
                    let mut said = "this terminal has no clipboard";
                    if let Some(bytes) = copied(&text, |name| std::env::var(name).ok()) {
                        self.session.write(bytes.as_bytes())?;
                        said = "summary sent to the clipboard";
                    }
                    self.send(Message::Said(said.to_owned()))?;
                }
                Effect::Suspend => self.suspend()?,
                Effect::Mouse(listen) => self.session.listen_to_mouse(listen)?,
                Effect::Repaint => self.repaint(),
                Effect::Quit(code) => self.exit = Some(code),
                Effect::Start(request) => self.start(request)?,
                Effect::Stop(ticket) => self.workers.values().for_each(|w| w.cancel(ticket)),
            }
        }
        Ok(())
    }

    /// Says what came of a change of the person's presets, and which there are now.
    fn changed(&mut self, outcome: Message) -> io::Result<()> {
        self.send(outcome)?;
        self.send(Message::Choices(choices()))
    }

    /// Hands a request to the thread of its kind.
    fn start(&mut self, request: Request) -> io::Result<()> {
        let kind = request.kind;
        if let Entry::Vacant(none) = self.workers.entry(kind) {
            let limit = self.settings.guest_limit.map(|_| LONGEST_ANSWER);
            let sender = self.sender.clone();
            // Nobody listens once the app is leaving.
            let tell = move |report| drop(sender.send(Event::News(Message::News(report))));
            none.insert(Worker::start(limit, kind.1, tell)?);
        }
        self.workers[&kind].submit(request);
        Ok(())
    }

    /// Stops until the shell goes on with the app. Without a shell the system ignores the signal
    /// and the app stays. Keys typed before the shell has the terminal wait until then.
    fn suspend(&mut self) -> io::Result<()> {
        let mut news = self.wait_for_replies();
        // Who asks twice wants to stop once.
        news.retain(|event| !event.is_suspend());
        if !news.iter().any(|event| matches!(event, Event::End(_))) {
            self.session.leave();
            system::stop()?;
            self.session.resume()?;
            self.repaint();
        }
        news.into_iter().try_for_each(|event| self.handle(event))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_text_goes_out_in_base64_through_tmux_both_ways_and_to_no_console() {
        let plain = "\x1b]52;c;YSBzdW1tYXJ5Cg==\x1b\\";
        let wrapped = "\x1bPtmux;\x1b\x1b]52;c;YSBzdW1tYXJ5Cg==\x1b\x1b\\\x1b\\";
        for (term, tmux, expected) in [
            ("linux", "", None),
            ("vt100", "", None),
            ("xterm-256color", "", Some(plain.to_owned())),
            ("tmux-256color", "/tmp/tmux", Some(format!("{plain}{wrapped}"))),
        ] {
            let env = |name: &str| Some(if name == "TERM" { term } else { tmux }.to_owned());
            assert_eq!(copied("a summary\n", env), expected, "{term}");
        }
    }
}
