//! The app on the preset that opens first, in one colour, and keys for it: what the tests here
//! start from.

use crate::tui::app::update::{Message, begin, update};
use crate::tui::request::{TaskQuestion, Ticket};
use crate::tui::terminal::caps::{Depth, Symbols};
use crate::tui::{app::App, look::Look, open::prepare, outbox::Effect};
use crossterm::event::{KeyCode, KeyEvent, KeyModifiers};

/// Opened, without its first simulation.
pub fn opened() -> App {
    prepare(&[], Look::new(Depth::Mono, Symbols::Braille)).unwrap()
}

/// Opened, and its first simulation asked for.
pub fn begun() -> App {
    let mut app = opened();
    begin(&mut app);
    app
}

/// The first question of a type that the effects ask.
pub fn asked<Q: TaskQuestion>(effects: &[Effect]) -> Option<(Ticket, &Q)> {
    effects.iter().find_map(|effect| match effect {
        Effect::Start(request) => Some((request.ticket, request.question()?)),
        _ => None,
    })
}

/// Presses a key.
pub fn key(app: &mut App, code: KeyCode) -> Vec<Effect> {
    update(app, Message::Key(KeyEvent::from(code)))
}

/// Presses the key of a letter, or that of a digit with Alt, which shows its screen from every
/// pane.
pub fn letter(app: &mut App, letter: char) -> Vec<Effect> {
    let held = match letter {
        '0'..='9' => KeyModifiers::ALT,
        _ => KeyModifiers::NONE,
    };
    let event = KeyEvent::new(KeyCode::Char(letter), held);
    update(app, Message::Key(event))
}
