//! The one screen that answers the question at the bedside: form, eye, traces, score.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;

use super::DIAL;
use super::{form, score};
use crate::recording::Peak;
use crate::report::text::digits;
use crate::study::course::Course;
use crate::study::{Answer, Quantity};
use crate::tui::model::{Model, Shown};
use crate::tui::screens::replay::pressures;
use crate::tui::view::chart::{Curve, spark};
use crate::tui::view::eye::Scene;
use crate::tui::view::raster::Ink;
use crate::tui::view::text::{put, put_right, width};
use crate::tui::view::theme::Theme;

/// Where the parts of the screen are.
pub struct Layout {
    /// The form.
    pub form: Rect,
    /// All at its right.
    right: Rect,
    /// The eye, below its caption.
    pub eye: Rect,
    traces: Rect,
    score: Rect,
}

/// Divides the screen.
pub fn layout(area: Rect) -> Layout {
    let left = match area.width {
        ..70 => 25,
        70..100 => 29,
        _ => 34,
    };
    let right = Rect::new(
        area.x + left + 1,
        area.y,
        area.width - left - 1,
        area.height,
    );
    let below = score::height(right.height);
    let upper = right.height - below;
    let wide = (upper * 2).min(right.width * 11 / 20);
    Layout {
        form: Rect {
            width: left,
            ..area
        },
        right,
        eye: Rect::new(right.x, right.y + 1, wide, upper - 1),
        traces: Rect::new(right.x + wide + 1, right.y, right.width - wide - 1, upper),
        score: Rect::new(right.x, right.y + upper, right.width, below),
    }
}

/// Draws the screen.
pub fn draw(model: &Model, area: Rect, buffer: &mut Buffer) {
    let theme = Theme::of(model.look);
    let parts = layout(area);
    form::draw(model, parts.form, buffer);
    for y in 0..area.height {
        put(buffer, area, (parts.form.width, y), "│", theme.line());
    }
    let Some(shown) = &model.shown else {
        waiting(model, parts.right, buffer);
        return;
    };
    eye(model, shown, parts.eye, buffer);
    sparklines(model, shown, parts.traces, buffer);
    score::draw(model, shown, parts.score, buffer);
}

/// Before the first result: what is being done, or why there is none.
fn waiting(model: &Model, area: Rect, buffer: &mut Buffer) {
    let theme = Theme::of(model.look);
    let (text, style) = match (&model.run.complaint, form::simulating(model)) {
        (Some((_, why)), _) => (why.clone(), theme.error()),
        (None, Some(text)) => (text + "  (Esc cancels)", theme.text()),
        (None, None) => ("simulating".to_owned(), theme.text()),
    };
    let lines = crate::tui::view::text::wrapped(&text, usize::from(area.width - 2));
    for (i, line) in lines.iter().enumerate() {
        put(buffer, area, (1, 1 + i as u16), line, style);
    }
}

fn eye(model: &Model, shown: &Shown, picture: Rect, buffer: &mut Buffer) {
    let theme = Theme::of(model.look);
    let aiming = model.has_focus(DIAL);
    let time = model.time();
    Scene {
        shown,
        time,
        largest: shown.hottest,
        highest: pressures(model, shown),
        zoom: model.clock.zoom(),
        detail: model.clock.detail,
        blow: Some(&model.work.scenario),
        aiming,
        lean: model.is_lean(),
        look: model.look,
    }
    .draw(picture, buffer);
    let zoom = match model.clock.zoom() {
        1 => String::new(),
        zoom => format!(" moved ×{zoom}"),
    };
    let state = if model.clock.playing { "▶ " } else { "" };
    let caption = format!(" {state}{:.3} ms{zoom} ", time * 1e3);
    let style = if aiming {
        theme.focus()
    } else {
        theme.heading()
    };
    let above = Rect::new(picture.x, picture.y - 1, picture.width, 1);
    put(buffer, above, (0, 0), &caption, style);
}

/// The results whose curves are drawn beside the eye, with their peaks.
fn sparks(answer: &Answer) -> Vec<(Quantity, Peak)> {
    let spark = |q: &Quantity| q.row().trace.is_some_and(|trace| trace.spark);
    let all = Quantity::ALL.iter().copied().filter(spark);
    all.filter_map(|q| Some((q, answer.peak(q)?))).collect()
}

/// Below this many columns the time of a peak stands at its curve.
const TIMED: u16 = 22;
/// Longer names are cut where room is short.
const LONGEST: usize = 7;

/// The name of a curve, its peak and the time of that, which together fit with a space between them.
/// Where room is short the space before the unit gives way, then letters of the name, digits of the
/// value and of the time, and at last the time.
fn caption(quantity: Quantity, peak: Peak, room: u16) -> (String, String, String) {
    let row = quantity.row();
    let (value, ms) = (peak.value * row.factor, peak.time * 1e3);
    let beside = |after: u8| {
        if ms < 10.0 {
            format!("{ms:.0$}ms", usize::from(after))
        } else {
            format!("{}ms", digits(ms, i32::from(after) + 1))
        }
    };
    let times = match room {
        26.. => vec![format!("at {ms:.3} ms"), beside(3), beside(2)],
        TIMED.. => vec![beside(3), beside(2)],
        _ => vec![String::new()],
    };
    let brief = match row.short.get(..LONGEST - 2) {
        Some(start) if row.short.len() > LONGEST => format!("{start}."),
        _ => row.short.to_owned(),
    };
    let brief = brief.as_str();
    let clear = [
        (row.short, digits(value, 4), " "),
        (brief, digits(value, 4), " "),
        (brief, digits(value, 4), ""),
        (brief, digits(value, 3), ""),
        (brief, digits(value, 2), ""),
    ];
    let rough = [digits(value, 1), format!("{value:.0e}")];
    let mut candidates = Vec::new();
    for time in &times {
        for (label, number, gap) in &clear {
            let text = format!("{number}{gap}{}", row.unit);
            candidates.push(((*label).to_owned(), text, time.clone()));
        }
    }
    let none = String::new();
    for time in times.iter().chain([&none]) {
        for number in &rough {
            let text = format!("{number}{}", row.unit);
            candidates.push((brief.to_owned(), text, time.clone()));
        }
    }
    let wide = |(label, value, time): &(String, String, String)| {
        let after = if time.is_empty() { 0 } else { width(time) + 1 };
        width(label) + 1 + width(value) + after
    };
    let last = candidates.pop().unwrap_or_default();
    let mut fitting = candidates.into_iter().filter(|parts| wide(parts) <= room);
    fitting.next().unwrap_or(last)
}

/// The curves, each with its peak and when it came.
fn sparklines(model: &Model, shown: &Shown, area: Rect, buffer: &mut Buffer) {
    let theme = Theme::of(model.look);
    let Some(recorded) = &shown.answer.traces else {
        return;
    };
    let sparks = sparks(&shown.answer);
    let each = (area.height / sparks.len().max(1) as u16).max(1);
    for (i, (quantity, peak)) in sparks.into_iter().enumerate() {
        let top = area.y + each * i as u16;
        if top >= area.y + area.height {
            break;
        }
        let row = Rect::new(area.x, top, area.width, 1);
        let (label, value, time) = caption(quantity, peak, area.width);
        put(buffer, row, (0, 0), &label, theme.heading());
        let left = area.width - width(&time);
        put(buffer, row, (left, 0), &time, theme.quiet());
        let right = if time.is_empty() { left } else { left - 1 };
        put_right(buffer, row, (right, 0), &value, theme.strong());
        if each < 2 {
            continue;
        }
        let values = Course::Of(quantity).values(recorded);
        if values.is_empty() {
            continue;
        }
        let curve = Curve {
            time: &recorded.time,
            values,
            factor: 1.0,
            ink: Ink::solid(theme.curve(i), 1, '*'),
        };
        let field = Rect::new(area.x, top + 1, area.width, each - 1);
        let window = shown.answer.window();
        spark(curve, window, model.time(), model.look, field, buffer);
        if area.width < TIMED {
            // The peaks come early, so the end of the curve has room for a word.
            let time = format!(" {:.3} ms", peak.time * 1e3);
            put_right(buffer, field, (area.width, 0), &time, theme.quiet());
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_caption_keeps_its_parts_apart() {
        let drawn = |q: &&Quantity| q.row().trace.is_some_and(|trace| trace.spark);
        for &quantity in Quantity::ALL.iter().filter(drawn) {
            for value in [12.4, 5199.0, 0.002, -0.0063, 1.016e-13] {
                for ms in [0.362, 12.345] {
                    let peak = Peak {
                        value: value / quantity.row().factor,
                        time: ms * 1e-3,
                    };
                    for room in 15..30 {
                        let (label, value, time) = caption(quantity, peak, room);
                        let long = width(&label) + 1 + width(&value);
                        let after = if time.is_empty() { 0 } else { width(&time) + 1 };
                        assert!(long + after <= room, "{label} {value} {time} in {room}");
                        assert_eq!(time.is_empty(), room < TIMED, "{label} {value} in {room}");
                    }
                }
            }
        }
    }
}
