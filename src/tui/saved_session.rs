//! Where the app was left: `contrecoup/last.ron` beside the config file, written when it closes
//! and read when it opens with nothing asked for. A guest leaves none.
//!
//! It is written whole or not at all; where it cannot be, changes are not promised to be kept. One
//! that cannot be read is told and otherwise as good as none.

use std::path::{Path, PathBuf};
use std::{fs, io};

use ron::ser::{PrettyConfig, to_string_pretty};
use serde::{Deserialize, Serialize};

use crate::scenario::load::{parse, read_text, to_ron};
use crate::scenario::{Scenario, library::home, problem::ScenarioError, ron_text};
use crate::tui::{app::App, screens::SCREENS, screens::screen::About};
use crate::whole_file;

#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SavedSession {
    /// The title of the screen.
    screen: String,
    /// The preset, or the whole path of a file.
    pub source: String,
    /// What was made of it, if it was changed: the text of a scenario file.
    changed: Option<String>,
}

impl SavedSession {
    pub fn of(app: &App) -> Self {
        let source = &app.model.work.source;
        // A file may be asked for from another folder next time.
        let is_file = Path::new(source).is_file();
        let whole = is_file.then(|| std::path::absolute(source).ok()).flatten();
        let whole = whole.and_then(|path| path.into_os_string().into_string().ok());
        Self {
            screen: app.about().title.to_lowercase(),
            source: whole.unwrap_or_else(|| source.clone()),
            changed: app.model.is_edited().then(|| to_ron(&app.model.work.scenario)),
        }
    }

    /// The place of the screen.
    pub fn screen(&self) -> usize {
        let here = |about: &About| about.title.eq_ignore_ascii_case(&self.screen);
        SCREENS.iter().position(here).unwrap_or(0)
    }
}

fn path() -> Option<PathBuf> {
    Some(home()?.join("last.ron"))
}

/// Where the app was left, if it was ever left, and what was made of what was worked on.
pub fn read() -> Result<Option<(SavedSession, Option<Scenario>)>, ScenarioError> {
    let Some(path) = path().filter(|path| path.symlink_metadata().is_ok()) else { return Ok(None) };
    let session: SavedSession = ron_text::read(&read_text(&path)?, "")?;
    let changed = session.changed.as_ref().map(|text| parse(text, "changed")).transpose()?;
    Ok(Some((session, changed)))
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

pub fn write(session: &SavedSession) -> io::Result<()> {
    let text = to_string_pretty(session, PrettyConfig::default()).map_err(io::Error::other)?;
    whole_file::write(&place()?, |file| writeln!(file, "{text}"))
}
