//! Reading a small text file from anywhere: no device or pipe can hang the program or fill memory.

use crate::files;
use std::fs::{self, File};
use std::io::{self, Read};
use std::path::Path;

/// The greatest size of a file, in bytes: a force curve of the most knots fits.
pub const LIMIT: u64 = 256 * 1024;

/// The text of a file, or why it cannot be read: missing, too large, not regular, not UTF-8.
pub(super) fn read(path: &Path) -> Result<String, String> {
    files::allowed()?;
    // Opening a pipe would wait for somebody to write to it, so its kind is asked for first.
    let kind = fs::metadata(path).map_err(reason)?;
    if kind.is_dir() {
        return Err("is a directory, not a file".to_owned());
    }
    if !kind.is_file() {
        return Err("is not a regular file".to_owned());
    }
    let mut bytes = Vec::new();
    let file = File::open(path).map_err(reason)?;
    file.take(LIMIT + 1).read_to_end(&mut bytes).map_err(reason)?;
    if bytes.len() as u64 > LIMIT {
        return Err(format!("is larger than {} KiB", LIMIT / 1024));
    }
    String::from_utf8(bytes).map_err(|error| {
        let before = &error.as_bytes()[..error.utf8_error().valid_up_to()];
        let line = before.split(|byte| *byte == b'\n').count();
        format!("is not UTF-8 text (line {line})")
    })
}

/// Editors on some systems put a byte order mark before the text.
pub(super) fn without_mark(text: &str) -> &str {
    text.strip_prefix('\u{feff}').unwrap_or(text)
}

#[expect(clippy::needless_pass_by_value, reason = "map_err hands it over")]
fn reason(error: io::Error) -> String {
    match error.kind() {
        io::ErrorKind::NotFound => "there is no such file".to_owned(),
        io::ErrorKind::PermissionDenied => "may not be read (permission denied)".to_owned(),
        _ => format!("cannot be read: {error}"),
    }
}
