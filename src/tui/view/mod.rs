//! What pictures are made of, whichever screen draws them: text, charts, the eye, lists and
//! questions in front. All of it draws with Unicode.

pub mod changing;
pub mod chart;
pub mod eye;
pub mod footer;
pub mod fundus;
pub mod heat;
pub mod overlay;
pub mod palette;
pub mod picker;
pub mod picture;
pub mod popup;
pub mod raster;
pub mod risks;
pub mod sheet;
pub mod text;
pub mod theme;
pub mod threshold;

/// The smallest screen that shows anything but a request for a larger one.
pub const SMALLEST: (u16, u16) = (60, 20);

/// What the program is for, shown on the main screen and in the help.
pub const PURPOSE: &str = "Research and education, not diagnosis";

/// What is left of an area below its first rows.
pub fn below(area: ratatui::layout::Rect, rows: u16) -> ratatui::layout::Rect {
    ratatui::layout::Rect { y: area.y + rows, height: area.height.saturating_sub(rows), ..area }
}
