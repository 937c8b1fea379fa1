//! Which colour plays which role: on dark grounds and on light ones, of 256 and of 16, and a person's own.
//!
//! [`ROLES`] is their one list: the theme reads it, the config file's names are its names, and printing iterates
//! it. Palettes are made by hand. Of the 256 every role has a contrast of 4.5 at least, on black and on the bar, or
//! on a near white and on its bar. The sixteen are those that stay legible on both grounds (bright black and blue
//! do not); a role without one of them is told by bold, dim or reverse.

use clap::ValueEnum;
use ratatui::style::Color;

use crate::tui::terminal::caps::Depth;
use crate::tui::view::heat::HeatMap;

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
    /// Whether it is light. Some terminals say so in `COLORFGBG`, whose last part is the ground's place among the
    /// sixteen colours.
    pub fn is_light(self, env: impl Fn(&str) -> Option<String>) -> bool {
        let told = || {
            let behind = env("COLORFGBG")?.rsplit(';').next()?.parse::<u8>().ok()?;
            Some(behind == 7 || behind > 8)
        };
        match self {
            Self::Auto => told().unwrap_or(false),
            Self::Dark => false,
            Self::Light => true,
        }
    }
}

/// A role that a colour plays, by its place in [`ROLES`].
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Role {
    Quiet,
    Heading,
    Warning,
    Error,
    Bar,
    BarGround,
    Chosen,
    ChosenGround,
    Load,
    Cursor,
    Curve1,
    Curve2,
    Curve3,
    Curve4,
    Curve5,
    Curve6,
    Harmless,
    Mild,
    Serious,
    Grave,
    Interior,
    Lens,
    Shell,
    Retina,
    Fat,
    Orbit,
}

/// What there is to know of a role.
pub struct Part {
    /// Which it is.
    pub role: Role,
    /// What a config file calls it.
    pub name: &'static str,
    /// What has it, in a few words.
    pub about: &'static str,
    /// Its colour of 256 on a dark ground.
    pub dark: u8,
    /// The same on a light one.
    pub light: u8,
    /// Its place among the [`SIXTEEN`]; none where it has no colour there.
    pub sixteen: Option<u8>,
}

const fn part(
    role: Role,
    (name, about): (&'static str, &'static str),
    (dark, light): (u8, u8),
    sixteen: Option<u8>,
) -> Part {
    Part {
        role,
        name,
        about,
        dark,
        light,
        sixteen,
    }
}

/// Every role, in the order in which they are printed.
#[rustfmt::skip]
pub static ROLES: [Part; 26] = [
    part(Role::Quiet, ("quiet", "text of less weight, frames and axes"), (246, 241), None),
    part(Role::Heading, ("heading", "headings"), (80, 24), Some(6)),
    part(Role::Warning, ("warning", "something to beware of"), (221, 94), Some(11)),
    part(Role::Error, ("error", "something wrong"), (203, 160), Some(9)),
    part(Role::Bar, ("bar", "the bars at the top and the bottom"), (252, 236), None),
    part(Role::BarGround, ("bar_ground", "what is behind them"), (236, 253), None),
    part(Role::Chosen, ("chosen", "what is chosen in a bar"), (16, 231), None),
    part(Role::ChosenGround, ("chosen_ground", "what is behind it"), (80, 24), None),
    part(Role::Load, ("load", "the load and its arc"), (84, 22), Some(10)),
    part(Role::Cursor, ("cursor", "the mark of the present moment"), (123, 25), Some(14)),
    part(Role::Curve1, ("curve_1", "the first of several curves"), (80, 24), Some(14)),
    part(Role::Curve2, ("curve_2", "the second"), (221, 94), Some(11)),
    part(Role::Curve3, ("curve_3", "the third"), (176, 127), Some(13)),
    part(Role::Curve4, ("curve_4", "the fourth"), (114, 22), Some(10)),
    part(Role::Curve5, ("curve_5", "the fifth"), (209, 124), Some(9)),
    part(Role::Curve6, ("curve_6", "the sixth"), (254, 238), Some(15)),
    part(Role::Harmless, ("harmless", "the least of index and risk"), (114, 22), Some(10)),
    part(Role::Mild, ("mild", "the step above"), (221, 94), Some(11)),
    part(Role::Serious, ("serious", "the next"), (209, 160), Some(9)),
    part(Role::Grave, ("grave", "the most"), (203, 88), Some(9)),
    part(Role::Interior, ("interior", "what fills the globe"), (243, 242), Some(7)),
    part(Role::Lens, ("lens", "the lens"), (117, 25), Some(14)),
    part(Role::Shell, ("shell", "cornea and sclera"), (252, 238), Some(7)),
    part(Role::Retina, ("retina", "the retina"), (176, 127), Some(13)),
    // Dark yellow is a step of heat already, and brown beside dark red would be one colour.
    part(Role::Fat, ("fat", "the fat behind the eye"), (101, 95), None),
    part(Role::Orbit, ("orbit", "the bone"), (108, 23), Some(2)),
];

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
    light: bool,
    own: [Option<u8>; ROLES.len()],
}

impl Palette {
    /// The same on a light ground, or on a dark one.
    #[must_use]
    pub fn on(self, light: bool) -> Self {
        Self { light, ..self }
    }

    /// The person's own colour of a role, if they have one: its place among the 256.
    pub fn own(&self, role: Role) -> Option<u8> {
        self.own[role as usize]
    }

    /// Gives a role a colour of one's own, or the usual one.
    pub fn choose(&mut self, role: Role, color: Option<u8>) {
        self.own[role as usize] = color;
    }

    /// The colour of a role; none where there are no colours, or none of the sixteen. One's own of the 256 counts
    /// where there are so many.
    pub fn ink(&self, role: Role, depth: Depth) -> Option<Color> {
        let part = &ROLES[role as usize];
        let usual = if self.light { part.light } else { part.dark };
        let place = match depth {
            Depth::Mono => None,
            Depth::Sixteen => self.own(role).filter(|own| *own < 16).or(part.sixteen),
            Depth::TwoFiveSix => Some(self.own(role).unwrap_or(usual)),
        };
        place.map(|place| match SIXTEEN.get(usize::from(place)) {
            Some((_, color)) => *color,
            None => Color::Indexed(place),
        })
    }

    /// The steps of heat from the least on, of what can be told apart on the ground.
    pub fn heat(&self, map: HeatMap, depth: Depth) -> &'static [Color] {
        match (depth, map, self.light) {
            (Depth::Sixteen, ..) => &HOT_16,

            (Depth::Mono, ..) | (_, HeatMap::Hot, false) => &HOT_DARK,
            (_, HeatMap::Hot, true) => &HOT_LIGHT,
            (_, HeatMap::Cividis, false) => &CIVIDIS_DARK,
            (_, HeatMap::Cividis, true) => &CIVIDIS_LIGHT,
        }
    }
}

/// The paper's HOT map from dark red to white.
const HOT_16: [Color; 5] = [
    Color::Red,
    Color::LightRed,
    Color::Yellow,
    Color::LightYellow,
    Color::White,
];
/// Of the same map, what can be read on black.
const HOT_DARK: [Color; 7] = indexed([196, 202, 208, 214, 220, 228, 231]);
/// Of the same map backwards, what can be read on white: the hottest is what stands out most on both grounds.
const HOT_LIGHT: [Color; 5] = indexed([160, 124, 88, 52, 16]);
/// The upper half of cividis (Nunez, Anderton and Renslow 2018, doi:10.1371/journal.pone.0199239): the nearest of
/// the 256 in even steps of lightness.
const CIVIDIS_DARK: [Color; 5] = indexed([243, 246, 144, 185, 227]);
/// The lower half of the same backwards, from grey to its dark blue.
const CIVIDIS_LIGHT: [Color; 4] = indexed([242, 239, 236, 17]);

const fn indexed<const N: usize>(places: [u8; N]) -> [Color; N] {
    let mut colors = [Color::Reset; N];
    let mut i = 0;
    while i < N {
        colors[i] = Color::Indexed(places[i]);
        i += 1;
    }
    colors
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_role_stands_at_its_place_under_a_name_of_its_own() {
        for (place, part) in ROLES.iter().enumerate() {
            assert_eq!(part.role as usize, place, "{}", part.name);
            let same = ROLES.iter().filter(|other| other.name == part.name);
            assert_eq!(same.count(), 1, "{}", part.name);
        }
    }

    #[test]
    fn a_colour_of_ones_own_counts_where_the_terminal_has_it() {
        let mut own = Palette::default();
        own.choose(Role::Heading, Some(200));
        own.choose(Role::Quiet, Some(3));
        let many = |role| own.ink(role, Depth::TwoFiveSix);
        let few = |role| own.ink(role, Depth::Sixteen);
        assert_eq!(many(Role::Heading), Some(Color::Indexed(200)));
        assert_eq!(few(Role::Heading), Some(Color::Cyan));
        assert_eq!(many(Role::Quiet), Some(Color::Yellow));
        assert_eq!(few(Role::Quiet), Some(Color::Yellow));
        assert_eq!(few(Role::Fat), None);
        assert_eq!(own.ink(Role::Quiet, Depth::Mono), None);
    }

    #[test]
    fn the_ground_is_told_or_found_in_the_environment() {
        let by = |ground: Ground, told: &str| {
            ground.is_light(|name| (name == "COLORFGBG").then(|| told.to_owned()))
        };
        for (told, light) in [
            ("0;15", true),
            ("0;default;15", true),
            ("0;7", true),
            ("15;0", false),
            ("12;8", false),
            ("", false),
        ] {
            assert_eq!(by(Ground::Auto, told), light, "{told}");
            assert!(by(Ground::Light, told) && !by(Ground::Dark, told));
        }
    }
}
