//! An answer with what every picture of it needs.

use std::borrow::Borrow;
use std::sync::Arc;

use crate::answer::solve::Answer;
use crate::run::drawing::Drawing;
use crate::scenario::Scenario;
use crate::tui::view::heat::{highest, hottest};

/// An answer with what every picture of it needs.
#[derive(Debug, Clone)]
pub struct ShownAnswer {
    /// What was asked.
    pub scenario: Scenario,
    /// What came of it.
    pub answer: Arc<Answer>,
    /// The largest force on any node in any frame, in N.
    pub hottest: f64,
    /// The largest pressure in any cell in any frame, in Pa, if it has cells.
    pub highest: Option<f64>,
    /// What pictures are made of.
    pub drawing: Drawing,
}

impl ShownAnswer {
    /// The answer to a scenario.
    pub fn new(scenario: Scenario, answer: Answer) -> Self {
        Self {
            scenario,
            hottest: hottest(&answer),
            highest: highest(&answer),
            drawing: answer.case.eye.drawing(),
            answer: Arc::new(answer),
        }
    }
}

impl Borrow<Answer> for Box<ShownAnswer> {
    fn borrow(&self) -> &Answer {
        &self.answer
    }
}
