//! What the app wants done outside of it: on other threads, on the disk, and by the terminal.

use crate::tui::request::{Request, Ticket};

/// Something to do outside.
#[derive(Debug, Clone, PartialEq)]
pub enum Effect {
    /// Work on a question, on the thread of its kind.
    Start(Request),
    /// Stop working on that.
    Stop(Ticket),
    /// Save a preset: name, text, whether it may replace another.
    Save(String, String, bool),
    /// Give the preset of the first name the second one.
    Rename(String, String),
    /// Remove the preset of this name.
    Remove(String),
    /// Bring a removed preset back: name, text.
    Restore(String, String),
    /// Write a page: the beginning of its file's name, and its text.
    Page(String, Vec<u8>),
    /// Put this on the clipboard.
    Copy(String),
    /// Stop the process until it is continued.
    Suspend,
    /// Have the mouse reported, or no longer.
    Mouse(bool),
    /// Draw everything afresh.
    Repaint,
    /// Leave with this exit code.
    Quit(u8),
}

/// What goes out of the model: requests, and the tickets of those to be given up.
#[derive(Debug, Default)]
pub struct Outbox {
    /// What is to be done, in this order.
    pub effects: Vec<Effect>,
    /// The last ticket given out.
    pub ticket: Ticket,
}
