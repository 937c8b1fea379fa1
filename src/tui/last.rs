//! Where the app was left: `contrecoup/last.ron` beside the config file, written when it closes and read when
//! it opens with nothing asked for.
//!
//! It holds the screen, the preset or file, and the scenario where it was changed since. It is written whole or
//! not at all; where it cannot be, changes are not promised to be kept. One that cannot be read is told and
//! otherwise as good as none. A guest leaves none.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};

use crate::scenario::Scenario;
use crate::scenario::library::home;
use crate::scenario::load::{parse, read_text, to_ron};
use crate::scenario::problem::ScenarioError;
use crate::scenario::ron_text;
use crate::tui::model::Model;
use crate::tui::screens::SCREENS;
use crate::whole_file;

/// Where the app was left.
#[derive(Debug, Clone, PartialEq)]
pub struct Left {
    /// The place of the screen.
    pub screen: usize,
    /// The preset, or the whole path of a file.
    pub source: String,
    /// What was made of it, if it was changed.
    pub changed: Option<Scenario>,
}

/// The same as the file has it; a scenario is the text of a scenario file.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Written {
    screen: String,
    source: String,
    changed: Option<String>,
}

impl Left {
    /// Where a model is.
    pub fn of(model: &Model) -> Self {
        let source = &model.work.source;
        // A file may be asked for from another folder next time.
        let is_file = Path::new(source).is_file();
        let whole = is_file.then(|| std::path::absolute(source).ok()).flatten();
        let whole = whole.and_then(|path| path.into_os_string().into_string().ok());
        Self {
            screen: model.screen,
            source: whole.unwrap_or_else(|| source.clone()),
            changed: model.is_edited().then(|| model.work.scenario.clone()),
        }
    }

    /// Reads the text of a file.
    fn read(text: &str) -> Result<Self, ScenarioError> {
        let written: Written = ron_text::read(text, "")?;
        let title = |at: &usize| SCREENS[*at].title.eq_ignore_ascii_case(&written.screen);
        let changed = written.changed.map(|text| parse(&text, "changed"));
        Ok(Self {
            screen: (0..SCREENS.len()).find(title).unwrap_or(0),
            source: written.source,
            changed: changed.transpose()?,
        })
    }

    fn text(&self) -> Result<String, ron::Error> {
        let written = Written {
            screen: SCREENS[self.screen].title.to_lowercase(),
            source: self.source.clone(),
            changed: self.changed.as_ref().map(to_ron),
        };
        Ok(ron::ser::to_string_pretty(&written, ron::ser::PrettyConfig::default())? + "\n")
    }
}

fn path() -> Option<PathBuf> {
    Some(home()?.join("last.ron"))
}

/// Where the app was left, if it was ever left.
///
/// # Errors
/// Says why the file cannot be read.
pub fn read() -> Result<Option<Left>, ScenarioError> {
    match path().filter(|path| path.symlink_metadata().is_ok()) {
        Some(path) => Left::read(&read_text(&path)?).map(Some),
        None => Ok(None),
    }
}

/// Where it is kept, in a folder that is made if need be.
fn place() -> io::Result<PathBuf> {
    let path = path().ok_or(io::ErrorKind::NotFound)?;
    if let Some(folder) = path.parent() {
        fs::create_dir_all(folder)?;
    }
    Ok(path)
}

/// Whether there is a place to keep it in, which takes a file.
pub fn can_be_kept() -> bool {
    place().is_ok_and(|path| whole_file::beside(&whole_file::resolved(&path)).is_ok())
}

/// Keeps where the app is left.
///
/// # Errors
/// What the system says.
pub fn write(left: &Left) -> io::Result<()> {
    let text = left.text().map_err(io::Error::other)?;
    whole_file::write(&place()?, |file| file.write_all(text.as_bytes()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scenario::library::find;
    use crate::tui::update::driven::opened;

    #[test]
    fn what_is_written_reads_back_with_its_changes() {
        let mut model = opened();
        assert_eq!(Left::of(&model).changed, None);
        model.work.scenario = find("squash-ball").unwrap().scenario().unwrap();
        model.screen = 2;
        let left = Left::of(&model);
        assert_eq!((left.screen, left.source.as_str()), (2, "paper-300n"));
        assert_eq!(left.changed.as_ref(), Some(&model.work.scenario));
        assert_eq!(Left::read(&left.text().unwrap()), Ok(left));
    }

    #[test]
    fn a_damaged_file_is_explained() {
        let whole = Left::of(&opened()).text().unwrap();
        for damaged in [
            "",
            "(",
            &whole[..whole.len() / 2],
            &whole.replace("None", "Some(\"(name: 1)\")"),
        ] {
            assert!(Left::read(damaged).is_err(), "{damaged}");
        }
        // A screen that is no more is no reason to lose the work.
        let other = whole.replace("main", "mean");
        assert_eq!(Left::read(&other).unwrap().screen, 0);
    }
}
