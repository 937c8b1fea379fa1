//! What comes from outside, and the threads that wait for it.

use std::io::{self, Read};
use std::sync::mpsc::Sender;
use std::thread;

use signal_hook::consts::signal::SIGXFSZ;
use signal_hook::consts::{SIGCONT, SIGINT, SIGQUIT, SIGTERM, SIGWINCH};
use signal_hook::iterator::Signals;

use super::input::Input;
use crate::tui::keys::shared::SUSPEND;
use crate::tui::update::Message;

/// Something that came from outside.
pub(super) enum Event {
    /// What was typed, and replies of the terminal.
    Bytes(Vec<u8>),
    /// What was typed while the terminal was about to be handed over.
    Input(Input),
    /// The terminal is gone.
    Hangup,
    /// A signal.
    Signal(i32),
    /// What a thread found out.
    News(Message),
}

impl Event {
    /// Whether the app must leave.
    pub(super) fn is_end(&self) -> bool {
        match self {
            Self::Hangup => true,
            Self::Signal(signal) => !matches!(*signal, SIGCONT | SIGWINCH | SIGXFSZ),
            _ => false,
        }
    }

    /// Whether it asks to stop until the shell goes on.
    pub(super) fn is_suspend(&self) -> bool {
        let Self::Input(Input::Key(key)) = self else {
            return false;
        };
        SUSPEND.is(*key)
    }
}

/// The signals that are listened to, from now on.
pub(super) fn signals() -> io::Result<Signals> {
    Signals::new([SIGWINCH, SIGTERM, SIGINT, SIGQUIT, SIGCONT, SIGXFSZ])
}

/// Sends what is typed and which signals come.
pub(super) fn listen(send: &Sender<Event>, mut signals: Signals) {
    let sender = send.clone();
    thread::spawn(move || {
        for signal in signals.forever() {
            if sender.send(Event::Signal(signal)).is_err() {
                return;
            }
        }
    });
    let sender = send.clone();
    thread::spawn(move || read_keyboard(&sender));
}

fn read_keyboard(send: &Sender<Event>) {
    let mut keyboard = io::stdin().lock();
    let mut bytes = [0; 4096];
    loop {
        let event = match keyboard.read(&mut bytes) {
            Ok(0) => Event::Hangup,
            Ok(count) => Event::Bytes(bytes[..count].to_vec()),
            Err(error) if error.kind() == io::ErrorKind::Interrupted => continue,
            Err(_) => Event::Hangup,
        };
        let over = matches!(event, Event::Hangup);
        if send.send(event).is_err() || over {
            return;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crossterm::event::{KeyCode, KeyEvent, KeyModifiers};

    #[test]
    fn what_ends_the_app_and_what_stops_it_are_told_from_the_rest() {
        let key = |code, held| Event::Input(Input::Key(KeyEvent::new(code, held)));
        let ctrl_z = key(KeyCode::Char('z'), KeyModifiers::CONTROL);
        assert!(ctrl_z.is_suspend() && !ctrl_z.is_end());
        assert!(!key(KeyCode::Char('z'), KeyModifiers::NONE).is_suspend());
        assert!(Event::Hangup.is_end() && Event::Signal(SIGTERM).is_end());
        for harmless in [SIGCONT, SIGWINCH, SIGXFSZ] {
            assert!(!Event::Signal(harmless).is_end());
        }
    }
}
