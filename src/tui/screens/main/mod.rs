//! The screen that answers the question at the bedside: form, eye, traces, score.

pub mod form;
pub mod score;
pub mod view;
