//! The screens. A new one is a module here and a line in [`SCREENS`]; nothing else in the app asks
//! for a screen by its name.

pub mod accuracy;
pub mod compare;
pub mod doubt;
pub mod forces;
pub mod injury;
pub mod main;
pub mod map;
pub mod replay;
pub mod screen;

use crate::tui::screens::screen::About;

/// Every screen, in the order of its number key; the first is shown first.
pub const SCREENS: &[About] = &[
    main::ABOUT,
    replay::ABOUT,
    forces::ABOUT,
    compare::ABOUT,
    accuracy::ABOUT,
    doubt::ABOUT,
    map::ABOUT,
    injury::ABOUT,
];
