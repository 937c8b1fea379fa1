//! Standard output, or the error that it was closed before the program began.
//!
//! The runtime puts `/dev/null` in the place of a standard stream that is closed, and what is
//! written there is lost without an error. So it is looked at before the runtime begins, which on
//! Linux the loader does for whoever asks.

use std::io::{self, Stdout, Write};

/// Standard output as it was given to the program.
pub(super) struct Output(Option<Stdout>);

impl Output {
    pub fn open() -> Self {
        Self((!is_closed()).then(io::stdout))
    }

    fn opened(&mut self) -> io::Result<&mut Stdout> {
        // As `cat >&-` says.
        self.0.as_mut().ok_or_else(|| io::Error::other("it is closed"))
    }
}

impl Write for Output {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.opened()?.write(bytes)
    }

    fn flush(&mut self) -> io::Result<()> {
        // Nothing is lost where nothing was written.
        self.0.as_mut().map_or(Ok(()), Stdout::flush)
    }
}

#[cfg(not(target_os = "linux"))]
pub(super) fn is_closed() -> bool {
    false
}

#[cfg(target_os = "linux")]
pub(super) use linux::is_closed;

#[cfg(target_os = "linux")]
mod linux {
    use std::hint::black_box;
    use std::os::fd::BorrowedFd;
    use std::sync::atomic::{AtomicBool, Ordering};

    static CLOSED: AtomicBool = AtomicBool::new(false);

    /// The loader calls what stands here before the runtime begins.
    #[used]
    #[unsafe(link_section = ".init_array")]
    #[expect(unsafe_code, reason = "no safe code runs before the runtime opens closed streams")]
    static LOOK: extern "C" fn() = look;

    #[expect(unsafe_code, reason = "there is no handle of standard output yet")]
    extern "C" fn look() {
        // SAFETY: the number is only asked about, and that it may be closed is the question. It is
        // one system call, which needs nothing that the runtime sets up.
        let there = rustix::io::fcntl_getfd(unsafe { BorrowedFd::borrow_raw(1) });
        CLOSED.store(there.is_err(), Ordering::Relaxed);
    }

    /// Whether standard output was closed when the program began.
    pub fn is_closed() -> bool {
        // What nobody names may be left out of the program.
        black_box(&LOOK);
        CLOSED.load(Ordering::Relaxed)
    }
}
