//! The one screen that answers the question at the bedside: form, eye, traces, score.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;

use crate::answer::solve::Answer;
use crate::report::figure::Figure;
use crate::report::risks::first_line;
use crate::run::kept::Peak;
use crate::run::quantity::Quantity;
use crate::run::trace::OtherTrace;
use crate::run::trace::Trace;
use crate::tui::clock::MeshDetail;
use crate::tui::model::AppModel;
use crate::tui::screens::main::form::DIAL;
use crate::tui::screens::main::{form, score};
use crate::tui::shown::ShownAnswer;
use crate::tui::view::below;
use crate::tui::view::chart::{TimeChart, TimeCurve, active, spark};
use crate::tui::view::eye::EyePicture;
use crate::tui::view::raster::Ink;
use crate::tui::view::risks::{SIGN_ROWS, draw_signs, rows};
use crate::tui::view::text::{put, put_lines, put_right, width, wrapped};
use crate::tui::view::theme::Theme;

/// Where the parts of the screen are.
pub struct Layout {
    /// The form.
    pub form: Rect,
    /// All at its right.
    right: Rect,
    /// The eye with its words.
    pub eye: Rect,
    traces: Rect,
    score: Rect,
    /// The risks, where there is room for them beside.
    risks: Option<Rect>,
}

/// From so many columns on risks and a pressure stand at the right.
const WIDE: u16 = 140;
/// Their columns.
const RISKS: u16 = 58;

/// Divides the screen.
pub fn layout(area: Rect) -> Layout {
    let left = match area.width {
        ..70 => 25,
        70..100 => 29,
        _ => 34,
    };
    let risks = (area.width >= WIDE).then(|| Rect {
        x: area.x + area.width - RISKS,
        width: RISKS,
        ..area
    });
    let right = Rect::new(
        area.x + left + 1,
        area.y,
        area.width - left - 1 - risks.map_or(0, |risks| risks.width + 1),
        area.height,
    );
    let below = score::height(right.height, risks.is_some());
    let upper = right.height - below;
    let wide = (upper * 2).min(right.width * 11 / 20);
    let wide = wide.min(right.width.saturating_sub(NARROWEST + 1));
    Layout {
        form: Rect {
            width: left,
            ..area
        },
        right,
        eye: Rect::new(right.x, right.y, wide, upper),
        traces: Rect::new(right.x + wide + 1, right.y, right.width - wide - 1, upper),
        score: Rect::new(right.x, right.y + upper, right.width, below),
        risks,
    }
}

/// Draws the screen.
pub fn draw(pane: usize, model: &AppModel, area: Rect, buffer: &mut Buffer) {
    let theme = Theme::of(model.look);
    let parts = layout(area);
    form::draw(pane, model, parts.form, buffer);
    for y in 0..area.height {
        put(buffer, area, (parts.form.width, y), "│", theme.line());
    }
    let Some(shown) = &model.shown else {
        waiting(model, parts.right, buffer);
        return;
    };
    eye(model, shown, pane == DIAL, parts.eye, buffer);
    sparklines(model, shown, parts.traces, buffer);
    score::draw(model, shown, parts.risks.is_some(), parts.score, buffer);
    if let Some(place) = parts.risks {
        for y in 0..area.height {
            put(buffer, place, (0, y), "│", theme.line());
        }
        let inside = Rect {
            x: place.x + 1,
            width: place.width - 1,
            ..place
        };
        beside(model, shown, inside, buffer);
    }
    if model.stale().is_some() {
        // All but the line that says so.
        let (above, below) = (
            parts.right.height - parts.score.height,
            parts.score.height - 1,
        );
        for (y, height) in [(0, above), (above + 1, below)] {
            let stale = Rect::new(parts.right.x, parts.right.y + y, parts.right.width, height);
            buffer.set_style(stale, theme.stale());
        }
        buffer.set_style(parts.risks.unwrap_or_default(), theme.stale());
    }
}

/// What to believe of each injury and what its tissue felt, and the pressure in the eye; of an eye
/// without one what acts on it.
fn beside(model: &AppModel, shown: &ShownAnswer, area: Rect, buffer: &mut Buffer) {
    let theme = Theme::of(model.look);
    put(buffer, area, (1, 0), "What to believe", theme.heading());
    let count = shown.answer.risks().len() as u16;
    let said = Rect {
        y: area.y + 1,
        height: 2 + 2 * count.max(1) + SIGN_ROWS,
        ..area
    };
    if count > 0 {
        rows((model, &shown.answer), (None, 2), said, buffer);
    } else {
        let silence = wrapped(&first_line(&shown.answer), usize::from(area.width - 2));
        put_lines(buffer, said, (1, 0), &silence, theme.strong());
    }
    draw_signs(theme, said, buffer);
    let top = said.height + 2;
    let Some(traces) = &shown.answer.run.traces else {
        return;
    };
    let courses = [
        Trace::Of(Quantity::Pressure),
        Trace::Other(OtherTrace::Drive),
    ];
    let recorded = |course: &&Trace| !course.values(traces).is_empty();
    let Some(&course) = courses.iter().find(recorded) else {
        return;
    };
    let (row, values) = (course.row(), course.values(traces));
    let window = shown.answer.window();
    let reading = match course {
        Trace::Of(of) => Figure::of(&shown.answer, of).map(|figure| format!("peak {figure}")),
        Trace::Other(_) => None,
    };
    TimeChart {
        title: &format!("{}, {}", course.label(traces), row.unit),
        reading: &reading.unwrap_or_default(),
        curves: vec![TimeCurve {
            time: &traces.time,
            values,
            factor: row.factor,
            ink: Ink::solid(theme.curve(0), 2, '*'),
        }],
        span: active(&traces.time, std::iter::once(values), window),
        cursor: model.time(),
        look: model.look,
    }
    .draw(
        Rect {
            y: area.y + top,
            height: area.height.saturating_sub(top),
            width: area.width - 1,
            ..area
        },
        buffer,
    );
}

/// Before the first result: what is being done, or why there is none.
fn waiting(model: &AppModel, area: Rect, buffer: &mut Buffer) {
    let theme = Theme::of(model.look);
    let (text, style) = match (&model.run.complaint, form::simulating(model)) {
        (Some((_, why)), _) => (why.clone(), theme.error()),
        (None, Some(text)) => (text + "  (Esc cancels)", theme.text()),
        (None, None) => ("simulating".to_owned(), theme.text()),
    };
    let lines = wrapped(&text, usize::from(area.width - 2));
    put_lines(buffer, area, (1, 1), &lines, style);
}

fn eye(model: &AppModel, shown: &ShownAnswer, on_dial: bool, picture: Rect, buffer: &mut Buffer) {
    let theme = Theme::of(model.look);
    let aiming = on_dial && model.overlay.is_none();
    let time = model.time();
    let drawn = EyePicture {
        blow: Some(&model.work.scenario),
        aiming,
        ..EyePicture::of(model, shown, time)
    };
    if drawn.detail == MeshDetail::Anatomy {
        drawn.draw(picture, buffer);
        return;
    }
    let (above, below) = (
        Rect {
            height: 1,
            ..picture
        },
        below(picture, 1),
    );
    drawn.draw(below, buffer);
    let zoom = match model.clock.zoom() {
        1 => String::new(),
        times => format!(" shown {times}x larger"),
    };
    let state = if model.clock.playing { "▶ " } else { "" };
    let caption = format!(" {state}{:.3} ms{zoom} ", time * 1e3);
    let style = [theme.heading(), theme.focus()][usize::from(aiming)];
    put(buffer, above, (0, 0), &caption, style);
}

/// The results whose curves are drawn beside the eye, with their peaks.
fn sparks(answer: &Answer) -> Vec<(Quantity, Peak)> {
    let spark = |q: &Quantity| q.row().trace.is_some_and(|trace| trace.spark);
    let all = Quantity::ALL.iter().copied().filter(spark);
    all.filter_map(|q| Some((q, answer.peak(q)?))).collect()
}

/// From so many columns on there may be room for the time of a peak beside it.
const TIMED: u16 = 26;
/// The fewest columns of the curves: a name, a figure and its error.
const NARROWEST: u16 = 18;
/// Longer names are cut where room is short.
const LONGEST: usize = 7;

/// The name of a curve, its peak with its error and the time of that, which together fit with a
/// space between them. Where room is short the spaces give way, then letters of the name, the
/// time, and at last the error.
fn caption(of: Quantity, figure: &Figure, peak: Peak, room: u16) -> (String, String, String) {
    let name = of.row().short;
    let ms = peak.time * 1e3;
    let times = match room {
        TIMED.. => vec![
            format!("at {ms:.3} ms"),
            format!("{ms:.3}ms"),
            format!("{ms:.2}ms"),
        ],
        _ => vec![String::new()],
    };
    let brief = match name.get(..LONGEST - 2) {
        Some(start) if name.len() > LONGEST => format!("{start}."),
        _ => name.to_owned(),
    };
    let whole = figure.to_string();
    let tight = whole.replace(" %", "%");
    let close = tight.replace(&format!(" {}", figure.unit), figure.unit);
    let closest = close.replace(' ', "");
    let bare = |count| figure.coarser(count).bare().replace(' ', "");
    let small = figure.off.percent().is_some_and(|error| error < 1.0);
    let error = figure.off.to_string().replace(' ', "");
    let least = if small { "±<1%" } else { &error };
    let closer = [(3, &error[..]), (2, &error), (2, least)];
    let closer = closer.map(|(count, error)| bare(count) + error);
    let bare = bare(2);
    let none = String::new();
    let mut candidates = Vec::new();
    for time in times.iter().chain([&none]) {
        for name in [name, &brief] {
            for text in [&whole, &tight, &close, &closest] {
                candidates.push((name.to_owned(), text.clone(), time.clone()));
            }
        }
    }
    candidates.extend(closer.map(|text| (brief.clone(), text, none.clone())));
    let wide = |(name, text, time): &(String, String, String)| {
        let after = if time.is_empty() { 0 } else { width(time) + 1 };
        width(name) + 1 + width(text) + after
    };
    let mut fitting = candidates.into_iter().filter(|parts| wide(parts) <= room);
    fitting.next().unwrap_or((brief, bare, none))
}

/// The curves, each with its peak and when it came.
fn sparklines(model: &AppModel, shown: &ShownAnswer, area: Rect, buffer: &mut Buffer) {
    let theme = Theme::of(model.look);
    let Some(recorded) = &shown.answer.run.traces else {
        return;
    };
    let sparks = sparks(&shown.answer);
    let values = |of: &Quantity| Trace::Of(*of).values(recorded);
    let drawn = sparks.iter().map(|(of, _)| values(of));
    let window = shown.answer.window();
    // What comes before is little, and the eye beside it begins at rest.
    let span = (0.0, active(&recorded.time, drawn, window).1);
    let each = (area.height / sparks.len().max(1) as u16).max(1);
    for (i, (quantity, peak)) in sparks.into_iter().enumerate() {
        let top = area.y + each * i as u16;
        let Some(figure) = Figure::of(&shown.answer, quantity) else {
            continue;
        };
        if top >= area.y + area.height {
            break;
        }
        let row = Rect::new(area.x, top, area.width, 1);
        let (label, value, time) = caption(quantity, &figure, peak, area.width);
        put(buffer, row, (0, 0), &label, theme.heading());
        let left = area.width - width(&time);
        put(buffer, row, (left, 0), &time, theme.quiet());
        let right = if time.is_empty() { left } else { left - 1 };
        let spoiled = shown.answer.spoiled().is_some();
        let style = if spoiled {
            theme.quiet()
        } else {
            theme.strong()
        };
        put_right(buffer, row, (right, 0), &value, style);
        let values = values(&quantity);
        if each < 2 || values.is_empty() {
            continue;
        }
        let curve = TimeCurve {
            time: &recorded.time,
            values,
            factor: 1.0,
            ink: Ink::solid(theme.curve(i), 1, '*'),
        };
        let field = Rect::new(area.x, top + 1, area.width, each - 1);
        spark(curve, span, model.time(), model.look, field, buffer);
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
    use crate::report::figure::Off;

    #[test]
    fn a_caption_keeps_its_parts_apart_and_its_error() {
        let drawn = |q: &&Quantity| q.row().trace.is_some_and(|trace| trace.spark);
        for &quantity in Quantity::ALL.iter().filter(drawn) {
            for (number, error) in [("12", 35.0), ("5199", 0.016), ("0.20", 0.42), ("73", 119.0)] {
                let figure = Figure {
                    number: number.to_owned(),
                    unit: quantity.row().unit,
                    off: Off::Both(error),
                    cut: None,
                };
                let peak = Peak {
                    value: 1.0,
                    time: 12.345e-3,
                };
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
