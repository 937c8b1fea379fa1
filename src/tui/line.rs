//! A line of text that is typed into. What stands in it at first is selected: a character takes
//! its place, any other key begins to change it.

use crossterm::event::{Event, KeyEvent, KeyModifiers};
use tui_input::backend::crossterm::EventHandler;
use tui_input::{Input, InputRequest};

/// The text with its cursor.
#[derive(Debug, Default)]
pub struct TextLine {
    /// The text.
    pub input: Input,
    /// Whether all of it is selected.
    pub selected: bool,
}

impl TextLine {
    /// A line with a text to keep, to change or to type over.
    pub fn of(text: String) -> Self {
        Self { selected: !text.is_empty(), input: Input::new(text) }
    }

    pub fn value(&self) -> &str {
        self.input.value()
    }

    /// Puts a character where the cursor is, or in the place of what is selected.
    pub fn put(&mut self, c: char) {
        if self.selected {
            *self = Self::default();
        }
        self.input.handle(InputRequest::InsertChar(c));
    }

    pub fn key(&mut self, event: KeyEvent) {
        if let Some(c) = letter(event) {
            self.put(c);
        } else {
            self.selected = false;
            self.input.handle_event(&Event::Key(event));
        }
    }
}

/// The character that a key stands for, unless another key is held.
pub fn letter(event: KeyEvent) -> Option<char> {
    let held = event.modifiers.intersects(KeyModifiers::CONTROL | KeyModifiers::ALT);
    event.code.as_char().filter(|_| !held)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crossterm::event::KeyCode;

    #[test]
    fn a_character_replaces_what_is_selected_and_other_keys_begin_to_change_it() {
        for (first, text) in [
            (KeyCode::Char('5'), "54"),
            (KeyCode::End, "3004"),
            (KeyCode::Home, "4300"),
            (KeyCode::Left, "3040"),
            (KeyCode::Right, "3004"),
            (KeyCode::Backspace, "304"),
        ] {
            let mut line = TextLine::of("300".to_owned());
            line.key(KeyEvent::from(first));
            line.key(KeyEvent::from(KeyCode::Char('4')));
            assert_eq!(line.value(), text, "{first:?}");
        }
    }
}
