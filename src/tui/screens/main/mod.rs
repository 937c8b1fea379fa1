//! The screen that answers the question at the bedside: form, eye, traces, score.

pub mod form;
mod pulse;
pub mod score;
pub mod view;
