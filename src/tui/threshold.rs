//! A question put to a number of the form: at which value of it a result reaches what is asked.
//!
//! Left out: a range of one's own, which `contrecoup threshold` takes.

use std::sync::Arc;

use crate::injury::Injury;
use crate::many::threshold::{Crossing, Threshold, ThresholdSearch};
use crate::report::format::significant;
use crate::run::{quantity::Quantity, refusal::Refusal, watch::Watch};
use crate::scenario::{fields::Field, problem::plain};
use crate::tui::{line::TextLine, request, shown::ShownAnswer, task::Task, worker::run_watched};

/// What a risk or an index is asked for unless something else is typed, in %.
const HALF: f64 = 50.0;

/// Asks for every crossing.
pub struct FindThreshold(pub ThresholdSearch);

impl request::TaskQuestion for FindThreshold {
    type Answer = Threshold;

    fn answer(&self, watch: Watch) -> Result<Threshold, Refusal> {
        run_watched(watch, &mut |()| {}, |stop, progress| {
            // `stop` tells it to end.
            self.0.answer(stop, |share| _ = progress.report(share, || ()))
        })
    }
}

/// What is asked, and what came of it.
pub struct Asking {
    /// The number that is varied.
    pub field: &'static Field,
    /// The result, and all that the answer on show has.
    pub quantity: Quantity,
    results: Vec<(Quantity, f64)>,
    /// The value that it is to reach, as typed.
    pub input: TextLine,
    /// What is being looked for.
    pub task: Task<FindThreshold>,
    /// What was found for what is asked.
    pub found: Option<(Arc<FindThreshold>, Threshold)>,
    /// The crossing that would be taken.
    pub row: usize,
    /// What is wrong with what is asked.
    pub error: Option<String>,
}

impl Asking {
    pub(super) fn of(field: &'static Field, shown: &ShownAnswer) -> Option<Self> {
        let values = shown.answer.results();
        let all = Quantity::ALL.iter().copied();
        let results: Vec<_> = all.filter_map(|of| Some((of, values[of]?))).collect();
        let rupture = Injury::GlobeRupture.result();
        let first = results.iter().find(|(of, _)| *of == rupture).or(results.first());
        let (quantity, value) = *first?;
        let mut asking = Self {
            field,
            quantity,
            results,
            input: TextLine::default(),
            task: Task::default(),
            found: None,
            row: 0,
            error: None,
        };
        asking.choose((quantity, value));
        Some(asking)
    }

    /// Asks for another result, for half of it or for what it is now.
    fn choose(&mut self, (quantity, value): (Quantity, f64)) {
        self.quantity = quantity;
        let is_risk = quantity.row().whole.is_some();
        self.input = TextLine::of(brief(if is_risk { HALF } else { value }));
        self.forget();
    }

    /// Asks for the next result of the answer on show, or for the one before.
    pub(super) fn next_result(&mut self, forward: bool) {
        let count = self.results.len();
        let here = self.results.iter().position(|(of, _)| *of == self.quantity);
        let by = if forward { 1 } else { count - 1 };
        self.choose(self.results[(here.unwrap_or(0) + by) % count]);
    }

    /// Goes to the next crossing.
    pub(super) fn next_crossing(&mut self) {
        let count = self.found.as_ref().map_or(0, |(_, found)| found.crossings.len());
        self.row = (self.row + 1) % count.max(1);
    }

    /// Changes the value that is asked for.
    pub(super) fn retype(&mut self, change: impl FnOnce(&mut TextLine)) {
        let before = self.input.value().to_owned();
        change(&mut self.input);
        if self.input.value() != before {
            self.forget();
        }
    }

    /// What was found is no answer to what is asked now.
    pub(super) fn forget(&mut self) {
        (self.found, self.error, self.row) = (None, None, 0);
        self.task.complaint = None;
    }

    /// The crossing that would be taken.
    pub fn chosen(&self) -> Option<&Crossing> {
        self.found.as_ref()?.1.crossings.get(self.row)
    }

    /// What would be taken, as it is typed.
    pub fn taken(&self) -> Option<String> {
        Some(brief(self.chosen()?.at))
    }
}

/// Four digits, as a person would type them.
fn brief(value: f64) -> String {
    significant(value).parse().map_or_else(|_| significant(value), plain)
}
