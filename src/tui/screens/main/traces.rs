//! The curves of the main screen: force of contact, pressure and stretch of an eye that is hit, the
//! node forces of the paper's, each with its peak, its error and its zero line.

use crate::answer::solve::Answer;
use crate::report::figure::{Figure, with_unit};
use crate::run::{kept::Peak, quantity::Quantity, trace::Trace};
use crate::tui::view::chart::{TimeChart, TimeCurve, active, colour_of, spark};
use crate::tui::view::text::width;
use crate::tui::{model::AppModel, shown::ShownAnswer, view::raster::Ink, view::sheet::Sheet};

/// The results drawn beside the eye: node forces where asked for or where there is nothing else.
fn sparks(answer: &Answer, nodes: bool) -> Vec<(Quantity, Peak)> {
    let peaks = |all: &[Quantity]| -> Vec<(Quantity, Peak)> {
        all.iter().filter_map(|q| Some((*q, answer.peak(*q)?))).collect()
    };
    let felt = peaks(&Quantity::FELT);
    if nodes || felt.is_empty() { peaks(&Quantity::FORCES) } else { felt }
}

/// From so many columns on there may be room for the time of a peak beside it.
const TIMED: u16 = 26;
/// The fewest columns of the curves: a name, a figure and its error.
pub const NARROWEST: u16 = 20;
/// Longer names are cut where room is short.
const LONGEST: usize = 7;

/// The name of a curve, its peak with its error, and the time of that, as they fit. Where room is
/// short spaces give way, then letters of the name, the time, and at last the error.
fn caption(of: Quantity, figure: &Figure, peak: Peak, room: u16) -> (String, String, String) {
    let name = of.row().short;
    let label = of.row().trace.map_or(name, |trace| trace.label);
    let brief = match name.get(..LONGEST - 2) {
        Some(start) if name.len() > LONGEST => &format!("{start}."),
        _ => name,
    };
    let ms = peak.time * 1e3;
    let times = [format!("at {ms:.3} ms"), format!("{ms:.3}ms"), format!("{ms:.2}ms")];
    let times = times.into_iter().filter(|_| room >= TIMED);
    let (unit, off) = figure.unit_and_error();
    let tight = format!("{} {off}", with_unit(&figure.cell(), unit));
    let tight = tight.trim_end().replace(" %", "%");
    let close = tight.replace(&format!(" {}", figure.unit), figure.unit);
    let closest = close.replace(' ', "").replace('±', " ±");
    let texts = [figure.to_string(), tight, close, closest];
    let small = figure.off.percent().is_some_and(|error| error < 1.0);
    let error = off.replace(' ', "");
    let least = if small { "±<1%" } else { &error };
    let mut candidates = Vec::new();
    for time in times.chain([String::new()]) {
        for name in [label, name, brief] {
            for text in &texts {
                candidates.push((name.to_owned(), text.clone(), time.clone()));
            }
        }
    }
    for (count, error) in [(3, &error[..]), (2, &error), (2, least), (2, "")] {
        let number = figure.coarser(count).signed().replace(' ', "");
        let text = format!("{number} {error}").trim_end().to_owned();
        candidates.push((brief.to_owned(), text, String::new()));
    }
    let fits = |(name, text, time): &&(String, String, String)| {
        let after = if time.is_empty() { 0 } else { width(time) + 1 };
        width(name) + 1 + width(text) + after <= room
    };
    candidates.iter().find(fits).or(candidates.last()).cloned().unwrap_or_default()
}

/// Draws the curves, each with its peak and when it came, and below them their time.
pub fn draw(model: &AppModel, (shown, nodes): (&ShownAnswer, bool), sheet: &mut Sheet) {
    let (area, theme) = (sheet.area, sheet.theme);
    let Some(recorded) = &shown.answer.run.traces else { return };
    let sparks = sparks(&shown.answer, nodes);
    let values = |of: &Quantity| Trace::Of(*of).values(recorded);
    let drawn = sparks.iter().map(|(of, _)| values(of));
    let window = shown.answer.window();
    // What comes before is little, and the eye beside it begins at rest.
    let span = (0.0, active(&recorded.time, drawn, window).1);
    let count = sparks.len().max(1) as u16;
    let mut height = area.height;
    if height > 2 * count {
        height -= 1;
        sheet.put((0, height), "0", theme.quiet());
        let end = format!("{:.1} ms", span.1 * 1e3);
        sheet.put_right((area.width, height), end, theme.quiet());
    }
    let each = (height / count).max(1);
    let spoiled = shown.answer.spoiled().is_some();
    let style = if spoiled { theme.quiet() } else { theme.strong() };
    for (i, (quantity, peak)) in sparks.into_iter().enumerate() {
        let top = each * i as u16;
        let Some(figure) = Figure::of(&shown.answer, quantity) else { continue };
        if top >= height {
            break;
        }
        let (label, value, time) = caption(quantity, &figure, peak, area.width);
        sheet.put((0, top), &label, theme.heading());
        sheet.put_right((area.width, top), &time, theme.quiet());
        let beside = if time.is_empty() { 0 } else { width(&time) + 1 };
        sheet.put_right((area.width - beside, top), &value, style);
        let values = values(&quantity);
        if each < 2 || values.is_empty() {
            continue;
        }
        let (time, ink) =
            (&recorded.time, Ink::solid(theme.curve(colour_of(Trace::Of(quantity))), 1, '*'));
        let curve = TimeCurve { time, values, factor: 1.0, ink };
        let field = &mut sheet.part((0, top + 1), (area.width, each - 1));
        spark(curve, span, model.time(), field);
        if area.width < TIMED {
            // The peaks come early, so the end of the curve has room for a word.
            let time = format!(" {:.3} ms", peak.time * 1e3);
            field.put_right((area.width, 0), &time, theme.quiet());
        }
    }
}

/// Draws with axes what else there is over time: stress of the wall, way of the cornea, or growth.
pub fn charts(model: &AppModel, shown: &ShownAnswer, sheet: &mut Sheet) {
    let theme = sheet.theme;
    let Some(traces) = &shown.answer.run.traces else { return };
    let of = [Quantity::ScleralStress, Quantity::Apex, Quantity::ShellGrowth];
    let there = |of: &Quantity| !Trace::Of(*of).values(traces).is_empty();
    let there: Vec<Quantity> = of.into_iter().filter(there).take(2).collect();
    let rows = there.len() as u16;
    for (i, of) in there.into_iter().enumerate() {
        let (course, row) = (Trace::Of(of), of.row());
        let values = course.values(traces);
        let reading = Figure::of(&shown.answer, of).map(|figure| format!("peak {figure}"));
        let (time, ink) = (&traces.time, Ink::solid(theme.curve(colour_of(course)), 2, '*'));
        let span = active(time, std::iter::once(values), shown.answer.window());
        let curves = vec![TimeCurve { time, values, factor: row.factor, ink }];
        let title = &format!("{}, {}", course.label(traces), row.unit);
        let reading = &reading.unwrap_or_default();
        let chart = TimeChart { title, reading, curves, span, cursor: model.time() };
        chart.draw(&mut sheet.tile(i, (1, rows)));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::figure::Off;

    #[test]
    fn a_caption_keeps_its_parts_apart_and_its_error() {
        for &quantity in Quantity::FELT.iter().chain(&Quantity::FORCES) {
            for (number, error) in [("12", 35.0), ("5199", 0.016), ("0.20", 0.42), ("73", 119.0)] {
                let (number, unit) = (number.to_owned(), quantity.row().unit);
                let figure = Figure { number, unit, off: Off::Known(error), cut: None };
                let peak = Peak { value: 1.0, time: 12.345e-3 };
                for room in NARROWEST..50 {
                    let (label, value, time) = caption(quantity, &figure, peak, room);
                    let long = width(&label) + 1 + width(&value);
                    let after = if time.is_empty() { 0 } else { width(&time) + 1 };
                    assert!(long + after <= room, "{label} {value} {time} in {room}");
                    assert!(value.contains('±'), "{label} {value} in {room}");
                }
            }
        }
    }
}
