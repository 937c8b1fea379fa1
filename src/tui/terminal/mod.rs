//! The one room that touches the terminal: its modes, its bytes, its signals.
//!
//! Left out, but on Windows: crossterm's event reader. One thread reads the keyboard's bytes and
//! [`input`] parses them, because replies to the program's own queries must be counted, and
//! because a reply that crossterm does not know blocks its reader for good (crossterm 0.29).

mod app;
pub mod caps;
mod event;
pub mod input;
pub mod pacer;
pub mod paint;
mod session;
#[cfg_attr(unix, path = "unix.rs")]
#[cfg_attr(windows, path = "windows.rs")]
mod system;

pub use crate::tui::terminal::app::{Settings, run};
