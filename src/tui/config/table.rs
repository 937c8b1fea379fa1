//! Every setting but the keys, whose names stand with the keys themselves.

use std::fmt::Write;

use clap::ValueEnum;

use crate::tui::app::tables::open_to_choice;
use crate::tui::config::Config;
use crate::tui::keys::chosen::Keys;
use crate::tui::keys::press::Press;
use crate::tui::screens::SCREENS;
use crate::tui::terminal::caps::{ColorFlag, Symbols};
use crate::tui::view::heat::HeatMap;
use crate::tui::view::palette::{Ground, Palette, ROLES, SIXTEEN};
use crate::tui::view::text::wrapped;

/// One setting.
pub struct Setting {
    /// What the file calls it.
    pub name: &'static str,
    /// What it does, in a few words.
    pub about: &'static str,
    /// What it may be, and where it is kept.
    pub kind: Kind,
}

/// What a setting holds.
pub enum Kind {
    /// One of these words; read and put by their place.
    Word(fn() -> Vec<String>, Place<usize>),
    /// A whole number from the first to the second.
    Whole(u8, u8, Place<u8>),
    /// Yes or no.
    Toggle(Place<bool>),
}

/// Where a value is kept.
pub struct Place<T> {
    /// Reads it.
    pub get: fn(&Config) -> T,
    /// Puts it.
    pub put: fn(&mut Config, T),
}

/// A place of a field.
macro_rules! at {
    ($field:ident) => {
        Place {
            get: |config| config.$field,
            put: |config, value| config.$field = value,
        }
    };
}

/// Every setting, in the order in which they are printed.
pub static SETTINGS: &[Setting] = &[
    Setting {
        name: "color",
        about: "How many colours",
        kind: Kind::Word(
            words::<ColorFlag>,
            Place {
                get: |config| place(&config.color),
                put: |config, at| config.color = ColorFlag::value_variants()[at],
            },
        ),
    },
    Setting {
        name: "ground",
        about: "Whether your terminal is dark or light, for 256 colours; auto: by COLORFGBG, else dark",
        kind: Kind::Word(
            words::<Ground>,
            Place {
                get: |config| place(&config.ground),
                put: |config, at| config.ground = Ground::value_variants()[at],
            },
        ),
    },
    Setting {
        name: "symbols",
        about: "How the mesh and the curves are drawn; auto: by the terminal",
        kind: Kind::Word(
            || [vec!["auto".to_owned()], words::<Symbols>()].concat(),
            Place {
                get: |config| config.symbols.map_or(0, |symbols| 1 + place(&symbols)),
                put: |config, at| {
                    config.symbols = at.checked_sub(1).map(|at| Symbols::value_variants()[at]);
                },
            },
        ),
    },
    Setting {
        name: "heat",
        about: "Which colours stand for force and pressure, of 256",
        kind: Kind::Word(
            words::<HeatMap>,
            Place {
                get: |config| place(&config.heat),
                put: |config, at| config.heat = HeatMap::value_variants()[at],
            },
        ),
    },
    Setting {
        name: "fps",
        about: "Most frames a second of a replay",
        kind: Kind::Whole(1, 60, at!(fps)),
    },
    Setting {
        name: "mouse",
        about: "Whether the mouse is listened to",
        kind: Kind::Toggle(at!(mouse)),
    },
    Setting {
        name: "idle",
        about: "Whether mesh errors and bands are computed while you do nothing",
        kind: Kind::Toggle(at!(idle)),
    },
    Setting {
        name: "start",
        about: "The screen that is shown first; last: where you left off, with what you worked on",
        kind: Kind::Word(
            || {
                let titles = SCREENS.iter().map(|screen| screen.title.to_lowercase());
                std::iter::once("last".to_owned()).chain(titles).collect()
            },
            Place {
                get: |config| config.start.map_or(0, |screen| 1 + screen),
                put: |config, at| config.start = at.checked_sub(1),
            },
        ),
    },
];

fn words<T: ValueEnum>() -> Vec<String> {
    let values = T::value_variants().iter();
    let words = values.filter_map(ValueEnum::to_possible_value);
    words.map(|word| word.get_name().to_owned()).collect()
}

fn place<T: ValueEnum + PartialEq>(value: &T) -> usize {
    let all = T::value_variants();
    all.iter().position(|known| known == value).unwrap_or(0)
}

impl Setting {
    /// The present value, as a file has it.
    pub fn text(&self, config: &Config) -> String {
        match &self.kind {
            Kind::Word(words, place) => format!("{:?}", words()[(place.get)(config)]),
            Kind::Whole(_, _, place) => (place.get)(config).to_string(),
            Kind::Toggle(place) => (place.get)(config).to_string(),
        }
    }

    /// What it may be, in words.
    pub fn allowed(&self) -> String {
        match &self.kind {
            Kind::Word(words, _) => {
                let quoted: Vec<String> = words().iter().map(|word| format!("{word:?}")).collect();
                quoted.join(", ")
            }
            Kind::Whole(min, max, _) => format!("whole numbers {min} to {max}"),
            Kind::Toggle(_) => "true or false".to_owned(),
        }
    }
}

/// What a colour may be, in words.
pub fn allowed_colours() -> String {
    let names: Vec<String> = SIXTEEN
        .iter()
        .map(|(name, _)| format!("{name:?}"))
        .collect();
    format!(
        "\"{USUAL}\", whole numbers 0 to 255, or one of {}",
        names.join(", ")
    )
}

/// What stands for the colour that a role has without a wish of one's own.
pub const USUAL: &str = "auto";

/// The colours as a file has them, each behind what has it and what it usually is.
pub fn colours_text(own: &Palette) -> String {
    let written = |place: u8| match SIXTEEN.get(usize::from(place)) {
        Some((name, _)) => format!("{name:?}"),
        None => place.to_string(),
    };
    let about = format!(
        "Colours by role: {}. Those of the 16 by name count where a terminal has no more. Behind each stands what \
         auto is: of the 256 on a dark and on a light ground, and of the 16.",
        allowed_colours()
    );
    let about = wrapped(&about, 100);
    let mut text = String::new();
    for line in about {
        // A string takes whatever it is given.
        let _ = writeln!(text, "    // {line}");
    }
    text += "    colours: (\n";
    for part in &ROLES {
        let value = own.own(part.role).map_or(format!("{USUAL:?}"), written);
        let few = part.sixteen.map_or("none".to_owned(), written);
        let entry = format!("{}: {value},", part.name);
        // A string takes whatever it is given.
        let _ = writeln!(
            text,
            "        {entry:<24} // {}: {}, {}, {few}",
            part.about, part.dark, part.light
        );
    }
    text + "    ),\n"
}

/// The keys as a file has them, each behind what it does.
pub fn keys_text(keys: &Keys) -> String {
    let list = |presses: &[Press]| {
        let names: Vec<String> = presses.iter().map(|p| format!("{:?}", p.name())).collect();
        format!("[{}]", names.join(", "))
    };
    let mut text = "    // Keys that count on every screen: one, or a list. Those of single panes stay.\n    keys: (\n"
        .to_owned();
    for binding in open_to_choice() {
        let entry = format!(
            "{}: {},",
            binding.name.to_lowercase(),
            list(keys.of(binding))
        );
        // A string takes whatever it is given.
        let _ = writeln!(text, "        {entry:<40} // {}", binding.help);
    }
    text + "    ),\n"
}
