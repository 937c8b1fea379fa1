//! Which colour plays which role: a theme for dark grounds, one for light ones and one of 16
//! colours, and a person's own colours over them.
//!
//! The themes are made by hand. Of the 256 every role has a contrast of 4.5 at least, on black and
//! on the bar, or on a near white and on its bar. The sixteen are those that stay legible on both
//! grounds (bright black and blue do not); a role without one of them is told by bold, dim or
//! reverse.

use clap::ValueEnum;
use ratatui::style::Color;
use ron::Value;
use serde::de::{Error, Unexpected};
use serde::{Deserialize, Deserializer, Serialize, Serializer};

use crate::tui::{terminal::caps::Depth, view::heat::HeatMap};

/// What the terminal's ground is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Ground {
    /// By the environment, dark where that does not tell
    Auto,
    /// Light text on a dark ground
    Dark,
    /// Dark text on a light ground
    Light,
}

impl Ground {
    /// Whether it is light: some terminals end `COLORFGBG` with its place among the sixteen.
    pub fn is_light(self, env: impl Fn(&str) -> Option<String>) -> bool {
        match self {
            Self::Auto => env("COLORFGBG")
                .and_then(|told| told.rsplit(';').next()?.parse().ok())
                .is_some_and(|behind: u8| behind == 7 || behind > 8),
            Self::Dark => false,
            Self::Light => true,
        }
    }
}

/// A colour by its place among the 256, first the [`SIXTEEN`]; none is the theme's or terminal's.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Colour(pub Option<u8>);

/// What a file calls a colour that is left to the theme.
const AUTO: &str = "auto";

impl Colour {
    /// The colour as it is drawn.
    pub fn ink(self) -> Option<Color> {
        self.0.map(ink)
    }

    /// What it may be, in words.
    pub fn allowed() -> String {
        let names = SIXTEEN.map(|(name, _)| format!("{name:?}")).join(", ");
        format!("{AUTO:?}, whole numbers 0 to 255, or one of {names}")
    }
}

/// The colour of a place among the 256, by name where it has one.
pub fn ink(place: u8) -> Color {
    SIXTEEN.get(usize::from(place)).map_or(Color::Indexed(place), |(_, color)| *color)
}

impl Serialize for Colour {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self.0 {
            None => serializer.serialize_str(AUTO),
            Some(few @ ..16) => serializer.serialize_str(SIXTEEN[usize::from(few)].0),
            Some(place) => serializer.serialize_u8(place),
        }
    }
}

impl<'de> Deserialize<'de> for Colour {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let place = match Value::deserialize(deserializer)? {
            Value::String(word) if word == AUTO => return Ok(Self(None)),
            Value::String(word) => SIXTEEN.iter().position(|(name, _)| *name == word),
            Value::Number(number) => (0..256).find(|place| *place as f64 == number.into_f64()),
            _ => None,
        };
        let unknown = || D::Error::invalid_value(Unexpected::Other("value"), &"a colour");
        Ok(Self(Some(place.ok_or_else(unknown)? as u8)))
    }
}

/// Makes a struct of the roles, its three themes and a list of what has each.
macro_rules! roles {
    ($($role:ident: $dark:literal, $light:literal, $sixteen:expr, $about:literal;)*) => {
        /// A colour for every role.
        #[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
        #[serde(default, deny_unknown_fields)]
        pub struct Colours {
            $(#[doc = $about] pub $role: Colour,)*
        }

        /// On a dark ground, of 256.
        pub const DARK: Colours = Colours { $($role: Colour(Some($dark)),)* };
        /// On a light ground, of 256.
        pub const LIGHT: Colours = Colours { $($role: Colour(Some($light)),)* };
        /// On either, of 16.
        pub const FEW: Colours = Colours { $($role: Colour($sixteen),)* };

        /// What a config file calls each role, and what has it.
        pub const ROLES: &[(&str, &str)] = &[$((stringify!($role), $about),)*];

        impl Colours {
            /// These where they are chosen and `counts`, else those of a theme.
            #[must_use]
            fn over(&self, theme: &Self, counts: impl Fn(u8) -> bool) -> Self {
                Self {
                    $($role: Colour(self.$role.0.filter(|place| counts(*place)).or(theme.$role.0)),)*
                }
            }
        }
    };
}

roles! {
    quiet: 246, 241, None, "text of less weight, frames and axes";
    heading: 110, 24, Some(6), "headings, and bars that are no risk";
    warning: 141, 91, Some(13), "something to beware of";
    error: 177, 127, Some(13), "something wrong";
    bar: 252, 236, None, "the bars at the top and the bottom";
    bar_ground: 236, 253, None, "what is behind them";
    chosen: 16, 231, None, "what is chosen in a bar";
    chosen_ground: 110, 24, None, "what is behind it";
    load: 250, 238, None, "the load and its arc";
    cursor: 255, 232, None, "the mark of the present moment";
    curve_1: 80, 23, Some(14), "the first of several curves";
    curve_2: 254, 16, Some(15), "the second";
    curve_3: 69, 26, Some(12), "the third";
    curve_4: 180, 89, Some(5), "the fourth";
    curve_5: 175, 61, Some(7), "the fifth";
    curve_6: 245, 241, Some(6), "the sixth";
    harmless: 114, 22, Some(10), "a risk that is not expected";
    mild: 221, 94, Some(11), "one that cannot be excluded";
    serious: 208, 160, Some(3), "one that is possible";
    grave: 203, 88, Some(9), "one that is likely or almost certain";
    interior: 243, 242, None, "what fills the globe";
    lens: 152, 24, Some(7), "the lens";
    shell: 252, 238, Some(7), "cornea and sclera as lines";
    retina: 174, 125, Some(5), "the retina";
    fat: 101, 95, None, "the fat behind the eye";
    orbit: 137, 94, Some(3), "the bone as a line";
    cornea: 123, 44, Some(14), "the cornea";
    sclera: 255, 254, Some(15), "the sclera";
    pressed: 206, 163, Some(13), "where the object presses";
    iris: 75, 26, Some(12), "the iris";
    ciliary: 96, 96, Some(5), "the ciliary body";
    nerve: 186, 143, Some(7), "the optic nerve";
    bone: 95, 137, Some(3), "the bone";
    fat_ground: 235, 223, None, "what is behind the fat";
    object: 247, 248, Some(7), "what hits the eye";
    skin: 59, 242, Some(8), "its outline";
}

/// The sixteen colours that every colour terminal has, in its order, by name.
pub const SIXTEEN: [(&str, Color); 16] = [
    ("black", Color::Black),
    ("red", Color::Red),
    ("green", Color::Green),
    ("yellow", Color::Yellow),
    ("blue", Color::Blue),
    ("magenta", Color::Magenta),
    ("cyan", Color::Cyan),
    ("white", Color::Gray),
    ("bright black", Color::DarkGray),
    ("bright red", Color::LightRed),
    ("bright green", Color::LightGreen),
    ("bright yellow", Color::LightYellow),
    ("bright blue", Color::LightBlue),
    ("bright magenta", Color::LightMagenta),
    ("bright cyan", Color::LightCyan),
    ("bright white", Color::White),
];

/// The ground, and the colours of a person's own choice.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Palette {
    /// Whether the ground is light.
    pub light: bool,
    /// What the person chose.
    pub own: Colours,
}

impl Palette {
    /// The colour of every role; none where there are no colours, or none of the sixteen. One's
    /// own of the 256 counts where there are so many.
    pub fn colours(&self, depth: Depth) -> Colours {
        match depth {
            Depth::Mono => Colours::default(),
            Depth::Sixteen => self.own.over(&FEW, |place| place < 16),
            Depth::TwoFiveSix if self.light => self.own.over(&LIGHT, |_| true),
            Depth::TwoFiveSix => self.own.over(&DARK, |_| true),
        }
    }

    /// The steps of heat from the least on, of what can be told apart on the ground.
    pub fn heat(&self, map: HeatMap, depth: Depth) -> &'static [u8] {
        match (depth, map, self.light) {
            (Depth::Sixteen, ..) => &HOT_16,
            (Depth::Mono, ..) | (_, HeatMap::Hot, false) => &HOT_DARK,
            (_, HeatMap::Hot, true) => &HOT_LIGHT,
            (_, HeatMap::Cividis, false) => &CIVIDIS_DARK,
            (_, HeatMap::Cividis, true) => &CIVIDIS_LIGHT,
        }
    }
}

/// What fills the globe, from low to high: not red, orange or white as anatomy and object are.
pub const FIELD: [u8; 11] = [53, 54, 60, 24, 31, 30, 36, 72, 78, 113, 191];
/// The same where there are sixteen colours: black, blue, cyan, green and bright green.
pub const FIELD_16: [u8; 5] = [0, 4, 6, 2, 10];

/// The paper's HOT map: red, bright red, yellow, bright yellow and bright white.
const HOT_16: [u8; 5] = [1, 9, 3, 11, 15];
/// Of the same map, what can be read on black.
const HOT_DARK: [u8; 7] = [196, 202, 208, 214, 220, 228, 231];
/// Of the same map backwards, what can be read on white: on both the hottest stands out most.
const HOT_LIGHT: [u8; 5] = [160, 124, 88, 52, 16];
/// The upper half of cividis (Nunez, Anderton and Renslow 2018, doi:10.1371/journal.pone.0199239):
/// the nearest of the 256 in even steps of lightness.
const CIVIDIS_DARK: [u8; 5] = [243, 246, 144, 185, 227];
/// The lower half of the same backwards, from grey to its dark blue.
const CIVIDIS_LIGHT: [u8; 4] = [242, 239, 236, 17];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_colour_of_ones_own_counts_where_the_terminal_has_it() {
        let (heading, quiet) = (Colour(Some(200)), Colour(Some(3)));
        let own = Colours { quiet, heading, ..Colours::default() };
        let own = Palette { own, ..Palette::default() };
        let (many, few) = (own.colours(Depth::TwoFiveSix), own.colours(Depth::Sixteen));
        let inks = |of: Colours| [of.heading, of.quiet, of.fat].map(Colour::ink);
        let yellow = Some(Color::Yellow);
        assert_eq!(inks(many), [Some(Color::Indexed(200)), yellow, Some(Color::Indexed(101))]);
        assert_eq!(inks(few), [Some(Color::Cyan), yellow, None]);
        assert_eq!(inks(own.colours(Depth::Mono)), [None; 3]);
    }

    #[test]
    fn the_ground_is_told_or_found_in_the_environment() {
        let by = |ground: Ground, told: &str| {
            ground.is_light(|name| (name == "COLORFGBG").then(|| told.to_owned()))
        };
        for told in ["0;15", "0;default;15", "0;7", "15;0", "12;8", ""] {
            assert_eq!(by(Ground::Auto, told), told.starts_with("0;"), "{told}");
            assert!(by(Ground::Light, told) && !by(Ground::Dark, told));
        }
    }
}
