//! A frame in front of the screen, and a line in it that is typed into.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::Style;

use crate::tui::line::Line;
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
    for y in 0..high {
        let blank = " ".repeat(usize::from(wide));
        for x in 0..wide {
            buffer[(place.x + x, place.y + y)].reset();
        }
        let line = match y {
            0 => format!("┌{}┐", "─".repeat(usize::from(wide) - 2)),
            _ if y == high - 1 => format!("└{}┘", "─".repeat(usize::from(wide) - 2)),
            _ => blank,
        };
        put(buffer, place, (0, y), &line, theme.line());
        if y > 0 && y < high - 1 {
            put(buffer, place, (0, y), "│", theme.line());
            put(buffer, place, (wide - 1, y), "│", theme.line());
        }
    }
    put(
        buffer,
        place,
        (2, 0),
        &format!(" {title} "),
        theme.heading(),
    );
    Rect::new(place.x + 2, place.y + 1, wide - MARGIN, high - 2)
}

/// Text that is being typed, with its cursor, scrolled so that the cursor is seen; what is selected
/// looks like that.
pub fn input(line: &Line, style: Style, cursor: Style, area: Rect, buffer: &mut Buffer) {
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
