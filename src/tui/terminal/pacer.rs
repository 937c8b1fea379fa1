//! When the next frame may be sent.
//!
//! Every frame ends with a question for the cursor's place. A frame of the replay waits for the
//! replies to all before it; a frame that answers a key may follow one other at once. So at most
//! two frames are under way however slow the link is. Kept by hand as no crate has it: at 256
//! colours and 12 frames a second a replay is 23 kB/s, so that on a link of 8 kB/s the queue would
//! grow by 15 kB every second, and a key would wait 19 s after ten; with it the slowest of three
//! keys waited 0.30 s.
//!
//! Each reply names its question, so a late one frees no later frame and a lost one is not missed.
//! A terminal that has ever answered and falls silent is stopped, or its link is: it gets no more
//! frames, only a bare question now and then in case a reply was lost, and goes on with the first
//! reply. One that has never answered is asked twice; then a budget of bytes a second takes over.

use std::collections::VecDeque;
use std::time::{Duration, Instant};

/// How long a reply is waited for.
const PATIENCE: Duration = Duration::from_secs(2);
/// Unanswered questions of a terminal that never answers, after which no more are asked.
const MAX_SILENCES: u32 = 2;
/// The longest time between two bare questions.
const LONGEST_SILENCE: Duration = Duration::from_secs(60);
/// Questions that can be told apart, by a column each.
const COLUMNS: u8 = 8;
/// Seconds: a reply is thought to take the first at least, and waited for no longer than the other.
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

/// A question that has no reply yet.
#[derive(Debug, Clone, Copy)]
struct Question {
    column: u8,
    since: Instant,
    /// Of the frame before it; a bare question has none.
    bytes: Option<usize>,
    /// Nobody waits for the reply any more.
    given_up: bool,
}

/// Counts questions and replies and says when a frame may go out.
#[derive(Debug, Default)]
pub struct Pacer {
    open: VecDeque<Question>,
    /// Column of the last question.
    last: u8,
    /// Whether whoever shows the frames takes them as they are written.
    local: bool,
    /// Whether a reply ever came.
    answers: bool,
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
    /// For a terminal that has shown a frame when the write returns: nothing is asked.
    pub fn local() -> Self {
        Self { local: true, ..Self::default() }
    }

    fn asks(&self) -> bool {
        !self.local && (self.answers || self.silences < MAX_SILENCES)
    }

    /// A frame of so many bytes goes out; gives the column of the question to end it with.
    pub fn sent(&mut self, now: Instant, bytes: usize) -> Option<u8> {
        if self.asks() {
            return Some(self.ask(now, Some(bytes)));
        }
        if !self.local {
            self.free_at = Some(now + Duration::from_secs_f64(bytes as f64 / BUDGET));
        }
        None
    }

    fn ask(&mut self, since: Instant, bytes: Option<usize>) -> u8 {
        self.last = self.last % COLUMNS + 1;
        // The one that had this column before will hardly be answered.
        self.open.retain(|question| question.column != self.last);
        self.open.push_back(Question { column: self.last, since, bytes, given_up: false });
        self.last
    }

    /// The column of a bare question that is due, for a terminal that used to answer.
    pub fn probe(&mut self, now: Instant) -> Option<u8> {
        self.probe_at().filter(|at| now >= *at).map(|_| self.ask(now, None))
    }

    /// The longer the silence, the longer until the next bare question.
    fn probe_at(&self) -> Option<Instant> {
        let last = self.open.back().filter(|_| self.answers)?;
        let bare = self.open.iter().filter(|q| q.bytes.is_none()).count();
        Some(last.since + (PATIENCE * 2_u32.pow(bare as u32)).min(LONGEST_SILENCE))
    }

    /// A reply came, from this column. Older questions will not be answered any more. A terminal
    /// that does not know its columns is taken to answer in turn.
    pub fn replied(&mut self, now: Instant, column: u8) {
        (self.answers, self.silences, self.free_at) = (true, 0, None);
        let place = self.open.iter().position(|q| q.column == column);
        self.open.drain(..place.unwrap_or(0));
        let Some(question) = self.open.pop_front() else { return };
        // After a silence the delay says nothing of the link.
        let is_late = question.given_up || self.open.iter().any(|q| q.bytes.is_none());
        if let (Some(bytes), false) = (question.bytes, is_late) {
            let delay = now.saturating_duration_since(question.since).as_secs_f64();
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
        let mean = |of: &dyn Fn(f64, f64) -> f64| {
            self.samples.iter().map(|(bytes, seconds)| of(*bytes, *seconds)).sum::<f64>() / count
        };
        let (size, delay) = (mean(&|bytes, _| bytes), mean(&|_, seconds| seconds));
        let variance = mean(&|bytes, _| (bytes - size) * (bytes - size));
        if self.samples.len() >= FEWEST && variance > LEAST_DEVIATION * LEAST_DEVIATION {
            self.per_byte = mean(&|bytes, seconds| (bytes - size) * (seconds - delay)) / variance;
        }
    }

    /// Whether a frame may go out; gives up on a reply that is overdue from who never answered.
    pub fn is_free(&mut self, now: Instant, cause: Cause) -> bool {
        if !self.answers && self.waiting().next().is_some_and(|q| now >= q.since + PATIENCE) {
            // What came after it is no sooner answered.
            self.open.iter_mut().for_each(|q| q.given_up = true);
            self.silences += 1;
        }
        let most = usize::from(cause == Cause::Event);
        self.waiting().count() <= most && self.free_at.is_none_or(|at| now >= at)
    }

    fn waiting(&self) -> impl Iterator<Item = &Question> {
        self.open.iter().filter(|question| !question.given_up)
    }

    /// When [`Self::is_free`] is worth another look, if no reply comes before.
    pub fn wake_at(&self) -> Option<Instant> {
        let overdue = || self.waiting().next().map(|q| q.since + PATIENCE);
        self.probe_at().or_else(overdue).or(self.free_at)
    }

    /// Whether a reply is still to come.
    pub fn awaits(&self) -> bool {
        self.waiting().next().is_some()
    }

    /// How long the last replies are worth waiting for before the terminal is given back: longer
    /// than any of late, and not at all from a terminal that never answers.
    pub fn farewell(&self) -> Duration {
        if !self.asks() {
            return Duration::ZERO;
        }
        let slowest = self.samples.iter().fold(FAREWELL.0, |most, (_, seconds)| seconds.max(most));
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

    fn fresh() -> (Pacer, Instant) {
        (Pacer::default(), Instant::now())
    }

    #[test]
    fn a_replay_waits_for_the_reply_and_a_key_for_all_but_one() {
        let (mut pacer, start) = fresh();
        assert!(pacer.is_free(start, Replay));
        // Nobody asked for that.
        pacer.replied(start, 1);
        let first = pacer.sent(start, 1000).unwrap();
        let later = start + SHORT;
        assert!(!pacer.is_free(later, Replay) && pacer.is_free(later, Event));
        let second = pacer.sent(later, 1000).unwrap();
        assert!(!pacer.is_free(later, Event));
        pacer.replied(later, first);
        assert!(!pacer.is_free(later, Replay) && pacer.is_free(later, Event));
        pacer.replied(later, second);
        assert!(pacer.is_free(later, Replay) && !pacer.is_slow());
    }

    #[test]
    fn a_late_first_reply_does_not_free_the_frame_after_its_own() {
        let (mut pacer, start) = fresh();
        let first = pacer.sent(start, 1000).unwrap();
        let later = start + PATIENCE;
        assert!(pacer.is_free(later, Replay));
        let second = pacer.sent(later, 1000).unwrap();
        for (column, is_free) in [(first, false), (second, true)] {
            pacer.replied(later + SHORT, column);
            assert_eq!(pacer.is_free(later + SHORT, Replay), is_free);
        }
    }

    /// A pacer whose terminal answered once and has another frame under way since then.
    fn answering() -> (Pacer, Instant, u8) {
        let (mut pacer, start) = fresh();
        let first = pacer.sent(start, 1000).unwrap();
        pacer.replied(start, first);
        let column = pacer.sent(start, 1000).unwrap();
        (pacer, start, column)
    }

    #[test]
    fn a_terminal_that_is_stopped_gets_one_frame_more_and_goes_on_with_its_first_reply() {
        let (mut pacer, start, column) = answering();
        let (mut frames, mut probes) = (0, Vec::new());
        for tenth in 0..36_000 {
            let now = start + Duration::from_millis(100 * tenth);
            assert!(!pacer.is_free(now, Replay));
            if pacer.is_free(now, Event) {
                pacer.sent(now, 1000);
                frames += 1;
            }
            probes.extend(pacer.probe(now));
        }
        assert_eq!(frames, 1);
        // Nine bytes each, in an hour.
        assert!((50..70).contains(&probes.len()), "{}", probes.len());
        let now = start + Duration::from_secs(3600);
        pacer.replied(now, *probes.last().unwrap());
        assert!(pacer.is_free(now, Replay) && pacer.probe(now).is_none());
        // Replies to what is no longer asked free nothing.
        pacer.sent(now, 1000);
        pacer.replied(now, column);
        assert!(!pacer.is_slow());
    }

    #[test]
    fn a_lost_reply_costs_one_bare_question() {
        let (mut pacer, start, _) = answering();
        let now = start + PATIENCE;
        assert_eq!(pacer.wake_at(), Some(now));
        assert!(pacer.probe(start + SHORT).is_none());
        let probe = pacer.probe(now).unwrap();
        assert!(pacer.probe(now + SHORT).is_none());
        pacer.replied(now + SHORT, probe);
        assert!(pacer.is_free(now + SHORT, Replay) && !pacer.awaits());
    }

    #[test]
    fn a_terminal_without_columns_answers_in_turn() {
        let (mut pacer, start) = fresh();
        for _ in 0..20 {
            assert!(pacer.is_free(start, Replay));
            pacer.sent(start, 1000);
            pacer.replied(start, 77);
        }
    }

    #[test]
    fn a_terminal_that_never_answers_gets_a_budget_of_bytes() {
        let (mut pacer, mut now) = fresh();
        for _ in 0..MAX_SILENCES {
            assert!(pacer.asks());
            pacer.sent(now, 1000);
            now += PATIENCE;
            assert!(pacer.is_free(now, Replay));
        }
        assert!(!pacer.asks() && pacer.is_slow() && pacer.probe(now).is_none());
        assert_eq!(pacer.sent(now, 3000), None);
        assert!(!pacer.is_free(now + Duration::from_millis(499), Replay));
        assert!(pacer.is_free(now + Duration::from_millis(501), Replay));
        // It was late, not mute.
        pacer.replied(now, 1);
        assert!(pacer.asks() && pacer.is_free(now, Replay));
    }

    #[test]
    fn the_last_replies_are_waited_for_as_long_as_they_may_take() {
        for (delay, farewell) in [(1, 300), (250, 500), (1900, 1000)] {
            let (mut pacer, start) = fresh();
            let column = pacer.sent(start, 1000).unwrap();
            pacer.replied(start + Duration::from_millis(delay), column);
            assert_eq!(pacer.farewell(), Duration::from_millis(farewell));
        }
        assert_eq!(Pacer { silences: MAX_SILENCES, ..Pacer::default() }.farewell(), Duration::ZERO);
    }

    #[test]
    fn a_local_console_is_neither_asked_nor_waited_for() {
        let (mut pacer, start) = (Pacer::local(), Instant::now());
        assert_eq!(pacer.sent(start, 1_000_000), None);
        assert!(!pacer.asks() && !pacer.awaits() && !pacer.is_slow());
        assert!(pacer.is_free(start, Replay));
    }

    #[test]
    fn a_slow_link_is_noticed() {
        // A long round trip alone is not slow.
        for (rate, is_slow) in [(8_000.0, true), (32_000.0, false)] {
            let (mut pacer, mut now) = fresh();
            for bytes in [50, 3000, 500, 2000, 300] {
                let column = pacer.sent(now, bytes).unwrap();
                now += Duration::from_millis(200) + Duration::from_secs_f64(bytes as f64 / rate);
                pacer.replied(now, column);
            }
            assert_eq!(pacer.is_slow(), is_slow);
        }
    }
}
