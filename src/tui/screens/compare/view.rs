//! Several presets: the list to mark, the table with overlaid curves, the replays on one clock.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;

use crate::study::Flag;
use crate::tui::model::Model;
use crate::tui::screens::forces::mark;
use crate::tui::view::text::{fitted, flag_name, numeral, put, put_right, width};
use crate::tui::view::theme::Theme;

use super::comparison::{Column, Entry, FORM, Found};
use super::overlaid::overlaid;
use super::replays::replays;
use super::{LIST, REPLAYS, SCREEN, TABLE};

/// Draws the screen.
pub fn draw(model: &Model, area: Rect, buffer: &mut Buffer) {
    match model.pane() {
        TABLE => with_table(model, area, buffer),
        REPLAYS => replays(model, area, buffer),
        _ => with_list(model, area, buffer),
    }
}

/// Where the names of the panes begin in the first line, and how they are written.
fn headings() -> impl Iterator<Item = (u16, String)> {
    let mut x = 1;
    SCREEN.panes.iter().map(move |pane| {
        let at = x;
        let name = format!(" {} ", pane.name);
        x += width(&name) + 1;
        (at, name)
    })
}

/// The pane whose name is written at a cell.
pub fn heading_at(area: Rect, (x, y): (u16, u16)) -> Option<usize> {
    let under = |(at, name): (u16, String)| (at..at + width(&name)).contains(&x);
    headings().position(under).filter(|_| y == area.y)
}

/// The row of the list of presets at a cell.
pub fn listed_at(model: &Model, area: Rect, (x, y): (u16, u16)) -> Option<usize> {
    let inside = model.pane() == LIST && x < list_width(area) && y > area.y;
    let row = first_listed(model, area.height - 1) + usize::from(y.saturating_sub(area.y + 1));
    (inside && row <= model.choices.len()).then_some(row)
}

fn list_width(area: Rect) -> u16 {
    30.min(area.width / 2)
}

/// The first row of the list of presets that there is room for.
fn first_listed(model: &Model, room: u16) -> usize {
    model
        .screens
        .compare
        .row
        .saturating_sub(usize::from(room).saturating_sub(1))
}

pub(super) fn heading(model: &Model, area: Rect, buffer: &mut Buffer) {
    let theme = Theme::of(model.look);
    for (i, (x, name)) in headings().enumerate() {
        let style = if i == model.pane() {
            theme.focus()
        } else {
            theme.text()
        };
        put(buffer, area, (x, 0), &name, style);
    }
    let entries = &model.screens.compare.entries;
    let text = match entries.len() {
        0 | 1 => "mark two to six presets".to_owned(),
        count => format!("{count} marked"),
    };
    put_right(buffer, area, (area.width - 1, 0), &text, theme.quiet());
}

fn with_list(model: &Model, area: Rect, buffer: &mut Buffer) {
    let theme = Theme::of(model.look);
    heading(model, area, buffer);
    let wide = list_width(area);
    let list = Rect::new(area.x, area.y + 1, wide, area.height - 1);
    let names = std::iter::once(FORM).chain(model.choices.iter().map(|c| c.name.as_str()));
    let room = usize::from(list.height);
    let first = first_listed(model, list.height);
    for (i, name) in names.enumerate().skip(first).take(room) {
        let y = (i - first) as u16;
        let entries = &model.screens.compare.entries;
        let place = entries.iter().position(|entry| entry.name == name);
        let sign = place.map_or("[ ]".to_owned(), |at| format!("[{}]", mark(at)));
        let chosen = i == model.screens.compare.row;
        let style = if chosen { theme.focus() } else { theme.text() };
        let text = fitted(name, usize::from(wide) - 6);
        let lit = place.map_or(theme.text(), |at| theme.curve(at));
        put(buffer, list, (1, y), &sign, lit);
        put(buffer, list, (5, y), &text, style);
    }
    let charts = Rect::new(
        area.x + wide,
        area.y + 1,
        area.width - wide,
        area.height - 1,
    );
    if model.screens.compare.entries.is_empty() {
        let text = "Space marks the preset under the cursor";
        put(buffer, charts, (1, 1), text, theme.quiet());
    } else {
        overlaid(model, model.screens.compare.curve, charts, buffer);
    }
}

/// A table that is wider is no easier to read.
const WIDEST: u16 = 120;
/// The least rows of the chart below it.
const CHART: u16 = 5;

fn with_table(model: &Model, area: Rect, buffer: &mut Buffer) {
    heading(model, area, buffer);
    let count = model.screens.compare.entries.len() as u16;
    let room = area.height.saturating_sub(1);
    // The differences give way before the chart does.
    let each = if 2 + 2 * count + CHART <= room { 2 } else { 1 };
    let rows = (2 + each * count).min(room);
    let table_area = Rect::new(area.x, area.y + 1, area.width.min(WIDEST), rows);
    table(model, each, table_area, buffer);
    let below = room - rows;
    if below >= CHART {
        let place = Rect::new(area.x, area.y + 1 + rows, area.width, below);
        overlaid(model, model.screens.compare.curve, place, buffer);
    }
}

fn title(column: Column) -> (&'static str, &'static str) {
    match column {
        Column::Name => ("preset", ""),
        Column::Result(quantity) => (quantity.row().short, quantity.row().unit),
        Column::Error => ("error", "%"),
    }
}

/// Columns of a number: one fewer than from number to number.
const CELLS: u16 = 5;
/// Room for the name that is never given to numbers.
const NAME: u16 = 18;

/// Columns from the end of a number to that of the next.
fn number_columns(area: Rect) -> u16 {
    if area.width >= 110 { 9 } else { 6 }
}

/// Where each column of numbers ends, as many as fit; the one with the cursor is among them.
fn columns(model: &Model, area: Rect) -> Vec<(Column, u16)> {
    let each = number_columns(area);
    let compare = &model.screens.compare;
    let columns = compare.columns();
    let count = usize::from((area.width - NAME) / each).min(columns.len() - 1);
    // The error, which is the last, is always there; the results before it scroll.
    let results = count.saturating_sub(1);
    let last = compare.column.clamp(results, columns.len() - 2);
    let right = |i: usize| area.width - each * (count - 1 - i) as u16;
    let shown = columns.into_iter().skip(last + 1 - results);
    let shown = shown.take(results).chain([Column::Error]);
    shown
        .enumerate()
        .map(|(i, column)| (column, right(i)))
        .collect()
}

/// Where the name ends.
fn name_room(model: &Model, area: Rect) -> usize {
    let each = number_columns(area);
    let taken = columns(model, area).len() as u16 * each;
    usize::from(area.width - taken).saturating_sub(4)
}

fn table(model: &Model, each: u16, area: Rect, buffer: &mut Buffer) {
    let theme = Theme::of(model.look);
    let compare = &model.screens.compare;
    let focused = model.has_focus(TABLE);
    let numbers = columns(model, area);
    let each_number = number_columns(area);
    let first = numbers.first().map(|(column, _)| *column);
    let name = (Column::Name, 0);
    for (column, right) in std::iter::once(name).chain(numbers) {
        // Beside the name there is a gap already.
        let gap = u16::from(Some(column) != first);
        let room = usize::from(each_number - gap);
        let (name, unit) = title(column);
        let sign = match compare.sort {
            Some((by, true)) if by == column => "▾",
            Some((by, false)) if by == column => "▴",
            _ => "",
        };
        let style = if focused && column == compare.here() {
            theme.focus()
        } else {
            theme.heading()
        };
        let text = format!("{sign}{name}");
        if column == Column::Name {
            put(buffer, area, (1, 0), &text, style);
            if each > 1 {
                put(buffer, area, (1, 1), "Δ to the first", theme.quiet());
            }
        } else {
            let text = fitted(&text, room);
            put_right(buffer, area, (right, 0), &text, style);
            put_right(buffer, area, (right, 1), unit, theme.quiet());
        }
    }
    let base = compare.entries.first();
    for (i, entry) in compare.sorted().into_iter().enumerate() {
        let at = compare.entries.iter().position(|e| e.name == entry.name);
        let place = Rect {
            y: area.y + 2 + each * i as u16,
            height: each,
            ..area
        };
        row(model, entry, (at.unwrap_or(0), base), place, buffer);
    }
}

fn row(
    model: &Model,
    entry: &Entry,
    (place, base): (usize, Option<&Entry>),
    area: Rect,
    buffer: &mut Buffer,
) {
    let theme = Theme::of(model.look);
    let room = name_room(model, area);
    let sign = mark(place).to_string();
    put(buffer, area, (1, 0), &sign, theme.curve(place));
    // In a row of one line what there is to say stands beside the name.
    let brief = area.height < 2;
    let flags = match &entry.found {
        Found::Answer(shown) => shown.answer.flags.len(),
        _ => 0,
    };
    let beside = if brief && flags > 0 {
        format!(" {flags}!")
    } else {
        String::new()
    };
    let name = fitted(&entry.name, room - beside.len().min(room));
    let end = put(buffer, area, (3, 0), &name, theme.strong());
    put(buffer, area, (end, 0), &beside, theme.warning());
    let said = if brief { (end + 2, 0) } else { (3, 1) };
    let answer = match &entry.found {
        Found::Awaited => {
            put(buffer, area, said, "simulating", theme.quiet());
            return;
        }
        Found::Refused(why) => {
            let why = fitted(why, usize::from(area.width.saturating_sub(said.0 + 1)));
            put(buffer, area, said, &why, theme.error());
            return;
        }
        Found::Answer(shown) => &shown.answer,
    };
    for (column, right) in columns(model, area) {
        let Some(value) = column.of(answer) else {
            put_right(buffer, area, (right, 0), "-", theme.quiet());
            continue;
        };
        put_right(
            buffer,
            area,
            (right, 0),
            &numeral(value, CELLS),
            theme.text(),
        );
        // An error that is larger by so many percent says little.
        let first = base.filter(|_| place > 0 && column != Column::Error);
        if let Some(first) = first.and_then(Entry::answer).and_then(|a| column.of(a)) {
            let text = difference(value, first);
            put_right(buffer, area, (right, 1), &text, theme.quiet());
        }
    }
    let style = if flags > 0 {
        theme.warning()
    } else {
        theme.quiet()
    };
    let text = remark(place == 0, &answer.flags, room);
    put(buffer, area, (3, 1), &text, style);
}

/// What stands below a name: whether it is the first, and its flags: their names where there is room,
/// else how many.
fn remark(first: bool, flags: &[Flag], room: usize) -> String {
    let names: Vec<String> = flags.iter().map(|flag| flag_name(flag.kind)).collect();
    let count = match flags.len() {
        1 => "1 flag".to_owned(),
        n => format!("{n} flags"),
    };
    let candidates = match (first, flags.is_empty()) {
        (true, true) => vec!["the first".to_owned()],
        (false, true) => return String::new(),
        (true, false) => vec![
            format!("the first, {}", names.join(", ")),
            format!("the first, {count}"),
            format!("first, {count}"),
        ],
        (false, false) => vec![names.join(", "), count],
    };
    let brief = format!("{}!", flags.len());
    let fits = |text: &String| text.len() <= room;
    candidates.into_iter().find(fits).unwrap_or(brief)
}

/// How much larger than the first, in % of it.
fn difference(value: f64, first: f64) -> String {
    if value == first {
        return "=".to_owned();
    }
    let share = 100.0 * (value - first) / first.abs();
    match share.abs() {
        s if !s.is_finite() => "-".to_owned(),
        s if s >= 1000.0 => format!("×{:.0}", value / first),
        s if s >= 10.0 => format!("{share:+.0}%"),
        _ => format!("{share:+.1}%"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_fit_their_columns() {
        for value in [
            0.0, 1.234_56, 0.004_971, 72.931, 1234.5, 123_456.0, 9.9e7, 3e-9, -0.5, -0.0063,
        ] {
            let text = numeral(value, CELLS);
            assert!(width(&text) <= CELLS, "{text}");
        }
        assert_eq!(difference(2.0, 1.0), "+100%");
        assert_eq!(difference(1.01, 1.0), "+1.0%");
        assert_eq!(difference(1.0, 1.0), "=");
        assert_eq!(difference(1.0, 0.0), "-");
        assert_eq!(difference(50.0, 1.0), "×50");
    }
}
