//! The terminal's modes: entered once, and left again whatever happens.

use std::io::{self, Write};
use std::sync::atomic::{AtomicBool, Ordering};

use crossterm::terminal::{disable_raw_mode, enable_raw_mode};

use crate::tui::terminal::system;

/// Alternate screen, bracketed paste, no cursor.
const ENTER: &[u8] = b"\x1b[?1049h\x1b[2J\x1b[?2004h\x1b[?25l";
/// The way back.
pub(super) const LEAVE: &[u8] = b"\x1b[?2026l\x1b[0m\x1b[?2004l\x1b[?25h\x1b[?1049l\x1b[?25h";

static ENTERED: AtomicBool = AtomicBool::new(false);
/// Whether the terminal reports the mouse, or will once it is entered again.
static MOUSE: AtomicBool = AtomicBool::new(false);

/// A terminal in the app's hands.
pub struct Session {
    out: system::Out,
}

impl Session {
    /// Takes the terminal over; a panic gives it back before it says anything.
    pub fn enter() -> io::Result<Self> {
        let (out, spare) = (system::out()?, system::out()?);
        let before = std::panic::take_hook();
        std::panic::set_hook(Box::new(move |info| {
            leave(&spare);
            before(info);
            // A worker's panic must not leave an app behind that waits for it.
            std::process::exit(101);
        }));
        system::restore_on_abort(|| ENTERED.load(Ordering::SeqCst))?;
        let mut session = Self { out };
        session.resume()?;
        Ok(session)
    }

    /// Takes the terminal over again, in whatever state somebody else left it.
    pub fn resume(&mut self) -> io::Result<()> {
        // What counts as raw already would not be made raw again.
        disable_raw_mode()?;
        enable_raw_mode()?;
        ENTERED.store(true, Ordering::SeqCst);
        self.out.write_all(ENTER)?;
        if MOUSE.load(Ordering::SeqCst) {
            system::listen_to_mouse(&self.out, true)?;
        }
        self.out.flush()
    }

    /// Has the mouse reported, or no longer. Says nothing to a terminal that does so already.
    pub fn listen_to_mouse(&mut self, listen: bool) -> io::Result<()> {
        if MOUSE.swap(listen, Ordering::SeqCst) == listen {
            return Ok(());
        }
        system::listen_to_mouse(&self.out, listen)
    }

    pub fn leave(&self) {
        leave(&self.out);
    }

    /// Writes a whole frame at once.
    pub fn write(&mut self, frame: &[u8]) -> io::Result<()> {
        self.out.write_all(frame)?;
        self.out.flush()
    }
}

impl Drop for Session {
    fn drop(&mut self) {
        self.leave();
    }
}

/// Gives back what can be given back of a terminal that does not read, and ends the program.
#[cfg(unix)]
pub(super) fn abandon(code: i32) -> ! {
    // The app may be held up in a write, so this one must not be waited for.
    let _ = crate::run::threads::start(|| {
        if let Ok(out) = system::out() {
            leave(&out);
        }
    });
    std::thread::sleep(std::time::Duration::from_millis(200));
    let _ = disable_raw_mode();
    std::process::exit(code)
}

fn leave(mut out: &system::Out) {
    if ENTERED.swap(false, Ordering::SeqCst) {
        if MOUSE.load(Ordering::SeqCst) {
            let _ = system::listen_to_mouse(out, false);
        }
        // A terminal that is gone needs no restoring.
        let _ = out.write_all(LEAVE).and_then(|()| out.flush());
        let _ = disable_raw_mode();
    }
}
