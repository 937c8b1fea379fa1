//! Total error against time: every run on two logarithmic axes, the front joined.
//!
//! A letter tells the integrator, a capital that nothing beats the run in both; levels stand in
//! rows, as the mesh errors are mostly the larger by far. So the picture is legible without
//! colours, which tell the level.

use std::iter;

use ratatui::style::Modifier;

use crate::many::accuracy::{Accuracy, ROUNDS, TOLERANCES, Total, cheapest};
use crate::report::format::{digits, percent, significant};
use crate::run::quantity::Quantity;
use crate::scenario::Integrator;
use crate::tui::screens::accuracy::log_axis::{LogAxis, tick_label};
use crate::tui::view::raster::{Ink, Raster};
use crate::tui::{model::AppModel, screens::accuracy::Measurement, view::chart::axes};
use crate::tui::{screens::screen::state_of_work, view::sheet::Sheet, view::text::flowed};

/// Room for the numbers of the error axis.
const LABELS: u16 = 7;
/// The fewest rows and columns that a picture is drawn into.
const LEAST: (u16, u16) = (20, 4);
/// Errors below this, in %, are drawn there: they are rounding.
const FLOOR: f64 = 1e-9;

pub fn draw(accuracy: &Measurement, model: &AppModel, sheet: &mut Sheet) {
    let (area, theme) = (sheet.area, sheet.theme);
    let scenario = &model.work.scenario;
    let shown = accuracy.shown(scenario);
    let known = format!("median of {ROUNDS} runs");
    let stopped = accuracy.complaint(scenario);
    let (said, style) = state_of_work(accuracy.task.pace(None), stopped, known, theme);
    let on_show = accuracy.on_show(scenario);
    let of = on_show.map_or("", |(_, of)| of.label());
    let full = format!("How exact, at what cost? Error of the {of} in % against time");
    let brief = format!("How exact? Error of the {of}, %");
    let titles: &[&str] = match of {
        "" => &["How exact, and at what cost?", "How exact?"],
        _ => &[&full, &brief, "How exact?"],
    };
    sheet.put_both((titles, theme.heading()), (&said, style));
    let (Some((totals, of)), false) = (on_show, shown.is_empty()) else {
        sheet.put_wrapped((1, 2), &waiting(accuracy, model), theme.text());
        return;
    };
    let here = accuracy.place(&shown);
    let room = area.width - 2;
    let mut below = Vec::new();
    for (parts, first, rest) in [
        (legend(&shown), theme.quiet(), theme.quiet()),
        (levels(totals, of), theme.text(), theme.text()),
        (named(&shown, here), theme.strong(), theme.text()),
    ] {
        let styles = iter::once(first).chain(iter::repeat(rest));
        below.extend(flowed(&parts, room).into_iter().zip(styles));
    }
    let top = area.height.saturating_sub(below.len() as u16);
    for (y, (line, style)) in (top..).zip(below) {
        sheet.put((1, y), line, style);
    }
    let first = sheet.put_wrapped((1, 1), &costs(&shown), theme.strong());
    let high = top.saturating_sub(first);
    if high < LEAST.1 + 2 || area.width < LEAST.0 + LABELS {
        sheet.put((1, 1), "too small for the chart", theme.warning());
        return;
    }
    chart(&shown, here, &mut sheet.part((0, first), (area.width, high)));
}

/// What less error costs: the fastest run, the most exact one, and one between them.
fn costs(shown: &[Total]) -> String {
    let front: Vec<&Total> = shown.iter().filter(|total| total.on_front).collect();
    let places = [0, front.len() / 2, front.len().saturating_sub(1)];
    let mut picked: Vec<&Total> = places.iter().filter_map(|at| front.get(*at).copied()).collect();
    picked.dedup_by_key(|total| total.seconds.to_bits());
    let time = |total: &Total| format!("{} ms", digits(total.seconds * 1e3, 2));
    let parts = picked.iter().enumerate().map(|(i, total)| {
        let costs = if i == 0 { " off costs" } else { " off:" };
        format!("{}{costs} {}", percent(total.error()), time(total))
    });
    parts.collect::<Vec<_>>().join("; ") + "."
}

/// What stands in place of the chart before there is one.
fn waiting(accuracy: &Measurement, model: &AppModel) -> String {
    match accuracy.of(&model.work.scenario) {
        known if accuracy.task.job.is_some() => {
            let text = "Mesh levels, integrators and steps are timed, the coarse ones first. The \
                        total error of a level is known once the two finer ones are.";
            match known.map_or(0, |known| known.levels.len()) {
                0 => text.to_owned(),
                levels => format!("{text} Solved so far: level 1 to {levels}."),
            }
        }
        Some(totals) if totals.done == totals.all => {
            "No result has an error here: finer meshes do not agree, or fold.".to_owned()
        }
        _ => "not measured yet: m goes on".to_owned(),
    }
}

fn legend(shown: &[Total]) -> Vec<String> {
    let there = |of: &&Integrator| shown.iter().any(|total| total.plan.integrator == **of);
    let letters = Integrator::ALL.iter().filter(there).map(|of| letter_and_name(*of));
    let others = ["capital: none is both faster and closer", "> more exact, < faster"];
    letters.chain(others.map(str::to_owned)).collect()
}

fn letter_and_name(of: Integrator) -> String {
    format!("{} {}", of.letter(), of.name())
}

/// What each mesh level may be off by.
fn levels(totals: &Accuracy, of: Quantity) -> Vec<String> {
    let error = |level| {
        let error = totals.mesh(level)?[of].map_or("unknown".to_owned(), percent);
        Some(format!("level {level}: {error}"))
    };
    let levels = 1..=totals.levels.len() as u32;
    iter::once("mesh error".to_owned()).chain(levels.filter_map(error)).collect()
}

/// All about the run under the cursor.
fn named(shown: &[Total], here: usize) -> Vec<String> {
    let total = &shown[here];
    let automatic = if total.is_answer { " (automatic)" } else { "" };
    vec![
        format!("▸ {} of {}", here + 1, shown.len()),
        format!("level {}", total.level),
        letter_and_name(total.plan.integrator),
        format!("step {} µs{automatic}", significant(total.step * 1e6)),
        format!("{} ms", significant(total.seconds * 1e3)),
        format!("error {}", percent(total.error())),
        format!("of it mesh {}, step {}", percent(total.mesh), percent(total.by_step)),
        front(shown, here),
    ]
}

/// Whether the run under the cursor is on the front, and for which tolerances it is the cheapest.
fn front(shown: &[Total], here: usize) -> String {
    let of = TOLERANCES.into_iter().filter(|percent| cheapest(shown, *percent) == Some(here));
    let of: Vec<String> = of.map(|percent| format!("{percent} %")).collect();
    match (shown[here].on_front, of.is_empty()) {
        (_, false) => format!("the cheapest for {}", of.join(", ")),
        (true, true) => "none is both faster and closer".to_owned(),
        (false, true) => "another is faster and closer".to_owned(),
    }
}

fn chart(shown: &[Total], cursor: usize, sheet: &mut Sheet) {
    let (area, theme) = (sheet.area, sheet.theme);
    let size = (area.width - LABELS - 2, area.height - 2);
    let field = sheet.part((LABELS + 1, 0), size).area;
    let times = LogAxis::over(shown.iter().map(|total| total.seconds * 1e3));
    let errors = LogAxis::over(shown.iter().map(|total| total.error().max(FLOOR)));
    let up = errors.ticks(usize::from(field.height / 2)).into_iter();
    let up = up.map(|value| (1.0 - errors.share(value), tick_label(value)));
    let across = times.ticks(usize::from(field.width / 8)).into_iter();
    let across = across.map(|value| (times.share(value), tick_label(value)));
    axes(field, (up, across), 1, sheet);
    sheet.put((0, 0), "%", theme.quiet());
    // In cells, so that lines run from mark to mark.
    let cell = |total: &Total| {
        let x = times.share(total.seconds * 1e3) * f64::from(field.width - 1);
        let y = (1.0 - errors.share(total.error().max(FLOOR))) * f64::from(field.height - 1);
        (x.round(), y.round())
    };
    let mut raster = Raster::new(field, theme.look.symbols);
    let (columns, rows) = raster.size();
    let grain =
        (f64::from(columns) / f64::from(field.width), f64::from(rows) / f64::from(field.height));
    let front = shown.iter().filter(|total| total.on_front).map(cell);
    let front: Vec<_> = front.map(|(x, y)| ((x + 0.5) * grain.0, (y + 0.5) * grain.1)).collect();
    let ink = Ink::solid(theme.cursor(), 0, '.');
    for pair in front.windows(2) {
        raster.line(pair[0], pair[1], ink);
    }
    raster.paint(sheet.buffer);
    // The front hides what it beats, and the chosen run hides everything.
    let mut marks: Vec<(usize, &Total)> = shown.iter().enumerate().collect();
    marks.sort_by_key(|(at, total)| (*at == cursor, total.on_front));
    for (at, total) in marks {
        let (x, y) = cell(total);
        let mut mark = total.plan.integrator.letter();
        let level = total.level as usize - 1;
        let mut style = if theme.is_mono() { theme.text() } else { theme.curve(level) };
        if total.on_front {
            style = style.add_modifier(Modifier::BOLD);
        } else {
            mark = mark.to_ascii_lowercase();
        }
        if at == cursor {
            style = style.patch(theme.focus());
        }
        let place = &mut sheet.buffer[(field.x + x as u16, field.y + y as u16)];
        place.reset();
        place.set_char(mark).set_style(style);
    }
}
