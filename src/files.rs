//! Whether the program may touch files at all.
//!
//! A guest's may not. Every way to a file asks here: text that is read (`scenario::text_file`), the
//! person's own folder (`scenario::library`) and files that are written (`whole_file`).

use std::sync::atomic::{AtomicBool, Ordering};

static SHUT: AtomicBool = AtomicBool::new(false);

/// From now on no file is read or written, until the program ends.
#[cfg(feature = "app")]
pub(crate) fn shut() {
    SHUT.store(true, Ordering::SeqCst);
}

/// Refuses a file that a guest asks for.
pub(crate) fn allowed() -> Result<(), &'static str> {
    if are_shut() { Err("a guest has no files") } else { Ok(()) }
}

/// Whether files must not be touched.
pub(crate) fn are_shut() -> bool {
    SHUT.load(Ordering::SeqCst)
}
