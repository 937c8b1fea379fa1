//! Through the window.

pub(crate) mod ending;
pub mod run;
