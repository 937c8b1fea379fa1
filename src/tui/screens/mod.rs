//! The screens. A new one is a module here, a line in [`SCREENS`] and, if it keeps anything, a field
//! of [`Screens`]; nothing else in the app asks for a screen by its name.

pub mod accuracy;
pub mod compare;
pub mod doubt;
pub mod forces;
pub mod injury;
pub mod main;
pub mod map;
pub mod replay;
mod screen;

pub use crate::tui::screens::screen::{Mouse, Pane, Screen};

/// Every screen, in the order of its number key; the first is shown first.
pub const SCREENS: &[Screen] = &[
    main::SCREEN,
    replay::SCREEN,
    forces::SCREEN,
    compare::SCREEN,
    accuracy::SCREEN,
    doubt::SCREEN,
    map::SCREEN,
    injury::SCREEN,
];

/// What the screens keep to themselves.
#[derive(Default)]
pub struct Screens {
    /// What the force profiles show.
    pub forces: forces::Forces,
    /// The presets side by side.
    pub compare: compare::comparison::Comparison,
    /// Speed against error.
    pub accuracy: accuracy::measurement::Measurement,
    /// The result whose band is explained.
    pub doubt: usize,
    /// A result over two inputs.
    pub map: map::state::Map,
    /// The injury curve that is explained.
    pub injury: usize,
}
