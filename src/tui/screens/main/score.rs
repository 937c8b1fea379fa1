//! What limits the answer, and the paper's index: a line or a gauge with its three parts against
//! their limits; where there are no risks, what is not known of the inputs.

use crate::answer::solve::Answer;
use crate::injury::Term;
use crate::report::figure::{Figure, PARTS, SCALE, allowing};
use crate::report::figure::{in_the_limit, times_its_limit, unusable};
use crate::report::{format::digits, risks::first_line};
use crate::run::quantity::Quantity;
use crate::tui::view::risks::{limits, rows};
use crate::tui::{ensemble::is_whole, screens::main::QUESTION, view::text::longest_fitting};
use crate::tui::{model::AppModel, shown::ShownAnswer, simulation::Complete, view::sheet::Sheet};

/// A bar of a share of its width, the threshold at its end.
fn bar(share: f64, sheet: &mut Sheet) {
    let (theme, cells) = (sheet.theme, sheet.area.width);
    let filled = (share.clamp(0.0, 1.0) * f64::from(cells)).round() as u16;
    let end = sheet.put((0, 0), "█".repeat(filled.into()), theme.gauge(share));
    sheet.put((end, 0), "░".repeat(usize::from(cells - filled)), theme.quiet());
    if share > 1.0 {
        sheet.put((cells - 1, 0), "▶", theme.gauge(share));
    }
}

/// The fewest columns of a gauge.
const SHORTEST: u16 = 4;
/// Rows of the index with its parts.
pub const BLOCK: u16 = 4;

/// Draws each injury in `each` rows, or why nothing is said and what is not known of the inputs.
pub fn answers(model: &AppModel, shown: &ShownAnswer, each: u16, sheet: &mut Sheet) {
    let theme = sheet.theme;
    let none = shown.answer.risks().is_empty();
    let (said, style) = match model.stale() {
        Some(why) => (why, theme.warning()),
        None if none => ("", theme.heading()),
        None => ("80 % ranges", theme.heading()),
    };
    let heading = format!("{QUESTION} {said}");
    if !none {
        rows(&shown.answer, (&heading, style), (None, each), sheet);
        return;
    }
    sheet.put((0, 0), heading.trim_end(), style);
    let below = sheet.put_wrapped((0, 1), &first_line(&shown.answer), theme.strong());
    sheet.put_longest((0, below), &bands(model, shown), theme.text());
}

/// Draws what limits the answer, or what the errors come from where nothing does.
pub fn limited(model: &AppModel, shown: &ShownAnswer, sheet: &mut Sheet) {
    let (area, theme) = (sheet.area, sheet.theme);
    let said = limits(shown, area.width.into(), area.height.into());
    if !said.is_empty() {
        sheet.put_lines((0, 0), &said, theme.warning());
        return;
    }
    let comes = model.idle && Complete::of(&shown.scenario, &shown.answer).is_some();
    let texts = match shown.answer.errors.mesh {
        Some(_) => ["Errors of step and mesh", ""],
        None if comes => [
            "Errors of the step alone; the mesh's is being computed",
            "Errors of the step; mesh to come",
        ],
        None => ["Errors of the step alone, without the mesh's", "Errors of the step"],
    };
    sheet.put_longest((0, 0), &texts, theme.quiet());
}

/// Draws the index and its parts, or the bare figures of an index that means nothing.
pub fn index(shown: &ShownAnswer, sheet: &mut Sheet) {
    let theme = sheet.theme;
    let [long, short] = brief(shown);
    let figure = Figure::of(&shown.answer, Quantity::Damage);
    let index = |written: fn(&Figure) -> String| figure.as_ref().map_or_else(String::new, written);
    if unusable(&shown.answer).is_some() {
        let index = index(|figure| figure.number.clone());
        let texts = [
            format!("raw figures: index {index}, {long}"),
            format!("raw: index {index}, {short}"),
            format!("raw: index {index}"),
        ];
        sheet.put_longest((0, 0), &texts, theme.quiet());
    } else if sheet.area.height < BLOCK {
        let (index, rough) = (index(Figure::to_string), index(|figure| figure.coarser(2).number));
        let texts = [
            format!("Index {index} ({SCALE}): {long}"),
            format!("Index {index}: {long}"),
            format!("Index {index}: {short} of limit"),
            format!("Index {rough}: {short} of limit"),
            format!("Index {rough}: {short}"),
        ];
        sheet.put_longest((0, 0), &texts, theme.text());
    } else {
        gauges(shown, sheet);
    }
}

fn gauges(shown: &ShownAnswer, sheet: &mut Sheet) {
    let (area, theme) = (sheet.area, sheet.theme);
    let answer = &shown.answer;
    if let Some(figure) = Figure::of(answer, Quantity::Damage) {
        sheet.put((0, 0), "Index", theme.heading());
        let end = sheet.put((6, 0), figure.to_string(), theme.strong());
        let texts = [format!(" ({SCALE})"), String::new()];
        let text = longest_fitting(&texts, area.width.saturating_sub(end + SHORTEST + 1));
        let end = sheet.put((end, 0), text, theme.quiet()) + 1;
        let room = area.width.saturating_sub(end);
        if room >= SHORTEST {
            bar(answer.index().damage() / 100.0, &mut sheet.part((end, 0), (room, 1)));
        }
    }
    for (y, (of, term)) in (1..).zip(PARTS) {
        if let (Some(figure), Some(value)) = (Figure::of(answer, of), answer.result(of)) {
            part(answer, (of, &figure, value, term), &mut sheet.row(y));
        }
    }
}

/// The parts of the index, how many times its limit each is, long and short.
fn brief(shown: &ShownAnswer) -> [String; 2] {
    let said = |name: fn(Quantity) -> &'static str, between: &str| {
        let times = PARTS.iter().filter_map(|(of, term)| {
            let times = digits(shown.answer.result(*of)? / term.threshold, 2);
            Some(format!("{} {times}", name(*of)))
        });
        times.collect::<Vec<_>>().join(between)
    };
    let long = said(|of| of.row().label, ", ");
    [format!("{long} times its limit"), said(|of| of.row().short, " ")]
}

/// The index of nine in ten samples where no risk has a range, the longest words first. A band of
/// fewer than were asked for, or of folded ones, says so or bears a star that its screen explains.
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
    let mark = if is_whole(ensemble) { "" } else { "*" };
    let reason = match (ensemble.valid().count(), ensemble.folded()) {
        (held, _) if held < ensemble.asked as usize => format!("{held} of {}", ensemble.asked),
        (held, 0) => held.to_string(),
        (held, folded) => format!("{held}, {folded} folded"),
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
const TIMES: u16 = 21;
/// Columns of what it tends to on finer meshes.
const FINER: u16 = 36;

/// One part of the index: its value, and how many times its limit that is.
fn part(
    answer: &Answer,
    (of, figure, value, term): (Quantity, &Figure, f64, Term),
    sheet: &mut Sheet,
) {
    let (area, theme) = (sheet.area, sheet.theme);
    let end = sheet.put((0, 0), of.row().label, theme.text());
    let times = times_its_limit(figure, value, term);
    let texts = [&times, &times.replace("times its limit", "of limit")];
    let text = longest_fitting(&texts, area.width.saturating_sub(end + 2));
    sheet.put_right((area.width, 0), text, theme.strong());
    let right = area.width.saturating_sub(TIMES + 1);
    if right < FIGURE {
        return;
    }
    sheet.put_right((FIGURE, 0), figure.to_string(), theme.text());
    let mut left = FIGURE + 2;
    if let Some(limit) = in_the_limit(answer, of)
        && left + FINER + SHORTEST <= right
    {
        sheet.put((left, 0), format!("with ever finer mesh {limit}"), theme.quiet());
        left += FINER;
    }
    if right >= left + SHORTEST {
        bar(value / term.threshold, &mut sheet.part((left, 0), (right - left, 1)));
    }
}
