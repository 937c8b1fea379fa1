//! Curves over time: bare ones for the main screen, and charts with axes.

use ratatui::layout::Rect;
use ratatui::widgets::{Block, Borders, Widget};

use crate::report::format::trimmed;
use crate::run::quantity::Quantity;
use crate::run::trace::{TRACES, Trace};
use crate::tui::view::raster::{Ink, Raster};
use crate::tui::view::sheet::{Sheet, along};
use crate::tui::view::{text::width, theme::Theme};

/// From and to.
type Ends = (f64, f64);

/// A curve over time.
pub struct TimeCurve<'a> {
    /// Times in s.
    pub time: &'a [f64],
    /// Its values in SI, one for each time.
    pub values: &'a [f64],
    /// From the values to the unit on show.
    pub factor: f64,
    /// How it looks.
    pub ink: Ink,
}

/// The value of a curve at a time, between its samples; `None` outside them.
pub fn value_at(time: &[f64], values: &[f64], at: f64) -> Option<f64> {
    let after = time.partition_point(|t| *t < at);
    if after == 0 {
        return values.first().copied();
    }
    let (t0, t1) = (time[after - 1], *time.get(after)?);
    let share = if t1 > t0 { (at - t0) / (t1 - t0) } else { 1.0 };
    Some(values[after - 1] + share * (values[after] - values[after - 1]))
}

/// A curve does something while it is above this share of its largest value.
const ACTIVE: f64 = 0.02;
/// Left before and after, as a share of the whole.
const LEFT: f64 = 0.03;

/// From when to when something happens in any of some values, of all times up to `window`.
pub fn active<'a>(time: &[f64], values: impl Iterator<Item = &'a [f64]>, window: f64) -> Ends {
    let ends = values.filter_map(|values| {
        let largest = values.iter().fold(0.0, |most: f64, v| most.max(v.abs()));
        let high = |value: &f64| value.abs() > ACTIVE * largest;
        Some((time[values.iter().position(high)?], time[values.iter().rposition(high)?]))
    });
    let Some((first, last)) = ends.reduce(|a, b| (a.0.min(b.0), a.1.max(b.1))) else {
        return (0.0, window);
    };
    let left = LEFT * window;
    // A short time before the contact is no reason to leave out the beginning.
    let from = if first < 2.0 * left { 0.0 } else { first - left };
    (from, (last + left).min(window))
}

/// The range of several curves over a span of time, 0 among them.
fn range(curves: &[TimeCurve], (from, to): Ends) -> Ends {
    let mut range = (0.0_f64, 0.0_f64);
    for curve in curves {
        let seen = curve.time.iter().zip(curve.values).filter(|(t, _)| (from..=to).contains(*t));
        for value in seen.map(|(_, value)| value * curve.factor) {
            range = (range.0.min(value), range.1.max(value));
        }
    }
    range
}

/// Draws curves over a span of time. A column of dots spans all its values, so no peak is lost.
fn plot(raster: &mut Raster, curves: &[TimeCurve], span: Ends, range: Ends, filled: bool) {
    let ((start, end), (low, high)) = (span, range);
    let (columns, rows) = raster.size();
    let span = if high > low { high - low } else { 1.0 };
    let row = |value: f64| f64::from(rows - 1) * (1.0 - (value - low) / span);
    let wider = |(top, bottom): Ends, row: f64| (top.min(row), bottom.max(row));
    for curve in curves {
        let mut previous: Option<f64> = None;
        for column in 0..columns {
            let at = |column: i32| start + (end - start) * f64::from(column) / f64::from(columns);
            let (from, to) = (at(column), at(column + 1));
            let begin = curve.time.partition_point(|t| *t < from);
            let end = curve.time.partition_point(|t| *t < to);
            let inside = curve.values[begin..end].iter().copied();
            let between = |at: f64| value_at(curve.time, curve.values, at);
            let rows = between(from).into_iter().chain(inside).map(|v| row(v * curve.factor));
            let ends = rows.fold((f64::INFINITY, f64::NEG_INFINITY), wider);
            if ends.0 > ends.1 {
                break;
            }
            let (top, mut bottom) = previous.into_iter().fold(ends, wider);
            if filled {
                bottom = bottom.max(row(0.0));
            }
            previous = between(to).map(|value| row(value * curve.factor));
            let x = f64::from(column) + 0.5;
            if column % i32::from(curve.ink.every) == 0 {
                let ink = Ink { every: 1, ..curve.ink };
                raster.line((x, top.round() + 0.5), (x, bottom.round() + 0.5), ink);
            }
        }
    }
}

/// Draws where a range has its zero.
fn zero_line(raster: &mut Raster, (low, high): Ends, theme: Theme) {
    let (columns, rows) = raster.size();
    let share = if high > low { high / (high - low) } else { 1.0 };
    let zero = (f64::from(rows - 1) * share).round() + 0.5;
    let line = Ink::solid(theme.quiet(), 0, '-').dotted(2);
    raster.line((0.0, zero), (f64::from(columns - 1), zero), line);
}

/// A curve with its zero line, with a mark at the present moment below it.
pub fn spark(curve: TimeCurve, span: Ends, now: f64, sheet: &mut Sheet) {
    let (area, theme) = (sheet.area, sheet.theme);
    let mut raster = Raster::new(area, theme.look.symbols);
    let curves = [curve];
    let range = range(&curves, span);
    zero_line(&mut raster, range, theme);
    plot(&mut raster, &curves, span, range, true);
    raster.paint(sheet.buffer);
    let share = ((now - span.0) / (span.1 - span.0)).clamp(0.0, 1.0);
    if area.height > 0 {
        let cell = sheet.cell((along(share, area.width.max(1)), area.height - 1));
        if cell.symbol() == " " {
            cell.set_char('▴');
        }
        cell.set_style(theme.cursor());
    }
}

/// A curve over the whole of a raster, filled down to 0.
pub fn fill(raster: &mut Raster, curve: TimeCurve, window: f64) {
    let (curves, span) = ([curve], (0.0, window));
    plot(raster, &curves, span, range(&curves, span), true);
}

/// Several curves with axes and a cursor.
pub struct TimeChart<'a> {
    /// Above it, from the left.
    pub title: &'a str,
    /// Above it, from the right.
    pub reading: &'a str,
    /// What it shows.
    pub curves: Vec<TimeCurve<'a>>,
    /// The ends of the time axis, in s.
    pub span: Ends,
    /// The cursor, in s.
    pub cursor: f64,
}

/// Room for the numbers of the value axis.
const LABELS: u16 = 7;

impl TimeChart<'_> {
    /// Draws the chart with its axes, its curves and its cursor.
    pub fn draw(&self, sheet: &mut Sheet) {
        let (area, theme) = (sheet.area, sheet.theme);
        if area.height < 4 || area.width < LABELS + 8 {
            return;
        }
        let end = sheet.put((LABELS, 0), self.title, theme.heading());
        if end + width(self.reading) < area.width {
            sheet.put_right((area.width, 0), self.reading, theme.cursor());
        }
        let size = (area.width - LABELS - 1, area.height - 3);
        let field = sheet.part((LABELS + 1, 1), size).area;
        let (low, high) = range(&self.curves, self.span);
        let (low, high) = if high > low { (low, high) } else { (low, low + 1.0) };
        let (first, last) = (self.span.0 * 1e3, self.span.1 * 1e3);
        let up = ticks(low, high, (field.height / 3).clamp(2, 6)).into_iter();
        let up = up.map(|v| ((high - v) / (high - low), trimmed(v)));
        let across = ticks(first, last, (field.width / 9).clamp(2, 10)).into_iter();
        let across = across.map(|v| ((v - first) / (last - first), trimmed(v)));
        axes(field, (up, across), 0, sheet);
        let mut raster = Raster::new(field, theme.look.symbols);
        let (columns, rows) = raster.size();
        let (start, end) = self.span;
        if (start..=end).contains(&self.cursor) {
            let at = (self.cursor - start) / (end - start) * f64::from(columns - 1);
            let line = Ink::solid(theme.cursor(), 0, '|').dotted(2);
            raster.line((at, 0.0), (at, f64::from(rows - 1)), line);
        }
        zero_line(&mut raster, (low, high), theme);
        plot(&mut raster, &self.curves, self.span, (low, high), false);
        raster.paint(sheet.buffer);
    }
}

/// Draws two axes round a field: the places of the labels upwards, from 0 at the top, and across,
/// from the left, each with what it says; `margin` columns from the right edge the unit of time.
pub fn axes(
    field: Rect,
    (up, across): (impl Iterator<Item = (f64, String)>, impl Iterator<Item = (f64, String)>),
    margin: u16,
    sheet: &mut Sheet,
) {
    let (area, quiet) = (sheet.area, sheet.theme.quiet());
    let (left, top) = (field.x - area.x, field.y - area.y);
    let bottom = top + field.height;
    axis_lines(field, sheet);
    for (share, label) in up {
        let y = top + along(share, field.height);
        sheet.put_right((left - 1, y), label, quiet);
        sheet.put((left - 1, y), "┤", quiet);
    }
    let mut free = 0;
    for (share, label) in across {
        let (x, wide) = (left + along(share, field.width), width(&label));
        let begin = x.saturating_sub(wide / 2).min(area.width - wide);
        sheet.put((x, bottom), "┬", quiet);
        if begin >= free && begin + wide + 3 + margin <= area.width {
            free = sheet.put((begin, bottom + 1), label, quiet) + 1;
        }
    }
    sheet.put_right((area.width - margin, bottom + 1), "ms", quiet);
}

/// The lines of two axes, at the left of a field and below it.
pub fn axis_lines(field: Rect, sheet: &mut Sheet) {
    let theme = sheet.theme;
    let place = Rect::new(field.x - 1, field.y, field.width + 1, field.height + 1);
    let lines = Block::new().borders(Borders::LEFT | Borders::BOTTOM);
    lines.border_style(theme.quiet()).render(place, sheet.buffer);
}

/// Round numbers between two bounds, about so many.
fn ticks(low: f64, high: f64, count: u16) -> Vec<f64> {
    let raw = (high - low) / f64::from(count);
    if !(raw.is_finite() && raw > 0.0) {
        return Vec::new();
    }
    let power = 10f64.powf(raw.log10().floor());
    let mut round = [1.0, 2.0, 5.0].into_iter().map(|m| m * power);
    let step = round.find(|step| *step >= raw * 0.999).unwrap_or(10.0 * power);
    let first = (low / step - 1e-9).ceil() as i64;
    let last = (high / step + 1e-9).floor() as i64;
    (first..=last).map(|i| i as f64 * step).collect()
}

/// Which of the colours of curves a course has wherever it is drawn by itself: what an eye feels
/// one each, the rest its place among its likes.
pub fn colour_of(course: Trace) -> usize {
    if let Trace::Of(of) = course
        && let Some(place) = Quantity::FELT.iter().position(|felt| *felt == of)
    {
        return place;
    }
    let likes = TRACES.iter().filter(|other| other.row().place.0 == course.row().place.0);
    Quantity::FELT.len() + likes.take_while(|other| **other != course).count()
}

/// Tells curves apart in ASCII and in legends without colour.
pub fn mark(index: usize) -> char {
    ['1', '2', '3', '4', '5', '6'][index % 6]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ticks_are_round_and_inside() {
        assert_eq!(ticks(0.0, 3.0, 3), [0.0, 1.0, 2.0, 3.0]);
        assert_eq!(ticks(0.0, 72.9, 3), [0.0, 50.0]);
        assert_eq!(ticks(-1.0, 1.0, 4), [-1.0, -0.5, 0.0, 0.5, 1.0]);
        assert!(ticks(0.0, 0.0, 3).is_empty());
    }

    #[test]
    fn a_chart_goes_from_the_first_to_the_last_that_happens() {
        let time: Vec<f64> = (0..=100).map(f64::from).collect();
        let during = |from: usize, to: usize| -> Vec<f64> {
            (0..=100).map(|i: usize| if (from..=to).contains(&i) { -5.0 } else { 0.05 }).collect()
        };
        let (early, late, nothing) = (during(3, 20), during(40, 60), vec![0.0; 101]);
        let of = |values: &[&Vec<f64>]| active(&time, values.iter().map(|v| &v[..]), 100.0);
        assert_eq!(of(&[&early, &nothing]), (0.0, 23.0));
        assert_eq!(of(&[&late]), (37.0, 63.0));
        assert_eq!(of(&[&late, &early]), (0.0, 63.0));
        assert_eq!(of(&[&nothing]), (0.0, 100.0));
    }

    #[test]
    fn values_between_samples_are_read_by_the_cursor() {
        let (time, values) = ([0.0, 1.0, 2.0], [0.0, 10.0, 0.0]);
        assert_eq!(value_at(&time, &values, 0.5), Some(5.0));
        assert_eq!(value_at(&time, &values, 2.0), Some(0.0));
        assert_eq!(value_at(&time, &values, 2.5), None);
        assert_eq!(value_at(&[], &[], 0.0), None);
    }
}
