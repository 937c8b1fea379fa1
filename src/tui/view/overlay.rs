//! What comes in front of the screen: the keys, the presets, a name to save under, a question.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::Style;

use crate::guide;
use crate::tui::keys::{KeyTable, tables};
use crate::tui::line::Line;
use crate::tui::model::{Model, Naming, Overlay, Question};
use crate::tui::view::text::{fitted, put, width, wrapped};
use crate::tui::view::theme::Theme;

/// Draws what is in front, if anything is.
pub fn draw(model: &Model, area: Rect, buffer: &mut Buffer) {
    match &model.overlay {
        None => {}
        Some(Overlay::Help(line)) => help(model, *line, area, buffer),
        Some(Overlay::Picker(picker)) => {
            crate::tui::view::picker::draw(model, picker, area, buffer)
        }
        Some(Overlay::Threshold(asking)) => {
            crate::tui::view::threshold::draw(model, asking, area, buffer)
        }
        Some(Overlay::Name(naming, name, error)) => {
            typed_name(model, naming, (name, error.as_deref()), area, buffer);
        }
        Some(Overlay::Question(question)) => ask(model, question, area, buffer),
    }
}

/// Columns that a frame takes.
const MARGIN: u16 = 4;

/// A frame in the middle; gives the space inside.
pub(super) fn frame(
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

/// Text that is being typed, with its cursor, scrolled so that the cursor is seen; what is selected looks like that.
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

/// Columns of the help, and of the keys in it.
const HELP: u16 = 76;
const KEYS: u16 = 18;

/// The help as lines: a heading, or keys and what they do. First what counts on the screen on show, then the rest,
/// then every word explained.
fn help_lines(model: &Model, room: usize) -> Vec<(String, String)> {
    let screen = model.on_show();
    let heading = |text: String| (text, String::new());
    let mut lines = vec![heading(format!(
        "{} {}: {}",
        model.screen + 1,
        screen.title,
        screen.question
    ))];
    let own = || screen.panes.iter().flat_map(|pane| pane.keys);
    let is_own = |table: &&KeyTable| own().any(|own| own.title == table.title);
    let rest = tables().into_iter().filter(|table| !is_own(table));
    for table in own().chain(rest) {
        lines.push(heading(table.title.to_owned()));
        for binding in table.bindings {
            let mut keys =
                wrapped(&binding.names(&model.keys).join(" "), usize::from(KEYS) - 3).into_iter();
            let mut words = wrapped(binding.help, room - usize::from(KEYS)).into_iter();
            loop {
                let (key, word) = (keys.next(), words.next());
                if key.is_none() && word.is_none() {
                    break;
                }
                let (key, word) = (key.unwrap_or_default(), word.unwrap_or_default());
                lines.push((format!("  {key}"), format!(" {word}")));
            }
        }
    }
    lines.push(heading("Words".to_owned()));
    lines.extend(glossary(room));
    lines.push(heading(crate::tui::view::PURPOSE.to_owned()));
    lines
}

/// How many lines the help has where it is narrowest, and the most of them.
pub fn help_rows(model: &Model) -> u16 {
    let room = crate::tui::view::SMALLEST.0 - MARGIN;
    u16::try_from(help_lines(model, room.into()).len()).unwrap_or(u16::MAX)
}

/// The glossary of the guide, wrapped; its headings without their marks.
fn glossary(room: usize) -> Vec<(String, String)> {
    let mut lines = Vec::new();
    let mut entry = String::new();
    let end = |entry: &mut String, lines: &mut Vec<(String, String)>| {
        for (i, line) in wrapped(entry, room - 4).iter().enumerate() {
            lines.push((
                String::new(),
                format!("{}{line}", if i == 0 { "" } else { "  " }),
            ));
        }
        entry.clear();
    };
    let page = guide::TOPICS.iter().find(|topic| topic.name == "glossary");
    for line in page.into_iter().flat_map(|topic| topic.page.lines()) {
        if let Some(text) = line.strip_prefix("- ") {
            end(&mut entry, &mut lines);
            text.clone_into(&mut entry);
        } else if let Some(text) = line.strip_prefix("## ") {
            end(&mut entry, &mut lines);
            lines.push((text.to_owned(), String::new()));
        } else if !line.starts_with('#') {
            entry.extend([" ", line.trim()]);
        }
    }
    end(&mut entry, &mut lines);
    lines
}

fn help(model: &Model, line: u16, area: Rect, buffer: &mut Buffer) {
    let theme = Theme::of(model.look);
    let inside = frame("Help", (HELP, area.height), theme, area, buffer);
    let lines = help_lines(model, usize::from(inside.width));
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
        // Words of the glossary have no keys before them.
        let x = if keys.is_empty() { 2 } else { KEYS - 1 };
        put(buffer, inside, (x, y as u16), what, theme.text());
    }
}

fn typed_name(
    model: &Model,
    naming: &Naming,
    (name, error): (&Line, Option<&str>),
    area: Rect,
    buffer: &mut Buffer,
) {
    let theme = Theme::of(model.look);
    let title = match naming {
        Naming::Save => "Save as a preset of your own".to_owned(),
        Naming::Rename(from) => format!("Another name for {}", fitted(from, 24)),
    };
    let inside = frame(&title, (50, 6), theme, area, buffer);
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
    let inside = frame("Sure?", (50, 6), theme, area, buffer);
    let lines = wrapped(&question.text(), usize::from(inside.width));
    for (i, line) in lines.iter().enumerate() {
        put(buffer, inside, (0, i as u16), line, theme.text());
    }
    let keys = "Enter or y: yes   Esc or n: no";
    put(buffer, inside, (0, 3), keys, theme.strong());
}
