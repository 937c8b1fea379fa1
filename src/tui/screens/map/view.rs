//! A result over two inputs as a shaded map, with lines at a tenth, a half and nine tenths of its
//! scale. The scale is that of the table of results, or else reaches to the largest value.
//!
//! Without colours digits tell the value in tenths. Where the nearest simulated point folded its
//! mesh the map is hatched, as no number holds there.

use std::collections::BTreeSet;

use ratatui::layout::Rect;
use ratatui::style::{Modifier, Style};

use crate::injury::{span, whole as whole_percent};
use crate::many::map::{Grid, MapReading, SIDE, Span};
use crate::report::figure::{with_unit, within};
use crate::report::format::{capital, significant};
use crate::report::{picture::Part, picture::field::step};
use crate::run::quantity::Quantity;
use crate::scenario::{doubt::number, problem::plain};
use crate::tui::screens::map::{Map, rounded};
use crate::tui::screens::screen::state_of_work;
use crate::tui::view::fundus::LADDER;
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

/// A result on the map may be off by so many % at least: no mesh error is estimated of its runs.
const MAPPED: f64 = 10.0;

pub fn draw(map: &Map, model: &AppModel, sheet: &mut Sheet) {
    let (area, theme) = (sheet.area, sheet.theme);
    let Some(spans @ [x, y]) = map.spans else {
        let text = "this scenario has no two inputs to draw a map over";
        sheet.put((1, 1), text, theme.warning());
        return;
    };
    let grid = map.grid(&model.work.scenario);
    let of = grid.map_or(Quantity::Damage, |grid| map.quantity(grid));
    let whole = whole(grid, of);
    let over = format!("{} across, {} up", x.field.label, y.field.label);
    let at_most = if map.upper && of.is_risk() { "upper end of " } else { "" };
    let [label, short] = [of.label(), of.row().short].map(|of| capital(&format!("{at_most}{of}")));
    let titles = [
        format!("What if? {label}: {over}"),
        format!("What if? {short}: {over}"),
        format!("{short}: {over}"),
        format!("What if? {label}"),
        format!("What if? {short}"),
        "What if?".to_owned(),
    ];
    let titles = titles.each_ref().map(String::as_str);
    let known = grid.map_or_else(String::new, |grid| format!("{} runs", grid.known().0));
    let stopped = map.task.complaint.as_ref().map(|(_, why)| why.as_str());
    let (said, style) = state_of_work(map.task.pace(Some(SIDE * SIDE)), stopped, known, theme);
    sheet.put_both((&titles, theme.heading()), (&said, style));
    let (wide, high) = (LABELS + 2, BELOW + 1);
    let size = (area.width.saturating_sub(wide), area.height.saturating_sub(high));
    let field = sheet.part((LABELS + 1, 1), size).area;
    if field.width < 10 || field.height < 4 {
        sheet.put((1, 1), "too small for the map", theme.warning());
        return;
    }
    axes(spans, field, sheet);
    let mut drawn = BTreeSet::new();
    if let Some(grid) = grid {
        let cells = Cells { grid, of, whole, field, upper: map.upper };
        for at in field.positions().map(|at| (at.x - field.x, at.y - field.y)) {
            let (sign, style) = cells.drawn(at, theme);
            sheet.at(field).put(at, sign, style);
            drawn.insert(sign);
        }
        cells.write_figures(&mut sheet.at(field));
        let share = |span: Span| {
            let (value, _) = number(span.field, &model.work.scenario)?;
            let share = (value - span.from) / (span.to - span.from);
            (0.0..=1.0).contains(&share).then_some(share)
        };
        if let (Some(x), Some(y)) = (share(x), share(y)) {
            sheet.at(field).put(cell_at((x, y), field), "o", theme.warning());
        }
    }
    let cursor = theme.focus().patch(theme.strong());
    let mut map_sheet = sheet.at(field);
    let place = map_sheet.cell(cell_at(map.place(), field));
    place.set_style(Style::reset()).set_symbol("X").set_style(cursor);
    let room = usize::from(area.width - 2);
    let lines = wrapped(&reading(map, model), room).into_iter().take(2);
    sheet.put_lines((1, area.height - BELOW + 2), lines, theme.strong());
    let unit = of.row().unit;
    let steps = if whole == 100.0 && unit == "%" {
        "tens of %".to_owned()
    } else {
        format!("steps of {}", with_unit(&rounded(0.1 * whole).to_string(), unit))
    };
    let mut legend = format!("{LINE} lines");
    for (sign, words) in [(ABOVE, "above that"), (FOLDED, "mesh folded")] {
        if drawn.contains(&sign) {
            legend.extend(["  ", sign, " ", words]);
        }
    }
    legend += "  o your blow";
    let row = &mut sheet.row(area.height - 1);
    let after = match (theme.is_mono(), of.row().risk) {
        (true, _) => row.put((1, 0), format!("0-9: {steps}"), theme.quiet()),
        (false, true) => ladder(row),
        (false, false) => ramp(whole, unit, row),
    };
    let room = usize::from(area.width.saturating_sub(after + 3));
    row.put((after + 2, 0), fitted(&legend, room), theme.quiet());
}

/// The steps of risk in their words; gives the column after them.
fn ladder(sheet: &mut Sheet) -> u16 {
    let theme = sheet.theme;
    LADDER.into_iter().fold(1, |x, (risk, words)| {
        let x = sheet.put((x, 0), "  ", theme.told(risk).reversed());
        sheet.put((x + 1, 0), words, theme.quiet()) + 1
    })
}

/// The colours of a scale from 0 to its whole; gives the column after them.
fn ramp(whole: f64, unit: &str, sheet: &mut Sheet) -> u16 {
    let theme = sheet.theme;
    let x = sheet.put((1, 0), "0 ", theme.quiet());
    let shade = |i: u16| Style::new().fg(theme.part(Part::Globe, step(f64::from(i) / 10.0, 1.0)));
    let x = (0..=10).fold(x, |x, i| sheet.put((x, 0), " ", shade(i).reversed()));
    sheet.put((x + 1, 0), with_unit(&rounded(whole).to_string(), unit), theme.quiet())
}

/// The cell at a place on the map, from 0 to 1 across and up.
fn cell_at((x, y): (f64, f64), field: Rect) -> (u16, u16) {
    (along(x, field.width), along(1.0 - y, field.height))
}

/// The whole scale: the result's, or 1, 2 or 5 times a power of ten that no value exceeds.
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

/// A result on the map, as it is drawn in cells.
struct Cells<'a> {
    grid: &'a Grid,
    of: Quantity,
    whole: f64,
    field: Rect,
    /// Whether the upper end of a risk is drawn.
    upper: bool,
}

impl Cells<'_> {
    fn reading(&self, (column, row): (u16, u16)) -> Option<MapReading> {
        let x = f64::from(column) / f64::from(self.field.width - 1);
        let y = 1.0 - f64::from(row) / f64::from(self.field.height - 1);
        let reading = self.grid.read(self.of, (x, y))?;
        let value = reading.range.filter(|_| self.upper).map_or(reading.value, |r| Some(r.1));
        Some(MapReading { value, ..reading })
    }

    /// The share of the whole scale at a cell.
    fn share(&self, at: (u16, u16)) -> Option<f64> {
        Some(self.reading(at)?.value? / self.whole)
    }

    fn drawn(&self, at: (u16, u16), theme: Theme) -> (&'static str, Style) {
        const DIGITS: [&str; 10] = ["0", "1", "2", "3", "4", "5", "6", "7", "8", "9"];
        let Some(reading) = self.reading(at) else { return (" ", theme.quiet()) };
        let Some(value) = reading.value.map(|value| value / self.whole) else {
            return ("·", theme.quiet());
        };
        let next = [(at.0 + 1, at.1), (at.0, at.1 + 1)];
        let inside = |(x, y): &(u16, u16)| *x < self.field.width && *y < self.field.height;
        let mut next = next.into_iter().filter(inside).filter_map(|next| self.share(next));
        let crosses = |other: f64| LINES.iter().any(|level| (other < *level) != (value < *level));
        let line = next.any(crosses);
        if reading.folded {
            return (FOLDED, theme.quiet());
        }
        // A risk looks as it does on every screen; of what is none, more is lighter.
        let row = self.of.row();
        let heat = if row.risk {
            theme.told(value * self.whole / 100.0)
        } else {
            Style::new().fg(theme.part(Part::Globe, step(value.min(1.0), 1.0)))
        };
        // Where colours shade the map, lines lie on them and digits would only be noise.
        let shaded = !theme.is_mono();
        match value {
            _ if line && shaded => (LINE, heat.add_modifier(Modifier::REVERSED)),
            _ if line => (LINE, theme.strong()),
            value if value > 1.0 => (ABOVE, if shaded { heat.reversed() } else { heat }),
            _ if shaded => (" ", heat.reversed()),
            value => (DIGITS[((value * 10.0).max(0.0) as usize).min(9)], heat),
        }
    }

    /// Writes on each line its figure, on rows of their own.
    fn write_figures(&self, sheet: &mut Sheet) {
        let field = self.field;
        for (i, level) in (1..).zip(LINES) {
            let crossing = |row: u16| {
                (1..field.width).find(|column| {
                    let [before, here] = [column - 1, *column].map(|x| self.share((x, row)));
                    before.zip(here).is_some_and(|(a, b)| (a < level) != (b < level))
                })
            };
            let wanted = field.height * i / (LINES.len() as u16 + 2);
            let mut rows: Vec<u16> = (0..field.height).collect();
            rows.sort_by_key(|row| row.abs_diff(wanted));
            let mut crossings = rows.into_iter().filter_map(|row| Some((row, crossing(row)?)));
            let Some((row, column)) = crossings.next() else { continue };
            let figure = rounded(level * self.whole).to_string();
            let text = format!(" {} ", with_unit(&figure, self.of.row().unit));
            let left = column.saturating_sub(width(&text) / 2);
            let left = left.min(field.width.saturating_sub(width(&text)));
            for x in 0..width(&text) {
                sheet.cell((left + x, row)).reset();
            }
            sheet.put((left, row), text, sheet.theme.strong());
        }
    }
}

/// A value of an input in as few digits as it takes, four at most.
fn short(value: f64) -> String {
    plain(significant(value).parse().unwrap_or(value))
}

fn axes([x, y]: [Span; 2], field: Rect, sheet: &mut Sheet) {
    let (area, theme) = (sheet.area, sheet.theme);
    let bottom = field.height;
    axis_lines(field, sheet);
    let middle = |span: Span| 0.5 * (span.from + span.to);
    for (row, value) in [(0, y.to), (bottom / 2, middle(y)), (bottom - 1, y.from)] {
        sheet.put_right((LABELS, 1 + row), short(value), theme.quiet());
    }
    let (left, row) = (LABELS + 1, 2 + bottom);
    sheet.put((left, row), short(x.from), theme.quiet());
    let text = format!("{} {}", short(middle(x)), x.field.unit);
    let at = (left + field.width / 2).saturating_sub(width(&text) / 2);
    sheet.put((at, row), text, theme.quiet());
    sheet.put_right((area.width - 1, row), short(x.to), theme.quiet());
    // Below the number at the top of its axis.
    sheet.put_right((LABELS, 2), y.field.unit, theme.quiet());
}

/// What is known under the cursor.
fn reading(map: &Map, model: &AppModel) -> String {
    let Some(inputs) = map.inputs() else { return String::new() };
    let value = map.grid(&model.work.scenario).and_then(|grid| {
        let of = map.quantity(grid);
        let reading = grid.read(of, map.place())?;
        let Some(value) = reading.value else {
            return reading.exact.then(|| "not allowed".to_owned());
        };
        let row = of.row();
        if row.risk && !reading.folded {
            // The points around it tell no more than where it about lies.
            let rough = if reading.exact { "" } else { ", between points that were computed" };
            let range = reading.range.map(|(low, high)| span((0.01 * low, 0.01 * high)));
            let range = range.map_or_else(String::new, |range| format!(" ({range})"));
            let told = whole_percent(0.01 * value);
            return Some(format!("{}: {told} of eyes hit so{range}{rough}", row.label));
        }
        let about = if reading.exact { "" } else { "about " };
        let folded = if reading.folded { ", but the mesh folded" } else { "" };
        let value = with_unit(&within(value, Some(MAPPED)), row.unit);
        Some(format!("{} {about}{value}{folded}", row.label))
    });
    let value = value.unwrap_or_else(|| "not known yet".to_owned());
    let [x, y] = inputs.map(|(span, value)| named(span, &short(value)));
    format!("X {x}, {y}: {value}")
}

/// An input with a value and its unit.
pub fn named(span: Span, value: &str) -> String {
    format!("{} {}", span.field.label, with_unit(value, span.field.unit))
}
