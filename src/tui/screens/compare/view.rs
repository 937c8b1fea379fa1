//! Several presets: the list to mark, the table with overlaid curves, the replays on one clock.

use ratatui::layout::Rect;

use crate::answer::solve::Answer;
use crate::many::comparison::{ComparisonColumn, Found};
use crate::report::risks::first_line;
use crate::tui::view::text::{fitted, longest_fitting, width, wrapped};
use crate::tui::{changing::began_as, model::AppModel, view::chart::mark, view::risks::longest};
use crate::tui::{view::sheet::Sheet, work::brief};

use crate::tui::screens::compare::comparison::{Comparison, FORM, LIST, Marked, REPLAYS, TABLE};
use crate::tui::screens::compare::{cell::cell, overlaid::overlaid, replays::replays};

/// What the screen answers.
pub const QUESTION: &str = "Which is worse?";
/// What its panes are called.
pub const PANES: [&str; 3] = ["presets", "table", "replays"];

/// Draws the screen.
pub fn draw(compare: &Comparison, model: &AppModel, sheet: &mut Sheet) {
    match compare.pane {
        TABLE => with_table(compare, model, sheet),
        REPLAYS => replays(compare, model, sheet),
        _ => with_list(compare, model, sheet),
    }
}

/// Where the names of the panes begin in the first line, and how they are written.
fn headings() -> impl Iterator<Item = (u16, String)> {
    let mut x = 1;
    PANES.iter().map(move |pane| {
        let at = x;
        let name = format!(" {pane} ");
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
pub fn listed_at(
    compare: &Comparison,
    model: &AppModel,
    area: Rect,
    (x, y): (u16, u16),
) -> Option<usize> {
    let inside = compare.pane == LIST && x < list_width(area) && y > area.y;
    let row = first_listed(compare, area.height - 1) + usize::from(y.saturating_sub(area.y + 1));
    (inside && row <= model.choices.len()).then_some(row)
}

fn list_width(area: Rect) -> u16 {
    30.min(area.width / 2)
}

/// The first row of the list of presets that there is room for.
fn first_listed(compare: &Comparison, room: u16) -> usize {
    compare.row.saturating_sub(usize::from(room).saturating_sub(1))
}

/// The names of the panes, and at the right how far things are, or else `text`.
pub(super) fn heading(compare: &Comparison, text: &str, sheet: &mut Sheet) {
    let (area, theme) = (sheet.area, sheet.theme);
    for (i, (x, name)) in headings().enumerate() {
        let here = i == compare.pane;
        let style = if here { theme.focus() } else { theme.text() };
        sheet.put((x, 0), &name, style);
    }
    let said = progress(compare);
    let text = if said.is_empty() { text } else { &said };
    sheet.put_right((area.width - 1, 0), text, theme.quiet());
}

/// How far simulations and what completes them are.
fn progress(compare: &Comparison) -> String {
    let count = compare.entries.len();
    let answered = |entry: &&Marked| !matches!(entry.found, Found::Awaited);
    let done = compare.entries.iter().filter(answered).count();
    let open = compare.incomplete().count();
    match (count, done, open) {
        (0, ..) => "mark two to six".to_owned(),
        (1, ..) => "mark one more".to_owned(),
        _ if done < count => format!("{done} of {count} simulated"),
        (_, _, 0) => String::new(),
        _ => format!("mesh and inputs: {} of {count}", count - open),
    }
}

fn marked(compare: &Comparison) -> String {
    format!("{} marked, w takes a page", compare.entries.len())
}

fn with_list(compare: &Comparison, model: &AppModel, sheet: &mut Sheet) {
    let (area, theme) = (sheet.area, sheet.theme);
    heading(compare, &marked(compare), sheet);
    let wide = list_width(area);
    let names = std::iter::once(FORM).chain(model.choices.iter().map(|c| c.name.as_str()));
    let room = usize::from(area.height - 1);
    let first = first_listed(compare, area.height - 1);
    for (i, name) in names.enumerate().skip(first).take(room) {
        let y = 1 + (i - first) as u16;
        let entries = &compare.entries;
        let same = |entry: &Marked| began_as(&entry.name, name);
        let place = entries.iter().position(same);
        let sign = place.map_or("[ ]".to_owned(), |at| format!("[{}]", mark(at)));
        let chosen = i == compare.row;
        let style = if chosen { theme.focus() } else { theme.text() };
        let called = match place {
            _ if name == FORM => {
                let texts = [format!("{FORM} {}", model.work.name()), FORM.to_owned()];
                longest_fitting(&texts, wide - 6).to_owned()
            }
            Some(at) => entries[at].name.clone(),
            None => name.to_owned(),
        };
        let text = fitted(brief(&called), usize::from(wide) - 6);
        let lit = place.map_or(theme.text(), |at| theme.curve(at));
        sheet.put((1, y), sign, lit);
        sheet.put((5, y), text, style);
    }
    let charts = &mut sheet.part((wide, 1), (area.width - wide, area.height - 1));
    if compare.entries.is_empty() {
        let texts = [
            "Space marks the preset under the cursor,",
            "/ finds presets by letters and marks them, with a speed: squash@30",
        ];
        let room = usize::from(charts.area.width.saturating_sub(2));
        let lines = texts.iter().flat_map(|text| wrapped(text, room));
        charts.put_lines((1, 1), lines, theme.quiet());
    } else {
        overlaid(compare, model, compare.curve(), charts);
    }
}

/// The least rows of the chart below the table.
const CHART: u16 = 5;

fn with_table(compare: &Comparison, model: &AppModel, sheet: &mut Sheet) {
    let area = sheet.area;
    heading(compare, &marked(compare), sheet);
    let count = compare.entries.len() as u16;
    let numbers = columns(compare, area);
    let room = area.height - 1;
    // What to believe gives way before the errors do, and those before the chart.
    let fits = |each: &u16| 2 + each * count + CHART <= room;
    let each = (1..=3).rev().find(fits).unwrap_or(1);
    let rows = (2 + each * count).min(room);
    let place = &mut sheet.part((0, 1), (area.width, rows));
    table(compare, model, each, &numbers, place);
    let below = room - rows;
    if below >= CHART {
        let place = &mut sheet.part((0, 1 + rows), (area.width, below));
        overlaid(compare, model, compare.curve(), place);
    }
}

fn title(column: ComparisonColumn) -> (&'static str, &'static str) {
    match column {
        ComparisonColumn::Name => ("preset", ""),
        ComparisonColumn::Result(quantity) => (quantity.row().short, quantity.row().unit),
    }
}

/// Columns from the end of a number to that of the next: room for the longest name and the mark of
/// sorting.
const EACH: u16 = 10;
/// Room for the name that is never given to numbers.
const NAME: u16 = 20;

/// Where each column of numbers ends, as many as fit; the one with the cursor is among them.
fn columns(compare: &Comparison, area: Rect) -> Vec<(ComparisonColumn, u16)> {
    let columns = compare.columns();
    let count = usize::from((area.width - NAME) / EACH).min(columns.len() - 1);
    let first = compare.column.clamp(count, columns.len() - 1) + 1 - count;
    let right = |i: usize| NAME + EACH * (i as u16 + 1);
    let shown = columns.into_iter().skip(first).take(count).enumerate();
    shown.map(|(i, column)| (column, right(i))).collect()
}

fn table(
    compare: &Comparison,
    model: &AppModel,
    each: u16,
    numbers: &[(ComparisonColumn, u16)],
    sheet: &mut Sheet,
) {
    let (area, theme) = (sheet.area, sheet.theme);
    let focused = compare.pane == TABLE && model.overlay.is_none();
    for &(column, right) in std::iter::once(&(ComparisonColumn::Name, 0)).chain(numbers) {
        let (name, unit) = title(column);
        let sign = match compare.sorting() {
            Some((by, true)) if by == column => "▾",
            Some((by, false)) if by == column => "▴",
            _ => "",
        };
        let here = focused && column == compare.here();
        let style = if here { theme.focus() } else { theme.heading() };
        let text = format!("{sign}{name}");
        if column == ComparisonColumn::Name {
            sheet.put((1, 0), &text, style);
        } else {
            sheet.put_right((right, 0), &text, style);
            sheet.put_right((right, 1), unit, theme.quiet());
        }
    }
    let hidden = compare.columns().len() - 1 - numbers.len();
    if hidden > 0 {
        let text = format!("←→ {hidden} more");
        sheet.put((1, 1), &text, theme.quiet());
    }
    for (i, entry) in compare.sorted().into_iter().enumerate() {
        let at = compare.entries.iter().position(|e| e.name == entry.name);
        let here = focused && i == compare.entry;
        let place = &mut sheet.part((0, 2 + each * i as u16), (area.width, each));
        row(entry, (at.unwrap_or(0), numbers), place);
        if here {
            place.put((0, 0), "▸", theme.strong());
        }
    }
}

fn row(entry: &Marked, (place, numbers): (usize, &[(ComparisonColumn, u16)]), sheet: &mut Sheet) {
    let (area, theme) = (sheet.area, sheet.theme);
    let room = usize::from(NAME) - 3;
    let sign = mark(place).to_string();
    sheet.put((1, 0), &sign, theme.curve(place));
    sheet.put((3, 0), fitted(brief(&entry.name), room), theme.strong());
    // In a row of one line what there is to say stands beside the name.
    let said = if area.height < 2 { (NAME, 0) } else { (3, 1) };
    let wide = usize::from(area.width.saturating_sub(said.0 + 1));
    let answer = match &entry.found {
        Found::Awaited => {
            sheet.put(said, "simulating", theme.quiet());
            return;
        }
        Found::Refused(why) => {
            sheet.put(said, fitted(why, wide), theme.error());
            return;
        }
        Found::Answer(shown) => &shown.answer,
    };
    for &(column, right) in numbers {
        let (value, error) = cell(answer, column, !entry.without_mesh);
        let style = match column {
            ComparisonColumn::Result(_) if answer.spoiled().is_some() => theme.quiet(),
            _ => theme.text(),
        };
        sheet.put_right((right, 0), &value, style);
        sheet.put_right((right, 1), &error, theme.quiet());
    }
    if !answer.flags.is_empty() {
        let flags = answer.flags.iter().map(|flag| flag.kind.words());
        let names = flags.collect::<Vec<_>>().join(", ");
        let texts = [
            names,
            format!(
                "{} warning{}",
                answer.flags.len(),
                if answer.flags.len() == 1 { "" } else { "s" }
            ),
        ];
        let text = longest_fitting(&texts, room as u16);
        sheet.put((3, 1), text, theme.warning());
    }
    sheet.put((3, 2), belief(answer, usize::from(area.width) - 4), theme.text());
}

/// What to believe of the gravest injury, in the longest words that there is room for.
fn belief(answer: &Answer, room: usize) -> String {
    match answer.risks().first() {
        Some(risk) => longest(risk, room),
        None => fitted(&first_line(answer), room),
    }
}
