//! The replay in full size: the eye, its legend, the readings, and time with the pulse in it.

use std::marker::PhantomData;

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::Style;

use crate::report::figure::at_a_moment;
use crate::report::format::significant;
use crate::report::picture::Part;
use crate::report::picture::front::seen;
use crate::run::places::Region;
use crate::run::quantity::Quantity;
use crate::run::result_trace::Group;
use crate::run::trace::OtherTrace;
use crate::run::trace::TRACES;
use crate::run::trace::Trace;
use crate::tui::clock::{MeshDetail, peak_said};
use crate::tui::form::unverified;
use crate::tui::keys::press::{LEFT, RIGHT, SHIFT_LEFT, SHIFT_RIGHT, c};
use crate::tui::keys::{Binding, TimeKeys};
use crate::tui::model::AppModel;
use crate::tui::screens::screen::{About, Act, Pane, PaneKeys, Panes, Screen, bind};
use crate::tui::shown::ShownAnswer;
use crate::tui::step::Step;
use crate::tui::terminal::caps::Symbols;
use crate::tui::view::chart::{TimeCurve, value_at};
use crate::tui::view::eye::EyePicture;
use crate::tui::view::heat::{heat_glyph, thresholds};
use crate::tui::view::picture::{NAMED, swatch};
use crate::tui::view::raster::{Ink, Raster};
use crate::tui::view::text::{longest_fitting, put, put_right, width, wrapped};
use crate::tui::view::theme::Theme;

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
    const PANES: &'static [Pane<Self>] = &[Pane::new(
        "replay",
        TimeKeys::Early,
        &[PaneKeys::new("Replay", FrameKeys::ALL), FRONT],
    )];
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
    fn draw(&self, model: &AppModel, area: Rect, buffer: &mut Buffer) {
        draw(self.front, model, area, buffer);
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

fn draw(front: bool, model: &AppModel, area: Rect, buffer: &mut Buffer) {
    let theme = Theme::of(model.look);
    let Some(shown) = &model.shown else {
        put(buffer, area, (1, 1), "no result yet", theme.text());
        return;
    };
    let bar = Rect::new(area.x, area.y + area.height - 3, area.width, 3);
    let picture = Rect::new(area.x, area.y, area.width - SIDE, area.height - 3);
    let side = Rect::new(area.x + picture.width, area.y, SIDE, picture.height);
    let drawn = EyePicture {
        blow: Some(&shown.scenario),
        front,
        ..EyePicture::of(model, shown, model.time())
    };
    let anatomy = drawn.detail == MeshDetail::Anatomy;
    // What reaches the edge does not touch the legend.
    let field = Rect {
        width: picture.width - 1,
        ..picture
    };
    drawn.draw(field, buffer);
    if model.clock.zoom() > 1 && !anatomy {
        let text = format!(" motion shown {}x larger ", model.clock.zoom());
        put(buffer, picture, (2, 0), &text, theme.warning());
    }
    if let Some(why) = model.stale() {
        let text = format!(" {why} ");
        put(
            buffer,
            picture,
            (0, picture.height - 2),
            &text,
            theme.warning(),
        );
    }
    side_panel(model, shown, anatomy.then_some(front), side, buffer);
    time_bar(model, shown, bar, buffer);
}

fn side_panel(
    model: &AppModel,
    shown: &ShownAnswer,
    anatomy: Option<bool>,
    area: Rect,
    buffer: &mut Buffer,
) {
    let theme = Theme::of(model.look);
    let time = model.time();
    let mut y = 0;
    let ascii = model.look.symbols == Symbols::Ascii;
    if let Some(front) = anatomy {
        parts(front, (model, shown), area, &mut y, buffer);
    } else {
        put(buffer, area, (0, y), "Node force", theme.heading());
        put_right(
            buffer,
            area,
            (area.width - 1, y),
            "e: anatomy",
            theme.quiet(),
        );
        y += 1;
        legend((shown.hottest, "N"), (theme, ascii), area, &mut y, buffer);
    }
    let traces = shown.answer.run.traces.as_ref();
    put(buffer, area, (0, y), "Now", theme.heading());
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
        put(buffer, area, (0, y), label, theme.text());
        put_right(buffer, area, (area.width - 1, y), &text, theme.strong());
        y += 1;
    }
    let unverified = !unverified(&shown.scenario).is_empty();
    let room = usize::from(area.width - 1);
    // What stands below keeps its lines.
    let rows = usize::from(area.height.saturating_sub(y + 1 + u16::from(unverified)));
    let fits = |text: &str| wrapped(text, room).len() <= rows;
    let peak = peak_said(&shown.answer, time, fits).unwrap_or_default();
    for line in wrapped(&peak, room) {
        put(buffer, area, (0, y), &line, theme.cursor());
        y += 1;
    }
    if unverified && y + 1 < area.height {
        let at = (0, area.height - 2);
        put(buffer, area, at, "? unverified figures", theme.warning());
    }
    let material = model.material();
    put(buffer, area, (0, area.height - 1), material, theme.quiet());
}

/// The parts of the anatomy that are seen, each with its colour.
fn parts(
    front: bool,
    (model, shown): (&AppModel, &ShownAnswer),
    area: Rect,
    y: &mut u16,
    buffer: &mut Buffer,
) {
    let theme = Theme::of(model.look);
    put(buffer, area, (0, *y), "What you see", theme.heading());
    put_right(buffer, area, (area.width - 1, *y), "e: mesh", theme.quiet());
    *y += 1;
    let hit = shown.drawing.object.is_some();
    let more = [
        (Part::Object, "object"),
        (Part::Pressed, "pressed"),
        (Part::Fat, "fat"),
    ];
    let more = more
        .into_iter()
        .filter(|(part, _)| hit || *part == Part::Fat);
    let tall = area.height >= TALL;
    let mut x = 0;
    let all = NAMED.into_iter().chain(more);
    let seen = all.filter(|(part, _)| !front || part.is_outside());
    // Without colours several parts have one sign.
    let mut signs: Vec<(String, Style, Vec<&str>)> = Vec::new();
    for (part, name) in seen {
        let (sign, style) = swatch(part, model.look);
        match signs
            .iter_mut()
            .find(|known| (&known.0, known.1) == (&sign, style))
        {
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
        put(buffer, area, (x, *y), &sign, style);
        for (i, line) in lines.iter().enumerate() {
            *y += u16::from(i > 0);
            put(buffer, area, (x + 2, *y), line, theme.text());
        }
        x += wide;
    }
    *y += 1;
    if front {
        *y += 1;
        return;
    }
    let dots = if model.look.symbols == Symbols::Ascii {
        "::"
    } else {
        "⠒⠒"
    };
    let x = put(buffer, area, (0, *y), dots, theme.quiet());
    put(buffer, area, (x, *y), " at rest", theme.text());
    put_right(
        buffer,
        area,
        (area.width - 1, *y),
        "c: field",
        theme.quiet(),
    );
    *y += 2;
}

/// Steps of force with their colours, and the parts of the eye with theirs.
fn legend(
    (largest, unit): (f64, &str),
    (theme, ascii): (Theme, bool),
    area: Rect,
    y: &mut u16,
    buffer: &mut Buffer,
) {
    let steps = thresholds(largest, theme.heat_steps());
    let mut x = 0;
    for (i, force) in steps.iter().enumerate().rev() {
        let text = format!(">{force}{unit} ");
        let wide = text.len() as u16 + 1;
        if x + wide > area.width {
            x = 0;
            *y += 1;
        }
        let style = theme.heat(i + 1);
        let sign = if theme.is_mono() || ascii {
            heat_glyph(i + 1).to_string()
        } else {
            "█".to_owned()
        };
        x = put(buffer, area, (x, *y), &sign, style);
        x = put(buffer, area, (x, *y), &text, theme.text());
    }
    if let Some(least) = steps.first() {
        // What is colder has the colour of its part.
        let short = format!("<{least}{unit}");
        let texts = [format!("{short}: by part"), short, String::new()];
        let text = longest_fitting(&texts, area.width.saturating_sub(x));
        put(buffer, area, (x, *y), text, theme.quiet());
    }
    *y += 1;
    put(buffer, area, (0, *y), "C F R T: nodes below", theme.quiet());
    *y += 1;
    let parts = [
        (Region::Shell, "shell", "━"),
        (Region::Retina, "retina", "█"),
        (Region::Lens, "lens", "━"),
        (Region::Interior, "globe", "╌"),
        (Region::Fat, "fat", "·"),
        (Region::Orbit, "orbit", "━"),
    ];
    for (i, (region, name, mut sign)) in parts.into_iter().enumerate() {
        if ascii {
            sign = match region {
                Region::Shell => "o",
                Region::Retina => "R",
                Region::Lens => "l",
                Region::Interior => ".",
                Region::Fat => ",",
                Region::Orbit => "#",
            };
        }
        let x = (i as u16 % 3) * 8;
        let after = put(buffer, area, (x, *y), sign, theme.region(region));
        put(buffer, area, (after, *y), name, theme.text());
        if i % 3 == 2 {
            *y += 1;
        }
    }
}

/// Time from 0 to the end of the window, with the pulse drawn in it.
fn time_bar(model: &AppModel, shown: &ShownAnswer, area: Rect, buffer: &mut Buffer) {
    let theme = Theme::of(model.look);
    let time = model.time();
    let window = shown.answer.window();
    let state = if model.clock.playing {
        "▶ playing"
    } else {
        "paused"
    };
    let text = format!("{:.3} of {} ms", time * 1e3, significant(window * 1e3));
    let end = put(buffer, area, (1, 0), &text, theme.strong());
    let rest = format!(
        "  {state}  {} ms/s  {}",
        model.clock.speed(),
        model.clock.detail(shown.drawing.object.is_some()).name()
    );
    put(buffer, area, (end, 0), &rest, theme.text());
    let field = Rect::new(area.x + 1, area.y + 1, area.width - 2, 2);
    if let Some(traces) = &shown.answer.run.traces {
        let mut raster = Raster::new(field, model.look.symbols);
        let curve = TimeCurve {
            time: &traces.time,
            values: Trace::Other(OtherTrace::Drive).values(traces),
            factor: 1.0,
            ink: Ink::solid(theme.load(), 1, '#'),
        };
        crate::tui::view::chart::fill(&mut raster, curve, window);
        raster.paint(buffer);
    }
    let last = f64::from(field.width - 1);
    let x = ((time / window).clamp(0.0, 1.0) * last).round() as u16;
    put(buffer, field, (x, 0), "│", theme.cursor());
    put(buffer, field, (x, 1), "▲", theme.cursor());
}
