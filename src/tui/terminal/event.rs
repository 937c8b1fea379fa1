//! What comes from outside.

use std::sync::atomic::{AtomicI32, Ordering};

use crate::tui::{app::update::Message, keys::press::SUSPEND, terminal::input::TerminalInput};

/// Something that came from outside.
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

/// The exit code that the app must leave with, if it must.
pub(super) fn leaving() -> Option<u8> {
    u8::try_from(LEAVING.load(Ordering::Relaxed)).ok()
}

impl Event {
    /// The terminal is gone.
    pub(super) fn hangup() -> Self {
        Self::end(129)
    }

    /// The app must leave with this exit code, from now on: whoever still has much to do looks at
    /// [`leaving`] meanwhile.
    pub(super) fn end(code: u8) -> Self {
        LEAVING.store(i32::from(code), Ordering::Relaxed);
        Self::End(code)
    }

    /// Whether the app must leave.
    pub(super) fn is_end(&self) -> bool {
        matches!(self, Self::End(_))
    }

    /// Whether it asks to stop until the shell goes on.
    pub(super) fn is_suspend(&self) -> bool {
        let Self::Input(TerminalInput::Key(key)) = self else {
            return false;
        };
        SUSPEND.is(*key)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crossterm::event::{KeyCode, KeyEvent, KeyModifiers};

    #[test]
    fn what_ends_the_app_and_what_stops_it_are_told_from_the_rest() {
        let key = |code, held| Event::Input(TerminalInput::Key(KeyEvent::new(code, held)));
        let ctrl_z = key(KeyCode::Char('z'), KeyModifiers::CONTROL);
        assert!(ctrl_z.is_suspend() && !ctrl_z.is_end());
        assert!(!key(KeyCode::Char('z'), KeyModifiers::NONE).is_suspend());
        assert!(Event::End(129).is_end());
        assert!(!Event::Continued.is_end() && !Event::Resized.is_end());
    }
}
