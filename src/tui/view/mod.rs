//! What pictures of any screen are made of: text, charts, the eye, lists and questions in front.

use ratatui::layout::Rect;

pub mod chart;
pub mod eye;
pub mod footer;
pub mod fundus;
pub mod heat;
pub mod overlay;
pub mod palette;
pub mod picture;
pub mod raster;
pub mod risks;
pub mod sheet;
pub mod text;
pub mod theme;

/// The smallest screen that shows anything but a request for a larger one.
pub const SMALLEST: (u16, u16) = (60, 20);

/// What the program is for, shown on the main screen and in the help.
pub const PURPOSE: &str = "Research and education, not diagnosis";

/// What is left of an area below its first rows.
pub fn below(area: Rect, rows: u16) -> Rect {
    Rect { y: area.y + rows, height: area.height.saturating_sub(rows), ..area }
}
