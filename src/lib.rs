//! What a blow does to a human eye, and how far to trust the answer.
//!
//! Data flows one way. [`scenario`] is what a person asks for, in their units; [`eye`] turns anatomy
//! into a mesh; [`dynamics`] moves it; [`recording`] keeps extremes, traces and frames; [`injury`]
//! scores them; [`study`] runs one case or many and estimates errors; [`report`] prints; [`cli`] is
//! the command line, [`tui`] the terminal app. A lower room never imports a higher one. [`guide`] is what
//! to read besides.
//!
//! Research and education, not diagnosis.

#[cfg(feature = "app")]
pub mod cli;
pub mod dynamics;
mod error;
pub mod eye;
pub mod guide;
pub mod injury;
mod normal;
mod plain_text;
pub mod recording;
#[cfg(feature = "app")]
pub mod report;
pub mod scenario;
pub mod study;
#[cfg(feature = "app")]
pub mod tui;
#[cfg(feature = "app")]
mod whole_file;

pub use error::Error;
