//! A result over two inputs as a map of digits: tenths of its scale, with the lines of the half
//! and the whole of it. The scale is that of the table of results, or else reaches to the largest
//! value.
//!
//! Digits tell the value without colours; colours add how grave that is, or how much. Where the
//! nearest simulated point folded its mesh the map is hatched, as no number holds there.

use std::collections::BTreeSet;

use ratatui::layout::Rect;
use ratatui::style::{Modifier, Style};

use crate::injury::{Blow, Injury, Known, whole as whole_percent};
use crate::many::map::{Grid, SIDE, Span};
use crate::report::figure::{with_unit, within};
use crate::report::format::{capital, significant};
use crate::report::picture::{Part, field::step};
use crate::run::quantity::Quantity;
use crate::scenario::{doubt::number, problem::plain, set::put_number};
use crate::tui::screens::map::state::{Map, rounded};
use crate::tui::view::sheet::{Sheet, along};
use crate::tui::view::text::{fitted, width, wrapped};
use crate::tui::{model::AppModel, view::chart::axis_lines, view::theme::Theme};

/// Room for the numbers of the axis that goes up.
const LABELS: u16 = 8;
/// Shares of the scale with a line, on which its figure stands.
const LINES: [f64; 3] = [0.1, 0.5, 0.9];
const LINE: &str = "+";
/// Signs of a value above the whole scale, and of a place where no number holds.
const ABOVE: &str = "*";
const FOLDED: &str = "▒";
/// Rows below the map: its axis, two of the reading, the legend.
const BELOW: u16 = 5;

/// What a result on the map may be off by, in %, at the least: no mesh error is estimated of its
/// runs.
const MAPPED: f64 = 10.0;

/// Draws the screen.
pub fn draw(map: &Map, model: &AppModel, sheet: &mut Sheet) {
    let (area, theme) = (sheet.area, sheet.theme);
    let Some([x, y]) = map.spans else {
        let text = "this scenario has no two inputs to draw a map over";
        sheet.put((1, 1), text, theme.warning());
        return;
    };
    let (said, style) = status(map, model, theme);
    let grid = map.grid(&model.work.scenario);
    let quantity = grid.map_or(Quantity::Damage, |grid| map.quantity(grid));
    let result = quantity.row();
    let whole = whole(grid, quantity);
    let over = format!("{} across, {} up", x.field.label, y.field.label);
    let name = capital(result.short);
    let whole_name = format!("What if? {}: {over}", capital(result.label));
    let axes_named = format!("{name}: {over}");
    let full = format!("What if? {axes_named}");
    let brief = format!("What if? {}", capital(result.label));
    let briefer = format!("What if? {name}");
    let titles = [&whole_name, &full, &axes_named, &brief, &briefer];
    let titles = titles.map(String::as_str);
    let titles = [&titles[..], &["What if?"]].concat();
    sheet.put_both((&titles, theme.heading()), (&said, style));
    let (wide, high) = (LABELS + 2, BELOW + 1);
    let size = (area.width.saturating_sub(wide), area.height.saturating_sub(high));
    let field = sheet.part((LABELS + 1, 1), size).area;
    if field.width < 10 || field.height < 4 {
        sheet.put((1, 1), "too small for the map", theme.warning());
        return;
    }
    axes((x, y), field, sheet);
    let mut drawn = BTreeSet::new();
    if let Some(grid) = grid {
        for row in 0..field.height {
            for column in 0..field.width {
                let (sign, style) = cell((grid, quantity, whole), (column, row), field, theme);
                sheet.at(field).put((column, row), sign, style);
                drawn.insert(sign);
            }
        }
        figures((grid, quantity, whole), field, sheet);
        mark_scenario(model, (x, y), field, sheet);
    }
    let (px, py) = map.place();
    let at = (along(px, field.width), along(1.0 - py, field.height));
    let cursor = theme.focus().patch(theme.strong());
    let place = &mut sheet.buffer[(field.x + at.0, field.y + at.1)];
    place.set_style(Style::reset());
    place.set_symbol("X").set_style(cursor);
    let top = area.height - BELOW + 2;
    let reading = reading(map, model, (x, y));
    let room = usize::from(area.width - 2);
    let lines = wrapped(&reading, room).into_iter().take(2);
    sheet.put_lines((1, top), lines, theme.strong());
    let unit = result.unit;
    let part = |share: f64| rounded(share * whole).to_string();
    let steps = if whole == 100.0 && unit == "%" {
        "tens of %".to_owned()
    } else {
        format!("steps of {}", with_unit(&part(0.1), unit))
    };
    let mut legend = format!("0-9: {steps}  {LINE} lines");
    for (sign, words) in [(ABOVE, "above that"), (FOLDED, "folded")] {
        if drawn.contains(&sign) {
            legend.extend(["  ", sign, " ", words]);
        }
    }
    legend += "  o your blow";
    sheet.put((1, area.height - 1), fitted(&legend, room), theme.quiet());
}

fn status(map: &Map, model: &AppModel, theme: Theme) -> (String, Style) {
    let grid = map.grid(&model.work.scenario);
    let all = SIDE * SIDE;
    match (map.task.pace(Some(all)), grid) {
        (Some(pace), _) => (format!("{pace}  Esc stops"), theme.warning()),
        (None, _) if map.task.complaint.is_some() => {
            ("stopped: m goes on".to_owned(), theme.warning())
        }
        (None, Some(grid)) => (format!("{} runs", grid.known().0), theme.quiet()),
        (None, None) => (String::new(), theme.quiet()),
    }
}

/// The place of a cell on the map, from 0 to 1, and of one that may lie outside.
fn place((column, row): (u16, u16), field: Rect) -> (f64, f64) {
    (
        f64::from(column) / f64::from(field.width - 1),
        1.0 - f64::from(row) / f64::from(field.height - 1),
    )
}

/// The whole of the scale: that of the result, or the first of 1, 2 and 5 times a power of ten
/// that no value exceeds.
fn whole(grid: Option<&Grid>, quantity: Quantity) -> f64 {
    let round = |largest: f64| {
        let power = 10_f64.powf(largest.log10().floor());
        let steps = [1.0, 2.0, 5.0, 10.0].map(|step| step * power);
        steps.into_iter().find(|step| *step >= largest)
    };
    let largest = grid.and_then(|grid| grid.largest(quantity));
    let own = quantity.row().whole;
    own.or_else(|| round(largest.filter(|v| *v > 0.0)?)).unwrap_or(1.0)
}

fn cell(
    (grid, quantity, whole): (&Grid, Quantity, f64),
    at: (u16, u16),
    field: Rect,
    theme: Theme,
) -> (&'static str, Style) {
    const DIGITS: [&str; 10] = ["0", "1", "2", "3", "4", "5", "6", "7", "8", "9"];
    let (x, y) = place(at, field);
    let share = |x, y| Some(grid.read(quantity, (x, y))?.value? / whole);
    let Some(reading) = grid.read(quantity, (x, y)) else {
        return (" ", theme.quiet());
    };
    let Some(value) = reading.value.map(|value| value / whole) else {
        return ("·", theme.quiet());
    };
    // What is harmless, or grave, looks so on every screen; of what is neither, more is lighter.
    let row = quantity.row();
    let heat = if row.risk {
        theme.likelihood(value * whole / 100.0)
    } else if row.whole.is_some() {
        theme.gauge(value)
    } else {
        Style::new().fg(theme.part(Part::Globe, step(value, 1.0)))
    };
    let heat = if theme.is_mono() { heat } else { heat.add_modifier(Modifier::REVERSED) };
    let crosses = |level: f64| {
        let next = [(at.0 + 1, at.1), (at.0, at.1 + 1)];
        next.iter()
            .filter(|(column, row)| *column < field.width && *row < field.height)
            .filter_map(|next| {
                let (x, y) = place(*next, field);
                share(x, y)
            })
            .any(|other| (other < level) != (value < level))
    };
    if LINES.iter().any(|level| crosses(*level)) {
        return (LINE, theme.strong());
    }
    if reading.folded {
        return (FOLDED, heat);
    }
    if value > 1.0 {
        return (ABOVE, heat);
    }
    let tenths = (value * 10.0).max(0.0) as usize;
    (DIGITS[tenths.min(9)], heat)
}

/// Writes on each line its figure, on rows of their own.
fn figures((grid, quantity, whole): (&Grid, Quantity, f64), field: Rect, sheet: &mut Sheet) {
    let theme = sheet.theme;
    let value = |column: u16, row: u16| {
        let (x, y) = place((column, row), field);
        Some(grid.read(quantity, (x, y))?.value? / whole)
    };
    for (i, level) in (1..).zip(LINES) {
        let crossing = |row: u16| {
            let mut columns = 1..field.width;
            columns.find(|column| {
                let (before, here) = (value(column - 1, row), value(*column, row));
                before.zip(here).is_some_and(|(a, b)| (a < level) != (b < level))
            })
        };
        let wanted = field.height * i / (LINES.len() as u16 + 2);
        let mut rows: Vec<u16> = (0..field.height).collect();
        rows.sort_by_key(|row| row.abs_diff(wanted));
        let Some((row, column)) = rows.into_iter().find_map(|row| Some((row, crossing(row)?)))
        else {
            continue;
        };
        let text =
            format!(" {} ", with_unit(&rounded(level * whole).to_string(), quantity.row().unit));
        let left = column.saturating_sub(width(&text) / 2);
        let left = left.min(field.width.saturating_sub(width(&text)));
        let field = &mut sheet.at(field);
        for x in 0..width(&text) {
            field.cell((left + x, row)).reset();
        }
        field.put((left, row), text, theme.strong());
    }
}

/// Marks where the scenario itself lies, if it is on the map.
fn mark_scenario(model: &AppModel, (x, y): (Span, Span), field: Rect, sheet: &mut Sheet) {
    let theme = sheet.theme;
    let share = |span: Span| {
        let (value, _) = number(span.field, &model.work.scenario)?;
        let share = (value - span.from) / (span.to - span.from);
        (0.0..=1.0).contains(&share).then_some(share)
    };
    if let (Some(x), Some(y)) = (share(x), share(y)) {
        let at = (along(x, field.width), along(1.0 - y, field.height));
        sheet.at(field).put(at, "o", theme.warning());
    }
}

/// A value of an input in as few digits as it takes, four at most.
fn short(value: f64) -> String {
    plain(significant(value).parse().unwrap_or(value))
}

fn axes((x, y): (Span, Span), field: Rect, sheet: &mut Sheet) {
    let (area, theme) = (sheet.area, sheet.theme);
    let bottom = field.height;
    axis_lines(field, sheet);
    let middle = |span: Span| 0.5 * (span.from + span.to);
    for (row, value) in [(0, y.to), (bottom / 2, middle(y)), (bottom - 1, y.from)] {
        sheet.put_right((LABELS, 1 + row), short(value), theme.quiet());
    }
    let row = 2 + bottom;
    let (left, right) = (LABELS + 1, area.width - 1);
    sheet.put((left, row), short(x.from), theme.quiet());
    let text = format!("{} {}", short(middle(x)), x.field.unit);
    let at = left + field.width / 2;
    let at = at.saturating_sub(width(&text) / 2);
    sheet.put((at, row), text, theme.quiet());
    sheet.put_right((right, row), short(x.to), theme.quiet());
    // Below the number at the top of its axis.
    sheet.put_right((LABELS, 2), y.field.unit, theme.quiet());
}

/// The range of a risk under the cursor: of curves, eyes and what a map may be off by.
fn risk_there(map: &Map, grid: &Grid, of: Quantity, model: &AppModel) -> Option<String> {
    let (injury, [x, y], [a, b]) = (Injury::of(of)?, map.spans?, map.values()?);
    let measure = injury.measure();
    let felt = map.reading(grid, measure).filter(|felt| !felt.folded)?.value?;
    let mut there = model.work.scenario.clone();
    put_number(&mut there, x.field, a);
    put_number(&mut there, y.field, b);
    let known =
        Known { value: felt / measure.row().factor, error: 0.01 * MAPPED, ..Known::default() };
    Some(injury.assess(&Blow::of(&there), known).percent())
}

/// What is known under the cursor.
fn reading(map: &Map, model: &AppModel, (x, y): (Span, Span)) -> String {
    let Some([a, b]) = map.values() else {
        return String::new();
    };
    let part = |span: Span, value: f64| {
        let text = format!("{} {} {}", span.field.label, short(value), span.field.unit);
        text.trim_end().to_owned()
    };
    let value = map.grid(&model.work.scenario).map(|grid| {
        let quantity = map.quantity(grid);
        let Some(reading) = map.reading(grid, quantity) else {
            return "not known yet".to_owned();
        };
        let Some(value) = reading.value else {
            return if reading.exact { "not allowed" } else { "not known yet" }.to_owned();
        };
        let row = quantity.row();
        if let Some(range) = risk_there(map, grid, quantity, model) {
            // The points around it tell no more than where it about lies.
            let rough = if reading.exact { "" } else { ", between points that were computed" };
            let middle = whole_percent(0.01 * value);
            return format!("{} about {middle}, {range}{rough}", row.label);
        }
        let about = if reading.exact { "" } else { "about " };
        let folded = if reading.folded { ", but the mesh folded" } else { "" };
        let value = with_unit(&within(value, Some(MAPPED)), row.unit);
        format!("{} {about}{value}{folded}", row.label)
    });
    let value = value.unwrap_or_else(|| "not known yet".to_owned());
    format!("X {}, {}: {value}", part(x, a), part(y, b))
}
