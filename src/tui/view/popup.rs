//! A frame in front of the screen, and a line in it that is typed into.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::Style;
use ratatui::text::{Line, Span};
use ratatui::widgets::{Block, Clear, Widget};

use crate::plain_text::printable;
use crate::tui::line::TextLine;
use crate::tui::view::text::{put, width};
use crate::tui::view::theme::Theme;

/// Columns that a frame takes.
pub const MARGIN: u16 = 4;

/// A frame in the middle; gives the space inside.
pub fn frame(
    title: &str,
    (wide, high): (u16, u16),
    theme: Theme,
    area: Rect,
    buffer: &mut Buffer,
) -> Rect {
    let (wide, high) = (wide.min(area.width), high.min(area.height));
    let place = Rect::new(
        area.x + (area.width - wide) / 2,
        area.y + (area.height - high) / 2,
        wide,
        high,
    );
    let title = Line::from(vec![
        Span::styled("─", theme.line()),
        Span::styled(format!(" {} ", printable(title)), theme.heading()),
    ]);
    Clear.render(place, buffer);
    let block = Block::bordered().style(theme.line()).title(title);
    block.render(place, buffer);
    Rect::new(place.x + 2, place.y + 1, wide - MARGIN, high - 2)
}

/// Text that is being typed, with its cursor, scrolled so that the cursor is seen; what is
/// selected looks like that.
pub fn input(line: &TextLine, style: Style, cursor: Style, area: Rect, buffer: &mut Buffer) {
    let input = &line.input;
    let style = if line.selected { cursor } else { style };
    let room = usize::from(area.width.saturating_sub(1));
    let hidden = input.visual_scroll(room);
    let mut x = 0;
    let mut skipped = 0;
    for c in input.value().chars() {
        let text = c.to_string();
        if skipped < hidden {
            skipped += usize::from(width(&text));
            continue;
        }
        x = put(buffer, area, (x, 0), &text, style);
    }
    let at = input.visual_cursor().saturating_sub(hidden) as u16;
    if at < area.width {
        buffer[(area.x + at, area.y)].set_style(cursor);
    }
}
