//! What Windows alone has: a console that is read by events and drawn on by its own calls.
//!
//! Left out: signals and the stop of a job, which there are none of; a console that is closed ends
//! its programs. Pasted text comes as keys.

use std::io;
use std::sync::mpsc::SyncSender;

use crossterm::event::{self as console, DisableMouseCapture, EnableMouseCapture, KeyEventKind};

use crate::run::threads;
use crate::tui::terminal::{event::Event, input::TerminalInput, pacer::Pacer};

/// Where the app draws: only this handle turns UTF-8 into what a console takes.
pub(super) type Out = io::Stdout;

/// Opens what is drawn on; none where escape sequences are unknown, as before Windows 10 of 2016.
pub(super) fn out() -> io::Result<Out> {
    if crossterm::ansi_support::supports_ansi() {
        Ok(io::stdout())
    } else {
        Err(io::Error::other("the console knows no escape sequences"))
    }
}

/// A console has drawn a frame when the write returns, and its replies would come as keys.
pub(super) fn pacer() -> Pacer {
    Pacer::local()
}

/// Has the console report its mouse, or no longer.
pub(super) fn listen_to_mouse(mut out: &Out, listen: bool) -> io::Result<()> {
    if listen {
        crossterm::execute!(out, EnableMouseCapture)
    } else {
        crossterm::execute!(out, DisableMouseCapture)
    }
}

/// Nothing runs there when a program aborts.
#[expect(clippy::unnecessary_wraps, reason = "other systems may refuse")]
pub(super) fn restore_on_abort(_is_entered: fn() -> bool) -> io::Result<()> {
    Ok(())
}

/// There are none.
#[expect(clippy::unnecessary_wraps, reason = "other systems may refuse")]
pub(super) fn signals() -> io::Result<()> {
    Ok(())
}

/// Sends what is typed and when the window changes.
pub(super) fn listen(send: &SyncSender<Event>, (): ()) -> io::Result<()> {
    let send = send.clone();
    threads::start(move || {
        let mut is_open = true;
        while is_open {
            let event = match console::read() {
                Ok(console::Event::Key(key)) if key.kind != KeyEventKind::Release => {
                    Event::Input(TerminalInput::Key(key))
                }
                Ok(console::Event::Mouse(mouse)) => Event::Input(TerminalInput::Mouse(mouse)),
                Ok(console::Event::Paste(text)) => Event::Input(TerminalInput::Paste(text)),
                Ok(console::Event::Resize(..)) => Event::Resized,
                Ok(_) => continue,
                Err(_) => {
                    is_open = false;
                    Event::hangup()
                }
            };
            is_open &= send.send(event).is_ok();
        }
    })
}

/// Nothing to stop for; no key asks for it.
pub(super) fn stop() -> io::Result<()> {
    Ok(())
}
