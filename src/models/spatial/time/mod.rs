//! Through the window.

pub mod run;
