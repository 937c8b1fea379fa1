//! When the next frame may be sent.
//!
//! Every frame ends with a question for the cursor's place. A frame of the replay waits for the
//! replies to all before it; a frame that answers a key may follow one other at once. So at most
//! two frames are under way however slow the link is. Without this, a secure shell buffers
//! megabytes of frames and a key waits behind them all.
//!
//! Questions and replies are counted. A reply to a question that was given up must not free a later
//! frame. A terminal that fails to answer twice in a row is never asked again; a budget of bytes a
//! second takes over.

use std::collections::VecDeque;
use std::time::{Duration, Instant};

/// How long a reply is waited for.
const PATIENCE: Duration = Duration::from_secs(2);
/// Unanswered questions in a row after which no more are asked.
const MAX_SILENCES: u32 = 2;
/// Seconds: a reply is thought to take at least the first, and none is waited for beyond the other.
const FAREWELL: (f64, f64) = (0.15, 1.0);
/// Bytes a second for a terminal that never answers.
const BUDGET: f64 = 6000.0;
/// Below this many bytes a second a link is slow.
const SLOW: f64 = 12_000.0;
/// Frames that the speed of the link is judged by.
const SAMPLES: usize = 16;
/// Fewer say too little, and so do frames of much the same size, in bytes.
const FEWEST: usize = 5;
const LEAST_DEVIATION: f64 = 100.0;

/// Counts questions and replies and says when a frame may go out.
#[derive(Debug, Default)]
pub struct Pacer {
    /// When frames without a reply went out, and how large they were.
    open: VecDeque<(Instant, usize)>,
    given_up: u32,
    /// Whether whoever shows the frames takes them as they are written.
    local: bool,
    silences: u32,
    free_at: Option<Instant>,
    /// Bytes of the last frames and the seconds until their replies.
    samples: VecDeque<(f64, f64)>,
    /// Seconds that a byte takes.
    per_byte: f64,
}

/// What a frame is drawn for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Cause {
    /// Time passed in the replay.
    Replay,
    /// Anything else, such as a key.
    Event,
}

impl Pacer {
    /// For a terminal that has shown a frame when the write returns: nothing is asked or waited for.
    pub fn local() -> Self {
        Self {
            local: true,
            ..Self::default()
        }
    }

    /// Whether a frame should end with a question.
    pub fn asks(&self) -> bool {
        !self.local && self.silences < MAX_SILENCES
    }

    /// A frame of so many bytes went out.
    pub fn sent(&mut self, now: Instant, bytes: usize) {
        if self.asks() {
            self.open.push_back((now, bytes));
        } else if !self.local {
            self.free_at = Some(now + Duration::from_secs_f64(bytes as f64 / BUDGET));
        }
    }

    /// A reply came.
    pub fn replied(&mut self, now: Instant) {
        if self.given_up > 0 {
            self.given_up -= 1;
        } else if let Some((since, bytes)) = self.open.pop_front() {
            self.silences = 0;
            let delay = now.saturating_duration_since(since).as_secs_f64();
            if self.samples.len() == SAMPLES {
                self.samples.pop_front();
            }
            self.samples.push_back((bytes as f64, delay));
            self.judge();
        }
    }

    /// Tells bytes from round trip: the slope of the line through the samples.
    fn judge(&mut self) {
        let count = self.samples.len() as f64;
        let mean = |of: fn(&(f64, f64)) -> f64| self.samples.iter().map(of).sum::<f64>() / count;
        let (size, delay) = (mean(|s| s.0), mean(|s| s.1));
        let sum = |of: &dyn Fn(f64, f64) -> f64| -> f64 {
            let part = |s: &(f64, f64)| of(s.0 - size, s.1 - delay);
            self.samples.iter().map(part).sum()
        };
        let variance = sum(&|bytes, _| bytes * bytes) / count;
        if self.samples.len() >= FEWEST && variance > LEAST_DEVIATION * LEAST_DEVIATION {
            self.per_byte = sum(&|bytes, seconds| bytes * seconds) / count / variance;
        }
    }

    /// Whether a frame may go out; gives up on a reply that is overdue.
    pub fn is_free(&mut self, now: Instant, cause: Cause) -> bool {
        let overdue = |since: Instant| now.saturating_duration_since(since) >= PATIENCE;
        if self.open.front().is_some_and(|(since, _)| overdue(*since)) {
            // What came after it is no sooner answered.
            self.given_up += self.open.len() as u32;
            self.open.clear();
            self.silences += 1;
        }
        let most = match cause {
            Cause::Replay => 0,
            Cause::Event => 1,
        };
        self.open.len() <= most && self.free_at.is_none_or(|at| now >= at)
    }

    /// When [`Self::is_free`] is worth another look, if no reply comes before.
    pub fn wake_at(&self) -> Option<Instant> {
        let overdue = self.open.front().map(|(since, _)| *since + PATIENCE);
        overdue.or(self.free_at)
    }

    /// Whether a reply is still to come.
    pub fn awaits(&self) -> bool {
        !self.open.is_empty()
    }

    /// How long the last replies are worth waiting for before the terminal is given back: longer
    /// than any of late, and not at all from a terminal that never answers.
    pub fn farewell(&self) -> Duration {
        if !self.asks() {
            return Duration::ZERO;
        }
        let slowest = self.samples.iter().map(|(_, seconds)| *seconds);
        let slowest = slowest.fold(FAREWELL.0, f64::max);
        Duration::from_secs_f64((2.0 * slowest).min(FAREWELL.1))
    }

    /// Whether bytes take long to arrive, or no one says whether they do.
    pub fn is_slow(&self) -> bool {
        !self.local && !self.asks() || self.per_byte > 1.0 / SLOW
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use Cause::{Event, Replay};

    const SHORT: Duration = Duration::from_millis(50);

    #[test]
    fn a_replay_waits_for_the_reply_and_a_key_for_all_but_one() {
        let mut pacer = Pacer::default();
        let start = Instant::now();
        assert!(pacer.is_free(start, Replay));
        pacer.sent(start, 1000);
        assert!(!pacer.is_free(start + SHORT, Replay));
        assert!(pacer.is_free(start + SHORT, Event));
        pacer.sent(start + SHORT, 1000);
        assert!(!pacer.is_free(start + SHORT, Event));
        pacer.replied(start + SHORT);
        assert!(!pacer.is_free(start + SHORT, Replay));
        assert!(pacer.is_free(start + SHORT, Event));
        pacer.replied(start + SHORT);
        assert!(pacer.is_free(start + SHORT, Replay));
        assert!(!pacer.is_slow());
    }

    #[test]
    fn a_reply_nobody_asked_for_frees_nothing() {
        let mut pacer = Pacer::default();
        let start = Instant::now();
        pacer.replied(start);
        pacer.sent(start, 1000);
        assert!(!pacer.is_free(start + SHORT, Replay));
    }

    #[test]
    fn a_late_reply_does_not_free_the_frame_after_its_own() {
        let mut pacer = Pacer::default();
        let start = Instant::now();
        pacer.sent(start, 1000);
        let later = start + PATIENCE;
        assert!(pacer.is_free(later, Replay));
        pacer.sent(later, 1000);
        pacer.replied(later + SHORT);
        assert!(
            !pacer.is_free(later + SHORT, Replay),
            "that was the first one's"
        );
        pacer.replied(later + 2 * SHORT);
        assert!(pacer.is_free(later + 2 * SHORT, Replay));
    }

    #[test]
    fn a_terminal_that_never_answers_gets_a_budget_of_bytes() {
        let mut pacer = Pacer::default();
        let mut now = Instant::now();
        for _ in 0..MAX_SILENCES {
            assert!(pacer.asks());
            pacer.sent(now, 1000);
            now += PATIENCE;
            assert!(pacer.is_free(now, Replay));
        }
        assert!(!pacer.asks() && pacer.is_slow());
        pacer.sent(now, 3000);
        assert!(!pacer.is_free(now + Duration::from_millis(499), Replay));
        assert!(pacer.is_free(now + Duration::from_millis(501), Replay));
    }

    #[test]
    fn the_last_replies_are_waited_for_as_long_as_they_may_take() {
        let after = |delay: u64| {
            let mut pacer = Pacer::default();
            let start = Instant::now();
            pacer.sent(start, 1000);
            pacer.replied(start + Duration::from_millis(delay));
            pacer.farewell()
        };
        assert_eq!(after(1), Duration::from_millis(300));
        assert_eq!(after(250), Duration::from_millis(500));
        assert_eq!(after(1900), Duration::from_secs(1));
        let mute = Pacer {
            silences: MAX_SILENCES,
            ..Pacer::default()
        };
        assert_eq!(mute.farewell(), Duration::ZERO);
    }

    #[test]
    fn a_local_console_is_neither_asked_nor_waited_for() {
        let mut pacer = Pacer::local();
        let start = Instant::now();
        pacer.sent(start, 1_000_000);
        assert!(!pacer.asks() && !pacer.awaits() && !pacer.is_slow());
        assert!(pacer.is_free(start, Replay));
    }

    #[test]
    fn a_slow_link_is_noticed() {
        let slow = |rate: f64| {
            let mut pacer = Pacer::default();
            let mut now = Instant::now();
            for bytes in [50, 3000, 500, 2000, 300] {
                pacer.sent(now, bytes);
                now += Duration::from_millis(200) + Duration::from_secs_f64(bytes as f64 / rate);
                pacer.replied(now);
            }
            pacer.is_slow()
        };
        assert!(slow(8_000.0));
        assert!(!slow(32_000.0), "a long round trip alone is not slow");
    }
}
