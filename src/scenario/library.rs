//! The presets: those built into the program, and a person's own.
//!
//! A person's presets are the `.ron` files in `contrecoup/presets` under `$XDG_CONFIG_HOME` (or
//! `~/.config`), on every system. One with the name of a built-in preset takes its place, even if
//! it is broken: to run another blow than the one asked for would be worse than an error. Nothing
//! is read before it is asked for.

use crate::files;
use crate::scenario::Scenario;
use crate::scenario::load::{load, parse, parse_file, read_text};
use crate::scenario::problem::{Problem, ScenarioError, suggestion};
use etcetera::BaseStrategy;
use etcetera::base_strategy::Xdg;
use std::borrow::Cow;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

/// Names and texts of the listed files in `presets/`.
macro_rules! built_in {
    ($($name:literal)*) => {
        &[$(($name, include_str!(concat!("../../presets/", $name, ".ron")))),*]
    };
}

static BUILT_IN: &[(&str, &str)] = built_in![
    "air-rifle-pellet" "airbag-foam" "airsoft-75" "airsoft-99" "baseball-34" "baseball-41" "bb-56"
    "bb-62" "bb-92" "champagne-cork" "fine-mesh" "fist" "foam-dart" "gel-ball" "golf-ball"
    "half-sine-below" "hockey-puck" "narrow-blow" "no-filaments" "off-axis-triangle" "paintball"
    "paper-100n" "paper-300n" "paper-600n" "pickleball" "racquetball" "rubber-round" "sharp-edges"
    "shuttlecock"
    "small-area" "soccer-ball" "soft-triangle" "softball" "sponge-round" "squash-ball"
    "tennis-ball" "test-ball-46" "unknown-side" "wide-area"
];

/// Where a preset comes from.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Origin {
    /// Part of the program, with its text.
    BuiltIn(&'static str),
    /// A file of the person's own.
    User(PathBuf),
}

/// A scenario that can be asked for by name.
#[derive(Debug, Clone)]
pub struct Preset {
    /// The file's name without `.ron`.
    pub name: String,
    /// Where it comes from.
    pub origin: Origin,
}

impl Preset {
    fn built_in((name, text): &(&str, &'static str)) -> Self {
        Self { name: (*name).to_owned(), origin: Origin::BuiltIn(text) }
    }

    fn user(name: String, path: PathBuf) -> Self {
        Self { name, origin: Origin::User(path) }
    }

    /// The RON text as it stands, comments included. A file is read when this is called.
    ///
    /// # Errors
    /// Says why it cannot be read.
    pub fn text(&self) -> Result<Cow<'static, str>, ScenarioError> {
        match &self.origin {
            Origin::BuiltIn(text) => Ok(Cow::Borrowed(text)),
            Origin::User(path) => Ok(Cow::Owned(read_text(path)?)),
        }
    }

    /// Reads and checks the text.
    ///
    /// # Errors
    /// Says what is wrong with it, and where.
    pub fn scenario(&self) -> Result<Scenario, ScenarioError> {
        let text = self.text()?;
        match &self.origin {
            Origin::BuiltIn(_) => parse(&text, &format!("preset {}", self.name)),
            Origin::User(path) => parse_file(&text, path),
        }
    }

    /// The name that the scenario gives itself.
    ///
    /// # Errors
    /// As [`Self::scenario`].
    pub fn title(&self) -> Result<String, ScenarioError> {
        Ok(self.scenario()?.name)
    }
}

/// The presets that come with the program, sorted by name.
pub fn built_in() -> Vec<Preset> {
    BUILT_IN.iter().map(Preset::built_in).collect()
}

/// All presets, sorted by name. A broken one is among them and says so when it is read.
///
/// # Errors
/// Where the person's folder exists but cannot be listed.
pub fn list() -> Result<Vec<Preset>, ScenarioError> {
    let (mut presets, own) = (built_in(), own_presets()?);
    presets.retain(|preset| own.iter().all(|own| own.name != preset.name));
    presets.extend(own);
    presets.sort_by(|a, b| a.name.cmp(&b.name));
    Ok(presets)
}

/// The preset of that name.
///
/// # Errors
/// Where there is none: suggests the nearest names.
pub fn find(name: &str) -> Result<Preset, ScenarioError> {
    if !is_plain(name) {
        let message = if name.is_empty() {
            "expected a preset's name or a file that ends in .ron"
        } else {
            "a preset's name holds no path"
        };
        return Err(unknown(name, message).into());
    }
    if let Some(own) = own_preset(name) {
        return Ok(own);
    }
    let built_in = BUILT_IN.iter().find(|(known, _)| *known == name);
    built_in.map(Preset::built_in).ok_or_else(|| {
        let names: Vec<String> = list().unwrap_or_default().into_iter().map(|p| p.name).collect();
        let near = suggestion(name, names.iter().map(String::as_str));
        unknown(name, &format!("there is no such preset{near}; `contrecoup presets` lists them"))
            .into()
    })
}

/// The scenario that an argument of the command line means: a file if it ends in `.ron` or holds a
/// path separator, else a preset. Where there is no such file, an own preset may be meant, by the
/// name of its file (`mine.ron`) or because its name ends so.
///
/// # Errors
/// Where it cannot be found, read or accepted.
pub fn resolve(argument: &str) -> Result<Scenario, ScenarioError> {
    let extension = Path::new(argument).extension();
    let is_ron = extension.is_some_and(|extension| extension.eq_ignore_ascii_case("ron"));
    if is_ron || argument.contains(std::path::is_separator) {
        let path = Path::new(argument);
        let own = is_plain(argument) && path.symlink_metadata().is_err();
        let stem = path.file_stem().unwrap_or_default().to_string_lossy();
        let mut names = [argument, &stem].into_iter().filter(|_| own);
        names.find_map(own_preset).map_or_else(|| load(path), |preset| preset.scenario())
    } else {
        find(argument)?.scenario()
    }
}

/// The person's own preset of that name.
fn own_preset(name: &str) -> Option<Preset> {
    let path = folder()?.join(format!("{name}.ron"));
    let there = path.symlink_metadata().is_ok();
    there.then(|| Preset::user(name.to_owned(), path))
}

fn unknown(name: &str, message: &str) -> Problem {
    Problem::new("", message).of(&crate::plain_text::quoted(name))
}

/// Whether a name stays inside its folder on every system.
pub fn is_plain(name: &str) -> bool {
    !name.is_empty() && !name.starts_with('.') && !name.contains(['/', '\\', ':', '\0'])
}

/// Where the presets of the person are kept, if there is a home for them.
pub fn folder() -> Option<PathBuf> {
    Some(home()?.join("presets"))
}

/// Where everything of the person's own is kept, if there is a home for it. A guest has none.
pub(crate) fn home() -> Option<PathBuf> {
    if files::are_shut() {
        return None;
    }
    Some(Xdg::new().ok()?.config_dir().join("contrecoup"))
}

fn own_presets() -> Result<Vec<Preset>, ScenarioError> {
    let Some(folder) = folder() else { return Ok(Vec::new()) };
    let failed = |error: io::Error| {
        let message = format!("the folder of presets cannot be listed: {error}");
        ScenarioError::from(Problem::new("", message).of(&folder.display().to_string()))
    };
    let entries = match fs::read_dir(&folder) {
        Ok(entries) => entries,
        Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(Vec::new()),
        Err(error) => return Err(failed(error)),
    };
    let mut own = Vec::new();
    for entry in entries {
        let path = entry.map_err(failed)?.path();
        let name = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
        if is_plain(&name) && path.extension().is_some_and(|extension| extension == "ron") {
            own.push(Preset::user(name, path));
        }
    }
    Ok(own)
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;
    use crate::scenario::set::set;

    /// A built-in preset with some of its fields set.
    pub(crate) fn preset(name: &str, changes: &[(&str, &str)]) -> Scenario {
        let mut scenario = find(name).unwrap().scenario().unwrap();
        for (path, value) in changes {
            set(&mut scenario, path, value).unwrap();
        }
        scenario
    }

    #[test]
    fn the_program_holds_every_preset_of_the_folder() {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("presets");
        let mut files: Vec<String> = fs::read_dir(folder)
            .unwrap()
            .map(|entry| entry.unwrap().file_name().into_string().unwrap())
            .collect();
        files.sort();
        let held: Vec<String> = BUILT_IN.iter().map(|(name, _)| format!("{name}.ron")).collect();
        assert_eq!(held, files);
    }

    #[test]
    fn every_built_in_preset_is_sound_and_says_what_it_is() {
        let mut titles = Vec::new();
        for preset in BUILT_IN.iter().map(Preset::built_in) {
            let title = preset.title().unwrap_or_else(|error| panic!("{error}"));
            assert!(!titles.contains(&title), "{title} is used twice");
            titles.push(title);
            assert!(preset.text().unwrap().starts_with("// "), "{}", preset.name);
        }
    }

    #[test]
    fn the_paper_preset_is_the_default_scenario_with_the_window_that_it_takes() {
        let preset = BUILT_IN.iter().find(|(name, _)| *name == "paper-300n").unwrap();
        let usual = Scenario::default();
        let window_ms = usual.known_window_ms();
        assert_eq!(Preset::built_in(preset).scenario().unwrap(), Scenario { window_ms, ..usual });
    }

    #[test]
    fn names_stay_inside_the_folder() {
        for name in ["", "..", ".", "../x", "a/b", "a\\b", "c:x", ".hidden", "a\0"] {
            assert!(find(name).is_err(), "{name:?}");
        }
    }
}
