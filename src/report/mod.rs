//! Results for people and for programs. It only prints what it is given.

pub mod accuracy;
pub mod json;
pub mod text;
