//! What a person wants of the app at every start: `contrecoup/config.ron` under `$XDG_CONFIG_HOME` (or
//! `~/.config`). A flag counts for more than the file.
//!
//! [`SETTINGS`](table::SETTINGS) holds every setting with its words, its bounds and its place; reading, refusing
//! and printing iterate it. An empty file sets nothing, so that `contrecoup config` may be sent into the file
//! that it reads.

mod read;
mod table;

use std::fmt::Write;
use std::path::{Path, PathBuf};

use crate::scenario::library;
use crate::scenario::load::read_text;
use crate::scenario::problem::ScenarioError;
use crate::tui::keys::chosen::Keys;
use crate::tui::terminal::caps::{ColorFlag, Symbols};
use crate::tui::view::heat::HeatMap;
use crate::tui::view::palette::{Ground, Palette};
use table::SETTINGS;

/// What a person wants of the app.
#[derive(Debug, Clone, PartialEq)]
pub struct Config {
    /// How many colours.
    pub color: ColorFlag,
    /// Which symbols; `None` by the terminal.
    pub symbols: Option<Symbols>,
    /// Whether the terminal's ground is dark or light.
    pub ground: Ground,
    /// Which colours stand for heat.
    pub heat: HeatMap,
    /// Most frames a second of a replay.
    pub fps: u8,
    /// Whether the mouse is listened to.
    pub mouse: bool,
    /// Whether bands and mesh errors are computed while nothing else is wanted.
    pub idle: bool,
    /// The place of the screen that is shown first; none where the app was left.
    pub start: Option<usize>,
    /// Colours of one's own.
    pub colours: Palette,
    /// Keys of one's own.
    pub keys: Keys,
}

impl Default for Config {
    fn default() -> Self {
        Self {
            color: ColorFlag::Auto,
            symbols: None,
            ground: Ground::Auto,
            heat: HeatMap::Hot,
            fps: 12,
            mouse: false,
            idle: true,
            start: None,
            colours: Palette::default(),
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
    /// Says every setting that is refused, each with its line and column.
    pub fn read(text: &str, origin: &str) -> Result<Self, ScenarioError> {
        read::read(text).map_err(|error| error.of(origin))
    }

    /// As a file that reads back as this, each setting below what it does and what it may be.
    pub fn to_ron(&self) -> String {
        let mut text = "(\n".to_owned();
        let default = Self::default();
        for setting in SETTINGS {
            let usual = setting.text(&default);
            let other = (setting.text(self) != usual).then(|| format!("; usually {usual}"));
            let (about, other) = (setting.about, other.unwrap_or_default());
            // A string takes whatever it is given.
            let _ = writeln!(text, "    // {about}: {}{other}.", setting.allowed());
            let _ = writeln!(text, "    {}: {},", setting.name, setting.text(self));
        }
        text + &table::colours_text(&self.colours) + &table::keys_text(&self.keys) + ")\n"
    }
}

/// Where the file is looked for, if there is a home for it.
pub fn path() -> Option<PathBuf> {
    Some(library::home()?.join("config.ron"))
}

/// Whether there is such a file.
pub fn is_there(path: &Path) -> bool {
    path.symlink_metadata().is_ok_and(|m| m.len() > 0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tui::view::palette::Role;

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
        assert_eq!(
            (config.fps, config.start, config.idle),
            (30, Some(6), false)
        );
        assert!(config.to_ron().contains("1 to 60; usually 12."));
    }

    #[test]
    fn every_default_may_be_written_out() {
        let default = Config::default();
        for setting in SETTINGS {
            let text = format!("({}: {})", setting.name, setting.text(&default));
            assert_eq!(Config::read(&text, "").unwrap(), default, "{text}");
        }
    }

    #[test]
    fn what_is_refused_is_told_with_place_value_and_range() {
        let text = "(\n color: \"blue\",\n fps: 99,\n mouse: 1,\n start: \"nowhere\",\n)";
        let complaint = complaint(text);
        let lines: Vec<_> = complaint.lines().collect();
        assert_eq!(
            lines,
            [
                "config.ron:2:9: color: \"blue\" is not known here: allowed \"auto\", \"never\", \"16\", \"256\"",
                "config.ron:3:7: fps: 99 is out of range: allowed whole numbers 1 to 60",
                "config.ron:4:9: mouse: 1 is neither true nor false: allowed true or false",
                "config.ron:5:9: start: \"nowhere\" is not known here: allowed \"last\", \"main\", \"replay\", \
                 \"forces\", \"compare\", \"accuracy\", \"doubt\", \"map\", \"injury\"",
            ]
        );
    }

    #[test]
    fn colours_are_chosen_by_the_name_of_their_role() {
        let config = Config::read("(colours: (heading: 21, fat: \"bright red\"))", "").unwrap();
        let own = |role| config.colours.own(role);
        assert_eq!(
            (own(Role::Heading), own(Role::Fat), own(Role::Bar)),
            (Some(21), Some(9), None)
        );
        let printed = config.to_ron();
        assert!(printed.contains("heading: 21,"), "{printed}");
        assert!(printed.contains("fat: \"bright red\","), "{printed}");
        assert!(printed.contains("bar: \"auto\","), "{printed}");
        let complaint = complaint(
            "(\n colours: (\n  heading: 256,\n  fat: \"mauve\",\n  hedding: 1,\n  bar: true,\n ),\n)",
        );
        let allowed = "allowed \"auto\", whole numbers 0 to 255, or one of \"black\", \"red\", ";
        let lines: Vec<_> = complaint.lines().collect();
        for (line, begins) in lines.iter().zip([
            "config.ron:3:12: colours.heading: 256 is no such colour: ",
            "config.ron:4:8: colours.fat: \"mauve\" is no such colour: ",
            "config.ron:5:12: colours.hedding: there is no such role; did you mean heading?",
            "config.ron:6:8: colours.bar: true is no such colour: ",
        ]) {
            assert!(line.starts_with(begins), "{line}");
            assert!(line.contains(allowed) || line.contains("role"), "{line}");
        }
        assert_eq!(lines.len(), 4);
    }

    #[test]
    fn names_that_are_not_there_and_values_given_twice_are_refused() {
        assert_eq!(
            complaint("(colour: \"auto\")"),
            "config.ron:1:10: colour: there is no such setting; did you mean colours or color? \
             (allowed: color, ground, symbols, heat, fps, mouse, idle, start, colours, keys)"
        );
        assert!(complaint("(fps: 1, fps: 2)").contains("fps: is given twice"));
        assert!(complaint("(keys: (undoo: \"x\"))").contains(":16: keys.undoo: there is no such"));
        assert!(complaint("(keys: (undo: \"xy\"))").contains(
            ":15: keys.undo: \"xy\" is no key: allowed a key or a list of keys, as in \"Ctrl-X\""
        ));

        assert!(complaint("(fps: 1").contains("config.ron:1:8: expected a comma or a closing"));
        assert_eq!(complaint("7"), "config.ron:1:1: expected `(`");
    }

    #[test]
    fn keys_that_clash_are_refused_by_name() {
        assert_eq!(
            complaint("(\n keys: (undo: \"s\"),\n)"),
            "config.ron:2:15: keys.undo: \"s\" is taken by `save` (save as a preset of your own): \
             choose another key, or another one for that"
        );
    }
}
