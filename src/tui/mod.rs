//! The terminal app: edit a blow, see the eye answer.
//!
//! The [`screens`] own their state, their keys and their pictures; [`model`] holds them and what they
//! share. A key is looked up in the tables of [`keys`], [`update`] changes the model by it, and
//! [`view`] draws what is on show. What takes long is a [`task`] that a thread of its own works on
//! and speaks of by channel. Only [`terminal`] touches the terminal.
//!
//! Left out: an async runtime, which work that only computes does not need. The mouse stays off
//! unless asked for: a dropped connection leaves it switched on.

pub(crate) mod clock;
pub mod config;
pub mod ensemble;
pub mod form;
pub mod guest;
mod idle;
pub mod keys;
mod last;
pub mod line;
pub mod model;
pub mod picker;
pub mod save;
pub mod screens;
pub mod simulation;
pub(crate) mod step;
pub mod take_away;
pub mod task;
pub mod terminal;
pub mod threshold;
pub(crate) mod undo;
pub mod update;
pub mod view;
pub mod work;
pub(crate) mod worker;

mod open;

pub use crate::tui::open::{AppFlags, OpenError, Options, prepare, run};
