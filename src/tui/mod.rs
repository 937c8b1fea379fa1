//! The terminal app: edit a blow, see the eye answer.
//!
//! [`model`] holds what the screens share and knows none of them; each of the [`screens`] holds
//! what is its own, its keys and its picture. [`app`] stands above both: it looks a key up in the
//! tables, hands everything that happens to who it concerns, and draws title, screen and footer.
//! What takes long is a [`task`] that the thread of its kind works on and speaks of by channel.
//! Only [`terminal`] touches the terminal.
//!
//! Left out: an async runtime, which work that only computes does not need. The mouse stays off
//! unless asked for: a dropped connection leaves it switched on.

pub mod app;
mod changes;
mod changing;
pub mod clock;
pub mod config;
pub mod ensemble;
pub mod form;
mod guest;
pub mod keys;
mod line;
pub mod look;
mod model;
pub mod outbox;
pub mod overlay;
mod page;
pub mod picker;
pub mod request;
pub mod save;
mod saved_session;
pub mod screens;
pub mod shown;
pub mod simulation;
mod step;
pub mod task;
pub mod terminal;
pub mod threshold;
mod undo;
pub mod view;
mod work;
mod worker;

mod open;

pub(crate) use crate::tui::open::run;
pub use crate::tui::open::{AppFlags, OpenError, Options, prepare};
