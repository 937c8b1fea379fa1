//! Which part of the section a picture shows: through a run the same, so that it does not move.

use nalgebra::Point2;
use ratatui::layout::Rect;

use crate::report::picture::front::REACH_M;
use crate::run::drawing::Drawing;
use crate::tui::terminal::caps::Symbols;

/// A picture with fewer mm a column than this shows all; else the globe with little around.
const WHOLE_M: f64 = 1.25e-3;
const GLOBE_M: (f64, f64) = (29e-3, 26e-3);
const NEAR_M: f64 = 1.1e-3;

/// From metres to cells.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Window {
    left: f64,
    top: f64,
    /// Width of a column, in m; a row is twice as high.
    pub column: f64,
    symbols: Symbols,
}

/// Rows from which on there is room for words above and below.
const WORDED: u16 = 7;

impl Window {
    /// The window of a picture with its words, and where it lies between them.
    pub fn within(area: Rect, drawing: &Drawing, symbols: Symbols) -> (Self, Rect) {
        let field = Self::field(area);
        let (columns, rows) = (f64::from(field.width.max(1)), f64::from(field.height.max(1)));
        let (low, high) = drawing.extent();
        let way = drawing.object.map_or(1.0, |object| object.direction.x);
        let fits = |wide: f64, tall: f64| (wide / columns).max(tall / (2.0 * rows));
        let (wide, tall) = (high.x - low.x, high.y - low.y);
        let whole = fits(wide, tall);
        let (column, middle) = if whole < WHOLE_M {
            (whole, 0.5 * (low.y + high.y))
        } else {
            (fits(GLOBE_M.0, GLOBE_M.1).max((0.8 * whole).min(NEAR_M)), 0.0)
        };
        // What is left over is room for the object; where room lacks, the back of the orbit goes.
        let spare = column * columns - wide;
        let beyond = match way {
            ..0.5 => 0.5 * spare,
            _ => 0.75 * spare.min(0.0),
        };
        let left = high.x + beyond - column * columns;
        (Self { left, top: middle + column * rows, column, symbols }, field)
    }

    /// The window of a picture from the front, and where it lies between its words.
    pub fn facing(area: Rect, symbols: Symbols) -> (Self, Rect) {
        let field = Self::field(area);
        let (columns, rows) = (f64::from(field.width.max(1)), f64::from(field.height.max(1)));
        let column = (2.0 * REACH_M / columns).max(REACH_M / rows);
        (Self { left: -0.5 * column * columns, top: column * rows, column, symbols }, field)
    }

    fn field(area: Rect) -> Rect {
        let worded = u16::from(area.height >= WORDED);
        Rect { y: area.y + worded, height: area.height - 2 * worded, ..area }
    }

    /// Where a place lies, in cells.
    pub fn cell(&self, at: Point2<f64>) -> (f64, f64) {
        ((at.x - self.left) / self.column, (self.top - at.y) / (2.0 * self.column))
    }

    /// The place at a point of the cells.
    pub fn place(&self, (x, y): (f64, f64)) -> Point2<f64> {
        Point2::new(self.left + x * self.column, self.top - 2.0 * y * self.column)
    }

    /// Points across and down a cell.
    pub fn points(&self) -> (usize, usize) {
        match self.symbols {
            Symbols::Ascii => (1, 1),
            Symbols::Braille | Symbols::Block => (2, 2),
            Symbols::Octant => (2, 4),
        }
    }

    /// The smallest thing that shows, in m.
    pub fn grain(&self) -> f64 {
        let (across, down) = self.points();
        self.column * (2.0 / (across * down) as f64).sqrt()
    }
}
