//! A file that appears whole or not at all.
//!
//! What is written goes to a temporary file in the same folder, which takes the place of the old one
//! by a rename. A full disk, an error or a signal that is heard leaves the old file as it was and no
//! other. A kill that is not heard leaves the temporary file; its writer's lock is gone then, and
//! the next file written into the folder takes it away.
//!
//! Left out: unnamed files (`O_TMPFILE`), which leave nothing behind, but which only Linux has and
//! which cannot take the place of another file.

use std::fs::{self, File};
use std::io;
use std::path::Path;

use tempfile::{NamedTempFile, PersistError};

use crate::files;

/// What the names of temporary files begin with.
const PREFIX: &str = ".contrecoup-";
/// Nobody has so many leftovers; a folder of more is not searched to its end.
const MAX_LOOKED_AT: usize = 100_000;

/// A temporary file in the folder of `path`, locked while it is written.
///
/// # Errors
/// Where the folder takes no file.
pub fn beside(path: &Path) -> io::Result<NamedTempFile> {
    if files::are_shut() {
        return Err(io::Error::other(files::REFUSAL));
    }
    let parent = path.parent().filter(|p| !p.as_os_str().is_empty());
    let folder = parent.unwrap_or(Path::new("."));
    sweep_up(folder);
    let mut builder = tempfile::Builder::new();
    builder.prefix(PREFIX);
    // Temporary files are private; what comes of this one is as readable as any new file.
    #[cfg(unix)]
    builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
    let file = builder.tempfile_in(folder)?;
    // Some network file systems have no locks; there leftovers stay.
    let _ = file.as_file().try_lock();
    Ok(file)
}

/// Puts the file in the place of whatever is at `path`, or only where nothing is.
///
/// # Errors
/// [`io::ErrorKind::AlreadyExists`] if something is there that may not be replaced; else what the
/// system says.
pub fn put(file: NamedTempFile, path: &Path, replace: bool) -> io::Result<()> {
    let put = if replace {
        file.persist(path)
    } else {
        file.persist_noclobber(path)
    };
    put.map(|_| ()).map_err(|e: PersistError| e.error)
}

/// Takes away temporary files that nobody writes any more.
fn sweep_up(folder: &Path) {
    let Ok(entries) = fs::read_dir(folder) else {
        return;
    };
    for entry in entries.flatten().take(MAX_LOOKED_AT) {
        let is_ours = entry.file_name().to_string_lossy().starts_with(PREFIX);
        if !is_ours || !entry.file_type().is_ok_and(|kind| kind.is_file()) {
            continue;
        }
        let path = entry.path();
        // Without a lock to take nobody knows whether it is still written.
        if File::open(&path).is_ok_and(|file| file.try_lock().is_ok()) {
            let _ = fs::remove_file(&path);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn names(folder: &Path) -> Vec<String> {
        let entries = fs::read_dir(folder).unwrap();
        entries
            .map(|e| e.unwrap().file_name().into_string().unwrap())
            .collect()
    }

    #[test]
    fn leftovers_go_and_what_is_being_written_stays() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.csv");
        fs::write(folder.path().join(".contrecoup-dead"), "half").unwrap();
        let busy = beside(&path).unwrap();
        let second = beside(&path).unwrap();
        assert_eq!(names(folder.path()).len(), 2, "two that are being written");
        put(second, &path, false).unwrap();
        assert!(busy.path().exists());
        let kind = put(busy, &path, false).map_err(|e| e.kind());
        assert_eq!(kind, Err(io::ErrorKind::AlreadyExists));
        assert_eq!(names(folder.path()), ["a.csv"]);
    }
}
