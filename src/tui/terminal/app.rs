//! The loop: wait for something to happen, take all of it in, draw once.
//!
//! Keyboard, signals and workers send into one channel. The loop sleeps until something comes or
//! the replay wants its next frame; with nothing to show it writes nothing.

use std::io::{self, Read};
use std::sync::mpsc::{Receiver, RecvTimeoutError, Sender, channel};
use std::thread;
use std::time::{Duration, Instant};

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use signal_hook::consts::{SIGCONT, SIGINT, SIGQUIT, SIGTERM, SIGTSTP, SIGWINCH};
use signal_hook::iterator::Signals;

use super::input::{Input, Parser};
use super::pacer::{Cause, Pacer};
use super::paint::{BEGIN, END, Pen, QUESTION};
use super::session::Session;
use crate::scenario::library;
use crate::study::MeshError;
use crate::study::accuracy::Accuracy;
use crate::study::ensemble::Ensemble;
use crate::study::map::Grid;
use crate::tui::accuracy::measure;
use crate::tui::ensemble::{Sampling, ensemble};
use crate::tui::model::Model;
use crate::tui::open::choices;
use crate::tui::save::{SaveError, save};
use crate::tui::sweep::{Drawing, map};
use crate::tui::update::{Effect, Message, begin, update};
use crate::tui::view;
use crate::tui::worker::{Report, Worker, mesh_error};

/// How the app runs.
pub struct Settings {
    /// Most frames a second of a replay.
    pub fps: u8,
    /// A key that makes the app fail, for a test.
    pub fail_on: Option<char>,
}

/// A lone ESC becomes a key after this long. A slow link may split a sequence between two packets.
const ESCAPE_PATIENCE: Duration = Duration::from_millis(50);
/// How long the last replies are waited for before the terminal is given back.
const FAREWELL: Duration = Duration::from_secs(1);
/// The largest screen that is drawn; a terminal that claims more shows a part.
const LARGEST: (u16, u16) = (500, 200);

/// Something that came from outside.
enum Event {
    Bytes(Vec<u8>),
    Hangup,
    Signal(i32),
    Form(Report),
    Comparison(Report),
    Accuracy(Report<Accuracy>),
    Mesh(Report<MeshError>),
    Ensemble(Report<Ensemble>),
    Map(Report<Grid>),
}

/// Runs the app until the person leaves; gives the exit code.
///
/// # Errors
/// Where the terminal fails.
pub fn run(model: Model, settings: &Settings) -> io::Result<u8> {
    let (send, events) = channel();
    let mut signals = Signals::new([SIGWINCH, SIGTERM, SIGINT, SIGQUIT, SIGCONT])?;
    let session = Session::enter()?;
    let sender = send.clone();
    thread::spawn(move || {
        for signal in signals.forever() {
            if sender.send(Event::Signal(signal)).is_err() {
                return;
            }
        }
    });
    let sender = send.clone();
    thread::spawn(move || read_keyboard(&sender));
    let mut app = App {
        form: worker(&send, Event::Form),
        comparison: worker(&send, Event::Comparison),
        mesh: {
            let send = send.clone();
            Worker::of(mesh_error, move |report| {
                let _ = send.send(Event::Mesh(report));
            })
        },
        ensemble: {
            let send = send.clone();
            Worker::of(ensemble, move |report| {
                let _ = send.send(Event::Ensemble(report));
            })
        },
        map: {
            let send = send.clone();
            Worker::of(map, move |report| {
                let _ = send.send(Event::Map(report));
            })
        },
        accuracy: Worker::of(measure, move |report| {
            let _ = send.send(Event::Accuracy(report));
        }),
        model,
        session,
        events,
        pacer: Pacer::default(),
        parser: Parser::default(),
        escape_since: None,
        screen: Screen::default(),
        dirty: true,
        started: Instant::now(),
        frame_time: Duration::from_secs(1) / u32::from(settings.fps.max(1)),
        last_frame: None,
        exit: None,
        fail_on: settings.fail_on,
    };
    app.run()
}

fn worker(send: &Sender<Event>, wrap: fn(Report) -> Event) -> Worker {
    let send = send.clone();
    Worker::start(move |report| {
        // Nobody listens once the app is leaving.
        let _ = send.send(wrap(report));
    })
}

fn read_keyboard(send: &Sender<Event>) {
    let mut keyboard = io::stdin().lock();
    let mut bytes = [0; 4096];
    loop {
        let event = match keyboard.read(&mut bytes) {
            Ok(0) => Event::Hangup,
            Ok(count) => Event::Bytes(bytes[..count].to_vec()),
            Err(error) if error.kind() == io::ErrorKind::Interrupted => continue,
            Err(_) => Event::Hangup,
        };
        let over = matches!(event, Event::Hangup);
        if send.send(event).is_err() || over {
            return;
        }
    }
}

/// What the terminal shows, and the pen that drew it.
#[derive(Default)]
struct Screen {
    shown: Buffer,
    pen: Pen,
}

struct App {
    model: Model,
    session: Session,
    events: Receiver<Event>,
    form: Worker,
    comparison: Worker,
    mesh: Worker,
    accuracy: Worker,
    ensemble: Worker<Sampling>,
    map: Worker<Drawing>,
    pacer: Pacer,
    parser: Parser,
    escape_since: Option<Instant>,
    screen: Screen,
    dirty: bool,
    started: Instant,
    frame_time: Duration,
    last_frame: Option<Instant>,
    exit: Option<u8>,
    fail_on: Option<char>,
}

impl App {
    fn run(&mut self) -> io::Result<u8> {
        let effects = begin(&mut self.model);
        self.perform(effects)?;
        loop {
            if let Some(code) = self.exit {
                let _ = self.hear_out();
                return Ok(code);
            }
            self.draw_if_due()?;
            match self.events.recv_timeout(self.patience()) {
                Ok(event) => self.take(event)?,
                Err(RecvTimeoutError::Timeout) => {}
                Err(RecvTimeoutError::Disconnected) => return Ok(1),
            }
            // All that has come so far goes into one frame.
            while let Ok(event) = self.events.try_recv() {
                self.take(event)?;
            }
            self.flush_escape()?;
        }
    }

    /// How long nothing needs to be done if nothing happens.
    fn patience(&self) -> Duration {
        let mut wake = None;
        let mut at = |time: Option<Instant>| {
            if let Some(time) = time {
                wake = Some(wake.map_or(time, |other: Instant| other.min(time)));
            }
        };
        at(self.escape_since.map(|since| since + ESCAPE_PATIENCE));
        let wants_frame = self.dirty || self.model.clock.playing;
        if wants_frame {
            let due = self.last_frame.map(|last| last + self.frame_time);
            match self.pacer.wake_at() {
                Some(time) => at(Some(time.max(due.unwrap_or(time)))),
                None => at(due),
            }
        }
        let now = Instant::now();
        wake.map_or(Duration::from_secs(3600), |time| {
            time.saturating_duration_since(now)
        })
    }

    fn draw_if_due(&mut self) -> io::Result<()> {
        let now = Instant::now();
        let animated = self.model.clock.playing
            && self
                .last_frame
                .is_none_or(|last| now.saturating_duration_since(last) >= self.frame_time);
        let cause = if self.dirty {
            Cause::Event
        } else {
            Cause::Replay
        };
        if !(self.dirty || animated) || !self.pacer.is_free(now, cause) {
            return Ok(());
        }
        self.tick();
        self.model.slow_link = self.pacer.is_slow();
        self.dirty = false;
        self.last_frame = Some(now);
        self.draw(now)
    }

    fn draw(&mut self, now: Instant) -> io::Result<()> {
        let (width, height) = crossterm::terminal::size().unwrap_or((80, 24));
        let area = Rect::new(0, 0, width.clamp(1, LARGEST.0), height.clamp(1, LARGEST.1));
        let mut next = Buffer::empty(area);
        view::draw(&self.model, &mut next);
        let mut frame = BEGIN.to_vec();
        if self.screen.shown.area != area {
            self.screen = Screen {
                shown: Buffer::empty(area),
                pen: Pen::default(),
            };
            frame.extend_from_slice(b"\x1b[0m\x1b[2J");
        }
        let empty = frame.len();
        self.screen.pen.draw(&self.screen.shown, &next, &mut frame);
        self.screen.shown = next;
        if frame.len() == empty && empty == BEGIN.len() {
            return Ok(());
        }
        frame.extend_from_slice(END);
        if self.pacer.asks() {
            frame.extend_from_slice(QUESTION);
        }
        self.pacer.sent(now, frame.len());
        self.session.write(&frame)
    }

    fn take(&mut self, event: Event) -> io::Result<()> {
        let message = match event {
            Event::Bytes(bytes) => {
                let inputs = self.parser.feed(&bytes);
                for input in inputs {
                    self.take_input(input)?;
                }
                self.escape_since = self.parser.is_waiting().then(Instant::now);
                return Ok(());
            }
            Event::Hangup => {
                self.exit = Some(129);
                return Ok(());
            }
            Event::Signal(signal) => return self.take_signal(signal),
            Event::Form(report) => Message::Form(report),
            Event::Comparison(report) => Message::Comparison(report),
            Event::Accuracy(report) => Message::Accuracy(report),
            Event::Mesh(report) => Message::Mesh(report),
            Event::Ensemble(report) => Message::Ensemble(report),
            Event::Map(report) => Message::Map(report),
        };
        self.tell(message)
    }

    fn take_signal(&mut self, signal: i32) -> io::Result<()> {
        match signal {
            SIGCONT => {
                // Whoever stopped the app may have left the terminal in any state.
                self.session.retake()?;
                self.repaint();
            }
            SIGWINCH => self.dirty = true,
            other => self.exit = Some(u8::try_from(128 + other).unwrap_or(1)),
        }
        Ok(())
    }

    fn flush_escape(&mut self) -> io::Result<()> {
        let overdue = |since: Instant| since.elapsed() >= ESCAPE_PATIENCE;
        if self.escape_since.is_some_and(overdue) {
            self.escape_since = None;
            if let Some(input) = self.parser.flush() {
                self.take_input(input)?;
            }
        }
        Ok(())
    }

    fn take_input(&mut self, input: Input) -> io::Result<()> {
        match input {
            Input::Key(event) => {
                if let (Some(fatal), crossterm::event::KeyCode::Char(c)) =
                    (self.fail_on, event.code)
                {
                    assert!(c != fatal, "failed on purpose");
                }
                self.tell(Message::Key(event))
            }
            Input::Paste(text) => self.tell(Message::Paste(text)),
            // The loop looks afresh at what may be sent.
            Input::CursorReport => {
                self.pacer.replied(Instant::now());
                Ok(())
            }
        }
    }

    /// Tells the model what time it is. It must know before a key starts the replay, or the replay
    /// would begin with all the time that passed since the last frame.
    fn tick(&mut self) {
        let effects = update(&mut self.model, Message::Tick(self.started.elapsed()));
        debug_assert!(effects.is_empty(), "time alone asks for nothing");
    }

    fn tell(&mut self, message: Message) -> io::Result<()> {
        self.dirty = true;
        self.tick();
        let effects = update(&mut self.model, message);
        self.perform(effects)
    }

    /// Waits for the replies that are still under way: whoever reads the terminal next would take
    /// them for typed text. Keys that come meanwhile are dropped; the news of workers is returned.
    fn hear_out(&mut self) -> Vec<Event> {
        let mut news = Vec::new();
        let until = Instant::now() + FAREWELL;
        while self.pacer.awaits() {
            let left = until.saturating_duration_since(Instant::now());
            let Ok(event) = self.events.recv_timeout(left) else {
                break;
            };
            match event {
                Event::Bytes(bytes) => {
                    for input in self.parser.feed(&bytes) {
                        if input == Input::CursorReport {
                            self.pacer.replied(Instant::now());
                        }
                    }
                }
                Event::Hangup => break,
                other => news.push(other),
            }
        }
        news
    }

    fn repaint(&mut self) {
        // A screen of no size differs from any other.
        self.screen = Screen::default();
        self.dirty = true;
    }

    fn perform(&mut self, effects: Vec<Effect>) -> io::Result<()> {
        for effect in effects {
            match effect {
                Effect::Solve(ticket, scenario) => {
                    self.mesh.cancel(ticket);
                    self.form.submit(ticket, scenario);
                }
                Effect::EstimateMesh(ticket, scenario) => self.mesh.submit(ticket, scenario),
                Effect::Stop(ticket) => self.form.cancel(ticket),
                Effect::StopComparing(ticket) => self.comparison.cancel(ticket),
                Effect::Compare(ticket, scenario) => self.comparison.submit(ticket, scenario),
                Effect::Measure(ticket, scenario) => self.accuracy.submit(ticket, scenario),
                Effect::StopMeasuring(ticket) => self.accuracy.cancel(ticket),
                Effect::Sample(ticket, question) => self.ensemble.submit(ticket, question),
                Effect::StopSampling(ticket) => self.ensemble.cancel(ticket),
                Effect::Draw(ticket, question) => self.map.submit(ticket, question),
                Effect::StopDrawing(ticket) => self.map.cancel(ticket),
                Effect::Save(name, text, replace) => self.save(name, &text, replace)?,
                Effect::Suspend => self.suspend()?,
                Effect::Repaint => self.repaint(),
                Effect::Quit(code) => self.exit = Some(code),
            }
        }
        Ok(())
    }

    fn save(&mut self, name: String, text: &str, replace: bool) -> io::Result<()> {
        let outcome = match library::folder() {
            Some(folder) => save(&folder, &name, text, replace),
            None => Err(SaveError::Failed("there is no home folder".to_owned())),
        };
        let is_saved = outcome.is_ok();
        self.tell(Message::Saved(name, outcome))?;
        if is_saved {
            self.tell(Message::Choices(choices()))?;
        }
        Ok(())
    }

    /// Stops until the shell goes on with the app. Without a shell the system ignores the signal
    /// and the app stays.
    fn suspend(&mut self) -> io::Result<()> {
        let news = self.hear_out();
        self.session.leave();
        signal_hook::low_level::raise(SIGTSTP)?;
        self.session.resume()?;
        self.repaint();
        news.into_iter().try_for_each(|event| self.take(event))
    }
}
