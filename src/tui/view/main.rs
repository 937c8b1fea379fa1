//! The one screen that answers the question at the bedside: form, eye, traces, score.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;

use super::chart::{Curve, spark};
use super::eye::Scene;
use super::raster::Ink;
use super::text::{put, put_right};
use super::theme::Theme;
use super::{form, score};
use crate::eye::Monitor;
use crate::report::text::significant;
use crate::tui::keys::Context;
use crate::tui::model::{Model, Run, Shown};

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
    let (text, style) = match &model.run {
        Run::Refused(why) => (why.clone(), theme.error()),
        Run::Running(_, Some(share)) => (
            format!("simulating {:.0} %  (Esc cancels)", share * 100.0),
            theme.text(),
        ),
        _ => ("simulating".to_owned(), theme.text()),
    };
    let lines = super::text::wrapped(&text, usize::from(area.width - 2));
    for (i, line) in lines.iter().enumerate() {
        put(buffer, area, (1, 1 + i as u16), line, style);
    }
}

fn eye(model: &Model, shown: &Shown, picture: Rect, buffer: &mut Buffer) {
    let theme = Theme::of(model.look);
    let aiming = model.context() == Context::Dial;
    let time = model.time();
    Scene {
        answer: &shown.answer,
        time,
        largest: shown.hottest,
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

/// Four curves, each with its peak and when it came.
fn sparklines(model: &Model, shown: &Shown, area: Rect, buffer: &mut Buffer) {
    let theme = Theme::of(model.look);
    let extremes = &shown.answer.recording.extremes;
    let Some(traces) = &shown.answer.recording.traces else {
        return;
    };
    let each = area.height / 4;
    for (i, monitor) in Monitor::ALL.iter().enumerate() {
        let top = area.y + each * i as u16;
        let row = Rect::new(area.x, top, area.width, 1);
        let peak = extremes.force[i];
        put(buffer, row, (0, 0), monitor.name(), theme.heading());
        let value = format!("{} N", significant(peak.value));
        let time = format!("at {:.3} ms", peak.time * 1e3);
        if area.width >= 26 {
            put_right(buffer, row, (area.width - 12, 0), &value, theme.strong());
            put_right(buffer, row, (area.width, 0), &time, theme.quiet());
        } else if area.width >= 22 {
            let time = format!("{:.3}ms", peak.time * 1e3);
            put_right(buffer, row, (area.width - 8, 0), &value, theme.strong());
            put_right(buffer, row, (area.width, 0), &time, theme.quiet());
        } else {
            put_right(buffer, row, (area.width, 0), &value, theme.strong());
        }
        if each < 2 {
            continue;
        }
        let curve = Curve {
            time: &traces.time,
            values: &traces.force[i],
            factor: 1.0,
            ink: Ink::solid(theme.curve(i), 1, '*'),
        };
        let field = Rect::new(area.x, top + 1, area.width, each - 1);
        let window = shown.answer.case.window;
        spark(curve, window, model.time(), model.look, field, buffer);
        if area.width < 22 {
            // The peaks come early, so the end of the curve has room for a word.
            let time = format!(" {:.3} ms", peak.time * 1e3);
            put_right(buffer, field, (area.width, 0), &time, theme.quiet());
        }
    }
}
