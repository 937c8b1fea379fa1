//! A field of a marked preset that is being changed.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;

use crate::tui::changing::Changing;
use crate::tui::form::allowed;
use crate::tui::model::AppModel;
use crate::tui::view::popup::{frame, input};
use crate::tui::view::text::{put, put_lines, width, wrapped};
use crate::tui::view::theme::Theme;

/// Draws it in the middle of `area`.
pub fn draw(model: &AppModel, changing: &Changing, area: Rect, buffer: &mut Buffer) {
    let theme = Theme::of(model.look);
    let field = changing.field();
    let inside = frame(&changing.name, (54, 8), theme, area, buffer);
    let x = put(buffer, inside, (0, 0), field.label, theme.heading()) + 2;
    let unit = width(field.unit);
    let room = inside.width.saturating_sub(x + unit + 1);
    let typed = Rect::new(inside.x + x, inside.y, room, 1);
    input(
        &changing.input,
        theme.strong(),
        theme.focus(),
        typed,
        buffer,
    );
    let beside = (x + width(changing.input.value()) + 1).min(inside.width - unit);
    put(buffer, inside, (beside, 0), field.unit, theme.text());
    let (said, style) = match &changing.error {
        Some(why) => (why.clone(), theme.error()),
        None => (format!("{}: {}", field.help, allowed(field)), theme.quiet()),
    };
    let lines = wrapped(&said, usize::from(inside.width));
    put_lines(buffer, inside, (0, 2), lines.iter().take(3), style);
    let keys = "↑↓ another field   Enter takes it   Esc leaves it";
    put(buffer, inside, (0, 5), keys, theme.strong());
}
