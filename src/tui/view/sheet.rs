//! What is drawn on: a part of the screen, and how things look there.

use ratatui::buffer::{Buffer, Cell};
use ratatui::layout::Rect;
use ratatui::style::Style;

use crate::plain_text::printable;
use crate::tui::view::text::{fitted, longest_fitting, width, wrapped};
use crate::tui::{look::Look, view::theme::Theme};

/// The cell that lies at a share of so many, from 0 for the first to 1 for the last.
pub fn along(share: f64, cells: u16) -> u16 {
    (share * f64::from(cells - 1)).round() as u16
}

/// A part of the screen.
pub struct Sheet<'a> {
    /// The cells of the whole screen.
    pub buffer: &'a mut Buffer,
    /// Where the part lies.
    pub area: Rect,
    /// How things look.
    pub theme: Theme,
}

impl<'a> Sheet<'a> {
    /// A part of a screen with this look.
    pub fn new(buffer: &'a mut Buffer, area: Rect, look: Look) -> Self {
        Self { buffer, area, theme: Theme::of(look) }
    }

    /// Another part of the screen.
    pub fn at(&mut self, area: Rect) -> Sheet<'_> {
        Sheet { buffer: self.buffer, area, theme: self.theme }
    }

    /// A part of this one: where it begins in it, and how wide and high it is.
    pub fn part(&mut self, (x, y): (u16, u16), (width, height): (u16, u16)) -> Sheet<'_> {
        self.at(Rect::new(self.area.x + x, self.area.y + y, width, height))
    }

    /// A row of this one.
    pub fn row(&mut self, y: u16) -> Sheet<'_> {
        self.part((0, y), (self.area.width, 1))
    }

    /// The part of this place, row by row, of so many columns and rows of one size.
    pub fn tile(&mut self, place: usize, (columns, rows): (u16, u16)) -> Sheet<'_> {
        let (column, row) = (place as u16 % columns, place as u16 / columns);
        let (wide, high) = (self.area.width / columns, self.area.height / rows);
        self.part((column * wide, row * high), (wide, high))
    }

    /// The cell at a column and row.
    pub fn cell(&mut self, (x, y): (u16, u16)) -> &mut Cell {
        &mut self.buffer[(self.area.x + x, self.area.y + y)]
    }

    /// Writes `text` at column and row, cut at the right edge; gives the column after it.
    pub fn put(&mut self, (x, y): (u16, u16), text: impl AsRef<str>, style: Style) -> u16 {
        let area = self.area;
        if y >= area.height || x >= area.width {
            return x;
        }
        let (text, room) = (printable(text.as_ref()), usize::from(area.width - x));
        let (end, _) = self.buffer.set_stringn(area.x + x, area.y + y, text, room, style);
        end - area.x
    }

    /// Writes lines under one another, each beginning at column `x`, the first in row `y`.
    pub fn put_lines<T: AsRef<str>>(
        &mut self,
        (x, y): (u16, u16),
        lines: impl IntoIterator<Item = T>,
        style: Style,
    ) {
        for (y, line) in (y..).zip(lines) {
            self.put((x, y), line, style);
        }
    }

    /// Writes a text in lines between two margins of `x` columns; gives the row below it.
    pub fn put_wrapped(&mut self, (x, y): (u16, u16), text: &str, style: Style) -> u16 {
        let lines = wrapped(text, self.area.width.saturating_sub(2 * x).into());
        self.put_lines((x, y), &lines, style);
        y + lines.len() as u16
    }

    /// Writes the first text that there is room for, or the last one, cut; gives the column after.
    pub fn put_longest<T: AsRef<str>>(
        &mut self,
        (x, y): (u16, u16),
        texts: &[T],
        style: Style,
    ) -> u16 {
        self.put((x, y), longest_fitting(texts, self.area.width.saturating_sub(x)), style)
    }

    /// Writes `text` so that it ends before column `right`.
    pub fn put_right(&mut self, (right, y): (u16, u16), text: impl AsRef<str>, style: Style) {
        let left = right.saturating_sub(width(text.as_ref()));
        self.put((left, y), text, style);
    }

    /// Writes the longest heading that fits into the first row beside the text at its right.
    pub fn put_both(&mut self, left: (&[&str], Style), right: (&str, Style)) {
        let wide = self.area.width;
        let beside = wide.saturating_sub(width(right.0) + 4);
        let end = self.put((1, 0), longest_fitting(left.0, beside), left.1);
        let room = usize::from(wide.saturating_sub(end + 3));
        self.put_right((wide - 1, 0), fitted(right.0, room), right.1);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tui::terminal::caps::{Depth, Symbols};

    #[test]
    fn nothing_is_written_outside_the_area() {
        let mut buffer = Buffer::empty(Rect::new(0, 0, 10, 2));
        let look = Look::new(Depth::Mono, Symbols::Ascii);
        let mut sheet = Sheet::new(&mut buffer, Rect::new(2, 0, 4, 1), look);
        for (at, text, end) in [((0, 0), "abcdefgh", 4), ((0, 1), "below", 0), ((9, 0), "x", 9)] {
            assert_eq!(sheet.put(at, text, Style::new()), end);
        }
        assert_eq!(buffer, Buffer::with_lines(["  abcd    ", "          "]));
    }
}
