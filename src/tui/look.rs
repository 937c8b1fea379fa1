//! Colours and symbols.

use crate::tui::terminal::caps::{Depth, Symbols};
use crate::tui::view::{heat::HeatMap, palette::Palette};

/// How things are drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Look {
    /// How many colours.
    pub depth: Depth,
    /// Which symbols.
    pub symbols: Symbols,
    /// Which colours stand for heat.
    pub heat: HeatMap,
    /// The ground, and colours of the person's own choice.
    pub palette: Palette,
}

#[cfg(test)]
impl Look {
    /// As the app is by itself on a dark ground.
    pub fn new(depth: Depth, symbols: Symbols) -> Self {
        Self { depth, symbols, ..Self::default() }
    }
}
