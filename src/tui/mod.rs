//! The terminal app: edit a blow, see the eye answer.
//!
//! A key becomes an [`action`](action::Action), [`update`] changes the [`model`] by it, and
//! [`view`] draws the model; the [`worker`] simulates on a thread of its own and speaks by channel.
//! Only [`terminal`] touches the terminal.
//!
//! Left out: an async runtime, which work that only computes does not need. The mouse stays off
//! unless asked for: a dropped connection leaves it switched on.

pub mod action;
pub mod clock;
pub mod ensemble;
pub mod form;
pub mod keys;
pub mod model;
pub mod save;
pub mod screens;
pub mod terminal;
pub mod undo;
pub mod update;
pub mod view;
pub mod worker;

mod open;

pub use open::{Manner, OpenError, Options, prepare, run};
