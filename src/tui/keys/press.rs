//! One press of a key, and how it is written.

use crossterm::event::{KeyCode, KeyEvent, KeyModifiers};

/// One press of a key.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Press(pub(super) KeyCode, pub(super) KeyModifiers);

/// The press of a key alone.
pub const fn plain(code: KeyCode) -> Press {
    Press(code, KeyModifiers::NONE)
}

/// The press of a character.
pub const fn c(c: char) -> Press {
    plain(KeyCode::Char(c))
}

/// A character with Control.
pub const fn ctrl(c: char) -> Press {
    Press(KeyCode::Char(c), KeyModifiers::CONTROL)
}

/// A character with Alt.
pub const fn alt(c: char) -> Press {
    Press(KeyCode::Char(c), KeyModifiers::ALT)
}

/// A key with Shift.
pub const fn shift(code: KeyCode) -> Press {
    Press(code, KeyModifiers::SHIFT)
}

impl Press {
    /// Whether an event is this press. A capital comes with or without Shift.
    pub fn is(self, event: KeyEvent) -> bool {
        let modifiers = match event.code {
            KeyCode::Char(_) | KeyCode::BackTab => event.modifiers - KeyModifiers::SHIFT,
            _ => event.modifiers,
        };
        self.0 == event.code && self.1 == modifiers
    }

    /// Whether it is a digit alone.
    pub(super) fn is_digit(&self) -> bool {
        matches!(self.0, KeyCode::Char('0'..='9')) && self.1.is_empty()
    }

    /// How it is written for a person.
    pub fn name(self) -> String {
        let held = HELD.iter().filter(|(_, modifier)| self.1.contains(*modifier));
        let mut name: String = held.map(|(name, _)| *name).collect();
        let known = NAMED.iter().find(|(_, code)| *code == self.0);
        match (known, self.0) {
            (Some((key, _)), _) => name += key,
            (None, KeyCode::Char(c)) if self.1.contains(KeyModifiers::CONTROL) => {
                name.extend(c.to_uppercase());
            }
            (None, KeyCode::Char(c)) => name.push(c),
            (None, other) => name += &other.to_string(),
        }
        name
    }
}

/// How keys that are held down with another are written before it.
pub(super) const HELD: [(&str, KeyModifiers); 3] = [
    ("Ctrl-", KeyModifiers::CONTROL),
    ("Alt-", KeyModifiers::ALT),
    ("Shift-", KeyModifiers::SHIFT),
];

/// How keys are written that are no character and no function key; an arrow in two ways.
pub(super) const NAMED: [(&str, KeyCode); 20] = [
    ("Space", KeyCode::Char(' ')),
    ("↑", KeyCode::Up),
    ("↓", KeyCode::Down),
    ("←", KeyCode::Left),
    ("→", KeyCode::Right),
    ("Up", KeyCode::Up),
    ("Down", KeyCode::Down),
    ("Left", KeyCode::Left),
    ("Right", KeyCode::Right),
    ("Home", KeyCode::Home),
    ("End", KeyCode::End),
    ("PgUp", KeyCode::PageUp),
    ("PgDn", KeyCode::PageDown),
    ("Shift-Tab", KeyCode::BackTab),
    ("Tab", KeyCode::Tab),
    ("Enter", KeyCode::Enter),
    ("Esc", KeyCode::Esc),
    ("Backspace", KeyCode::Backspace),
    ("Delete", KeyCode::Delete),
    ("Insert", KeyCode::Insert),
];

pub(crate) const UP: Press = plain(KeyCode::Up);
pub(crate) const DOWN: Press = plain(KeyCode::Down);
pub(crate) const LEFT: Press = plain(KeyCode::Left);
pub(crate) const RIGHT: Press = plain(KeyCode::Right);
pub(crate) const ENTER: Press = plain(KeyCode::Enter);
pub(crate) const HOME: Press = plain(KeyCode::Home);
pub(crate) const END: Press = plain(KeyCode::End);
pub(crate) const PAGE_UP: Press = plain(KeyCode::PageUp);
pub(crate) const PAGE_DOWN: Press = plain(KeyCode::PageDown);
pub(crate) const SHIFT_UP: Press = shift(KeyCode::Up);
pub(crate) const SHIFT_DOWN: Press = shift(KeyCode::Down);
pub(crate) const SHIFT_LEFT: Press = shift(KeyCode::Left);
pub(crate) const SHIFT_RIGHT: Press = shift(KeyCode::Right);
/// Stops the process until the shell goes on with it.
pub(crate) const SUSPEND: Press = ctrl('z');
pub(crate) const ESC: Press = plain(KeyCode::Esc);
pub(crate) const TAB: Press = plain(KeyCode::Tab);
pub(crate) const BACK_TAB: Press = plain(KeyCode::BackTab);

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn capitals_count_with_and_without_shift() {
        for modifiers in [KeyModifiers::NONE, KeyModifiers::SHIFT] {
            let event = KeyEvent::new(KeyCode::Char('H'), modifiers);
            assert!(c('H').is(event) && !c('h').is(event));
        }
    }
}
