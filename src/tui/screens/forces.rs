//! Curves over time with axes, and a cursor that reads their values. The cursor is the clock.

use ratatui::layout::Rect;

use crate::report::figure::at_a_moment;
use crate::run::trace::{TRACES, Trace};
use crate::run::{kept::Traces, quantity::Quantity, result_trace::Group};
use crate::tui::keys::press::{LEFT, RIGHT, SHIFT_LEFT, SHIFT_RIGHT, c};
use crate::tui::screens::screen::{About, Pane, PaneKeys, Panes, Screen, bind};
use crate::tui::view::chart::{TimeChart, TimeCurve, active, mark, value_at};
use crate::tui::view::{below, raster::Ink, sheet::Sheet, text::width};
use crate::tui::{
    clock::peak_said, keys::TimeKeys, model::AppModel, shown::ShownAnswer, step::Step,
};
use strum::VariantArray;

/// Charts that stand together, each with the curves in it.
struct View {
    name: &'static str,
    charts: Vec<Vec<Trace>>,
}

impl View {
    /// A chart for each curve.
    fn alone(name: &'static str, curves: &[Trace]) -> Self {
        let charts = curves.iter().map(|curve| vec![*curve]).collect();
        Self { name, charts }
    }
}

/// Charts of one curve each that stand in one view, and curves that stand in one chart.
const MAX_CHARTS: usize = 4;
const MAX_CURVES: usize = 6;

/// What the screen keeps to itself.
#[derive(Debug, Clone, Copy, Default)]
pub struct Forces {
    view: usize,
    zoom: Zoom,
}

/// How much of the time is drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Zoom {
    /// All that was asked for.
    Whole,
    /// The time in which something happens, halved so many times about the cursor.
    Close(u32),
}

impl Default for Zoom {
    fn default() -> Self {
        Self::Close(0)
    }
}

/// Halved so many times at most.
const CLOSEST: u32 = 6;

impl Zoom {
    fn nearer(self) -> Self {
        match self {
            Self::Whole => Self::Close(0),
            Self::Close(times) => Self::Close((times + 1).min(CLOSEST)),
        }
    }

    fn farther(self) -> Self {
        match self {
            Self::Whole | Self::Close(0) => Self::Whole,
            Self::Close(times) => Self::Close(times - 1),
        }
    }

    /// The ends of the time drawn, of a window with something in `active`.
    fn span(self, active: (f64, f64), window: f64, cursor: f64) -> (f64, f64) {
        let Self::Close(times) = self else {
            return (0.0, window);
        };
        let wide = (active.1 - active.0) / f64::from(1 << times);
        let from = (cursor - 0.5 * wide).clamp(active.0, (active.1 - wide).max(active.0));
        (from, from + wide)
    }
}

/// Every course that is drawn as a curve; of the load and the force of contact that which drives.
pub fn drawn() -> impl Iterator<Item = Trace> {
    let named = |course: &Trace| !matches!(course.row().place.0, Group::Input | Group::Projectile);
    TRACES.iter().copied().filter(named)
}

/// Those that a recording has.
fn recorded(traces: &Traces) -> Vec<Trace> {
    drawn().filter(|c| !c.values(traces).is_empty()).collect()
}

/// What the screen can show of a recording: of an eye that was hit first what it felt.
fn views(traces: &Traces) -> Vec<View> {
    let there = |curve: &Trace| !curve.values(traces).is_empty();
    let [contact, pressure, stretch] = Quantity::FELT;
    let felt = [contact, pressure, stretch, Quantity::Apex].map(Trace::Of);
    let mut views = Vec::new();
    if felt.iter().all(there) {
        views.push(View::alone("what the eye felt", &felt));
    }
    let recorded = recorded(traces);
    for group in Group::VARIANTS {
        let own = recorded.iter().filter(|c| c.row().place.0 == *group);
        let own: Vec<Trace> = own.copied().collect();
        let name = match group {
            Group::NodeForces => "the four nodes",
            Group::Energies => "energies",
            Group::Inside => "pressures and stress",
            Group::Tissues => "tissues",
            Group::Motion | Group::Input | Group::Projectile => "load and movement",
        };
        if *group == Group::Energies {
            let chunks = own.chunks(MAX_CURVES).map(<[Trace]>::to_vec);
            views.extend(chunks.map(|curves| View { name, charts: vec![curves] }));
            continue;
        }
        views.extend(own.chunks(MAX_CHARTS).map(|own| View::alone(name, own)));
        if *group == Group::NodeForces {
            views.extend(own.iter().map(|one| View::alone(one.row().label, &[*one])));
        }
    }
    views
}

pub(super) const ABOUT: About = About {
    title: "Forces",
    question: "When and how hard?",
    purpose: "the force profiles",
    new: || Box::new(Forces::default()),
};

impl Panes for Forces {
    const PANES: &'static [Pane<Self>] = &[Pane::new("forces", TimeKeys::Early, &[KEYS])];
}

#[rustfmt::skip]
const KEYS: PaneKeys<Forces> = PaneKeys::new("Forces", &[
    bind(&[LEFT, c('h')], |s, m| s.step_time(m, Step::LESS), "cursor", "the cursor to the left"),
    bind(&[RIGHT, c('l')], |s, m| s.step_time(m, Step::MORE), "&", "the cursor to the right"),
    bind(&[SHIFT_LEFT, c('H')], |s, m| s.step_time(m, Step::MUCH_LESS), "", "the cursor far to the left"),
    bind(&[SHIFT_RIGHT, c('L')], |s, m| s.step_time(m, Step::MUCH_MORE), "", "the cursor far to the right"),
    bind(&[c('i')], |s, _| s.zoom = s.zoom.nearer(), "zoom", "half of the time shown, about the cursor"),
    bind(&[c('o')], |s, _| s.zoom = s.zoom.farther(), "&", "twice of the time shown, up to the whole"),
    bind(&[c('v')], |s, m| s.next_view(m), "view", "the next curves: felt, nodes, movement, energies, tissues"),
    bind(&[c('V')], |s, m| s.last_view(m), "&", "the curves before"),
]);

impl Screen for Forces {
    fn draw(&self, model: &AppModel, sheet: &mut Sheet) {
        draw(*self, model, sheet);
    }

    fn courses(&self, model: &AppModel) -> Vec<Trace> {
        let mut views = all_views(model);
        if views.is_empty() {
            return Vec::new();
        }
        let place = self.view % views.len();
        let charts = views.swap_remove(place).charts;
        charts.into_iter().flatten().collect()
    }
}

impl Forces {
    /// The next set of curves.
    fn next_view(&mut self, model: &AppModel) {
        let count = all_views(model).len().max(1);
        self.view = (self.view % count + 1) % count;
    }

    /// The set of curves before.
    fn last_view(&mut self, model: &AppModel) {
        let count = all_views(model).len().max(1);
        self.view = (self.view % count + count - 1) % count;
    }
}

/// What the screen can show of the answer to the form.
fn all_views(model: &AppModel) -> Vec<View> {
    let traces = model.shown.as_ref().and_then(|s| s.answer.run.traces.as_ref());
    traces.map(views).unwrap_or_default()
}

fn draw(forces: Forces, model: &AppModel, sheet: &mut Sheet) {
    let (area, theme) = (sheet.area, sheet.theme);
    let Some(shown) = &model.shown else {
        sheet.put((1, 1), "no result yet", theme.text());
        return;
    };
    let time = model.time();
    let views = all_views(model);
    let place = forces.view % views.len().max(1);
    let view = views.get(place);
    let (said, style) = match (model.stale(), view) {
        (Some(why), _) => (why.to_owned(), theme.warning()),
        (None, Some(view)) => {
            let of = views.len();
            (format!("v: {}, {} of {of}", view.name, place + 1), theme.heading())
        }
        (None, None) => (String::new(), theme.quiet()),
    };
    let mut text = format!(" cursor {:.4} ms", time * 1e3);
    let room = area.width.saturating_sub(width(&text) + width(&said) + 4);
    if let Some(peak) = peak_said(&shown.answer, time, |peak| width(peak) < room) {
        text.extend(["  ", &peak]);
    }
    sheet.put((0, 0), &text, theme.strong());
    sheet.put_right((area.width - 1, 0), &said, style);
    let (Some(traces), Some(view)) = (&shown.answer.run.traces, view) else {
        return;
    };
    let charts = Rect::new(area.x, area.y + 1, area.width, area.height - 1);
    let (columns, rows) = match view.charts.len() {
        1 => (1, 1),
        2 => (1, 2),
        _ => (2, 2),
    };
    let (wide, high) = (charts.width / columns, charts.height / rows);
    for (i, curves) in view.charts.iter().enumerate() {
        let (column, row) = (i as u16 % columns, i as u16 / columns);
        let place = Rect::new(charts.x + column * wide, charts.y + row * high, wide - 1, high);
        chart(model, forces.zoom, (shown, traces), curves, &mut sheet.at(place));
    }
}

fn chart(
    model: &AppModel,
    zoom: Zoom,
    (shown, traces): (&ShownAnswer, &Traces),
    courses: &[Trace],
    sheet: &mut Sheet,
) {
    let (area, theme) = (sheet.area, sheet.theme);
    let time = model.time();
    // A curve by itself keeps its colour in every view.
    let first = match courses {
        [only] => recorded(traces).iter().position(|c| c == only),
        _ => None,
    };
    let values = courses.iter().map(|course| course.values(traces));
    let window = shown.answer.window();
    let active = active(&traces.time, values, window);
    let curves = courses
        .iter()
        .enumerate()
        .map(|(i, course)| TimeCurve {
            time: &traces.time,
            values: course.values(traces),
            factor: course.row().factor,
            ink: Ink::solid(theme.curve(first.unwrap_or(i)), 2 + i as u8, mark(i)),
        })
        .collect();
    let reading = |course: &Trace| {
        let value = value_at(&traces.time, course.values(traces), time)?;
        let value = value * course.row().factor;
        Some(at_a_moment(&shown.answer, *course, value))
    };
    let (title, now) = if let [only] = courses {
        let (unit, label) = (only.row().unit, only.label(traces));
        let now = reading(only).unwrap_or_default();
        let short = match only {
            Trace::Of(of) => of.row().short,
            Trace::Other(_) => label,
        };
        // The reading has the unit too.
        let texts = [format!("{label}, {unit}"), label.to_owned(), short.to_owned()];
        let room = area.width.saturating_sub(TITLED + width(&now));
        let fitting = texts.iter().find(|text| width(text) <= room);
        (fitting.unwrap_or(&texts[0]).clone(), now)
    } else {
        (String::new(), String::new())
    };
    let entries: Vec<String> = courses
        .iter()
        .enumerate()
        .map(|(i, course)| {
            let now = reading(course).unwrap_or_default();
            format!("{} {} {now}", mark(i), course.label(traces))
        })
        .collect();
    // What does not fit into one line of the legend takes two.
    let room = area.width.saturating_sub(LEGEND);
    let long: u16 = entries.iter().map(|text| width(text) + 2).sum();
    let lines = if courses.len() > 1 && long > room + 2 { 2 } else { 1 };
    let field = below(area, lines - 1);
    TimeChart {
        title: &title,
        reading: &now,
        curves,
        span: zoom.span(active, window, time),
        cursor: time,
    }
    .draw(&mut sheet.at(field));
    if courses.len() > 1 {
        let each = entries.len().div_ceil(usize::from(lines));
        let mut x = LEGEND;
        for (i, text) in entries.iter().enumerate() {
            if i % each == 0 {
                x = LEGEND;
            }
            let y = (i / each) as u16;
            x = sheet.put((x, y), text, theme.curve(i)) + 2;
        }
    }
}

/// Columns before a title and between it and the reading.
const TITLED: u16 = 8;
/// Where the legend of several curves begins.
const LEGEND: u16 = 8;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn zoom_halves_the_time_about_the_cursor_and_stays_inside_it() {
        let (active, window) = ((1.0, 5.0), 9.0);
        let mut zoom = Zoom::default();
        assert_eq!(zoom.span(active, window, 2.0), (1.0, 5.0));
        assert_eq!(zoom.farther().span(active, window, 2.0), (0.0, 9.0));
        zoom = zoom.nearer();
        assert_eq!(zoom.span(active, window, 3.5), (2.5, 4.5));
        assert_eq!(zoom.span(active, window, 0.0), (1.0, 3.0));
        assert_eq!(zoom.span(active, window, 8.0), (3.0, 5.0));
        for _ in 0..20 {
            zoom = zoom.nearer();
        }
        assert_eq!(zoom, Zoom::Close(CLOSEST));
        assert_eq!(Zoom::Whole.nearer(), Zoom::Close(0));
    }
}
