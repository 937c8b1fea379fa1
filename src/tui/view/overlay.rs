//! What comes in front of the screen: the keys, the presets, a name to save under, a question.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::Style;
use tui_input::Input;

use super::text::{fitted, put, width, wrapped};
use super::theme::Theme;
use crate::tui::keys::tables;
use crate::tui::model::{Model, Overlay, Question};

/// Draws what is in front, if anything is.
pub fn draw(model: &Model, area: Rect, buffer: &mut Buffer) {
    match &model.overlay {
        None => {}
        Some(Overlay::Help(line)) => help(model, *line, area, buffer),
        Some(Overlay::Picker(row)) => picker(model, *row, area, buffer),
        Some(Overlay::SaveAs(name, error)) => save(model, name, error.as_deref(), area, buffer),
        Some(Overlay::Question(question)) => ask(model, question, area, buffer),
    }
}

/// A frame in the middle; gives the space inside.
fn frame(
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
    Rect::new(place.x + 2, place.y + 1, wide - 4, high - 2)
}

/// Text that is being typed, with its cursor, scrolled so that the cursor is seen.
pub fn input(input: &Input, style: Style, cursor: Style, area: Rect, buffer: &mut Buffer) {
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

fn help(model: &Model, line: u16, area: Rect, buffer: &mut Buffer) {
    let theme = Theme::of(model.look);
    let mut lines: Vec<(String, String)> = Vec::new();
    for table in tables() {
        lines.push((table.title.to_owned(), String::new()));
        for binding in table.bindings {
            lines.push((
                format!("  {}", binding.names(&model.keys).join(" ")),
                binding.help.to_owned(),
            ));
        }
    }
    lines.push((super::PURPOSE.to_owned(), String::new()));
    let inside = frame("Keys", (58, area.height), theme, area, buffer);
    let last = (lines.len() as u16).saturating_sub(inside.height);
    for (y, (keys, what)) in lines
        .iter()
        .skip(usize::from(line.min(last)))
        .take(usize::from(inside.height))
        .enumerate()
    {
        let style = if what.is_empty() {
            theme.heading()
        } else {
            theme.strong()
        };
        put(buffer, inside, (0, y as u16), keys, style);
        put(buffer, inside, (18, y as u16), what, theme.text());
    }
}

fn picker(model: &Model, row: usize, area: Rect, buffer: &mut Buffer) {
    let theme = Theme::of(model.look);
    let count = model.choices.len() as u16;
    let inside = frame("Open", (56, count + 2), theme, area, buffer);
    let room = usize::from(inside.height);
    let first = row.saturating_sub(room.saturating_sub(1));
    for (i, choice) in model.choices.iter().enumerate().skip(first).take(room) {
        let y = (i - first) as u16;
        let style = if i == row {
            theme.focus()
        } else {
            theme.strong()
        };
        put(buffer, inside, (0, y), &fitted(&choice.name, 20), style);
        let (text, style) = match &choice.scenario {
            Ok(scenario) => (scenario.name.clone(), theme.text()),
            Err(why) => (why.clone(), theme.error()),
        };
        let text = match choice.origin {
            "" => text,
            origin => format!("{origin}: {text}"),
        };
        let room = usize::from(inside.width - 21);
        put(buffer, inside, (21, y), &fitted(&text, room), style);
    }
}

fn save(model: &Model, name: &Input, error: Option<&str>, area: Rect, buffer: &mut Buffer) {
    let theme = Theme::of(model.look);
    let inside = frame("Save as a preset of your own", (50, 6), theme, area, buffer);
    put(buffer, inside, (0, 0), "Name", theme.text());
    let field = Rect::new(inside.x + 6, inside.y, inside.width - 6, 1);
    input(name, theme.strong(), theme.focus(), field, buffer);
    if let Some(error) = error {
        for (i, line) in wrapped(error, usize::from(inside.width)).iter().enumerate() {
            put(buffer, inside, (0, 2 + i as u16), line, theme.error());
        }
    }
}

fn ask(model: &Model, question: &Question, area: Rect, buffer: &mut Buffer) {
    let theme = Theme::of(model.look);
    let text = match question {
        Question::Replace(name) => {
            format!("There is a preset {name} already. Put this one in its place?")
        }
        Question::Hide(name) => {
            format!(
                "{name} comes with the program. A preset of your own of that name hides it. Save it?"
            )
        }
        Question::Quit => "The changes are not saved. Quit and lose them?".to_owned(),
    };
    let inside = frame("Sure?", (50, 6), theme, area, buffer);
    let lines = wrapped(&text, usize::from(inside.width));
    for (i, line) in lines.iter().enumerate() {
        put(buffer, inside, (0, i as u16), line, theme.text());
    }
    put(buffer, inside, (0, 3), "y yes   n no", theme.strong());
}
