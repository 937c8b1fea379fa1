//! The replay in full size: the eye, its legend, the readings, and time with the pulse in it.

use std::marker::PhantomData;

use ratatui::style::Style;

use crate::report::{
    figure::at_a_moment, format::significant, picture::Part, picture::front::seen,
};
use crate::run::trace::{OtherTrace, TRACES, Trace};
use crate::run::{places::Region, quantity::Quantity, result_trace::Group};
use crate::tui::clock::{MeshDetail, peak_said};
use crate::tui::keys::press::{LEFT, RIGHT, SHIFT_LEFT, SHIFT_RIGHT, c};
use crate::tui::keys::{Binding, TimeKeys};
use crate::tui::screens::screen::{About, Act, Pane, PaneKeys, Panes, Screen, bind};
use crate::tui::view::chart::{TimeCurve, value_at};
use crate::tui::view::heat::{heat_glyph, thresholds};
use crate::tui::view::picture::{NAMED, swatch};
use crate::tui::view::raster::{Ink, Raster};
use crate::tui::view::sheet::{Sheet, along};
use crate::tui::view::text::{longest_fitting, width, wrapped};
use crate::tui::{form::unverified, model::AppModel, shown::ShownAnswer, step::Step};
use crate::tui::{terminal::caps::Symbols, view::eye::EyePicture};

/// Rows from which on each part has a line of its own.
const TALL: u16 = 30;
/// Room at the right for legend and readings.
const SIDE: u16 = 24;

pub(super) const ABOUT: About = About {
    title: "Replay",
    question: "What moved?",
    purpose: "the replay in full size",
    new: || Box::new(Replay::default()),
};

/// What the screen keeps to itself.
#[derive(Default)]
pub struct Replay {
    /// Whether the eye is seen from the front and not cut.
    front: bool,
}

impl Panes for Replay {
    const PANES: &'static [Pane<Self>] =
        &[Pane::new("replay", TimeKeys::Early, &[PaneKeys::new("Replay", FrameKeys::ALL), FRONT])];
}

#[rustfmt::skip]
const FRONT: PaneKeys<Replay> = PaneKeys::new("Replay", &[
    bind(&[c('f')], Replay::turn, "front", "the eye from the front, or cut"),
]);

/// The keys of a screen that go from frame to frame, wherever the eye is replayed.
pub struct FrameKeys<S>(PhantomData<S>);

#[rustfmt::skip]
impl<S: Screen> FrameKeys<S> {
    /// The keys.
    pub const ALL: &'static [Binding<Act<S>>] = &[
        bind(&[LEFT, c('h')], |s, m| s.step_time(m, Step::LESS), "frame", "the frame before"),
        bind(&[RIGHT, c('l')], |s, m| s.step_time(m, Step::MORE), "&", "the next frame"),
        bind(&[SHIFT_LEFT, c('H')], |s, m| s.step_time(m, Step::MUCH_LESS), "", "ten frames back"),
        bind(&[SHIFT_RIGHT, c('L')], |s, m| s.step_time(m, Step::MUCH_MORE), "", "ten frames on"),
        bind(&[c('c')], |_, m| change_field(m), "field", "what fills the eye: pressure, strain or forces"),
    ];
}

impl Screen for Replay {
    fn draw(&self, model: &AppModel, sheet: &mut Sheet) {
        draw(self.front, model, sheet);
    }
}

impl Replay {
    /// Shows the eye from the front or cut, its anatomy first.
    fn turn(&mut self, model: &mut AppModel) {
        let Some(shown) = &model.shown else { return };
        let frame = shown.answer.run.frames.first();
        let faced = frame.and_then(|frame| seen(&shown.drawing, frame));
        if faced.is_none() {
            model.notice = Some("a section has no front: hit the eye with an object".to_owned());
            return;
        }
        let hit = shown.drawing.object.is_some();
        let anatomy = model.clock.detail(hit) == MeshDetail::Anatomy;
        self.front = !(self.front && anatomy);
        while model.clock.detail(hit) != MeshDetail::Anatomy {
            model.clock.change_detail();
        }
    }
}

fn change_field(model: &mut AppModel) {
    let shown = model.shown.as_ref();
    let hit = shown.is_some_and(|shown| shown.drawing.object.is_some());
    model.clock.change_field(hit);
}

fn draw(front: bool, model: &AppModel, sheet: &mut Sheet) {
    let (area, theme) = (sheet.area, sheet.theme);
    let Some(shown) = &model.shown else {
        sheet.put((1, 1), "no result yet", theme.text());
        return;
    };
    let (wide, high) = (area.width - SIDE, area.height - 3);
    let drawn = EyePicture {
        blow: Some(&shown.scenario),
        front,
        ..EyePicture::of(model, shown, model.time())
    };
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
    let front = anatomy.then_some(front);
    side_panel(model, shown, front, &mut sheet.part((wide, 0), (SIDE, high)));
    time_bar(model, shown, &mut sheet.part((0, high), (area.width, 3)));
}

fn side_panel(model: &AppModel, shown: &ShownAnswer, anatomy: Option<bool>, sheet: &mut Sheet) {
    let (area, theme) = (sheet.area, sheet.theme);
    let time = model.time();
    let mut y = 0;
    if let Some(front) = anatomy {
        parts(front, (model, shown), &mut y, sheet);
    } else {
        sheet.put((0, y), "Node force", theme.heading());
        sheet.put_right((area.width - 1, y), "e: anatomy", theme.quiet());
        y += 1;
        legend(shown.hottest, &mut y, sheet);
    }
    let traces = shown.answer.run.traces.as_ref();
    sheet.put((0, y), "Now", theme.heading());
    y += 1;
    let forces = TRACES.iter().copied();
    let forces = forces.filter(|course| course.row().place.0 == Group::NodeForces);
    let first = std::iter::once(Trace::Other(OtherTrace::Drive));
    for course in first.chain(forces).chain([Trace::Of(Quantity::Apex)]) {
        let row = course.row();
        let label = traces.map_or(row.label, |traces| course.label(traces));
        let now = traces.and_then(|t| value_at(&t.time, course.values(t), time));
        let reading = |value: f64| at_a_moment(&shown.answer, course, value * row.factor);
        let text = now.map_or("-".to_owned(), reading);
        let label = match course {
            Trace::Of(of) if width(label) + width(&text) + 1 >= area.width => of.row().short,
            _ => label,
        };
        sheet.put((0, y), label, theme.text());
        sheet.put_right((area.width - 1, y), &text, theme.strong());
        y += 1;
    }
    let unverified = !unverified(&shown.scenario).is_empty();
    let room = usize::from(area.width - 1);
    // What stands below keeps its lines.
    let rows = usize::from(area.height.saturating_sub(y + 1 + u16::from(unverified)));
    let fits = |text: &str| wrapped(text, room).len() <= rows;
    let peak = peak_said(&shown.answer, time, fits).unwrap_or_default();
    for line in wrapped(&peak, room) {
        sheet.put((0, y), &line, theme.cursor());
        y += 1;
    }
    if unverified && y + 1 < area.height {
        let at = (0, area.height - 2);
        sheet.put(at, "? unverified figures", theme.warning());
    }
    let material = model.work.scenario.model.title();
    sheet.put((0, area.height - 1), material, theme.quiet());
}

/// The parts of the anatomy that are seen, each with its colour.
fn parts(front: bool, (model, shown): (&AppModel, &ShownAnswer), y: &mut u16, sheet: &mut Sheet) {
    let (area, theme) = (sheet.area, sheet.theme);
    sheet.put((0, *y), "What you see", theme.heading());
    sheet.put_right((area.width - 1, *y), "e: mesh", theme.quiet());
    *y += 1;
    let hit = shown.drawing.object.is_some();
    let more = [(Part::Object, "object"), (Part::Pressed, "pressed"), (Part::Fat, "fat")];
    let more = more.into_iter().filter(|(part, _)| hit || *part == Part::Fat);
    let tall = area.height >= TALL;
    let mut x = 0;
    let all = NAMED.into_iter().chain(more);
    let seen = all.filter(|(part, _)| !front || part.is_outside());
    // Without colours several parts have one sign.
    let mut signs: Vec<(String, Style, Vec<&str>)> = Vec::new();
    for (part, name) in seen {
        let (sign, style) = swatch(part, model.look);
        match signs.iter_mut().find(|known| (&known.0, known.1) == (&sign, style)) {
            Some((.., names)) => names.push(name),
            None if sign == " " && style == Style::new() => {}
            None => signs.push((sign, style, vec![name])),
        }
    }
    for (sign, style, names) in signs {
        let lines = wrapped(&names.join(", "), usize::from(area.width - 3));
        let wide = lines.iter().map(|line| width(line) + 3).max().unwrap_or(0);
        if x > 0 && (tall || x + wide > area.width) {
            (x, *y) = (0, *y + 1);
        }
        sheet.put((x, *y), &sign, style);
        for (i, line) in lines.iter().enumerate() {
            *y += u16::from(i > 0);
            sheet.put((x + 2, *y), line, theme.text());
        }
        x += wide;
    }
    *y += 1;
    if front {
        *y += 1;
        return;
    }
    let ascii = model.look.symbols == Symbols::Ascii;
    let dots = if ascii { "::" } else { "⠒⠒" };
    let x = sheet.put((0, *y), dots, theme.quiet());
    sheet.put((x, *y), " at rest", theme.text());
    sheet.put_right((area.width - 1, *y), "c: field", theme.quiet());
    *y += 2;
}

/// Steps of force with their colours, and the parts of the eye with theirs.
fn legend(largest: f64, y: &mut u16, sheet: &mut Sheet) {
    let (area, theme) = (sheet.area, sheet.theme);
    let ascii = theme.look.symbols == Symbols::Ascii;
    let steps = thresholds(largest, theme.heat_steps());
    let mut x = 0;
    for (i, force) in steps.iter().enumerate().rev() {
        let text = format!(">{force}N ");
        let wide = text.len() as u16 + 1;
        if x + wide > area.width {
            x = 0;
            *y += 1;
        }
        let style = theme.heat(i + 1);
        let sign =
            if theme.is_mono() || ascii { heat_glyph(i + 1).to_string() } else { "█".to_owned() };
        x = sheet.put((x, *y), &sign, style);
        x = sheet.put((x, *y), &text, theme.text());
    }
    if let Some(least) = steps.first() {
        // What is colder has the colour of its part.
        let short = format!("<{least}N");
        let texts = [format!("{short}: by part"), short, String::new()];
        let text = longest_fitting(&texts, area.width.saturating_sub(x));
        sheet.put((x, *y), text, theme.quiet());
    }
    *y += 1;
    sheet.put((0, *y), "C F R T: nodes below", theme.quiet());
    *y += 1;
    let parts = [
        (Region::Shell, "shell", ["━", "o"]),
        (Region::Retina, "retina", ["█", "R"]),
        (Region::Lens, "lens", ["━", "l"]),
        (Region::Interior, "globe", ["╌", "."]),
        (Region::Fat, "fat", ["·", ","]),
        (Region::Orbit, "orbit", ["━", "#"]),
    ];
    for (i, (region, name, signs)) in parts.into_iter().enumerate() {
        let sign = signs[usize::from(ascii)];
        let x = (i as u16 % 3) * 8;
        let after = sheet.put((x, *y), sign, theme.region(region));
        sheet.put((after, *y), name, theme.text());
        if i % 3 == 2 {
            *y += 1;
        }
    }
}

/// Time from 0 to the end of the window, with the pulse drawn in it.
fn time_bar(model: &AppModel, shown: &ShownAnswer, sheet: &mut Sheet) {
    let (area, theme) = (sheet.area, sheet.theme);
    let time = model.time();
    let window = shown.answer.window();
    let state = if model.clock.playing { "▶ playing" } else { "paused" };
    let text = format!("{:.3} of {} ms", time * 1e3, significant(window * 1e3));
    let end = sheet.put((1, 0), &text, theme.strong());
    let rest = format!(
        "  {state}  {} ms/s  {}",
        model.clock.speed(),
        model.clock.detail(shown.drawing.object.is_some()).name()
    );
    sheet.put((end, 0), &rest, theme.text());
    let field = &mut sheet.part((1, 1), (area.width - 2, 2));
    if let Some(traces) = &shown.answer.run.traces {
        let mut raster = Raster::new(field.area, model.look.symbols);
        let curve = TimeCurve {
            time: &traces.time,
            values: Trace::Other(OtherTrace::Drive).values(traces),
            factor: 1.0,
            ink: Ink::solid(theme.load(), 1, '#'),
        };
        crate::tui::view::chart::fill(&mut raster, curve, window);
        raster.paint(field.buffer);
    }
    let x = along((time / window).clamp(0.0, 1.0), field.area.width);
    field.put((x, 0), "│", theme.cursor());
    field.put((x, 1), "▲", theme.cursor());
}
