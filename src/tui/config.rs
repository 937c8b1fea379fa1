//! What a person wants of the app at every start: `contrecoup/config.ron` under `$XDG_CONFIG_HOME`
//! (or `~/.config`). A flag counts for more than the file.
//!
//! An empty file sets nothing, so that `contrecoup config` may be sent into the file it reads.

use std::fmt::Write;
use std::path::PathBuf;

use serde::{Deserialize, Serialize};
use serde_json::{Map, Value};

use crate::scenario::load::read_text;
use crate::scenario::locate::{is_blank, locate};
use crate::scenario::problem::{Problem, ScenarioError};
use crate::scenario::{library, ron_text};
use crate::tui::app::{chosen_keys::named, tables::clash};
use crate::tui::terminal::caps::{ColorFlag, Symbols};
use crate::tui::view::palette::{Colour, Colours, DARK, FEW, Ground, LIGHT, ROLES};
use crate::tui::view::{heat::HeatMap, text::wrapped};
use crate::tui::{keys::chosen::Keys, screens::SCREENS};

/// What a person wants of the app.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Config {
    /// How many colours.
    #[serde(with = "word")]
    pub color: ColorFlag,
    /// Whether the terminal's ground is dark or light.
    #[serde(with = "word")]
    pub ground: Ground,
    /// Which symbols; `None` by the terminal.
    #[serde(serialize_with = "word::or_auto", deserialize_with = "word::read_or_auto")]
    pub symbols: Option<Symbols>,
    /// Which colours stand for heat.
    #[serde(with = "word")]
    pub heat: HeatMap,
    /// Most frames a second of a replay.
    pub fps: u8,
    /// Whether the mouse is listened to.
    pub mouse: bool,
    /// Whether bands and mesh errors are computed while nothing else is wanted.
    pub idle: bool,
    /// The screen that is shown first, or [`LAST`].
    pub start: String,
    /// Colours of one's own.
    pub colours: Colours,
    /// Keys of one's own.
    pub keys: Keys,
}

/// Starts where the app was left.
const LAST: &str = "last";

impl Default for Config {
    fn default() -> Self {
        Self {
            color: ColorFlag::Auto,
            ground: Ground::Auto,
            symbols: None,
            heat: HeatMap::Hot,
            fps: 12,
            mouse: false,
            idle: true,
            start: LAST.to_owned(),
            colours: Colours::default(),
            keys: Keys::default(),
        }
    }
}

impl Config {
    /// The person's own, or the defaults where they have none.
    ///
    /// # Errors
    /// Says what is wrong with the file, and where.
    pub fn load() -> Result<Self, ScenarioError> {
        match path().filter(|path| path.symlink_metadata().is_ok()) {
            Some(path) => Self::read(&read_text(&path)?, &path.display().to_string()),
            None => Ok(Self::default()),
        }
    }

    /// Reads the text of a file; `origin` is what messages call it.
    ///
    /// # Errors
    /// Says what is refused, with its line and column.
    pub fn read(text: &str, origin: &str) -> Result<Self, ScenarioError> {
        let text = text.strip_prefix('\u{feff}').unwrap_or(text);
        if is_blank(text) {
            return Ok(Self::default());
        }
        let placed = |problem: Problem| {
            let at = locate(text, &problem.field);
            problem.at(at).of(origin)
        };
        let config: Self = ron_text::read_with(text, "", expected).map_err(|mut error| {
            let keys = |problem: &&mut Problem| problem.field.starts_with("keys.");
            // A key is refused when all of its list is read.
            for problem in error.problems.iter_mut().filter(keys) {
                *problem = placed(std::mem::take(problem));
            }
            error.of(origin)
        })?;
        let problems: Vec<Problem> = config.problems().map(placed).collect();
        if problems.is_empty() { Ok(config) } else { Err(ScenarioError { problems }) }
    }

    /// What makes no sense although it could be read.
    fn problems(&self) -> impl Iterator<Item = Problem> {
        let refused = |field: &str, value: &str, complaint: &str| {
            let (_, allowed) = expected(field).unwrap_or_default();
            Problem::refused(field, value, complaint, allowed)
        };
        let fps = (!(1..=60).contains(&self.fps))
            .then(|| refused("fps", &self.fps.to_string(), "is out of range"));
        let is_known = self.start == LAST || self.first_screen().is_some();
        let start = (!is_known)
            .then(|| refused("start", &format!("{:?}", self.start), "is not known here"));
        let clash = clash(&self.keys).map(|(name, key, other)| {
            let (key, field) = (key.name(), format!("keys.{}", name.to_lowercase()));
            let choose = "choose another key, or another one for that";
            Problem::new(field, format!("{key:?} is taken by {other}: {choose}"))
        });
        [fps, start, clash].into_iter().flatten()
    }

    /// The place of the screen that is shown first; none where the app was left.
    pub fn first_screen(&self) -> Option<usize> {
        titles().position(|title| title == self.start)
    }

    /// As a file that reads back as this, each setting below what it does and what it may be.
    pub fn to_ron(&self) -> String {
        let usual = fields(&Self::default());
        let mut text = "(\n".to_owned();
        // A string takes whatever it is given.
        for (name, value) in &fields(self) {
            let mut about = about(name);
            if usual[name] != *value && !value.is_object() {
                let _ = write!(about, "; usually {}", usual[name]);
            }
            for line in wrapped(&(about + "."), 100) {
                let _ = writeln!(text, "    // {line}");
            }
            let Some(list) = value.as_object() else {
                let _ = writeln!(text, "    {name}: {value},");
                continue;
            };
            let _ = writeln!(text, "    {name}: (");
            for (entry, value) in list {
                let written = format!("{entry}: {},", spaced(value));
                let about = about_entry(name, entry);
                let _ = writeln!(text, "        {written:<36} // {about}");
            }
            text += "    ),\n";
        }
        text + ")\n"
    }
}

/// Names and values, which JSON and RON write alike.
fn fields(of: &impl Serialize) -> Map<String, Value> {
    serde_json::to_value(of).ok().and_then(|of| of.as_object().cloned()).unwrap_or_default()
}

/// A value as it is written in one line.
fn spaced(value: &Value) -> String {
    let Some(list) = value.as_array() else { return value.to_string() };
    format!("[{}]", list.iter().map(Value::to_string).collect::<Vec<_>>().join(", "))
}

/// What a setting does, and what it may be.
fn about(name: &str) -> String {
    match name {
        "colours" => format!(
            "Colours by role: {}. Those of the 16 by name count where a terminal has no more. Behind each \
             stands what auto is: of the 256 on a dark and on a light ground, and of the 16",
            Colour::allowed()
        ),
        "keys" => {
            "Keys that count on every screen: one, or a list. Those of single panes stay".into()
        }
        _ => {
            let (about, _, allowed) = setting(name).unwrap_or_default();
            format!("{about}: {allowed}")
        }
    }
}

/// What has a colour and what it is without a wish, or what a key does.
fn about_entry(list: &str, name: &str) -> String {
    if let Some((_, about)) = ROLES.iter().find(|(role, _)| list == "colours" && *role == name) {
        let [dark, light, few] = [DARK, LIGHT, FEW].map(|theme| fields(&theme)[name].to_string());
        let few = few.replace("\"auto\"", "none");
        return format!("{about}: {dark}, {light}, {few}");
    }
    named(name).map_or(String::new(), |key| key.help.to_owned())
}

/// What a setting does, what is wrong with a value of the wrong kind, and what it may be.
fn setting(path: &str) -> Option<(&'static str, &'static str, String)> {
    let known = "is not known here";
    let flag = |about| (about, "is neither true nor false", "true or false".to_owned());
    Some(match path {
        "color" => ("How many colours", known, word::all::<ColorFlag>()),
        "ground" => {
            let about = "Whether your terminal is dark or light, for 256 colours; auto: by COLORFGBG, \
                         else dark";
            (about, known, word::all::<Ground>())
        }
        "symbols" => {
            let about = "How the mesh and the curves are drawn; auto: by the terminal";
            (about, known, format!("\"auto\", {}", word::all::<Symbols>()))
        }
        "heat" => {
            let about = "Which colours stand for force and pressure, of 256";
            (about, known, word::all::<HeatMap>())
        }
        "fps" => {
            let wrong = "is not a whole number in range";
            ("Most frames a second of a replay", wrong, "whole numbers 1 to 60".to_owned())
        }
        "mouse" => flag("Whether the mouse is listened to"),
        "idle" => flag("Whether mesh errors and bands are computed while you do nothing"),
        "start" => {
            let about = "The screen that is shown first; last: where you left off, with what you \
                         worked on";
            let all = std::iter::once(LAST.to_owned()).chain(titles());
            (about, known, all.map(|title| format!("{title:?}")).collect::<Vec<_>>().join(", "))
        }
        path if path.starts_with("colours.") => ("", "is no such colour", Colour::allowed()),
        path if path.starts_with("keys.") => {
            ("", "is no key in quotes", "a key or a list of keys, as in \"Ctrl-X\"".to_owned())
        }
        _ => return None,
    })
}

fn expected(path: &str) -> Option<(&'static str, String)> {
    setting(path).map(|(_, wrong, allowed)| (wrong, allowed))
}

fn titles() -> impl Iterator<Item = String> {
    SCREENS.iter().map(|screen| screen.title.to_lowercase())
}

/// A choice by the word that a flag has for it, or none by the word `auto`.
mod word {
    use clap::ValueEnum;
    use serde::de::{Error, Unexpected};
    use serde::{Deserialize, Deserializer, Serializer};

    /// All that may be chosen, in quotes.
    pub fn all<T: ValueEnum>() -> String {
        let words = T::value_variants().iter().map(|of| format!("{:?}", name(of)));
        words.collect::<Vec<_>>().join(", ")
    }

    pub fn name<T: ValueEnum>(value: &T) -> String {
        value.to_possible_value().map_or(String::new(), |word| word.get_name().to_owned())
    }

    pub fn read<T: ValueEnum, E: Error>(word: &str) -> Result<T, E> {
        let unknown = |_| E::invalid_value(Unexpected::Str(word), &"a word of the list");
        T::from_str(word, false).map_err(unknown)
    }

    pub fn serialize<T: ValueEnum, S: Serializer>(value: &T, to: S) -> Result<S::Ok, S::Error> {
        to.serialize_str(&name(value))
    }

    pub fn deserialize<'de, T: ValueEnum, D: Deserializer<'de>>(from: D) -> Result<T, D::Error> {
        read(&String::deserialize(from)?)
    }

    #[expect(clippy::ref_option, reason = "serde calls it so")]
    pub fn or_auto<T: ValueEnum, S: Serializer>(of: &Option<T>, to: S) -> Result<S::Ok, S::Error> {
        let word = of.as_ref().map(name);
        to.serialize_str(word.as_deref().unwrap_or("auto"))
    }

    pub fn read_or_auto<'de, T: ValueEnum, D: Deserializer<'de>>(
        from: D,
    ) -> Result<Option<T>, D::Error> {
        let word = String::deserialize(from)?;
        if word == "auto" { Ok(None) } else { read(&word).map(Some) }
    }
}

/// Where the file is looked for, if there is a home for it.
pub fn path() -> Option<PathBuf> {
    Some(library::home()?.join("config.ron"))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn complaint(text: &str) -> String {
        Config::read(text, "config.ron").unwrap_err().to_string()
    }

    #[test]
    fn what_is_printed_reads_back_as_it_was() {
        let own = "(color: \"256\", symbols: \"ascii\", fps: 30, mouse: true, idle: false, start: \"map\",\n\
                   ground: \"light\", colours: (heading: 21, fat: \"bright red\", bar: \"auto\"),\n\
                   keys: (save: \"W\", undo: [\"Ctrl-X\", \"F12\"], redraw: []))";
        for text in ["", "()", " // nothing\n", own] {
            let config = Config::read(text, "").unwrap();
            let printed = config.to_ron();
            assert_eq!(Config::read(&printed, "").unwrap(), config, "{printed}");
        }
        let config = Config::read(own, "").unwrap();
        assert_eq!((config.fps, config.first_screen(), config.idle), (30, Some(6), false));
        assert!(config.to_ron().contains("1 to 60; usually 12."));
    }

    #[test]
    fn what_is_refused_is_told_with_place_value_and_range() {
        let depths = "not known here: allowed \"auto\", \"never\", \"16\", \"256\"";
        let number = "not a whole number in range: allowed whole numbers 1 to 60";
        let screens = "not known here: allowed \"last\", \"main\", \"replay\", \"forces\", \"compare\", \
                       \"accuracy\", \"doubt\", \"map\", \"injury\"";
        for (written, at, told) in [
            ("color: \"blue\"", 9, depths),
            ("fps: 99", 7, "out of range: allowed whole numbers 1 to 60"),
            ("fps: 300", 7, number),
            ("mouse: 1", 9, "neither true nor false: allowed true or false"),
            ("start: \"nowhere\"", 9, screens),
        ] {
            let told = format!("config.ron:2:{at}: {written} is {told}");
            assert_eq!(complaint(&format!("(\n {written},\n)")), told);
        }
        let complaint = complaint("(start: \"nowhere\", fps: 0)");
        assert_eq!(complaint.lines().count(), 2, "{complaint}");
    }

    #[test]
    fn colours_are_chosen_by_the_name_of_their_role() {
        let config = Config::read("(colours: (heading: 21, fat: \"bright red\"))", "").unwrap();
        let own = config.colours;
        assert_eq!([own.heading.0, own.fat.0, own.bar.0], [Some(21), Some(9), None]);
        let printed = config.to_ron();
        for line in ["heading: 21,", "fat: \"bright red\",", "bar: \"auto\","] {
            assert!(printed.contains(line), "{printed}");
        }
        let allowed = "allowed \"auto\", whole numbers 0 to 255, or one of \"black\", \"red\", ";
        for (written, at) in [("heading: 256", 12), ("fat: \"mauve\"", 8), ("bar: true", 8)] {
            let told = complaint(&format!("(\n colours: (\n  {written},\n ),\n)"));
            let why = format!("colours.{written} is no such colour: {allowed}");
            assert!(told.starts_with(&format!("config.ron:3:{at}: {why}")), "{told}");
        }
        let told = complaint("(colours: (hedding: 1))");
        assert!(told.contains("colours.hedding: there is no such field; did you mean heading?"));
    }

    #[test]
    fn names_that_are_not_there_and_values_given_twice_are_refused() {
        assert_eq!(
            complaint("(colour: \"auto\")"),
            "config.ron:1:2: colour: there is no such field; did you mean colours or color? \
             (allowed: color, ground, symbols, heat, fps, mouse, idle, start, colours, keys)"
        );
        assert!(complaint("(fps: 1, fps: 2)").contains("fps: is given twice"));
        assert!(complaint("(keys: (undoo: \"x\"))").contains(":16: keys.undoo: there is no such"));
        assert!(complaint("(keys: (undo: \"xy\"))").contains(
            ":15: keys.undo: \"xy\" is no key: allowed a key or a list of keys, as in \"Ctrl-X\""
        ));

        assert!(complaint("(fps: 1").contains("config.ron:1:8: expected a comma or a closing"));
        assert_eq!(complaint("7"), "config.ron:1:1: expected `(`, found 7");
    }

    #[test]
    fn keys_that_clash_are_refused_by_name() {
        assert_eq!(
            complaint("(\n keys: (undo: \"p\"),\n)"),
            "config.ron:2:15: keys.undo: \"p\" is taken by `presets` (open a preset): \
             choose another key, or another one for that"
        );
    }
}
