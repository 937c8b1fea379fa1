//! The replay in full size: the eye, its legend, the readings, and time with the pulse in it.

use ratatui::style::Style;

use crate::report::picture::Part;
use crate::report::{figure::at_a_moment, format::grouped, format::significant};
use crate::run::trace::{OtherTrace, TRACES, Trace};
use crate::run::{places::Region, quantity::Quantity, result_trace::Group};
use crate::tui::clock::{MeshDetail, peak_said};
use crate::tui::keys::press::{LEFT, RIGHT, SHIFT_LEFT, SHIFT_RIGHT, c};
use crate::tui::keys::{Binding, TimeKeys};
use crate::tui::screens::screen::{Act, Pane, PaneKeys, Panes, Screen, bind};
use crate::tui::view::chart::{TimeCurve, fill, value_at};
use crate::tui::view::heat::{heat_glyph, thresholds};
use crate::tui::view::picture::{NAMED, blank_cornea, swatch};
use crate::tui::view::raster::{Ink, Raster};
use crate::tui::view::sheet::{Sheet, along};
use crate::tui::view::text::{width, wrapped};
use crate::tui::{form::unverified, model::AppModel, shown::ShownAnswer, step::Step};
use crate::tui::{terminal::caps::Symbols, view::eye::EyePicture};

/// Rows from which on each part has a line of its own.
const TALL: u16 = 30;
/// Room at the right for legend and readings.
const SIDE: u16 = 24;

#[derive(Default)]
pub struct Replay {
    /// Whether the eye is seen from the front and not cut.
    front: bool,
}

impl Panes for Replay {
    const PANES: &'static [Pane<Self>] = &[Pane::new("replay", TimeKeys::Early, &[FRAMES, FRONT])];
}

const FRAMES: PaneKeys<Replay> = PaneKeys::new("Replay", Replay::FRAME_KEYS);

#[rustfmt::skip]
const FRONT: PaneKeys<Replay> = PaneKeys::new("Replay", &[
    bind(&[c('f')], Replay::turn, "front", "the eye from the front, or cut"),
]);

/// The keys of a screen that go from frame to frame, wherever the eye is replayed.
pub trait FrameKeys: Screen + Sized {
    #[rustfmt::skip]
    const FRAME_KEYS: &'static [Binding<Act<Self>>] = &[
        bind(&[LEFT, c('h')], |s, m| s.step(m, Step::LESS), "frame", "the frame before"),
        bind(&[RIGHT, c('l')], |s, m| s.step(m, Step::MORE), "&", "the next frame"),
        bind(&[SHIFT_LEFT, c('H')], |s, m| s.step(m, Step::MUCH_LESS), "", "ten frames back"),
        bind(&[SHIFT_RIGHT, c('L')], |s, m| s.step(m, Step::MUCH_MORE), "", "ten frames on"),
        bind(&[c('c')], |_, m| change_field(m), "field", "what fills the eye: pressure, strain or forces"),
    ];
}

impl<S: Screen> FrameKeys for S {}

impl Screen for Replay {
    fn draw(&self, model: &AppModel, sheet: &mut Sheet) {
        let (area, theme) = (sheet.area, sheet.theme);
        let Some(shown) = &model.shown else {
            sheet.put((1, 1), "no result yet", theme.text());
            return;
        };
        let (wide, high) = (area.width - SIDE, area.height - 3);
        let plain = EyePicture::of(model, shown, model.time());
        let drawn = EyePicture { blow: Some(&shown.scenario), front: self.front, ..plain };
        let anatomy = drawn.detail == MeshDetail::Anatomy;
        // What reaches the edge does not touch the legend.
        let field = sheet.part((0, 0), (wide - 1, high));
        drawn.draw(field.area, field.buffer);
        if model.clock.zoom() > 1 && !anatomy {
            let text = format!(" motion shown {}x larger ", model.clock.zoom());
            sheet.put((2, 0), text, theme.warning());
        }
        if let Some(why) = model.stale() {
            let text = format!(" {why} ");
            sheet.put((0, high - 2), text, theme.warning());
        }
        let front = anatomy.then_some(self.front);
        side_panel(model, shown, front, &mut sheet.part((wide, 0), (SIDE, high)));
        time_bar(model, shown, &mut sheet.part((0, high), (area.width, 3)));
    }
}

impl Replay {
    /// Shows the eye from the front or cut, its anatomy first.
    fn turn(&mut self, model: &mut AppModel) {
        if !model.can_face_front() {
            return;
        }
        let Some(shown) = &model.shown else { return };
        let hit = shown.drawing.object.is_some();
        let anatomy = model.clock.detail(hit) == MeshDetail::Anatomy;
        self.front = !(self.front && anatomy);
        while model.clock.detail(hit) != MeshDetail::Anatomy {
            model.clock.change_detail();
        }
    }
}

fn change_field(model: &mut AppModel) {
    let object = model.shown.as_ref().and_then(|shown| shown.drawing.object.as_ref());
    model.clock.change_field(object.is_some());
}

fn side_panel(model: &AppModel, shown: &ShownAnswer, anatomy: Option<bool>, sheet: &mut Sheet) {
    let (area, theme, time) = (sheet.area, sheet.theme, model.time());
    let mut y = match anatomy {
        Some(front) => parts(front, model, shown, sheet),
        None => legend(shown.hottest, sheet),
    };
    let (mut next, hit) = (model.clock, shown.drawing.object.is_some());
    next.change_detail();
    let next = format!("e: {}", next.detail(hit).name());
    sheet.put_right((area.width - 1, 0), next, theme.quiet());
    sheet.put((0, y), "Now", theme.heading());
    let traces = shown.answer.run.traces.as_ref();
    let forces = TRACES.iter().copied();
    let forces = forces.filter(|course| course.row().place.0 == Group::NodeForces);
    let first = std::iter::once(Trace::Other(OtherTrace::Drive));
    for course in first.chain(forces).chain([Trace::Of(Quantity::Apex)]) {
        y += 1;
        let row = course.row();
        let now = traces.and_then(|t| value_at(&t.time, course.values(t), time));
        let reading = |value: f64| at_a_moment(&shown.answer, course, value * row.factor);
        let text = now.map_or("-".to_owned(), reading);
        let mut label = traces.map_or(row.label, |traces| course.label(traces));
        if let Trace::Of(of) = course
            && width(label) + width(&text) + 1 >= area.width
        {
            label = of.row().short;
        }
        sheet.put((0, y), label, theme.text());
        sheet.put_right((area.width - 1, y), &text, theme.strong());
    }
    y += 1;
    let unverified = !unverified(&shown.scenario).is_empty();
    let room = usize::from(area.width - 1);
    // What stands below keeps its lines.
    let rows = usize::from(area.height.saturating_sub(y + 1 + u16::from(unverified)));
    let fits = |text: &str| wrapped(text, room).len() <= rows;
    let peak = wrapped(&peak_said(&shown.answer, time, fits).unwrap_or_default(), room);
    sheet.put_lines((0, y), &peak, theme.cursor());
    if unverified && y + peak.len() as u16 + 1 < area.height {
        sheet.put((0, area.height - 2), "? unverified figures", theme.warning());
    }
    let material = model.work.scenario.model.title();
    sheet.put((0, area.height - 1), material, theme.quiet());
}

/// The parts of the anatomy that are seen, each with its colour; gives the row below them.
fn parts(front: bool, model: &AppModel, shown: &ShownAnswer, sheet: &mut Sheet) -> u16 {
    let (area, theme) = (sheet.area, sheet.theme);
    sheet.put((0, 0), "What you see", theme.heading());
    let hit = shown.drawing.object.is_some();
    let of_blow = [(Part::Object, "object"), (Part::Pressed, "pressed")];
    let more = of_blow.into_iter().filter(|_| hit).chain([(Part::Fat, "fat")]);
    let seen = NAMED.into_iter().chain(more).filter(|(part, _)| !front || part.is_outside());
    // Without colours several parts have one sign.
    let blank = blank_cornea(front, model.look);
    let seen = seen.filter(|(part, _)| !blank || *part != Part::Cornea);
    let signs = seen.map(|(part, name)| (swatch(part, model.look), name));
    let signs = signs.filter(|((sign, style), _)| sign != " " || *style != Style::new());
    let (mut x, mut y) = (0, 1);
    for ((sign, style), names) in grouped(signs) {
        let lines = wrapped(&names.join(", "), usize::from(area.width - 3));
        let wide = lines.iter().map(|line| width(line) + 3).max().unwrap_or(0);
        if x > 0 && (area.height >= TALL || x + wide > area.width) {
            (x, y) = (0, y + 1);
        }
        sheet.put((x, y), &sign, style);
        sheet.put_lines((x + 2, y), &lines, theme.text());
        y += (lines.len() as u16).saturating_sub(1);
        x += wide;
    }
    if !front {
        y += 1;
        let ascii = model.look.symbols == Symbols::Ascii;
        let x = sheet.put((0, y), if ascii { "::" } else { "⠒⠒" }, theme.quiet());
        sheet.put((x, y), " at rest", theme.text());
        sheet.put_right((area.width - 1, y), "c: field", theme.quiet());
    }
    y + 2
}

/// Steps of force with their colours, and the parts of the eye with theirs; gives the row below.
fn legend(largest: f64, sheet: &mut Sheet) -> u16 {
    let (area, theme) = (sheet.area, sheet.theme);
    sheet.put((0, 0), "Node force", theme.heading());
    let ascii = theme.look.symbols == Symbols::Ascii;
    let steps = thresholds(largest, theme.heat_steps());
    let (mut x, mut y) = (0, 1);
    for (step, force) in steps.iter().enumerate().rev() {
        let step = step + 1;
        let text = format!(">{force}N ");
        if x + width(&text) + 1 > area.width {
            (x, y) = (0, y + 1);
        }
        let sign = if theme.is_mono() || ascii { heat_glyph(step) } else { '█' };
        x = sheet.put((x, y), sign.to_string(), theme.heat(step));
        x = sheet.put((x, y), &text, theme.text());
    }
    if let Some(least) = steps.first() {
        // What is colder has the colour of its part.
        let short = format!("<{least}N");
        sheet.put_longest((x, y), &[&format!("{short}: by part"), &short, ""], theme.quiet());
    }
    sheet.put((0, y + 1), "C F R T: nodes below", theme.quiet());
    let parts = [
        (Region::Shell, "shell", ["━", "o"]),
        (Region::Retina, "retina", ["█", "R"]),
        (Region::Lens, "lens", ["━", "l"]),
        (Region::Interior, "globe", ["╌", "."]),
        (Region::Fat, "fat", ["·", ","]),
        (Region::Orbit, "orbit", ["━", "#"]),
    ];
    for (i, (region, name, signs)) in (0..).zip(parts) {
        let y = y + 2 + i / 3;
        let after = sheet.put((i % 3 * 8, y), signs[usize::from(ascii)], theme.region(region));
        sheet.put((after, y), name, theme.text());
    }
    y + 4
}

/// Time from 0 to the end of the window, with the pulse drawn in it.
fn time_bar(model: &AppModel, shown: &ShownAnswer, sheet: &mut Sheet) {
    let (area, theme) = (sheet.area, sheet.theme);
    let time = model.time();
    let window = shown.answer.window();
    let state = if model.clock.playing { "▶ playing" } else { "paused" };
    let text = format!("{:.3} of {} ms", time * 1e3, significant(window * 1e3));
    let end = sheet.put((1, 0), &text, theme.strong());
    let detail = model.clock.detail(shown.drawing.object.is_some()).name();
    let rest = format!("  {state}  {} ms/s  {detail}", model.clock.speed());
    sheet.put((end, 0), &rest, theme.text());
    let field = &mut sheet.part((1, 1), (area.width - 2, 2));
    if let Some(traces) = &shown.answer.run.traces {
        let mut raster = Raster::new(field.area, model.look.symbols);
        let values = Trace::Other(OtherTrace::Drive).values(traces);
        let ink = Ink::solid(theme.load(), 1, '#');
        let curve = TimeCurve { time: &traces.time, values, factor: 1.0, ink };
        fill(&mut raster, curve, window);
        raster.paint(field.buffer);
    }
    let x = along((time / window).clamp(0.0, 1.0), field.area.width);
    field.put((x, 0), "│", theme.cursor());
    field.put((x, 1), "▲", theme.cursor());
}
