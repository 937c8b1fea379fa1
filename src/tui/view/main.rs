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

/// Draws the screen.
pub fn draw(model: &Model, area: Rect, buffer: &mut Buffer) {
    let theme = Theme::of(model.look);
    let left = match area.width {
        ..70 => 25,
        70..100 => 29,
        _ => 34,
    };
    form::draw(
        model,
        Rect {
            width: left,
            ..area
        },
        buffer,
    );
    for y in 0..area.height {
        put(buffer, area, (left, y), "│", theme.line());
    }
    let right = Rect::new(
        area.x + left + 1,
        area.y,
        area.width - left - 1,
        area.height,
    );
    let Some(shown) = &model.shown else {
        waiting(model, right, buffer);
        return;
    };
    let below = score::height(right.height);
    let upper = Rect {
        height: right.height - below,
        ..right
    };
    let eye_width = (upper.height * 2).min(right.width * 11 / 20);
    eye(
        model,
        shown,
        Rect {
            width: eye_width,
            ..upper
        },
        buffer,
    );
    let traces = Rect::new(
        upper.x + eye_width + 1,
        upper.y,
        upper.width - eye_width - 1,
        upper.height,
    );
    sparklines(model, shown, traces, buffer);
    let lower = Rect::new(right.x, right.y + upper.height, right.width, below);
    score::draw(model, shown, lower, buffer);
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

fn eye(model: &Model, shown: &Shown, area: Rect, buffer: &mut Buffer) {
    let theme = Theme::of(model.look);
    let aiming = model.context() == Context::Dial;
    let time = model.time();
    let picture = Rect::new(area.x, area.y + 1, area.width, area.height - 1);
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
    put(buffer, area, (0, 0), &caption, style);
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
