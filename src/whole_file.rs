//! A file that appears whole or not at all.
//!
//! What is written goes to a temporary file in the same folder, which takes the place of the old
//! one by a rename. A full disk, an error or a signal that is heard leaves the old file as it was
//! and no other. A kill that is not heard leaves the temporary file; its writer's lock is gone
//! then, and the next file written into the folder takes it away. A link stays a link: what it
//! leads to is replaced. What is no plain file, such as `/dev/stdout`, is written to and stays.

use crate::files;
use std::fs::{self, File};
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};
use tempfile::{NamedTempFile, PersistError};

/// What the names of temporary files begin with.
const PREFIX: &str = ".contrecoup-";
/// What they end with: a file of somebody's own is not called like this.
const SUFFIX: &str = ".part";
/// Nobody has so many leftovers; a folder of more is not searched to its end.
const MAX_LOOKED_AT: usize = 100_000;

/// Fills the file at `path`; on an error it holds what it held before.
pub fn write(path: &Path, fill: impl FnOnce(&mut dyn Write) -> io::Result<()>) -> io::Result<()> {
    let filled = |file: &mut File| {
        let mut buffered = BufWriter::new(file);
        fill(&mut buffered)?;
        buffered.flush()
    };
    if path.metadata().is_ok_and(|m| !m.is_file()) {
        files::allowed().map_err(io::Error::other)?;
        return filled(&mut File::create(path)?);
    }
    let target = resolved(path);
    let mut file = beside(&target)?;
    filled(file.as_file_mut())?;
    put(file, &target, true)
}

/// Links that are followed one after the other where nothing stands at their end.
const MAX_LINKS: usize = 40;

/// The file that a path leads to, even where it is still to be made.
pub fn resolved(path: &Path) -> PathBuf {
    let mut path = path.to_owned();
    for _ in 0..MAX_LINKS {
        let Ok(next) = path.read_link() else { break };
        path = path.parent().unwrap_or(Path::new("")).join(next);
    }
    let beside = || Some(folder_of(&path).canonicalize().ok()?.join(path.file_name()?));
    let there = path.canonicalize().ok().or_else(beside);
    there.unwrap_or(path)
}

fn folder_of(path: &Path) -> &Path {
    path.parent().filter(|parent| !parent.as_os_str().is_empty()).unwrap_or(Path::new("."))
}

/// A temporary file in the folder of `path`, locked while it is written.
pub fn beside(path: &Path) -> io::Result<NamedTempFile> {
    files::allowed().map_err(io::Error::other)?;
    let folder = folder_of(path);
    sweep_up(folder);
    let mut builder = tempfile::Builder::new();
    builder.prefix(PREFIX).suffix(SUFFIX);
    // Temporary files are private; what comes of this one is as readable as any new file.
    #[cfg(unix)]
    builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
    let file = builder.tempfile_in(folder)?;
    // Some network file systems have no locks; there leftovers stay.
    let _ = file.as_file().try_lock();
    Ok(file)
}

/// Puts the file at `path`, or says [`io::ErrorKind::AlreadyExists`] of what may not be replaced.
pub fn put(file: NamedTempFile, path: &Path, replace: bool) -> io::Result<()> {
    let put = if replace {
        // What somebody keeps to themselves stays theirs alone.
        #[cfg(unix)]
        if let Ok(old) = path.metadata() {
            let _ = file.as_file().set_permissions(old.permissions());
        }
        file.persist(path)
    } else {
        file.persist_noclobber(path)
    };
    put.map(|_| ()).map_err(|e: PersistError| e.error)
}

/// Takes away temporary files that nobody writes any more.
fn sweep_up(folder: &Path) {
    let Ok(entries) = fs::read_dir(folder) else { return };
    for entry in entries.flatten().take(MAX_LOOKED_AT) {
        let name = entry.file_name();
        let name = name.to_string_lossy();
        let is_ours = name.starts_with(PREFIX) && name.ends_with(SUFFIX);
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
        entries.map(|e| e.unwrap().file_name().into_string().unwrap()).collect()
    }

    #[cfg(unix)]
    #[test]
    fn a_link_stays_a_link_and_what_is_no_plain_file_stays_what_it_is() {
        let folder = tempfile::tempdir().unwrap();
        let file = |name: &str| folder.path().join(name);
        fs::write(file("old"), "old").unwrap();
        std::os::unix::fs::symlink("old", file("link")).unwrap();
        write(&file("link"), |out| out.write_all(b"new")).unwrap();
        assert!(file("link").is_symlink());
        assert_eq!(fs::read_to_string(file("old")).unwrap(), "new");
        let half = write(&file("link"), |out| {
            out.write_all(b"half")?;
            Err(io::Error::other("enough"))
        });
        assert!(half.is_err());
        assert_eq!(fs::read_to_string(file("old")).unwrap(), "new");
        std::os::unix::fs::symlink("/dev/null", file("device")).unwrap();
        write(&file("device"), |out| out.write_all(b"gone")).unwrap();
        assert_eq!(fs::read(file("device")).unwrap(), b"");
        assert_eq!(names(folder.path()).len(), 3);
    }

    #[cfg(unix)]
    #[test]
    fn a_link_to_what_is_still_to_be_made_makes_it_and_a_private_file_stays_private() {
        use std::os::unix::fs::PermissionsExt;
        let folder = tempfile::tempdir().unwrap();
        let file = |name: &str| folder.path().join(name);
        std::os::unix::fs::symlink("second", file("first")).unwrap();
        std::os::unix::fs::symlink("made", file("second")).unwrap();
        write(&file("first"), |out| out.write_all(b"new")).unwrap();
        assert!(file("first").is_symlink() && file("second").is_symlink());
        assert_eq!(fs::read_to_string(file("made")).unwrap(), "new");
        fs::set_permissions(file("made"), PermissionsExt::from_mode(0o600)).unwrap();
        write(&file("first"), |out| out.write_all(b"newer")).unwrap();
        let mode = file("made").metadata().unwrap().permissions().mode();
        assert_eq!(mode & 0o777, 0o600);
    }

    #[test]
    fn leftovers_go_and_what_is_being_written_stays() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.csv");
        fs::write(folder.path().join(".contrecoup-dead.part"), "half").unwrap();
        // Nobody's file but the person's.
        let own = folder.path().join(".contrecoup-notes");
        fs::write(&own, "mine").unwrap();
        let busy = beside(&path).unwrap();
        let second = beside(&path).unwrap();
        assert_eq!(names(folder.path()).len(), 3, "two that are being written, and notes");
        fs::remove_file(own).unwrap();
        put(second, &path, false).unwrap();
        assert!(busy.path().exists());
        let kind = put(busy, &path, false).map_err(|e| e.kind());
        assert_eq!(kind, Err(io::ErrorKind::AlreadyExists));
        assert_eq!(names(folder.path()), ["a.csv"]);
    }
}
