//! Curves over time with axes, and a cursor that reads their values. The cursor is the clock.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;

use super::{Pane, Screen};
use crate::recording::Traces;
use crate::report::text::significant;
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

/// A curve that can be drawn.
pub struct Profile {
    /// Its name.
    pub label: &'static str,
    /// Its unit.
    pub unit: &'static str,
    /// Where it comes from.
    pub values: fn(&Traces) -> &[f64],
    /// From SI to its unit.
    pub factor: f64,
}

const fn profile(
    label: &'static str,
    unit: &'static str,
    factor: f64,
    values: fn(&Traces) -> &[f64],
) -> Profile {
    Profile {
        label,
        unit,
        values,
        factor,
    }
}

/// Every curve; the first four are the monitored forces.
#[rustfmt::skip]
pub static CURVES: &[Profile] = &[
    profile("centre", "N", 1.0, |t| &t.force[0]),
    profile("front", "N", 1.0, |t| &t.force[1]),
    profile("right", "N", 1.0, |t| &t.force[2]),
    profile("top", "N", 1.0, |t| &t.force[3]),
    profile("load", "N", 1.0, drive),
    profile("apex", "mm", 1e3, |t| &t.apex),
    profile("shell growth S", "%", 1e2, |t| &t.shell_growth),
    profile("meridian growth M", "%", 1e2, |t| &t.meridian_growth),
    profile("work in", "J", 1.0, |t| &t.work),
    profile("kinetic", "J", 1.0, |t| &t.kinetic),
    profile("elastic", "J", 1.0, |t| &t.elastic),
    profile("dissipated", "J", 1.0, |t| &t.dissipated),
    profile("pressure", "MPa", 1e-6, |t| &t.pressure),
    profile("vitreous area", "%", 1e2, |t| &t.area_ratio),
];

/// What drives the eye among the [`CURVES`].
pub const DRIVE: usize = 4;
/// The pressure in the eye among them.
pub const PRESSURE: usize = 12;

/// The force that acts on the eye: of a projectile that of its contact, else the load.
pub fn drive(traces: &Traces) -> &[f64] {
    if traces.contact_force.is_empty() {
        &traces.load
    } else {
        &traces.contact_force
    }
}

/// What [`drive`] is called.
pub fn drive_label(traces: &Traces) -> &'static str {
    if traces.contact_force.is_empty() {
        "load"
    } else {
        "contact"
    }
}

/// What the force screen can show: charts, each with the curves in it.
static VIEWS: &[View] = &[
    &[&[0], &[1], &[2], &[3]],
    &[&[0]],
    &[&[1]],
    &[&[2]],
    &[&[3]],
    &[&[4], &[5], &[6], &[7]],
    &[&[8, 9, 10, 11]],
    &[&[12], &[13]],
];

/// Charts, each with the curves in it.
type View = &'static [&'static [usize]];

/// The views whose curves a recording has.
fn views(traces: &Traces) -> Vec<View> {
    let there = |view: &&View| {
        let mut curves = view.iter().flat_map(|chart| chart.iter());
        curves.all(|&i| !(CURVES[i].values)(traces).is_empty())
    };
    VIEWS.iter().filter(there).copied().collect()
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
    let traces = model
        .shown
        .as_ref()
        .and_then(|s| s.answer.recording.traces.as_ref());
    let count = traces.map_or(1, |t| views(t).len());
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
    let views = match &shown.answer.recording.traces {
        Some(traces) => views(traces),
        None => return,
    };
    let view = views[model.screens.forces % views.len()];
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
        chart(model, shown, curves, place, buffer);
    }
}

fn chart(model: &Model, shown: &Shown, which: &[usize], area: Rect, buffer: &mut Buffer) {
    let theme = Theme::of(model.look);
    let Some(traces) = &shown.answer.recording.traces else {
        return;
    };
    let time = model.time();
    let profiles: Vec<&Profile> = which.iter().filter_map(|i| CURVES.get(*i)).collect();
    let curves = profiles
        .iter()
        .enumerate()
        .map(|(i, profile)| Curve {
            time: &traces.time,
            values: (profile.values)(traces),
            factor: profile.factor,
            ink: Ink::solid(
                theme.curve(if which.len() == 1 { which[0] } else { i }),
                2 + i as u8,
                mark(i),
            ),
        })
        .collect();
    let reading = |profile: &Profile| {
        let value = value_at(&traces.time, (profile.values)(traces), time)?;
        Some(significant(value * profile.factor))
    };
    let (title, now) = if let [only] = profiles[..] {
        let now = reading(only).map_or(String::new(), |v| format!("{v} {}", only.unit));
        let label = if which[0] == DRIVE {
            drive_label(traces)
        } else {
            only.label
        };
        (format!("{label}, {}", only.unit), now)
    } else {
        (String::new(), String::new())
    };
    let entries: Vec<String> = profiles
        .iter()
        .enumerate()
        .map(|(i, profile)| {
            let now = reading(profile).unwrap_or_default();
            format!("{} {} {now} {}", mark(i), profile.label, profile.unit)
        })
        .collect();
    // What does not fit into one line of the legend takes two.
    let room = area.width.saturating_sub(LEGEND);
    let long: u16 = entries.iter().map(|text| width(text) + 2).sum();
    let lines = if profiles.len() > 1 && long > room + 2 {
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
        window: shown.answer.case.window,
        cursor: time,
        look: model.look,
    }
    .draw(field, buffer);
    if profiles.len() > 1 {
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
