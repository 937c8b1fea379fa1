//! Progress of long work: one line on standard error that is written anew, if that is a terminal.

use std::io::{self, IsTerminal, Write};
use std::ops::ControlFlow;
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

use crate::report::pace::Pace;

/// Work shorter than this shows no progress.
const PATIENCE: Duration = Duration::from_millis(500);
/// In a log or a pipe it is said early what goes on for this many seconds, after this many.
const LONG: f64 = 60.0;
const KNOWN: Duration = Duration::from_secs(5);
/// Nothing is silent there for longer than this from its beginning; each silence that follows is
/// as long as all before it.
const SILENCE: Duration = Duration::from_secs(20);
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
    /// When it was said last in a log how far it is, from the beginning.
    said: Option<Duration>,
}

impl Line {
    /// What is said in a log at a time from the beginning, if it is time for it.
    fn logged(&mut self, what: &str, of: Option<usize>, elapsed: Duration) -> Option<String> {
        let is_long = elapsed > KNOWN && self.pace.left.is_some_and(|left| left >= LONG);
        let silent = self.said.map_or(SILENCE, |said| SILENCE.max(2 * said));
        if elapsed < silent && (self.said.is_some() || !is_long) {
            return None;
        }
        self.said = Some(elapsed);
        let (seconds, words) = (elapsed.as_secs(), self.pace.words(of));
        Some(format!("{what}, {seconds} s so far: {words}"))
    }
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
        if !self.visible
            && let Some(said) = line.logged(what, of, elapsed)
        {
            let _ = writeln!(io::stderr(), "{said}");
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn in_a_log_no_silence_is_longer_than_all_before_it() {
        let mut line = Line::default();
        let said = |line: &mut Line, seconds: u64| {
            let elapsed = Duration::from_secs(seconds);
            // Each half of the work begins anew, so that no time is ever known.
            line.pace.advance(if seconds.is_multiple_of(2) { 0.9 } else { 0.1 }, elapsed);
            line.logged("simulating", None, elapsed)
        };
        let all: Vec<u64> = (0..200).filter(|at| said(&mut line, *at).is_some()).collect();
        assert_eq!(all, [20, 40, 80, 160]);
        let mut slow = Line::default();
        slow.pace.advance(0.0, Duration::ZERO);
        slow.pace.advance(0.05, Duration::from_secs(6));
        let words = slow.logged("rows", Some(40), Duration::from_secs(6));
        assert_eq!(words.as_deref(), Some("rows, 6 s so far: 2 of 40, about 2 min"));
    }
}
