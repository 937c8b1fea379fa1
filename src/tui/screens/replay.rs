//! The replay in full size: the eye, its legend, the readings, and time with the pulse in it.

use std::marker::PhantomData;

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;

use crate::report::figure::at_a_moment;
use crate::report::format::significant;
use crate::run::places::Region;
use crate::run::quantity::Quantity;
use crate::run::result_trace::Group;
use crate::run::trace::OtherTrace;
use crate::run::trace::TRACES;
use crate::run::trace::Trace;
use crate::tui::clock::{Colouring, peak_said};
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
use crate::tui::view::raster::{Ink, Raster};
use crate::tui::view::text::{longest_fitting, put, put_right, wrapped};
use crate::tui::view::theme::Theme;

/// Room at the right for legend and readings.
const SIDE: u16 = 24;

pub(super) const ABOUT: About = About {
    title: "Replay",
    question: "What moved?",
    purpose: "the replay in full size",
    new: || Box::new(Replay),
};

/// The screen keeps nothing to itself.
pub struct Replay;

impl Panes for Replay {
    const PANES: &'static [Pane<Self>] = &[Pane::new(
        "replay",
        TimeKeys::Early,
        &[PaneKeys::new("Replay", FrameKeys::ALL)],
    )];
}

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
        bind(&[c('c')], |_, m| m.clock.change_colouring(), "", "coloured by force, or by pressure where cells have one"),
    ];
}

impl Screen for Replay {
    fn draw(&self, model: &AppModel, area: Rect, buffer: &mut Buffer) {
        draw(model, area, buffer);
    }
}

/// The largest pressure of the scale, in Pa, where an eye is to be coloured by that.
pub fn pressures(model: &AppModel, shown: &ShownAnswer) -> Option<f64> {
    let wanted = model.clock.colouring == Colouring::Pressure;
    shown.highest.filter(|_| wanted)
}

fn draw(model: &AppModel, area: Rect, buffer: &mut Buffer) {
    let theme = Theme::of(model.look);
    let Some(shown) = &model.shown else {
        put(buffer, area, (1, 1), "no result yet", theme.text());
        return;
    };
    let bar = Rect::new(area.x, area.y + area.height - 3, area.width, 3);
    let picture = Rect::new(area.x, area.y, area.width - SIDE, area.height - 3);
    let side = Rect::new(area.x + picture.width, area.y, SIDE, picture.height);
    EyePicture {
        shown,
        time: model.time(),
        largest: shown.hottest,
        highest: pressures(model, shown),
        zoom: model.clock.zoom(),
        detail: model.clock.detail,
        blow: Some(&shown.scenario),
        aiming: false,
        lean: model.is_lean(),
        look: model.look,
    }
    .draw(picture, buffer);
    // What reaches the edge does not touch the legend.
    for y in 0..picture.height {
        buffer[(side.x - 1, picture.y + y)].reset();
    }
    if model.clock.zoom() > 1 {
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
    side_panel(model, shown, side, buffer);
    time_bar(model, shown, bar, buffer);
}

fn side_panel(model: &AppModel, shown: &ShownAnswer, area: Rect, buffer: &mut Buffer) {
    let theme = Theme::of(model.look);
    let time = model.time();
    let mut y = 0;
    let pressures = pressures(model, shown);
    let (heading, other) = match pressures {
        Some(_) => ("Pressure", "c: force"),
        None => ("Node force", "c: pressure"),
    };
    put(buffer, area, (0, y), heading, theme.heading());
    if shown.highest.is_some() {
        put_right(buffer, area, (area.width - 1, y), other, theme.quiet());
    }
    y += 1;
    let ascii = model.look.symbols == Symbols::Ascii;
    let scale = match pressures {
        Some(highest) => (highest * 1e-3, "kPa"),
        None => (shown.hottest, "N"),
    };
    legend(scale, (theme, ascii), area, &mut y, buffer);
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
        model.clock.detail.name()
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
