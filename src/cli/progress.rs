//! Progress of long work: one line on standard error that is written anew, if that is a terminal.

use std::io::{self, IsTerminal, Write};
use std::ops::ControlFlow;
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

use crate::report::pace::Pace;

/// Work shorter than this shows no progress.
const PATIENCE: Duration = Duration::from_millis(500);
/// In a log or a pipe it is said once what goes on for this many seconds, after this many.
const LONG: f64 = 60.0;
const KNOWN: Duration = Duration::from_secs(5);
/// The line is written anew this often at most.
const EVERY: Duration = Duration::from_millis(100);

pub(super) struct Progress {
    began: Instant,
    visible: bool,
    line: Mutex<Line>,
}

#[derive(Default)]
struct Line {
    pace: Pace,
    shown: Option<(String, Instant)>,
    said: bool,
}

/// What `work` gives, which tells on a line how far it is.
pub(super) fn shown<T>(work: impl FnOnce(&Progress) -> T) -> T {
    let progress = Progress::new();
    let found = work(&progress);
    progress.clear();
    found
}

impl Progress {
    pub fn new() -> Self {
        Self { began: Instant::now(), visible: io::stderr().is_terminal(), line: Mutex::default() }
    }

    fn line(&self) -> MutexGuard<'_, Line> {
        self.line.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Says once what is begun, where no line of progress can follow it: in a log or a pipe.
    pub fn announce(&self, what: &str) {
        if !self.visible {
            // Nobody is hurt if it is lost.
            let _ = writeln!(io::stderr(), "{what}");
        }
    }

    pub fn show(&self, what: &str, share: f64) {
        self.show_of(what, share, None);
    }

    pub fn count(&self, what: &str, done: usize, of: usize) {
        self.show_of(what, done as f64 / of.max(1) as f64, Some(of));
    }

    /// Shows what share is done, of so many where that is known.
    pub fn show_of(&self, what: &str, share: f64, of: Option<usize>) {
        let elapsed = self.began.elapsed();
        let mut line = self.line();
        line.pace.advance(share, elapsed);
        let is_long = line.pace.left.is_some_and(|left| left >= LONG);
        if !self.visible && !line.said && elapsed > KNOWN && is_long {
            line.said = true;
            let _ = writeln!(io::stderr(), "{what}: {}", line.pace.words(of));
        }
        let recent = |(_, at): &(String, Instant)| at.elapsed() < EVERY;
        if !self.visible || elapsed <= PATIENCE || line.shown.as_ref().is_some_and(recent) {
            return;
        }
        let text = format!("{what}: {}", line.pace.words(of));
        if line.shown.as_ref().is_none_or(|(shown, _)| *shown != text) {
            let _ = write!(io::stderr(), "\r{text}\x1b[K");
            line.shown = Some((text, Instant::now()));
        }
    }

    /// A watch that shows what share is done and never stops the work.
    pub fn watch(&self, what: &str) -> impl FnMut(f64) -> ControlFlow<()> {
        move |share| {
            self.show(what, share);
            ControlFlow::Continue(())
        }
    }

    pub fn clear(&self) {
        if self.line().shown.take().is_some() {
            let _ = write!(io::stderr(), "\r\x1b[K");
        }
    }
}
