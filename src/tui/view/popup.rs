//! A frame in front of the screen, and a line in it that is typed into.

use ratatui::style::Style;
use ratatui::text::{Line, Span};
use ratatui::widgets::{Block, Clear, Widget};

use crate::plain_text::printable;
use crate::tui::{line::TextLine, view::sheet::Sheet, view::text::width};

/// Columns that a frame takes.
pub const MARGIN: u16 = 4;

/// A frame in the middle; gives what is inside.
pub fn frame<'a>(title: &str, (wide, high): (u16, u16), sheet: &'a mut Sheet) -> Sheet<'a> {
    let (area, theme) = (sheet.area, sheet.theme);
    let (wide, high) = (wide.min(area.width), high.min(area.height));
    let (x, y) = ((area.width - wide) / 2, (area.height - high) / 2);
    let place = sheet.part((x, y), (wide, high)).area;
    let title = Line::from(vec![
        Span::styled("─", theme.quiet()),
        Span::styled(format!(" {} ", printable(title)), theme.heading()),
    ]);
    Clear.render(place, sheet.buffer);
    let block = Block::bordered().style(theme.quiet()).title(title);
    block.render(place, sheet.buffer);
    sheet.part((x + 2, y + 1), (wide - MARGIN, high - 2))
}

/// Text that is being typed, scrolled so that its cursor is seen; all of it is one if selected.
pub fn input(line: &TextLine, style: Style, sheet: &mut Sheet) {
    let (area, cursor) = (sheet.area, sheet.theme.focus());
    let input = &line.input;
    let style = if line.selected { cursor } else { style };
    let room = usize::from(area.width.saturating_sub(1));
    let hidden = input.visual_scroll(room);
    let (mut x, mut skipped) = (0, 0);
    for c in input.value().chars() {
        let text = c.to_string();
        if skipped < hidden {
            skipped += usize::from(width(&text));
            continue;
        }
        x = sheet.put((x, 0), &text, style);
    }
    let at = input.visual_cursor().saturating_sub(hidden) as u16;
    if at < area.width {
        sheet.cell((at, 0)).set_style(cursor);
    }
}
