//! What limits the answer, and the paper's index: a line or a gauge with its three parts against
//! their limits; where there are no risks, what is not known of the inputs.

use ratatui::style::Style;

use crate::injury::Term;
use crate::report::figure::{
    Figure, PARTS, SCALE, allowing, in_the_limit, times_its_limit, unusable,
};
use crate::report::{format::digits, risks::first_line};
use crate::run::quantity::Quantity;
use crate::tui::view::risks::{comes, limits, rows};
use crate::tui::view::text::{longest_fitting, width, wrapped};
use crate::tui::{model::AppModel, shown::ShownAnswer, view::sheet::Sheet};

/// What the screen answers.
pub const QUESTION: &str = "How bad?";

/// A bar of a share of its width, the threshold at its end.
fn bar(share: f64, style: Style, sheet: &mut Sheet) {
    let (area, theme) = (sheet.area, sheet.theme);
    if area.width == 0 {
        return;
    }
    let cells = f64::from(area.width);
    let filled = (share.clamp(0.0, 1.0) * cells).round() as u16;
    for x in 0..area.width {
        if x < filled {
            sheet.put((x, 0), "█", style);
        } else {
            sheet.put((x, 0), "░", theme.quiet());
        }
    }
    if share > 1.0 {
        sheet.put((area.width - 1, 0), "▶", style);
    }
}

/// The fewest columns of a gauge.
const SHORTEST: u16 = 4;
/// Rows of the index with its parts.
pub const BLOCK: u16 = 4;

/// Draws what to believe of each injury in `each` rows, or why nothing is said and what is not
/// known of the inputs.
pub fn answers(model: &AppModel, shown: &ShownAnswer, each: u16, sheet: &mut Sheet) {
    let (area, theme) = (sheet.area, sheet.theme);
    let heading = match model.stale() {
        Some(why) => (format!("{QUESTION} {why}"), theme.warning()),
        None if shown.answer.risks().is_empty() => (QUESTION.to_owned(), theme.heading()),
        None if comes(model, &shown.answer) => {
            (format!("{QUESTION} so far, widening"), theme.warning())
        }
        None => (format!("{QUESTION} 80 % ranges"), theme.heading()),
    };
    if !shown.answer.risks().is_empty() {
        let heading = (&heading.0[..], heading.1);
        rows(&shown.answer, heading, (None, each), sheet);
        return;
    }
    sheet.put((0, 0), &heading.0, heading.1);
    let silence = wrapped(&first_line(&shown.answer), area.width.into());
    sheet.put_lines((0, 1), &silence, theme.strong());
    let bands = bands(model, shown);
    let text = longest_fitting(&bands, area.width);
    sheet.put((0, 1 + silence.len() as u16), text, theme.text());
}

/// Draws what limits the answer, or what the errors come from where nothing does.
pub fn limited(model: &AppModel, shown: &ShownAnswer, sheet: &mut Sheet) {
    let (area, theme) = (sheet.area, sheet.theme);
    let said = limits(model, &shown.answer, area.width.into(), area.height.into());
    if !said.is_empty() {
        sheet.put_lines((0, 0), &said, theme.warning());
        return;
    }
    let texts = match (&shown.answer.errors.mesh, model.idle) {
        (Some(_), _) => ["Errors of step and mesh", ""],
        (None, true) => [
            "Errors of the step alone; the mesh's is being computed",
            "Errors of the step; the mesh's comes",
        ],
        (None, false) => ["Errors of the step alone, without the mesh's", "Errors of the step"],
    };
    let text = longest_fitting(&texts, area.width);
    sheet.put((0, 0), text, theme.quiet());
}

/// Draws the index and its parts, or the bare figures of an index that means nothing.
pub fn index(shown: &ShownAnswer, sheet: &mut Sheet) {
    let (area, theme) = (sheet.area, sheet.theme);
    let [long, short] = brief(shown);
    if unusable(&shown.answer).is_some() {
        let index = Figure::of(&shown.answer, Quantity::Damage);
        let index = index.map_or_else(String::new, |figure| figure.number);
        let texts = [
            format!("raw figures: index {index}, {long}"),
            format!("raw: index {index}, {short}"),
            format!("raw: index {index}"),
        ];
        let text = longest_fitting(&texts, area.width);
        sheet.put((0, 0), text, theme.quiet());
    } else if area.height < BLOCK {
        let index = Figure::of(&shown.answer, Quantity::Damage);
        let rough = index.as_ref().map_or_else(String::new, |figure| figure.coarser(2).number);
        let index = index.map_or_else(String::new, |figure| figure.to_string());
        let texts = [
            format!("Index {index} ({SCALE}): {long}"),
            format!("Index {index}: {long}"),
            format!("Index {index}: {short} of limit"),
            format!("Index {rough}: {short} of limit"),
            format!("Index {rough}: {short}"),
        ];
        let text = longest_fitting(&texts, area.width);
        sheet.put((0, 0), text, theme.text());
    } else {
        gauges(shown, sheet);
    }
}

/// The index with its gauge, and its parts.
fn gauges(shown: &ShownAnswer, sheet: &mut Sheet) {
    let (area, theme) = (sheet.area, sheet.theme);
    let answer = &shown.answer;
    let damage = answer.index().damage();
    if let Some(figure) = Figure::of(answer, Quantity::Damage) {
        sheet.put((0, 0), "Index", theme.heading());
        let end = sheet.put((6, 0), figure.to_string(), theme.strong());
        let texts = [format!(" ({SCALE})"), String::new()];
        let text = longest_fitting(&texts, area.width.saturating_sub(end + SHORTEST + 1));
        let end = sheet.put((end, 0), text, theme.quiet()) + 1;
        let gauge = &mut sheet.part((end, 0), (area.width.saturating_sub(end), 1));
        let share = damage / 100.0;
        if gauge.area.width >= SHORTEST {
            bar(share, theme.gauge(share), gauge);
        }
    }
    for (y, (of, term)) in (1..).zip(PARTS) {
        if let Some(value) = answer.result(of) {
            part(shown, (of, value, term), &mut sheet.row(y));
        }
    }
}

/// The parts of the index, how many times its limit each is, long and short.
fn brief(shown: &ShownAnswer) -> [String; 2] {
    let said = |name: fn(Quantity) -> &'static str| {
        let times = PARTS.iter().filter_map(|(of, term)| {
            let times = digits(shown.answer.result(*of)? / term.threshold, 2);
            Some(format!("{} {times}", name(*of)))
        });
        times.collect::<Vec<_>>().join(", ")
    };
    let long = said(|of| of.row().label);
    let short = said(|of| of.row().short);
    [format!("{long} times its limit"), short.replace(',', "")]
}

/// How many times its limit a part of the index is.
fn times(shown: &ShownAnswer, of: Quantity, value: f64, term: Term) -> Option<String> {
    let figure = Figure::of(&shown.answer, of)?;
    let text = times_its_limit(&figure, value, term);
    Some(text.split(' ').next()?.to_owned())
}

/// Between what nine in ten samples of the inputs have the index where no risk has a range, the
/// longest words first. Where the band holds fewer than were asked for, or folded ones, it says
/// so, or bears a star that the screen of its own explains.
fn bands(model: &AppModel, shown: &ShownAnswer) -> Vec<String> {
    if shown.answer.silence().is_none() {
        return Vec::new();
    }
    let Some(ensemble) = model.ensemble.of(&shown.scenario) else {
        let waiting = if model.idle { "still being computed" } else { "not computed" };
        return vec![
            format!("what doubt in the inputs does to the index: {waiting}"),
            format!("inputs: {waiting}"),
        ];
    };
    let Some(band) = ensemble.band(Quantity::Damage) else {
        return vec!["what the inputs do to the index: not known".to_owned()];
    };
    let end = |value| allowing(value, Some(0.1 * (band.high - band.low)));
    let within = format!("{} to {}", end(band.low), end(band.high));
    let (held, folded) = (ensemble.valid().count(), ensemble.folded());
    let (mark, reason) = if held < ensemble.asked as usize {
        ("*", format!("{held} of {}", ensemble.asked))
    } else if folded > 0 {
        ("*", format!("{held}, {folded} folded"))
    } else {
        ("", held.to_string())
    };
    vec![
        format!("index with inputs in doubt: {within} (90 % of {reason})"),
        format!("inputs in doubt: {within} (90 % of {reason})"),
        format!("inputs in doubt: {within}{mark} (90 %)"),
        format!("inputs in doubt: {within}{mark}"),
    ]
}

/// Where the figure of a part ends, and the columns of how many times its limit it is.
const FIGURE: u16 = 38;
const TIMES: &str = " times its limit";
/// Columns of what it tends to on finer meshes.
const FINER: u16 = 36;

/// One part of the index: its value, and how many times its limit that is.
fn part(shown: &ShownAnswer, (of, value, term): (Quantity, f64, Term), sheet: &mut Sheet) {
    let (area, theme) = (sheet.area, sheet.theme);
    let (Some(figure), Some(times)) =
        (Figure::of(&shown.answer, of), times(shown, of, value, term))
    else {
        return;
    };
    let end = sheet.put((0, 0), of.row().label, theme.text());
    let texts = [format!("{times}{TIMES}"), format!("{times} of limit")];
    let room = area.width.saturating_sub(end + 2);
    let text = longest_fitting(&texts, room);
    sheet.put_right((area.width, 0), text, theme.strong());
    let right = area.width.saturating_sub(5 + width(TIMES) + 1);
    if right < FIGURE {
        return;
    }
    sheet.put_right((FIGURE, 0), figure.to_string(), theme.text());
    let mut left = FIGURE + 2;
    if let Some(limit) = in_the_limit(&shown.answer, of)
        && left + FINER + SHORTEST <= right
    {
        let text = format!("with ever finer mesh {limit}");
        sheet.put((left, 0), &text, theme.quiet());
        left += FINER;
    }
    if right >= left + SHORTEST {
        let share = value / term.threshold;
        let field = &mut sheet.part((left, 0), (right - left, 1));
        bar(share, theme.gauge(share), field);
    }
}
