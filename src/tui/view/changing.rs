//! A field of a marked preset that is being changed.

use crate::tui::view::popup::{frame, input};
use crate::tui::view::text::{width, wrapped};
use crate::tui::{changing::Changing, form::allowed, view::sheet::Sheet};

/// Draws it in the middle of `area`.
pub fn draw(changing: &Changing, sheet: &mut Sheet) {
    let theme = sheet.theme;
    let field = changing.field();
    let sheet = &mut frame(&changing.name, (54, 8), sheet);
    let wide = sheet.area.width;
    let x = sheet.put((0, 0), field.label, theme.heading()) + 2;
    let unit = width(field.unit);
    let room = wide.saturating_sub(x + unit + 1);
    let typed = &mut sheet.part((x, 0), (room, 1));
    input(&changing.input, theme.strong(), typed);
    let beside = (x + width(changing.input.value()) + 1).min(wide - unit);
    sheet.put((beside, 0), field.unit, theme.text());
    let (said, style) = match &changing.error {
        Some(why) => (why.clone(), theme.error()),
        None => (format!("{}: {}", field.help, allowed(&changing.scenario, field)), theme.quiet()),
    };
    let lines = wrapped(&said, usize::from(wide));
    sheet.put_lines((0, 2), lines.iter().take(3), style);
    let keys = "↑↓ another field   Enter takes it   Esc leaves it";
    sheet.put((0, 5), keys, theme.strong());
}
