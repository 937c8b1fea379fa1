//! What comes from outside.

use std::sync::atomic::{AtomicI32, Ordering};

use crate::tui::{app::update::Message, keys::press::SUSPEND, terminal::input::TerminalInput};

pub(super) enum Event {
    /// What was typed, and replies of the terminal.
    #[cfg_attr(windows, expect(dead_code, reason = "a console gives keys, not bytes"))]
    Bytes(Vec<u8>),
    /// What was typed, already told apart.
    Input(TerminalInput),
    /// The terminal has another size.
    Resized,
    /// The shell goes on with the app; the terminal may be in any state.
    #[cfg_attr(windows, expect(dead_code, reason = "nothing is stopped there"))]
    Continued,
    /// The app must leave with this exit code.
    End(u8),
    /// What a thread found out.
    News(Message),
}

/// The exit code that the app must leave with, below 0 as long as it may stay.
static LEAVING: AtomicI32 = AtomicI32::new(-1);

pub(super) fn leaving() -> Option<u8> {
    u8::try_from(LEAVING.load(Ordering::Relaxed)).ok()
}

impl Event {
    /// The terminal is gone.
    pub(super) fn hangup() -> Self {
        Self::end(129)
    }

    /// The app must leave with this code; whoever still has much to do looks at [`leaving`].
    pub(super) fn end(code: u8) -> Self {
        LEAVING.store(i32::from(code), Ordering::Relaxed);
        Self::End(code)
    }

    /// Whether it asks to stop until the shell goes on.
    pub(super) fn is_suspend(&self) -> bool {
        matches!(self, Self::Input(TerminalInput::Key(key)) if SUSPEND.is(*key))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crossterm::event::{KeyCode, KeyEvent, KeyModifiers};

    #[test]
    fn what_stops_the_app_is_told_from_the_rest() {
        for (held, stops) in [(KeyModifiers::CONTROL, true), (KeyModifiers::NONE, false)] {
            let key = KeyEvent::new(KeyCode::Char('z'), held);
            assert_eq!(Event::Input(TerminalInput::Key(key)).is_suspend(), stops);
        }
    }
}
