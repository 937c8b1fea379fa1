//! Saving a scenario as a preset of the person's own, giving one another name, and removing one.
//!
//! The file appears whole or not at all (`whole_file`), and only once it is on disk.

use std::fs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use crate::plain_text::is_unprintable;
use crate::scenario::{library::is_plain, load::parse_file};
use crate::whole_file;

/// Why nothing was saved.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum SaveError {
    /// Not a name that a file can have everywhere.
    #[error(
        "a name has 1 to 40 ASCII letters, digits, spaces, - . or _, no space or dot first or space last"
    )]
    Name,
    /// It has a character that a file name cannot have everywhere.
    #[error("no {0} in a name: it has 1 to 40 ASCII letters, digits, spaces, - . or _")]
    Letter(String),
    /// The command line would take it for an option or for a file.
    #[error("a name has no dash first and no .ron last: the command line would not find it")]
    CommandLine,
    /// There is a preset of that name.
    #[error("{0} exists")]
    Exists(String),
    /// The system refused.
    #[error("not saved: {0}")]
    Failed(String),
    /// The system refused to rename or to remove it.
    #[error("left as it was: {0}")]
    Kept(String),
}

/// Whether a preset may be called this, or why not.
pub(crate) fn check_name(name: &str) -> Result<(), SaveError> {
    let end = Path::new(name).extension();
    let is_path = end.is_some_and(|end| end.eq_ignore_ascii_case("ron"));
    match name.chars().find(|c| !is_allowed(*c)) {
        Some(c) if !is_unprintable(c) => Err(SaveError::Letter(c.to_string())),
        None if name.starts_with('-') || is_path => Err(SaveError::CommandLine),
        None if is_plain(name) && name.trim() == name && name.len() <= LONGEST => Ok(()),
        _ => Err(SaveError::Name),
    }
}

/// Characters of a name, at most.
const LONGEST: usize = 40;

fn is_allowed(c: char) -> bool {
    c.is_ascii_alphanumeric() || matches!(c, '-' | '_' | '.' | ' ')
}

/// `stem`, or a name like it, that none of the others has: with a number behind it, from 2 on.
pub(crate) fn free_name(stem: &str, is_taken: impl Fn(&str) -> bool) -> String {
    // Room for a dash and three digits.
    let letters = stem.chars().take(LONGEST - 4);
    let like: String = letters.map(|c| if is_allowed(c) { c } else { '-' }).collect();
    let like = match like.trim_start_matches(['.', '-', ' ']).trim_end() {
        "" => "blow",
        like => like,
    };
    let numbered = (2..1000).map(|i| format!("{like}-{i}"));
    let mut names = [stem, like].into_iter().map(str::to_owned).chain(numbered);
    let free = |name: &String| check_name(name).is_ok() && !is_taken(name);
    names.find(free).unwrap_or_default()
}

/// Writes `text` as the preset `name` into `folder`, which is made if need be. Where that fails,
/// whatever was there before is still there.
pub(crate) fn save(folder: &Path, name: &str, text: &str, replace: bool) -> Result<(), SaveError> {
    check_name(name)?;
    fs::create_dir_all(folder).map_err(failed)?;
    let mut path = folder.join(format!("{name}.ron"));
    if replace {
        // What a link leads to is replaced, and the link stays.
        path = whole_file::resolved(&path);
    }
    // On an error the temporary file goes when it is dropped.
    let mut file = whole_file::beside(&path).map_err(failed)?;
    file.write_all(text.as_bytes()).map_err(failed)?;
    file.as_file().sync_all().map_err(failed)?;
    whole_file::put(file, &path, replace).map_err(|error| match error.kind() {
        io::ErrorKind::AlreadyExists => SaveError::Exists(name.to_owned()),
        _ => failed(error),
    })?;
    // The rename itself must reach the disk; a folder that cannot be opened is no loss of data.
    let _ = fs::File::open(folder).and_then(|folder| folder.sync_all());
    Ok(())
}

#[expect(clippy::needless_pass_by_value, reason = "what map_err gives")]
fn failed(error: io::Error) -> SaveError {
    SaveError::Failed(error.to_string())
}

#[expect(clippy::needless_pass_by_value, reason = "what map_err gives")]
fn kept(error: io::Error) -> SaveError {
    SaveError::Kept(error.to_string())
}

/// Gives the preset `from` of `folder` the name `to`, its title too where that was its name.
/// Between the two steps it is there under both names, never under none.
pub(crate) fn rename(folder: &Path, from: &str, to: &str) -> Result<(), SaveError> {
    check_name(from)?;
    let text = fs::read_to_string(folder.join(format!("{from}.ron"))).map_err(kept)?;
    save(folder, to, &retitled(text, (from, to), folder), false)?;
    remove(folder, from).map(|_| ())
}

/// The text of a preset with another title, where its title is `from` and is written plainly.
fn retitled(text: String, (from, to): (&str, &str), folder: &Path) -> String {
    let path = folder.join(format!("{to}.ron"));
    let read = |text: &str| parse_file(text, &path).ok();
    let Some(mut wanted) = read(&text).filter(|scenario| scenario.name == from) else {
        return text;
    };
    to.clone_into(&mut wanted.name);
    let changed = text.replacen(&format!("{from:?}"), &format!("{to:?}"), 1);
    if read(&changed) == Some(wanted) { changed } else { text }
}

/// Removes the preset `name` of `folder`; gives its text, from which it can be saved again.
pub(crate) fn remove(folder: &Path, name: &str) -> Result<String, SaveError> {
    check_name(name)?;
    let path = folder.join(format!("{name}.ron"));
    let text = fs::read_to_string(&path).map_err(kept)?;
    fs::remove_file(&path).map_err(kept)?;
    Ok(text)
}

/// Writes `stem.html` into `folder`, with a number behind where that is taken; gives the path.
pub(crate) fn page(folder: &Path, stem: &str, text: &[u8]) -> Result<PathBuf, SaveError> {
    let file = |name: &str| folder.join(format!("{name}.html"));
    loop {
        let name = free_name(stem, |name| file(name).symlink_metadata().is_ok());
        check_name(&name)?;
        let path = file(&name);
        let mut file = whole_file::beside(&path).map_err(failed)?;
        file.write_all(text).map_err(failed)?;
        match whole_file::put(file, &path, false) {
            Ok(()) => return Ok(path),
            // Somebody was faster: the next number.
            Err(error) if error.kind() == io::ErrorKind::AlreadyExists => {}
            Err(error) => return Err(failed(error)),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn names(folder: &Path) -> Vec<String> {
        let entries = fs::read_dir(folder).unwrap();
        let mut names: Vec<String> =
            entries.map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
        names.sort();
        names
    }

    #[cfg(unix)]
    #[test]
    fn saving_over_a_linked_preset_follows_the_link() {
        let (presets, elsewhere) = (tempfile::tempdir().unwrap(), tempfile::tempdir().unwrap());
        let link = presets.path().join("a.ron");
        let target = elsewhere.path().join("own.ron");
        fs::write(&target, "old").unwrap();
        std::os::unix::fs::symlink(&target, &link).unwrap();
        assert_eq!(save(presets.path(), "a", "new", false), Err(SaveError::Exists("a".to_owned())));
        save(presets.path(), "a", "new", true).unwrap();
        assert!(link.symlink_metadata().unwrap().is_symlink());
        assert_eq!(fs::read_to_string(&target).unwrap(), "new");
        assert_eq!(names(elsewhere.path()), ["own.ron"]);
    }

    #[test]
    fn pages_take_the_next_free_name() {
        let folder = tempfile::tempdir().unwrap();
        for expected in ["bb-56.html", "bb-56-2.html", "bb-56-3.html"] {
            let path = page(folder.path(), "bb-56", b"page").unwrap();
            assert_eq!(path, folder.path().join(expected));
            assert_eq!(fs::read(path).unwrap(), b"page");
        }
        let odd = page(folder.path(), "my/blow", b"page").unwrap();
        assert_eq!(odd, folder.path().join("my-blow.html"));
        assert!(page(&folder.path().join("none"), "x", b"").is_err());
        assert_eq!(names(folder.path()).len(), 4);
    }

    #[test]
    fn a_preset_gets_another_name_and_with_it_its_title_and_goes_when_removed() {
        let folder = tempfile::tempdir().unwrap();
        let text = "(name: \"mine\", /* mine */ impact: ForcePulse(force_n: 42))";
        save(folder.path(), "mine", text, false).unwrap();
        save(folder.path(), "other", "(name: \"Mine\", broken", false).unwrap();
        let taken = rename(folder.path(), "mine", "other");
        assert_eq!(taken, Err(SaveError::Exists("other".to_owned())));
        assert_eq!(rename(folder.path(), "mine", "my blow"), Ok(()));
        let read = |name: &str| fs::read_to_string(folder.path().join(name)).unwrap();
        assert_eq!(read("my blow.ron"), text.replacen("mine", "my blow", 1));
        // A title of its own stays, and what cannot be read is no less one's own.
        assert_eq!(rename(folder.path(), "other", "else"), Ok(()));
        assert_eq!(names(folder.path()), ["else.ron", "my blow.ron"]);
        assert_eq!(read("else.ron"), "(name: \"Mine\", broken");
        for name in ["else", "my blow"] {
            assert!(remove(folder.path(), name).is_ok_and(|text| !text.is_empty()));
        }
        assert!(matches!(remove(folder.path(), "else"), Err(SaveError::Kept(_))));
        assert_eq!(names(folder.path()), [""; 0]);
    }

    #[test]
    fn names_that_leave_the_folder_or_hide_are_refused() {
        for name in ["", "..", ".x", " x", "x ", "a\u{1b}"] {
            assert_eq!(check_name(name), Err(SaveError::Name), "{name:?}");
        }
        for name in ["a/b", "a\\b", "c:x", "blöw"] {
            assert!(matches!(check_name(name), Err(SaveError::Letter(_))), "{name:?}");
        }
        assert_eq!(check_name(&"x".repeat(41)), Err(SaveError::Name));
        for name in ["my-blow_2.1", "my squash ball"] {
            assert_eq!(check_name(name), Ok(()));
        }
        // The command line could not open these.
        for name in ["mine.ron", "mine.RON", "-rf", "--help", "-"] {
            assert_eq!(check_name(name), Err(SaveError::CommandLine), "{name}");
        }
    }

    #[test]
    fn the_name_that_is_offered_is_free_and_allowed() {
        let taken = |name: &str| ["paper-300n", "paper-300n-2"].contains(&name);
        assert_eq!(free_name("paper-300n", taken), "paper-300n-3");
        assert_eq!(free_name("my blow", taken), "my blow");
        for stem in ["", "..", "-rf", "a b/c", "x.ron", &"é".repeat(60)] {
            assert_eq!(check_name(&free_name(stem, |_| false)), Ok(()), "{stem}");
        }
    }
}
