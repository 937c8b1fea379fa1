//! Curves over time with axes, and a cursor that reads their values. The cursor is the clock.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;

use super::{Pane, Screen};
use crate::recording::Traces;
use crate::report::text::significant;
use crate::study::course::{COURSES, Course, Group};
use crate::tui::clock::peak_at;
use crate::tui::keys::shared::{LEFT, RIGHT, SHIFT_LEFT, SHIFT_RIGHT};
use crate::tui::keys::{KeyTable, TimeKeys, bind, c};
use crate::tui::model::{Model, Shown};
use crate::tui::step::Step;
use crate::tui::update::time;
use crate::tui::view::chart::{Chart, Curve, value_at};
use crate::tui::view::raster::Ink;
use crate::tui::view::text::{put, put_right, width};
use crate::tui::view::theme::Theme;
use strum::VariantArray;

/// Charts, each with the curves in it.
type View = Vec<Vec<Course>>;

/// Charts of one curve each that stand in one view, and curves that stand in one chart.
const MAX_CHARTS: usize = 4;
const MAX_CURVES: usize = 6;

/// Every course that is drawn as a curve; of the load and the force of contact that which drives.
pub fn drawn() -> impl Iterator<Item = Course> {
    let named = |course: &Course| !matches!(course.row().place.0, Group::Input | Group::Projectile);
    COURSES.iter().copied().filter(named)
}

/// Those that a recording has.
fn recorded(traces: &Traces) -> Vec<Course> {
    drawn().filter(|c| !c.values(traces).is_empty()).collect()
}

/// What the screen can show of a recording.
fn views(traces: &Traces) -> Vec<View> {
    let recorded = recorded(traces);
    let mut views = Vec::new();
    for group in Group::VARIANTS {
        let own = recorded.iter().filter(|c| c.row().place.0 == *group);
        let own: Vec<Course> = own.copied().collect();
        if *group == Group::Energies {
            views.extend(own.chunks(MAX_CURVES).map(|curves| vec![curves.to_vec()]));
            continue;
        }
        let alone = |courses: &[Course]| courses.iter().map(|c| vec![*c]).collect();
        views.extend(own.chunks(MAX_CHARTS).map(alone));
        if *group == Group::NodeForces {
            views.extend(own.chunks(1).map(alone));
        }
    }
    views
}

pub(crate) const SCREEN: Screen = Screen::new(
    "Forces",
    "the force profiles",
    &[Pane {
        name: "forces",
        keys: &[KEYS],
        time: TimeKeys::Early,
    }],
    draw,
);

#[rustfmt::skip]
const KEYS: KeyTable = KeyTable::new("Forces", &[
    bind(&[LEFT, c('h')], |m| time::step(m, Step::LESS), "cursor", "the cursor to the left"),
    bind(&[RIGHT, c('l')], |m| time::step(m, Step::MORE), "&", "the cursor to the right"),
    bind(&[SHIFT_LEFT, c('H')], |m| time::step(m, Step::MUCH_LESS), "", "the cursor far to the left"),
    bind(&[SHIFT_RIGHT, c('L')], |m| time::step(m, Step::MUCH_MORE), "", "the cursor far to the right"),
    bind(&[c('v')], next_view, "view", "all four forces, one of them, growth, energies"),
]);

/// The next set of curves.
fn next_view(model: &mut Model) {
    let traces = model.shown.as_ref().and_then(|s| s.answer.traces.as_ref());
    let count = traces.map_or(1, |t| views(t).len().max(1));
    let view = &mut model.screens.forces;
    *view = (*view % count + 1) % count;
}

fn draw(model: &Model, area: Rect, buffer: &mut Buffer) {
    let theme = Theme::of(model.look);
    let Some(shown) = &model.shown else {
        put(buffer, area, (1, 1), "no result yet", theme.text());
        return;
    };
    let time = model.time();
    let mut text = format!(" cursor {:.4} ms", time * 1e3);
    if let Some(peak) = peak_at(&shown.answer, time) {
        text.push_str("  peak ");
        text.push_str(&peak);
    }
    let end = put(buffer, area, (0, 0), &text, theme.strong());
    let said = model.stale().unwrap_or(model.material());
    let style = if model.stale().is_some() {
        theme.warning()
    } else {
        theme.quiet()
    };
    if end + (said.len() as u16) + 2 < area.width {
        put_right(buffer, area, (area.width - 1, 0), said, style);
    }
    let Some(traces) = &shown.answer.traces else {
        return;
    };
    let views = views(traces);
    let Some(view) = views.get(model.screens.forces % views.len().max(1)) else {
        return;
    };
    let charts = Rect::new(area.x, area.y + 1, area.width, area.height - 1);
    let (columns, rows) = match view.len() {
        1 => (1, 1),
        2 => (1, 2),
        _ => (2, 2),
    };
    let (wide, high) = (charts.width / columns, charts.height / rows);
    for (i, curves) in view.iter().enumerate() {
        let (column, row) = (i as u16 % columns, i as u16 / columns);
        let place = Rect::new(
            charts.x + column * wide,
            charts.y + row * high,
            wide - 1,
            high,
        );
        chart(model, (shown, traces), curves, place, buffer);
    }
}

fn chart(
    model: &Model,
    (shown, traces): (&Shown, &Traces),
    courses: &[Course],
    area: Rect,
    buffer: &mut Buffer,
) {
    let theme = Theme::of(model.look);
    let time = model.time();
    // A curve by itself keeps its colour in every view.
    let first = match courses {
        [only] => recorded(traces).iter().position(|c| c == only),
        _ => None,
    };
    let curves = courses
        .iter()
        .enumerate()
        .map(|(i, course)| Curve {
            time: &traces.time,
            values: course.values(traces),
            factor: course.row().factor,
            ink: Ink::solid(theme.curve(first.unwrap_or(i)), 2 + i as u8, mark(i)),
        })
        .collect();
    let reading = |course: &Course| {
        let value = value_at(&traces.time, course.values(traces), time)?;
        Some(significant(value * course.row().factor))
    };
    let (title, now) = if let [only] = courses {
        let unit = only.row().unit;
        let now = reading(only).map_or(String::new(), |v| format!("{v} {unit}"));
        (format!("{}, {unit}", only.label(traces)), now)
    } else {
        (String::new(), String::new())
    };
    let entries: Vec<String> = courses
        .iter()
        .enumerate()
        .map(|(i, course)| {
            let now = reading(course).unwrap_or_default();
            let (label, unit) = (course.label(traces), course.row().unit);
            format!("{} {label} {now} {unit}", mark(i))
        })
        .collect();
    // What does not fit into one line of the legend takes two.
    let room = area.width.saturating_sub(LEGEND);
    let long: u16 = entries.iter().map(|text| width(text) + 2).sum();
    let lines = if courses.len() > 1 && long > room + 2 {
        2
    } else {
        1
    };
    let field = Rect {
        y: area.y + lines - 1,
        height: area.height.saturating_sub(lines - 1),
        ..area
    };
    Chart {
        title: &title,
        reading: &now,
        curves,
        window: shown.answer.window(),
        cursor: time,
        look: model.look,
    }
    .draw(field, buffer);
    if courses.len() > 1 {
        let each = entries.len().div_ceil(usize::from(lines));
        let mut x = LEGEND;
        for (i, text) in entries.iter().enumerate() {
            if i % each == 0 {
                x = LEGEND;
            }
            let y = (i / each) as u16;
            x = put(buffer, area, (x, y), text, theme.curve(i)) + 2;
        }
    }
}

/// Where the legend of several curves begins.
const LEGEND: u16 = 8;

/// Tells curves apart in ASCII and in legends without colour.
pub fn mark(index: usize) -> char {
    ['1', '2', '3', '4', '5', '6'][index % 6]
}
