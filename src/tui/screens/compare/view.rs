//! Several presets: the list to mark, the table with overlaid curves, the replays on one clock.

use ratatui::layout::Rect;

use crate::answer::solve::Answer;
use crate::injury::Injury;
use crate::many::comparison::{ComparisonColumn, Entry, Found};
use crate::report::compare::{brief, which_is_worse};
use crate::report::figure::{Figure, Off};
use crate::report::sentence::verdict;
use crate::run::quantity::Quantity;
use crate::tui::screens::compare::comparison::{Alignment, Comparison, Marked};
use crate::tui::screens::compare::comparison::{FORM, LIST, REPLAYS, TABLE};
use crate::tui::screens::compare::comparison::{mesh_question, shown};
use crate::tui::view::chart::{TimeChart, TimeCurve, mark};
use crate::tui::view::risks::{SHORTEST, bare, draw_bar, longest, short_name};
use crate::tui::view::text::{fitted, longest_fitting, width, wrapped};
use crate::tui::view::{below, eye::EyePicture, raster::Ink, sheet::Sheet};
use crate::tui::{model::AppModel, shown::ShownAnswer};

pub const PANES: [&str; 3] = ["presets", "table", "replays"];

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

fn list_width(area: Rect) -> u16 {
    30.min(area.width / 2)
}

/// The rows of the list of presets that there is room for, each by its place in it.
fn listed(
    compare: &Comparison,
    model: &AppModel,
    area: Rect,
) -> impl Iterator<Item = (usize, Rect)> {
    // Below the names of the panes and what is said of all.
    let top = 1 + worse(compare, area.width).len();
    let first = compare.row.saturating_sub(usize::from(area.height).saturating_sub(top + 1));
    let rows = Rect { width: list_width(area), ..area }.rows().skip(top);
    (first..=model.choices.len()).zip(rows)
}

/// The place in the list of presets at a cell.
pub fn listed_at(
    compare: &Comparison,
    model: &AppModel,
    area: Rect,
    at: (u16, u16),
) -> Option<usize> {
    let mut rows = listed(compare, model, area).filter(|_| compare.pane == LIST);
    rows.find_map(|(place, row)| row.contains(at.into()).then_some(place))
}

/// The names of the panes, and at the right how far things are.
fn heading(compare: &Comparison, sheet: &mut Sheet) {
    let (area, theme) = (sheet.area, sheet.theme);
    for (i, (x, name)) in headings().enumerate() {
        let style = if i == compare.pane { theme.focus() } else { theme.text() };
        sheet.put((x, 0), &name, style);
    }
    let count = compare.entries.len();
    let answered = |entry: &&Marked| !matches!(entry.found, Found::Awaited);
    let done = compare.entries.iter().filter(answered).count();
    let open = compare.incomplete().count();
    let text = match (count, open) {
        (0, _) => "mark two to six".to_owned(),
        (1, _) => "mark one more".to_owned(),
        _ if done < count => format!("{done} of {count} simulated"),
        (_, 1..) => format!("mesh errors: {} of {count}", count - open),
        (_, 0) if compare.pane == REPLAYS => String::new(),
        (_, 0) => format!("{count} marked, w takes a page"),
    };
    sheet.put_right((area.width - 1, 0), text, theme.quiet());
}

fn with_list(compare: &Comparison, model: &AppModel, sheet: &mut Sheet) {
    let (area, theme) = (sheet.area, sheet.theme);
    heading(compare, sheet);
    let wide = list_width(area);
    for (i, row) in listed(compare, model, area) {
        let name = i.checked_sub(1).map_or(FORM, |at| &model.choices[at].name);
        let place = compare.place_of(name);
        let sign = place.map_or("[ ]".to_owned(), |at| format!("[{}]", mark(at)));
        let texts = [format!("{FORM} {}", model.work.name()), FORM.to_owned()];
        let called = match place {
            _ if name == FORM => longest_fitting(&texts, wide - 6),
            Some(at) => &compare.entries[at].name,
            None => name,
        };
        let row = &mut sheet.at(row);
        row.put((1, 0), sign, place.map_or(theme.text(), |at| theme.curve(at)));
        let style = if i == compare.row { theme.focus() } else { theme.text() };
        row.put((5, 0), fitted(brief(called), usize::from(wide) - 6), style);
    }
    let said = worse(compare, area.width);
    sheet.put_lines((1, 1), &said, theme.strong());
    let top = 1 + said.len() as u16;
    let charts = &mut sheet.part((wide, top), (area.width - wide, area.height - top));
    if compare.entries.is_empty() {
        let below = charts.put_wrapped((1, 1), "Which is worse?", theme.heading());
        let text = "Space marks the preset under the cursor, two to six in all.";
        let below = charts.put_wrapped((1, below + 1), text, theme.text());
        let text = "/ takes several at once, each with its speed:";
        let below = charts.put_wrapped((1, below + 1), text, theme.text());
        charts.put((3, below), "squash@30, paintball@80, bb", theme.strong());
    } else {
        side_by_side(compare, model, charts);
    }
}

/// The least rows of the chart below the table.
const CHART: u16 = 5;

fn with_table(compare: &Comparison, model: &AppModel, sheet: &mut Sheet) {
    let area = sheet.area;
    heading(compare, sheet);
    let count = compare.entries.len() as u16;
    let worse = worse(compare, area.width);
    let room = (area.height - 1).saturating_sub(worse.len() as u16);
    // What to believe gives way before the errors do, and those before the chart.
    let fits = |each: &u16| 2 + each * count + CHART <= room;
    let each = (1..=3).rev().find(fits).unwrap_or(1);
    let mut rows = (2 + each * count).min(room);
    table(compare, model, each, &mut sheet.part((0, 1), (area.width, rows)));
    sheet.put_lines((1, 1 + rows), &worse, sheet.theme.strong());
    rows += worse.len() as u16;
    let room = area.height - 1;
    let below = room - rows;
    if below >= CHART {
        overlaid(compare, model, &mut sheet.part((0, 1 + rows), (area.width, below)));
    }
}

/// Which is worse, in lines of an area so wide; none while some are being simulated.
fn worse(compare: &Comparison, wide: u16) -> Vec<String> {
    let said = which_is_worse(&compare.entries).filter(|_| compare.next().is_none());
    said.map_or_else(Vec::new, |said| wrapped(&said, usize::from(wide.saturating_sub(2))))
}

/// Columns of an injury's name, and of a told share with its range.
const INJURY: u16 = 14;
const SHARES: u16 = 13;

/// Each injury's bars side by side in the order of the table; the curves where no risks are told.
fn side_by_side(compare: &Comparison, model: &AppModel, sheet: &mut Sheet) {
    let (area, theme) = (sheet.area, sheet.theme);
    let told = || compare.entries.iter().filter_map(Entry::answer);
    if told().next().is_some() && told().flat_map(Answer::risks).next().is_none() {
        return overlaid(compare, model, sheet);
    }
    // What is marked, in the order of the table and wherever it stands in the list.
    let (mut x, mut y) = (1, 0);
    for at in compare.sorted() {
        let text = format!("{} {}", mark(at), brief(&compare.entries[at].name));
        if x > 1 && x + width(&text) > area.width {
            (x, y) = (1, y + 1);
        }
        x = sheet.put((x, y), text, theme.curve(at)) + 2;
    }
    y += 1;
    if told().next().is_none() {
        sheet.put((1, y), "simulating", theme.quiet());
        return;
    }
    let bar = (1 + INJURY + 2, area.width.saturating_sub(1 + INJURY + 2 + SHARES + 1));
    if y + 1 + (Injury::ALL.len() * compare.entries.len()) as u16 <= area.height {
        sheet.put((1, y), "of 100 eyes hit so", theme.quiet());
        sheet.put_right((area.width, y), "range: 8 of 10", theme.quiet());
        y += 1;
    }
    let order = compare.sorted();
    // A blank row between injuries where there is room for all.
    let rows = Injury::ALL.len() as u16 * order.len() as u16;
    let gap = u16::from(y + rows + Injury::ALL.len() as u16 <= area.height + 1);
    for injury in Injury::ALL {
        sheet.put((1, y), short_name(*injury), theme.text());
        for (at, row) in order.iter().zip(y..) {
            let entry = &compare.entries[*at];
            sheet.put((1 + INJURY, row), mark(*at).to_string(), theme.curve(*at));
            let risk = entry.answer().and_then(|answer| answer.risk(*injury));
            let Some(risk) = risk.filter(|risk| risk.usable) else {
                sheet.put_right((area.width, row), "not known", theme.quiet());
                continue;
            };
            let share = risk.hit;
            let style = theme.share(&share);
            let told = bare(&share.percent());
            let range = bare(&share.range());
            let figures = if told == range { told } else { format!("{told} ({range})") };
            sheet.put_right((area.width, row), figures, style);
            if bar.1 >= SHORTEST && row < area.height {
                draw_bar(&share, style, &mut sheet.part((bar.0, row), (bar.1, 1)));
            }
        }
        y += order.len() as u16 + gap;
    }
}

/// Columns of a number: room for the longest name and the mark of sorting.
const EACH: u16 = 10;
/// Room for the name that is never given to numbers.
const NAME: u16 = 20;

/// The results that fit, the one with the cursor among them, and where the column of each ends.
fn columns(compare: &Comparison, area: Rect) -> Vec<(Quantity, u16)> {
    let columns = compare.columns();
    let count = usize::from((area.width - NAME) / EACH).min(columns.len() - 1);
    let first = compare.column.clamp(count, columns.len() - 1) + 1 - count;
    let results = columns.into_iter().skip(first).filter_map(|column| match column {
        ComparisonColumn::Name => None,
        ComparisonColumn::Result(of) => Some(of),
    });
    results.zip((1..).map(|i| NAME + EACH * i)).take(count).collect()
}

fn table(compare: &Comparison, model: &AppModel, each: u16, sheet: &mut Sheet) {
    let (area, theme) = (sheet.area, sheet.theme);
    let numbers = columns(compare, area);
    let focused = compare.pane == TABLE && model.overlay.is_none();
    let heading = |column: ComparisonColumn, name: &str| {
        let sign = match compare.sorting() {
            Some((by, true)) if by == column => "▾",
            Some((by, false)) if by == column => "▴",
            _ => "",
        };
        let here = focused && column == compare.here();
        (format!("{sign}{name}"), if here { theme.focus() } else { theme.heading() })
    };
    let (text, style) = heading(ComparisonColumn::Name, "preset");
    sheet.put((1, 0), text, style);
    for (of, right) in &numbers {
        let (text, style) = heading(ComparisonColumn::Result(*of), of.row().short);
        sheet.put_right((*right, 0), text, style);
        sheet.put_right((*right, 1), of.row().unit, theme.quiet());
    }
    let hidden = compare.columns().len() - 1 - numbers.len();
    if hidden > 0 {
        sheet.put((1, 1), format!("←→ {hidden} more"), theme.quiet());
    }
    for (i, at) in compare.sorted().into_iter().enumerate() {
        let place = &mut sheet.part((0, 2 + each * i as u16), (area.width, each));
        row(&compare.entries[at], (at, &numbers), place);
        if focused && i == compare.entry {
            place.put((0, 0), "▸", theme.strong());
        }
    }
}

/// The answer of an entry, or else it is said at a cell why there is none.
fn answered<'a>(entry: &'a Marked, at: (u16, u16), sheet: &mut Sheet) -> Option<&'a ShownAnswer> {
    let theme = sheet.theme;
    match &entry.found {
        Found::Answer(shown) => return Some(shown),
        Found::Awaited => sheet.put(at, "simulating", theme.quiet()),
        Found::Refused(why) => {
            let room = sheet.area.width.saturating_sub(at.0 + 1);
            sheet.put(at, fitted(why, room.into()), theme.error())
        }
    };
    None
}

fn row(entry: &Marked, (place, numbers): (usize, &[(Quantity, u16)]), sheet: &mut Sheet) {
    let (area, theme) = (sheet.area, sheet.theme);
    let room = usize::from(NAME) - 3;
    sheet.put((1, 0), mark(place).to_string(), theme.curve(place));
    sheet.put((3, 0), fitted(brief(&entry.name), room), theme.strong());
    // In a row of one line what there is to say stands beside the name.
    let said = if area.height < 2 { (NAME, 0) } else { (3, 1) };
    let Some(ShownAnswer { answer, .. }) = answered(entry, said, sheet) else { return };
    let style = if answer.spoiled().is_some() { theme.quiet() } else { theme.text() };
    let mesh_comes = mesh_question(entry).is_some();
    for (of, right) in numbers {
        let (value, error) = cell(answer, *of, mesh_comes);
        sheet.put_right((*right, 0), &value, style);
        sheet.put_right((*right, 1), &error, theme.quiet());
    }
    if !answer.flags.is_empty() {
        let flags = answer.flags.iter().map(|flag| flag.kind.words());
        let plural = if answer.flags.len() == 1 { "" } else { "s" };
        let texts = [
            flags.collect::<Vec<_>>().join(", "),
            format!("{} warning{plural}", answer.flags.len()),
        ];
        sheet.put((3, 1), longest_fitting(&texts, room as u16), theme.warning());
    }
    // What to believe of the gravest injury, in the longest words that there is room for.
    let room = usize::from(area.width) - 4;
    let belief = match answer.risks().first() {
        Some(risk) => longest(risk, room),
        None => fitted(&verdict(answer), room),
    };
    sheet.put((3, 2), belief, theme.text());
}

/// A result and its error, which the mesh may still add to; a risk and its range.
fn cell(answer: &Answer, of: Quantity, mesh_comes: bool) -> (String, String) {
    if let Some(risk) = Injury::of(of).and_then(|injury| answer.risk(injury)) {
        return [risk.middle(), risk.range()].map(|said| bare(&said)).into();
    }
    let Some(Figure { number, off, .. }) = Figure::of(answer, of) else {
        return ("-".to_owned(), String::new());
    };
    let comes = mesh_comes && answer.errors.mesh.is_none() && matches!(off, Off::Known(_));
    (number, if comes { "mesh …".to_owned() } else { off.to_string().replace(' ', "") })
}

/// One curve of every entry in one chart.
fn overlaid(compare: &Comparison, model: &AppModel, sheet: &mut Sheet) {
    let (theme, course) = (sheet.theme, compare.curve());
    let row = course.row();
    let Some(window) = compare.window() else { return };
    // Each on the time of the first.
    let times = compare.entries.iter().map(|entry| {
        let answer = entry.answer()?;
        let shift = compare.shift(answer);
        let times = answer.run.traces.as_ref()?.time.iter();
        Some(times.map(|time| time - shift).collect::<Vec<f64>>())
    });
    let times: Vec<_> = times.map(Option::unwrap_or_default).collect();
    let (mut labels, mut curves) = (Vec::new(), Vec::new());
    for (i, (entry, time)) in compare.entries.iter().zip(&times).enumerate() {
        let Some(traces) = entry.answer().and_then(|answer| answer.run.traces.as_ref()) else {
            continue;
        };
        // What drives the eye is a load for some and a contact for others.
        labels.push(course.label(traces));
        let values = course.values(traces);
        if !values.is_empty() {
            let ink = Ink::solid(theme.curve(i), 2 + i as u8, mark(i));
            // Without colours, dots of different spacing tell the curves apart.
            let ink = if theme.is_mono() { ink.dotted(1 + (i % 4) as u8) } else { ink };
            curves.push(TimeCurve { time, values, factor: row.factor, ink });
        }
    }
    labels.sort_unstable_by(|a, b| b.cmp(a));
    labels.dedup();
    let cursor = compare.time(model);
    let ms = format!("{:.3} ms", cursor * 1e3);
    let title = &format!("{}, {}", labels.join(" or "), row.unit);
    let reading = &match compare.alignment {
        Alignment::Clock => ms,
        other => format!("{}, {ms}", other.words()),
    };
    TimeChart { title, reading, curves, span: (0.0, window), cursor }.draw(sheet);
}

/// Side by side, all at the same time and on the same scale of force.
fn replays(compare: &Comparison, model: &AppModel, sheet: &mut Sheet) {
    let (area, theme) = (sheet.area, sheet.theme);
    heading(compare, sheet);
    let entries = &compare.entries;
    if entries.is_empty() {
        return;
    }
    // All are filled with the same on one scale, as far as they have it.
    let answers = || entries.iter().filter_map(shown);
    let largest = answers().map(|shown| shown.hottest).fold(0.0, f64::max);
    let wanted = answers().find_map(|shown| model.clock.field(&shown.fields));
    let wanted = wanted.map(|(field, _)| field);
    let own = |shown: &ShownAnswer| {
        shown.fields.iter().copied().find(|(field, _)| Some(*field) == wanted)
    };
    let end = answers().filter_map(own).map(|(_, end)| end).fold(0.0, f64::max);
    let field = |shown: &ShownAnswer| {
        let own = own(shown).map(|(field, _)| (field, end));
        own.or_else(|| model.clock.field(&shown.fields))
    };
    let zoom = match model.clock.zoom() {
        1 => String::new(),
        times => format!("  shown {times}x larger"),
    };
    let (time, aligned) = (compare.time(model), compare.alignment.words());
    let text = format!("{:.3} ms{zoom}  {aligned}", time * 1e3);
    sheet.put_right((area.width - 1, 0), &text, theme.strong());
    let count = entries.len() as u16;
    let rows = if count > 3 { 2 } else { 1 };
    let mut pictures = sheet.at(below(area, 1));
    for (i, entry) in entries.iter().enumerate() {
        let place = &mut pictures.tile(i, (count.div_ceil(rows), rows));
        let (width, height) = (place.area.width, place.area.height);
        let name = fitted(brief(&entry.name), usize::from(width) - 4);
        place.put((1, 0), mark(i).to_string(), theme.curve(i));
        place.put((3, 0), name, theme.strong());
        let Some(shown) = answered(entry, (1, 2), place) else { continue };
        let time = time + compare.shift(&shown.answer);
        let time = time.clamp(0.0, shown.answer.window());
        let picture = place.part((0, 1), (width - 1, height - 1));
        let (field, blow) = (field(shown), Some(&entry.scenario));
        let drawn = EyePicture { largest, field, blow, ..EyePicture::of(model, shown, time) };
        drawn.draw(picture.area, picture.buffer);
    }
}
