//! Progress of long work: one line on standard error, if that is a terminal.

use std::io::{self, IsTerminal, Write};
use std::ops::ControlFlow;
use std::time::{Duration, Instant};

/// Work shorter than this shows no progress.
const PATIENCE: Duration = Duration::from_millis(500);

/// A line on standard error, if that is a terminal, once the work takes long.
pub(super) struct Progress {
    began: Instant,
    shown: Option<(&'static str, u32)>,
    visible: bool,
}

impl Progress {
    pub fn new() -> Self {
        Self {
            began: Instant::now(),
            shown: None,
            visible: io::stderr().is_terminal(),
        }
    }

    pub fn show(&mut self, what: &'static str, share: f64) {
        let now = (what, (100.0 * share) as u32);
        if self.visible && self.shown != Some(now) && self.began.elapsed() > PATIENCE {
            self.shown = Some(now);
            // Nobody is hurt if a line of progress is lost.
            let _ = write!(io::stderr(), "\r{what}: {} %\x1b[K", now.1);
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
