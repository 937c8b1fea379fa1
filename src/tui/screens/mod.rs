//! The screens, one line each: a new one needs a variant, a line in [`SCREENS`] and a module in
//! `view`.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;

use super::keys::Context;
use super::model::Model;

pub mod accuracy;
pub mod compare;
pub mod doubt;
pub mod forces;
pub mod injury;
pub mod main;
pub mod map;
pub mod replay;

/// A screen.
#[derive(Debug, Clone, Copy, PartialEq, Eq, strum::EnumIter)]
pub enum Screen {
    /// Form, eye, traces and score.
    Main,
    /// The eye in full size.
    Replay,
    /// Curves with axes.
    Forces,
    /// Several presets.
    Compare,
    /// Speed against error.
    Accuracy,
    /// What is not known of the inputs.
    Doubt,
    /// Damage over two inputs.
    Map,
    /// Published injury curves.
    Injury,
}

/// What there is to know of a screen.
pub struct Listed {
    /// Which.
    pub screen: Screen,
    /// Its number key.
    pub key: char,
    /// Its name.
    pub title: &'static str,
    /// Draws it into the space between title and footer.
    pub draw: fn(&Model, Rect, &mut Buffer),
    /// What Tab moves between, each with the keys that it takes; at least one.
    pub panes: &'static [(&'static str, Context)],
}

/// Every screen, in the order of its key.
pub static SCREENS: &[Listed] = &[
    Listed {
        screen: Screen::Main,
        key: '1',
        title: "Main",
        draw: main::view::draw,
        panes: &[("form", Context::Form), ("dial", Context::Dial)],
    },
    Listed {
        screen: Screen::Replay,
        key: '2',
        title: "Replay",
        draw: replay::draw,
        panes: &[("replay", Context::Replay)],
    },
    Listed {
        screen: Screen::Forces,
        key: '3',
        title: "Forces",
        draw: forces::draw,
        panes: &[("forces", Context::Forces)],
    },
    Listed {
        screen: Screen::Compare,
        key: '4',
        title: "Compare",
        draw: compare::view::draw,
        panes: &[
            ("presets", Context::Marks),
            ("table", Context::Table),
            ("replays", Context::Replays),
        ],
    },
    Listed {
        screen: Screen::Accuracy,
        key: '5',
        title: "Accuracy",
        draw: accuracy::view::draw,
        panes: &[("points", Context::Accuracy)],
    },
    Listed {
        screen: Screen::Doubt,
        key: '6',
        title: "Doubt",
        draw: doubt::view::draw,
        panes: &[("outputs", Context::Doubt)],
    },
    Listed {
        screen: Screen::Map,
        key: '7',
        title: "Map",
        draw: map::view::draw,
        panes: &[("map", Context::Map)],
    },
    Listed {
        screen: Screen::Injury,
        key: '8',
        title: "Injury",
        draw: injury::draw,
        panes: &[("curves", Context::Injury)],
    },
];

impl Screen {
    /// Its line.
    pub fn listed(self) -> &'static Listed {
        let found = SCREENS.iter().find(|listed| listed.screen == self);
        found.unwrap_or(&SCREENS[0])
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use strum::IntoEnumIterator;

    #[test]
    fn every_screen_is_listed_once_with_its_number() {
        assert_eq!(SCREENS.len(), Screen::iter().count());
        for (index, screen) in Screen::iter().enumerate() {
            let listed = screen.listed();
            assert_eq!(listed.screen, screen);
            assert_eq!(listed.key.to_digit(10), Some(index as u32 + 1));
            assert!(!listed.panes.is_empty());
        }
    }
}
