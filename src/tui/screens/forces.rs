//! Curves over time with axes, and a cursor that reads their values. The cursor is the clock.

use crate::report::figure::at_a_moment;
use crate::run::trace::{TRACES, Trace};
use crate::run::{kept::Traces, quantity::Quantity, result_trace::Group};
use crate::tui::keys::press::{LEFT, RIGHT, SHIFT_LEFT, SHIFT_RIGHT, c};
use crate::tui::screens::screen::{Pane, PaneKeys, Panes, Screen, bind};
use crate::tui::view::chart::{TimeChart, TimeCurve, active, colour_of, mark, value_at};
use crate::tui::view::{below, raster::Ink, sheet::Sheet, text::width};
use crate::tui::{clock::peak_said, keys::TimeKeys};
use crate::tui::{model::AppModel, shown::ShownAnswer, step::Step};
use strum::VariantArray;

/// Charts that stand together under a name, each with the curves in it.
type View = (&'static str, Vec<Vec<Trace>>);

/// Charts of one curve each that stand in one view, and curves that stand in one chart.
const MAX_CHARTS: usize = 4;
const MAX_CURVES: usize = 6;

#[derive(Clone, Copy, Default)]
pub struct Forces {
    view: usize,
    /// How often the time in which something happens is halved about the cursor; below 0, all time.
    zoom: i32,
}

/// The bounds of that.
const WHOLE: i32 = -1;
const CLOSEST: i32 = 6;

/// The ends of the time drawn, of a window with something in `active`.
fn span(zoom: i32, active: (f64, f64), window: f64, cursor: f64) -> (f64, f64) {
    if zoom <= WHOLE {
        return (0.0, window);
    }
    let wide = (active.1 - active.0) / f64::from(1 << zoom);
    let from = (cursor - 0.5 * wide).clamp(active.0, (active.1 - wide).max(active.0));
    (from, from + wide)
}

/// Every course that is drawn as a curve; of the load and the force of contact that which drives.
pub fn drawn() -> impl Iterator<Item = Trace> {
    let named = |course: &Trace| !matches!(course.row().place.0, Group::Input | Group::Projectile);
    TRACES.iter().copied().filter(named)
}

/// Those that a recording has.
fn recorded(traces: &Traces) -> impl Iterator<Item = Trace> {
    drawn().filter(|curve| !curve.values(traces).is_empty())
}

/// What the screen can show of a recording: of an eye that was hit first what it felt.
fn views(traces: &Traces) -> Vec<View> {
    let alone = |name, own: &[Trace]| (name, own.iter().map(|curve| vec![*curve]).collect());
    let [contact, pressure, stretch] = Quantity::FELT;
    let felt = [contact, pressure, stretch, Quantity::Apex].map(Trace::Of);
    let mut views: Vec<View> = Vec::new();
    if felt.iter().all(|curve| !curve.values(traces).is_empty()) {
        views.push(alone("what the eye felt", &felt));
    }
    for group in Group::VARIANTS {
        let own: Vec<Trace> = recorded(traces).filter(|c| c.row().place.0 == *group).collect();
        let name = match group {
            Group::NodeForces => "the four nodes",
            Group::Energies => "energies",
            Group::Inside => "pressures and stress",
            Group::Tissues => "tissues",
            Group::Motion | Group::Input | Group::Projectile => "load and movement",
        };
        if *group == Group::Energies {
            views.extend(own.chunks(MAX_CURVES).map(|own| (name, vec![own.to_vec()])));
        } else {
            views.extend(own.chunks(MAX_CHARTS).map(|own| alone(name, own)));
        }
        if *group == Group::NodeForces {
            views.extend(own.iter().map(|one| alone(one.row().label, &[*one])));
        }
    }
    views
}

impl Panes for Forces {
    const PANES: &'static [Pane<Self>] = &[Pane::new("forces", TimeKeys::Early, &[KEYS])];
}

#[rustfmt::skip]
const KEYS: PaneKeys<Forces> = PaneKeys::new("Forces", &[
    bind(&[LEFT, c('h')], |s, m| s.step(m, Step::LESS), "cursor", "the cursor to the left"),
    bind(&[RIGHT, c('l')], |s, m| s.step(m, Step::MORE), "&", "the cursor to the right"),
    bind(&[SHIFT_LEFT, c('H')], |s, m| s.step(m, Step::MUCH_LESS), "", "the cursor far to the left"),
    bind(&[SHIFT_RIGHT, c('L')], |s, m| s.step(m, Step::MUCH_MORE), "", "the cursor far to the right"),
    bind(&[c('i')], |s, _| s.change_zoom(1), "zoom", "half of the time shown, about the cursor"),
    bind(&[c('o')], |s, _| s.change_zoom(-1), "&", "twice of the time shown, up to the whole"),
    bind(&[c('v')], |s, m| s.turn(m, 1), "view", "the next curves: felt, nodes, movement, energies, tissues"),
    bind(&[c('V')], |s, m| s.turn(m, -1), "&", "the curves before"),
]);

impl Screen for Forces {
    fn draw(&self, model: &AppModel, sheet: &mut Sheet) {
        let (area, theme) = (sheet.area, sheet.theme);
        let Some(shown) = &model.shown else {
            sheet.put((1, 1), "no result yet", theme.text());
            return;
        };
        let time = model.time();
        let views = views_of(model);
        let place = self.view % views.len().max(1);
        let view = views.get(place);
        let (said, style) = match (model.stale(), view) {
            (Some(why), _) => (why.to_owned(), theme.warning()),
            (None, Some((name, _))) => {
                (format!("v: {name}, {} of {}", place + 1, views.len()), theme.heading())
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
        let (Some(traces), Some((_, charts))) = (&shown.answer.run.traces, view) else {
            return;
        };
        let grid = match charts.len() {
            1 => (1, 1),
            2 => (1, 2),
            _ => (2, 2),
        };
        let mut field = sheet.at(below(area, 1));
        for (i, curves) in charts.iter().enumerate() {
            let place = &mut field.tile(i, grid);
            place.area.width -= 1;
            chart(model, self.zoom, (shown, traces), curves, place);
        }
    }

    fn courses(&self, model: &AppModel) -> Vec<Trace> {
        let views = views_of(model);
        let here = views.get(self.view % views.len().max(1));
        here.map_or_else(Vec::new, |(_, charts)| charts.concat())
    }
}

impl Forces {
    fn change_zoom(&mut self, by: i32) {
        self.zoom = (self.zoom + by).clamp(WHOLE, CLOSEST);
    }

    /// Shows the next set of curves, or the one before.
    fn turn(&mut self, model: &AppModel, by: isize) {
        let count = views_of(model).len().max(1);
        self.view = (self.view % count + count).saturating_add_signed(by) % count;
    }
}

/// What the screen can show of the answer to the form.
fn views_of(model: &AppModel) -> Vec<View> {
    let traces = model.shown.as_ref().and_then(|s| s.answer.run.traces.as_ref());
    traces.map(views).unwrap_or_default()
}

fn chart(
    model: &AppModel,
    zoom: i32,
    (shown, traces): (&ShownAnswer, &Traces),
    courses: &[Trace],
    sheet: &mut Sheet,
) {
    let (area, theme, cursor) = (sheet.area, sheet.theme, model.time());
    // A curve by itself has its colour on every screen.
    let first = match courses {
        [only] => Some(colour_of(*only)),
        _ => None,
    };
    let curves = (0_u8..).zip(courses).map(|(i, course)| {
        let ink = Ink::solid(theme.curve(first.unwrap_or(i.into())), 2 + i, mark(i.into()));
        let (values, factor) = (course.values(traces), course.row().factor);
        TimeCurve { time: &traces.time, values, factor, ink }
    });
    let reading = |course: &Trace| {
        let value = value_at(&traces.time, course.values(traces), cursor);
        let said = |value| at_a_moment(&shown.answer, *course, value * course.row().factor);
        value.map(said).unwrap_or_default()
    };
    let (mut title, mut now, mut entries) = (String::new(), String::new(), Vec::new());
    if let [only] = courses {
        now = reading(only);
        let label = only.label(traces);
        let short = match only {
            Trace::Of(of) => of.row().short,
            Trace::Other(_) => label,
        };
        // The reading has the unit too.
        title = format!("{label}, {}", only.row().unit);
        let room = area.width.saturating_sub(TITLED + width(&now));
        if width(&title) > room
            && let Some(fitting) = [label, short].into_iter().find(|text| width(text) <= room)
        {
            title.replace_range(.., fitting);
        }
    } else {
        entries.extend(courses.iter().enumerate().map(|(i, course)| {
            let text = format!("{} {} {}", mark(i), course.label(traces), reading(course));
            (text, theme.curve(i))
        }));
    }
    // What does not fit into one line of the legend takes two.
    let long: u16 = entries.iter().map(|(text, _)| width(text) + 2).sum();
    let lines = if long > area.width.saturating_sub(LEGEND) + 2 { 2 } else { 1 };
    let window = shown.answer.window();
    let values = courses.iter().map(|course| course.values(traces));
    let active = active(&traces.time, values, window);
    let (curves, span) = (curves.collect(), span(zoom, active, window, cursor));
    let chart = TimeChart { title: &title, reading: &now, curves, span, cursor };
    chart.draw(&mut sheet.at(below(area, lines - 1)));
    let each = entries.len().div_ceil(lines.into()).max(1);
    for (y, line) in (0..).zip(entries.chunks(each)) {
        let mut x = LEGEND;
        for (text, style) in line {
            x = sheet.put((x, y), text, *style) + 2;
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
        for (zoom, cursor, ends) in [
            (WHOLE, 2.0, (0.0, 9.0)),
            (0, 2.0, active),
            (1, 3.5, (2.5, 4.5)),
            (1, 0.0, (1.0, 3.0)),
            (1, 8.0, (3.0, 5.0)),
        ] {
            assert_eq!(span(zoom, active, window, cursor), ends);
        }
        let mut forces = Forces::default();
        for (by, end) in [(1, CLOSEST), (-1, WHOLE)] {
            (0..20).for_each(|_| forces.change_zoom(by));
            assert_eq!(forces.zoom, end);
        }
    }
}
