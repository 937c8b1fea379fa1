//! Progress of long work: one line on standard error that is written anew, if that is a terminal.

use std::io::{self, IsTerminal, Write};
use std::ops::ControlFlow;
use std::time::{Duration, Instant};

use crate::report::pace::Pace;

/// Work shorter than this shows no progress.
const PATIENCE: Duration = Duration::from_millis(500);
/// The line is written anew this often at most.
const EVERY: Duration = Duration::from_millis(100);

/// A line on standard error, if that is a terminal, once the work takes long.
pub(super) struct Progress {
    began: Instant,
    pace: Pace,
    shown: Option<(String, Instant)>,
    visible: bool,
}

impl Progress {
    pub fn new() -> Self {
        Self {
            began: Instant::now(),
            pace: Pace::default(),
            shown: None,
            visible: io::stderr().is_terminal(),
        }
    }

    /// Says once what is begun, where no line of progress can follow it: in a log or a pipe.
    pub fn announce(&self, what: &str) {
        if !self.visible {
            // Nobody is hurt if it is lost.
            let _ = writeln!(io::stderr(), "{what}");
        }
    }

    /// Shows what share of the work is done.
    pub fn show(&mut self, what: &str, share: f64) {
        self.put(what, share, None);
    }

    /// Shows how many are done of how many.
    pub fn count(&mut self, what: &str, done: usize, of: usize) {
        self.put(what, done as f64 / of.max(1) as f64, Some(of));
    }

    fn put(&mut self, what: &str, share: f64, of: Option<usize>) {
        let elapsed = self.began.elapsed();
        self.pace.advance(share, elapsed);
        let recent = |(_, at): &(String, Instant)| at.elapsed() < EVERY;
        if !self.visible || elapsed <= PATIENCE || self.shown.as_ref().is_some_and(recent) {
            return;
        }
        let line = format!("{what}: {}", self.pace.words(of));
        if self.shown.as_ref().is_none_or(|(shown, _)| *shown != line) {
            // Nobody is hurt if a line of progress is lost.
            let _ = write!(io::stderr(), "\r{line}\x1b[K");
            self.shown = Some((line, Instant::now()));
        }
    }

    /// Shows how much has been simulated; never stops the run.
    pub fn simulated(&mut self, share: f64) -> ControlFlow<()> {
        self.show("simulating", share);
        ControlFlow::Continue(())
    }

    /// Shows how much has been measured; never stops it.
    pub fn measured(&mut self, share: f64) -> ControlFlow<()> {
        self.show("measuring", share);
        ControlFlow::Continue(())
    }

    pub fn clear(&mut self) {
        if self.shown.take().is_some() {
            let _ = write!(io::stderr(), "\r\x1b[K");
        }
    }
}
