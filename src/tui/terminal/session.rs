//! The terminal's modes: entered once, and left again whatever happens.

use std::fs::File;
use std::io::{self, Write};
use std::os::fd::AsFd;
use std::sync::atomic::{AtomicBool, Ordering};

use crossterm::terminal::{disable_raw_mode, enable_raw_mode};

use super::mouse;

/// Alternate screen, bracketed paste, no cursor.
const ENTER: &[u8] = b"\x1b[?1049h\x1b[2J\x1b[?2004h\x1b[?25l";
/// The way back.
const LEAVE: &[u8] = b"\x1b[?2026l\x1b[0m\x1b[?2004l\x1b[?25h\x1b[?1049l\x1b[?25h";

static ENTERED: AtomicBool = AtomicBool::new(false);
/// Whether the terminal reports the mouse, or will once it is entered again.
static MOUSE: AtomicBool = AtomicBool::new(false);

/// A terminal in the app's hands.
pub struct Session {
    out: File,
}

impl Session {
    /// Takes the terminal over; a panic gives it back before it says anything.
    ///
    /// # Errors
    /// Where the terminal refuses.
    pub fn enter() -> io::Result<Self> {
        // A handle of its own takes no lock, so a panic on any thread can write.
        let out = File::from(io::stdout().as_fd().try_clone_to_owned()?);
        let spare = out.try_clone()?;
        let before = std::panic::take_hook();
        std::panic::set_hook(Box::new(move |info| {
            leave(&spare);
            before(info);
            // A worker's panic must not leave an app behind that waits for it.
            std::process::exit(101);
        }));
        let mut session = Self { out };
        session.resume()?;
        Ok(session)
    }

    /// Takes the terminal over again.
    ///
    /// # Errors
    /// Where the terminal refuses.
    pub fn resume(&mut self) -> io::Result<()> {
        enable_raw_mode()?;
        ENTERED.store(true, Ordering::SeqCst);
        self.out.write_all(ENTER)?;
        if MOUSE.load(Ordering::SeqCst) {
            self.out.write_all(mouse::ON)?;
        }
        Ok(())
    }

    /// Has the mouse reported, or no longer. Says nothing to a terminal that does so already.
    ///
    /// # Errors
    /// Where the terminal is gone.
    pub fn listen_to_mouse(&mut self, listen: bool) -> io::Result<()> {
        if MOUSE.swap(listen, Ordering::SeqCst) == listen {
            return Ok(());
        }
        self.out
            .write_all(if listen { mouse::ON } else { mouse::OFF })
    }

    /// Takes the terminal over again after somebody else may have changed it.
    ///
    /// # Errors
    /// Where the terminal refuses.
    pub fn retake(&mut self) -> io::Result<()> {
        // Raw mode counts as entered already, and would not be entered again.
        disable_raw_mode()?;
        self.resume()
    }

    /// Gives the terminal back.
    pub fn leave(&self) {
        leave(&self.out);
    }

    /// Writes a whole frame at once.
    ///
    /// # Errors
    /// Where the terminal is gone.
    pub fn write(&mut self, frame: &[u8]) -> io::Result<()> {
        self.out.write_all(frame)
    }
}

impl Drop for Session {
    fn drop(&mut self) {
        self.leave();
    }
}

fn leave(mut out: &File) {
    if ENTERED.swap(false, Ordering::SeqCst) {
        if MOUSE.load(Ordering::SeqCst) {
            let _ = out.write_all(mouse::OFF);
        }
        // A terminal that is gone needs no restoring.
        let _ = out.write_all(LEAVE);
        let _ = disable_raw_mode();
    }
}
