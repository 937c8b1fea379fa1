//! Speed against error: every integrator's points on two logarithmic axes, the front joined.
//!
//! A letter tells the integrator, a capital that nothing beats the point in both; so the picture is
//! legible without colours.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::{Modifier, Style};

use super::log_axis::{Axis, tick_label};
use super::measurement::Measured;
use crate::dynamics::Integrator;
use crate::report::errors::{of_damage, worst_in_short};
use crate::report::text::significant;
use crate::study::accuracy::{Point, TARGETS};
use crate::tui::model::{Look, Model};
use crate::tui::view::raster::{Ink, Raster};
use crate::tui::view::text::{flowed, put, put_both, put_right, width, wrapped};
use crate::tui::view::theme::Theme;

/// Room for the numbers of the error axis.
const LABELS: u16 = 7;
/// The fewest rows and columns that a picture is drawn into.
const LEAST: (u16, u16) = (20, 4);
/// Errors below this, in %, are drawn there: they are rounding.
const FLOOR: f64 = 1e-9;

fn style(theme: Theme, point: &Point) -> Style {
    let place = Integrator::ALL
        .iter()
        .position(|i| *i == point.plan.integrator);
    let own = if theme.is_mono() {
        theme.text()
    } else {
        theme.curve(place.unwrap_or(0))
    };
    if point.on_front {
        own.add_modifier(Modifier::BOLD)
    } else {
        own
    }
}

/// Draws the screen.
pub fn draw(model: &Model, area: Rect, buffer: &mut Buffer) {
    let theme = Theme::of(model.look);
    let (said, style) = status(model, theme);
    let heading = ("Error in % against time", theme.heading());
    put_both(buffer, area, heading, (&said, style));
    let Some(measured) = &model.screens.accuracy.measured else {
        let text = match (
            &model.screens.accuracy.task.job,
            &model.screens.accuracy.task.complaint,
        ) {
            (Some(_), _) => "every integrator is being timed at several steps",
            (None, Some((_, why))) => why,
            (None, None) => "not measured yet",
        };
        let room = usize::from(area.width - 2);
        for (row, line) in (2..).zip(wrapped(text, room)) {
            put(buffer, area, (1, row), &line, theme.text());
        }
        return;
    };
    let room = area.width - 2;
    let mut below = flowed(&legend(), room);
    let notes = below.len();
    if area.height >= 30 {
        below.extend(flowed(&choices(measured), room));
        below.extend(flowed(&levels(measured), room));
    }
    let details = below.len();
    if let Some(point) = model.screens.accuracy.chosen() {
        below.extend(flowed(&named(model, point), room));
    }
    let top = area.height.saturating_sub(below.len() as u16);
    for (i, line) in below.iter().enumerate() {
        let style = match i {
            _ if i < notes => theme.quiet(),
            _ if i < details => theme.text(),
            _ if i == details => theme.strong(),
            _ => theme.text(),
        };
        put(buffer, area, (1, top + i as u16), line, style);
    }
    let plot = Rect::new(area.x, area.y + 1, area.width, top.saturating_sub(1));
    if plot.height < LEAST.1 + 2 || plot.width < LEAST.0 + LABELS {
        put(
            buffer,
            area,
            (1, 1),
            "too small for the chart",
            theme.warning(),
        );
        return;
    }
    chart(
        measured,
        model.screens.accuracy.cursor,
        model.look,
        plot,
        buffer,
    );
}

fn status(model: &Model, theme: Theme) -> (String, Style) {
    let stale = model.screens.accuracy.is_stale(&model.work.scenario);
    let folded = model
        .screens
        .accuracy
        .measured
        .as_ref()
        .is_some_and(|m| m.report.folded);
    if let Some(done) = model.screens.accuracy.task.percent() {
        let text = format!("measuring {done:.0} %  Esc stops");
        (text, theme.warning())
    } else if stale {
        let text = "of another scenario: m measures".to_owned();
        (text, theme.warning())
    } else if let Some((_, why)) = &model.screens.accuracy.task.complaint {
        (format!("{why}: m measures"), theme.warning())
    } else if folded {
        ("the mesh folded".to_owned(), theme.warning())
    } else {
        ("median of seven runs".to_owned(), theme.quiet())
    }
}

fn legend() -> Vec<String> {
    let mut parts: Vec<String> = Integrator::ALL
        .iter()
        .map(|i| format!("{} {}", i.method().letter, i.name()))
        .collect();
    parts.push("capitals: the front".to_owned());
    parts
}

/// The cheapest point for each error.
fn choices(measured: &Measured) -> Vec<String> {
    let mut parts = vec!["cheapest".to_owned()];
    for (target, best) in TARGETS.iter().zip(measured.report.best) {
        let what = best
            .and_then(|i| measured.report.points.get(i))
            .map_or_else(
                || "none".to_owned(),
                |p| format!("{} {} ms", p.plan.integrator.name(), ms(p.seconds)),
            );
        parts.push(format!("within {target} %: {what}"));
    }
    parts
}

/// What the mesh adds.
fn levels(measured: &Measured) -> Vec<String> {
    let Some((finest, others)) = measured.report.levels.split_last() else {
        return Vec::new();
    };
    let mut parts = vec![format!("mesh against level {}", finest.level)];
    for level in others {
        let error = worst_in_short(&level.errors);
        parts.push(format!("level {}: {error}", level.level));
    }
    parts
}

fn ms(seconds: f64) -> String {
    significant(seconds * 1e3)
}

/// All about the point under the cursor.
fn named(model: &Model, point: &Point) -> Vec<String> {
    let count = model
        .screens
        .accuracy
        .measured
        .as_ref()
        .map_or(0, |m| m.order.len());
    let mut parts = vec![
        format!("▸ {} of {count}", model.screens.accuracy.cursor + 1),
        format!(
            "{} {}",
            point.plan.integrator.method().letter,
            point.plan.integrator.name()
        ),
        format!("step {} µs", significant(point.step * 1e6)),
    ];
    if point.plan.integrator.method().adaptive() {
        parts.push(format!("tolerance {:e}", point.plan.local_tolerance));
    }
    parts.push(format!("{} ms", ms(point.seconds)));
    parts.push(format!("error {}", worst_in_short(&point.errors)));
    parts.push(format!("damage error {}", of_damage(&point.errors)));
    let elements = point.element_evaluations as f64 * 1e-6;
    parts.push(format!("{} evaluations", point.evaluations));
    let of = model.screens.accuracy.measured.as_ref();
    let of = of.map_or("", |m| m.report.element.plural());
    parts.push(format!("{} M {of}", significant(elements)));
    let front = if point.on_front {
        "on the front"
    } else {
        "beaten: not on the front"
    };
    parts.push(front.to_owned());
    parts
}

fn chart(measured: &Measured, cursor: usize, look: Look, area: Rect, buffer: &mut Buffer) {
    let theme = Theme::of(look);
    let left = LABELS + 1;
    let field = Rect::new(
        area.x + left,
        area.y,
        area.width - left - 1,
        area.height - 2,
    );
    let points = &measured.report.points;
    let shown: Vec<&Point> = measured.order.iter().map(|i| &points[*i]).collect();
    let least = shown
        .iter()
        .map(|p| p.error())
        .filter(|e| *e > FLOOR)
        .fold(f64::INFINITY, f64::min);
    let floor = if least.is_finite() { least } else { FLOOR };
    let times = Axis::over(shown.iter().map(|p| p.seconds * 1e3));
    let errors = Axis::over(shown.iter().map(|p| p.error().max(floor)));
    axes(area, field, (times, errors), theme, buffer);
    // In cells, so that lines run from mark to mark.
    let cell = |p: &Point| {
        let x = times.share(p.seconds * 1e3) * f64::from(field.width - 1);
        let y = (1.0 - errors.share(p.error().max(floor))) * f64::from(field.height - 1);
        (x.round(), y.round())
    };
    let mut raster = Raster::new(field, look.symbols);
    let (columns, rows) = raster.size();
    let grain = (
        f64::from(columns) / f64::from(field.width),
        f64::from(rows) / f64::from(field.height),
    );
    let front: Vec<(f64, f64)> = shown
        .iter()
        .filter(|p| p.on_front)
        .map(|p| cell(p))
        .map(|(x, y)| ((x + 0.5) * grain.0, (y + 0.5) * grain.1))
        .collect();
    let ink = Ink::solid(theme.cursor(), 0, '.');
    for pair in front.windows(2) {
        raster.line(pair[0], pair[1], ink);
    }
    raster.paint(buffer);
    // The front hides what it beats, and the chosen point hides everything.
    let mut marks: Vec<(usize, &Point)> = shown.iter().copied().enumerate().collect();
    marks.sort_by_key(|(at, p)| (*at == cursor, p.on_front));
    for (at, point) in marks {
        let (x, y) = cell(point);
        let letter = point.plan.integrator.method().letter;
        let mark = if point.on_front {
            letter
        } else {
            letter.to_ascii_lowercase()
        };
        let mut style = style(theme, point);
        if at == cursor {
            style = style.patch(theme.focus());
        }
        let place = &mut buffer[(field.x + x as u16, field.y + y as u16)];
        place.reset();
        place.set_char(mark).set_style(style);
    }
}

fn axes(area: Rect, field: Rect, (times, errors): (Axis, Axis), theme: Theme, buffer: &mut Buffer) {
    let bottom = field.height;
    for y in 0..bottom {
        put(buffer, area, (LABELS, y), "│", theme.line());
    }
    put(buffer, area, (LABELS, bottom), "└", theme.line());
    for x in LABELS + 1..area.width - 1 {
        put(buffer, area, (x, bottom), "─", theme.line());
    }
    for value in errors.ticks(usize::from(field.height / 2)) {
        let y = ((1.0 - errors.share(value)) * f64::from(field.height - 1)).round() as u16;
        let label = tick_label(value);
        put_right(buffer, area, (LABELS, y), &label, theme.quiet());
        put(buffer, area, (LABELS, y), "┤", theme.line());
    }
    let mut free = 0;
    for value in times.ticks(usize::from(field.width / 8)) {
        let x = LABELS + 1 + (times.share(value) * f64::from(field.width - 1)).round() as u16;
        let label = tick_label(value);
        let left = x.saturating_sub(width(&label) / 2);
        put(buffer, area, (x, bottom), "┬", theme.line());
        if left >= free && left + width(&label) + 3 <= area.width {
            free = put(buffer, area, (left, bottom + 1), &label, theme.quiet()) + 1;
        }
    }
    put_right(
        buffer,
        area,
        (area.width - 1, bottom + 1),
        "ms",
        theme.quiet(),
    );
}
