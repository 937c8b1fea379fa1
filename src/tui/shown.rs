//! An answer with what every picture of it needs.

use std::borrow::Borrow;
use std::sync::Arc;

use crate::answer::solve::Answer;
use crate::report::picture::{Anatomy, field::TissueField, front::seen};
use crate::run::drawing::Drawing;
use crate::scenario::Scenario;
use crate::tui::view::heat::hottest;

/// An answer with what every picture of it needs.
#[derive(Debug, Clone)]
pub struct ShownAnswer {
    /// What was asked.
    pub scenario: Scenario,
    /// What came of it.
    pub answer: Arc<Answer>,
    /// The largest force on any node in any frame, in N.
    pub hottest: f64,
    /// What can fill the globe, each with the end of its scale, what tells most first.
    pub fields: Vec<(TissueField, f64)>,
    /// What pictures are made of.
    pub drawing: Drawing,
    /// What moves with its tissue in them.
    pub anatomy: Anatomy,
}

impl ShownAnswer {
    /// Whether the eye can be seen from the front.
    pub fn has_front(&self) -> bool {
        let first = self.answer.run.frames.first();
        first.is_some_and(|frame| seen(&self.drawing, frame).is_some())
    }

    /// The answer to a scenario.
    pub fn new(scenario: Scenario, answer: Answer) -> Self {
        let drawing = answer.case.eye.drawing();
        let frames = &answer.run.frames;
        let fields = TissueField::all(&drawing, frames).into_iter();
        Self {
            scenario,
            hottest: hottest(&answer),
            fields: fields.map(|field| (field, field.largest(&drawing, frames))).collect(),
            anatomy: Anatomy::of(&drawing),
            drawing,
            answer: Arc::new(answer),
        }
    }
}

impl Borrow<Answer> for Box<ShownAnswer> {
    fn borrow(&self) -> &Answer {
        &self.answer
    }
}
