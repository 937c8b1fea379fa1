//! Dots and lines in characters: braille, blocks or plain ASCII.
//!
//! A cell has one colour, so each dot carries a rank and the highest rank in a cell gives its
//! style: a hot spring is never hidden by a cold one that happens to be drawn later.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::Style;
use ratatui::symbols::{braille::BRAILLE, pixel::QUADRANTS};

use crate::tui::terminal::caps::Symbols;

/// How a dot looks.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ink {
    /// Colour and weight of its cell.
    pub style: Style,
    /// Wins over lower ranks.
    pub rank: u8,
    /// What ASCII shows.
    pub glyph: char,
    /// Draws every such dot of a line; 1 is solid.
    pub every: u8,
}

impl Ink {
    /// A solid line.
    pub fn solid(style: Style, rank: u8, glyph: char) -> Self {
        Self { style, rank, glyph, every: 1 }
    }

    /// This ink for a line that sets every `every`-th dot only.
    #[must_use]
    pub fn dotted(self, every: u8) -> Self {
        Self { every, ..self }
    }
}

/// A field of dots over an area of cells.
pub struct Raster {
    area: Rect,
    symbols: Symbols,
    /// The dots of each cell, bit by bit from the upper left along the rows, and their ink.
    spots: Vec<Option<(u8, Ink)>>,
}

impl Raster {
    /// An empty field over `area`.
    pub fn new(area: Rect, symbols: Symbols) -> Self {
        Self { area, symbols, spots: vec![None; area.area() as usize] }
    }

    /// Dots across and down a cell.
    pub fn grain(&self) -> (i32, i32) {
        match self.symbols {
            Symbols::Braille | Symbols::Octant => (2, 4),
            Symbols::Block => (2, 2),
            Symbols::Ascii => (1, 1),
        }
    }

    /// Width and height in dots.
    pub fn size(&self) -> (i32, i32) {
        let (across, down) = self.grain();
        (across * i32::from(self.area.width), down * i32::from(self.area.height))
    }

    /// The cell of the buffer that holds a dot.
    pub fn cell(&self, (x, y): (f64, f64)) -> Option<(u16, u16)> {
        let (width, height) = self.size();
        let inside = x >= 0.0 && y >= 0.0 && x < f64::from(width) && y < f64::from(height);
        let (across, down) = self.grain();
        let (column, row) = (x as i32 / across, y as i32 / down);
        inside.then_some((self.area.x + column as u16, self.area.y + row as u16))
    }

    /// Sets a dot; outside the area nothing happens.
    pub fn dot(&mut self, x: i32, y: i32, ink: Ink) {
        let (width, height) = self.size();
        if x < 0 || y < 0 || x >= width || y >= height {
            return;
        }
        let (across, down) = self.grain();
        let index = y / down * i32::from(self.area.width) + x / across;
        let (bits, kept) = self.spots[index as usize].get_or_insert((0, ink));
        *bits |= 1 << (y % down * across + x % across);
        if kept.rank <= ink.rank {
            *kept = ink;
        }
    }

    /// Draws a line between two points in dots.
    pub fn line(&mut self, from: (f64, f64), to: (f64, f64), ink: Ink) {
        let (width, height) = self.size();
        let reach = f64::from(width + height) * 2.0;
        let sane = |v: f64| v.is_finite() && v.abs() < reach;
        if ![from.0, from.1, to.0, to.1].into_iter().all(sane) {
            return;
        }
        let (dx, dy) = (to.0 - from.0, to.1 - from.1);
        let count = dx.abs().max(dy.abs()).round().max(1.0) as i32;
        for i in 0..=count {
            let s = f64::from(i) / f64::from(count);
            let x = (from.0 + dx * s).floor() as i32;
            let y = (from.1 + dy * s).floor() as i32;
            // Gaps follow the place, not the line, so that short lines in a row look like one.
            let along = if dx.abs() >= dy.abs() { x } else { y };
            if along.rem_euclid(i32::from(ink.every)) == 0 {
                self.dot(x, y, ink);
            }
        }
    }

    /// Puts the dots into the cells; cells without dots stay as they are.
    pub fn paint(&self, buffer: &mut Buffer) {
        for (place, spot) in self.area.positions().zip(&self.spots) {
            let &Some((bits, ink)) = spot else { continue };
            let symbol = match self.symbols {
                Symbols::Braille | Symbols::Octant => BRAILLE[usize::from(bits)],
                Symbols::Block => QUADRANTS[usize::from(bits)],
                Symbols::Ascii => ink.glyph,
            };
            buffer[place].set_char(symbol).set_style(ink.style);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use ratatui::style::Color;

    fn drawn(symbols: Symbols, draw: impl FnOnce(&mut Raster)) -> Buffer {
        let mut buffer = Buffer::empty(Rect::new(0, 0, 2, 1));
        let mut raster = Raster::new(buffer.area, symbols);
        draw(&mut raster);
        raster.paint(&mut buffer);
        buffer
    }

    fn ink(rank: u8, colour: Color) -> Ink {
        Ink::solid(Style::new().fg(colour), rank, '#')
    }

    #[test]
    fn dots_land_where_the_symbols_have_them() {
        for (symbols, corners) in [
            (Symbols::Braille, ["⠁", "⢀"]),
            (Symbols::Block, ["▘", "▗"]),
            (Symbols::Ascii, ["#", "#"]),
        ] {
            let buffer = drawn(symbols, |raster| {
                let (width, height) = raster.size();
                for (x, y) in [(0, 0), (width - 1, height - 1), (width, 0), (-1, 0)] {
                    raster.dot(x, y, ink(0, Color::Red));
                }
            });
            assert_eq!([buffer[(0, 0)].symbol(), buffer[(1, 0)].symbol()], corners);
        }
    }

    #[test]
    fn the_highest_rank_owns_the_cell() {
        let buffer = drawn(Symbols::Braille, |raster| {
            raster.dot(0, 0, ink(5, Color::Red));
            raster.dot(1, 3, ink(1, Color::Blue));
        });
        assert_eq!(buffer[(0, 0)].fg, Color::Red);
    }

    #[test]
    fn a_line_to_nowhere_is_not_drawn() {
        let buffer = drawn(Symbols::Ascii, |raster| {
            raster.line((0.0, 0.0), (f64::NAN, 1.0), ink(0, Color::Red));
            raster.line((0.0, 0.0), (1e30, 1.0), ink(0, Color::Red));
        });
        assert_eq!(buffer, Buffer::empty(buffer.area));
    }
}
