//! When the next frame may be sent.
//!
//! Every frame ends with a question for the cursor's place; the next frame waits for the reply, so
//! at most one frame is under way however slow the link is. Without this, a secure shell buffers
//! megabytes of frames and a key waits behind them all.
//!
//! Questions and replies are counted. A reply to a question that was given up must not free a later
//! frame. A terminal that fails to answer twice in a row is never asked again; a budget of bytes a
//! second takes over.

use std::time::{Duration, Instant};

/// How long a reply is waited for.
const PATIENCE: Duration = Duration::from_secs(2);
/// Unanswered questions in a row after which no more are asked.
const MOST_SILENCES: u32 = 2;
/// Bytes a second for a terminal that never answers.
const BUDGET: f64 = 6000.0;
/// A frame that takes this long to be acknowledged means a slow link.
const SLOW: Duration = Duration::from_millis(300);

/// Counts questions and replies and says when a frame may go out.
#[derive(Debug, Default)]
pub struct Pacer {
    waiting_since: Option<Instant>,
    given_up: u32,
    silences: u32,
    free_at: Option<Instant>,
    delay: Option<Duration>,
}

impl Pacer {
    /// Whether a frame should end with a question.
    pub fn asks(&self) -> bool {
        self.silences < MOST_SILENCES
    }

    /// A frame of so many bytes went out.
    pub fn sent(&mut self, now: Instant, bytes: usize) {
        if self.asks() {
            self.waiting_since = Some(now);
        } else {
            self.free_at = Some(now + Duration::from_secs_f64(bytes as f64 / BUDGET));
        }
    }

    /// A reply came.
    pub fn replied(&mut self, now: Instant) {
        if self.given_up > 0 {
            self.given_up -= 1;
        } else if let Some(since) = self.waiting_since.take() {
            self.silences = 0;
            let delay = now.saturating_duration_since(since);
            self.delay = Some(self.delay.map_or(delay, |old| (old * 3 + delay) / 4));
        }
    }

    /// Whether a frame may go out; gives up on a reply that is overdue.
    pub fn is_free(&mut self, now: Instant) -> bool {
        if let Some(since) = self.waiting_since {
            if now.saturating_duration_since(since) < PATIENCE {
                return false;
            }
            self.waiting_since = None;
            self.given_up += 1;
            self.silences += 1;
        }
        self.free_at.is_none_or(|at| now >= at)
    }

    /// When [`Self::is_free`] is worth another look, if no reply comes before.
    pub fn wake_at(&self) -> Option<Instant> {
        self.waiting_since
            .map(|since| since + PATIENCE)
            .or(self.free_at)
    }

    /// Whether frames take long to arrive, or no one says whether they do.
    pub fn is_slow(&self) -> bool {
        !self.asks() || self.delay.is_some_and(|delay| delay > SLOW)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SHORT: Duration = Duration::from_millis(50);

    #[test]
    fn one_frame_is_under_way_at_most() {
        let mut pacer = Pacer::default();
        let start = Instant::now();
        assert!(pacer.is_free(start));
        pacer.sent(start, 1000);
        assert!(!pacer.is_free(start + SHORT));
        pacer.replied(start + SHORT);
        assert!(pacer.is_free(start + SHORT));
        assert!(!pacer.is_slow());
    }

    #[test]
    fn a_reply_nobody_asked_for_frees_nothing() {
        let mut pacer = Pacer::default();
        let start = Instant::now();
        pacer.replied(start);
        pacer.sent(start, 1000);
        assert!(!pacer.is_free(start + SHORT));
    }

    #[test]
    fn a_late_reply_does_not_free_the_frame_after_its_own() {
        let mut pacer = Pacer::default();
        let start = Instant::now();
        pacer.sent(start, 1000);
        let later = start + PATIENCE;
        assert!(pacer.is_free(later));
        pacer.sent(later, 1000);
        pacer.replied(later + SHORT);
        assert!(!pacer.is_free(later + SHORT), "that was the first one's");
        pacer.replied(later + 2 * SHORT);
        assert!(pacer.is_free(later + 2 * SHORT));
    }

    #[test]
    fn a_terminal_that_never_answers_gets_a_budget_of_bytes() {
        let mut pacer = Pacer::default();
        let mut now = Instant::now();
        for _ in 0..MOST_SILENCES {
            assert!(pacer.asks());
            pacer.sent(now, 1000);
            now += PATIENCE;
            assert!(pacer.is_free(now));
        }
        assert!(!pacer.asks() && pacer.is_slow());
        pacer.sent(now, 3000);
        assert!(!pacer.is_free(now + Duration::from_millis(499)));
        assert!(pacer.is_free(now + Duration::from_millis(501)));
    }

    #[test]
    fn a_slow_link_is_noticed() {
        let mut pacer = Pacer::default();
        let mut now = Instant::now();
        for _ in 0..5 {
            pacer.sent(now, 3000);
            now += Duration::from_millis(600);
            pacer.replied(now);
        }
        assert!(pacer.is_slow());
    }
}
