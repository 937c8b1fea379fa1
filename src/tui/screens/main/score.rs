//! The sentence, a line for each injury, what limits them, and the paper's index: a line, or a
//! gauge with its three parts against their limits, which is the answer of a blow on its section.

use crate::report::figure::{Figure, PARTS, SCALE, allowing, unusable, with_unit};
use crate::report::format::{capital, digits};
use crate::report::{risks, sentence as report};
use crate::run::quantity::Quantity;
use crate::tui::ensemble::is_whole;
use crate::tui::view::risks::{limits, rows};
use crate::tui::view::text::{longest_fitting, width, wrapped};
use crate::tui::{model::AppModel, shown::ShownAnswer, simulation::Complete, view::sheet::Sheet};

/// A bar of a share of its width, the threshold or the whole at its end.
pub fn bar(share: f64, sheet: &mut Sheet) {
    let (theme, cells) = (sheet.theme, sheet.area.width);
    let filled = (share.clamp(0.0, 1.0) * f64::from(cells)).round() as u16;
    let end = sheet.put((0, 0), "━".repeat(filled.into()), theme.filled());
    sheet.put((end, 0), "─".repeat(usize::from(cells - filled)), theme.quiet());
    if share > 1.0 {
        sheet.put((cells - 1, 0), "▶", theme.strong());
    }
}

/// The fewest columns of a gauge.
const SHORTEST: u16 = 4;
/// Rows of the index with its parts.
pub const BLOCK: u16 = 4;
/// Rows of the paper's own answer: those, the apex, and what is not known of the inputs.
pub const PAPER: u16 = BLOCK + 2;

/// The answer on show in one sentence, in lines of so many columns; before it that it is an older
/// one, if so.
pub fn sentence(model: &AppModel, room: u16) -> Vec<String> {
    let Some(shown) = &model.shown else { return Vec::new() };
    let older = model.stale().map_or_else(String::new, |why| format!("({why}) "));
    let said = report::sentence(&shown.scenario, &shown.answer);
    wrapped(&format!("{older}{said}"), usize::from(room))
}

/// Draws each injury in `each` rows.
pub fn answers(shown: &ShownAnswer, each: u16, sheet: &mut Sheet) {
    let theme = sheet.theme;
    // So far the heads of the columns leave room.
    let texts = ["range: 8 of 10 of what it may be", "range: 8 of 10"];
    let room = if sheet.area.width > 60 { 34 } else { 27 };
    rows(&shown.answer, (longest_fitting(&texts, room), theme.quiet()), (None, each), sheet);
}

/// Draws the paper's own answer: the index and its parts against their limits, the apex, and what
/// is not known of the inputs.
pub fn paper(model: &AppModel, shown: &ShownAnswer, sheet: &mut Sheet) {
    let theme = sheet.theme;
    if unusable(&shown.answer).is_some() {
        index(shown, sheet);
    } else {
        gauges(shown, sheet);
    }
    if let Some(apex) = Figure::of(&shown.answer, Quantity::Apex) {
        let label = capital(Quantity::Apex.row().label);
        let peak = shown.answer.peak(Quantity::Apex);
        let when = peak.map_or_else(String::new, |p| format!(" at {:.3} ms", p.time * 1e3));
        let texts = [format!("{label} {apex}{when}"), format!("{label} {apex}")];
        sheet.put_longest((0, BLOCK), &texts, theme.text());
    }
    sheet.put_longest((0, BLOCK + 1), &bands(model, shown), theme.text());
}

/// Draws why no injury is told of, for whoever asks.
pub fn silence(shown: &ShownAnswer, sheet: &mut Sheet) {
    let why = risks::silence(&shown.answer).unwrap_or_default();
    let (not, take) = (why.split(": the").next(), why.rsplit_once("; ").map(|(_, take)| take));
    let brief = format!("{}; {}", not.unwrap_or_default(), take.unwrap_or_default());
    sheet.put_longest((0, 0), &[&why, &brief, not.unwrap_or_default()], sheet.theme.quiet());
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
    let answer = &shown.answer;
    if let Some(figure) = Figure::of(answer, Quantity::Damage) {
        let share = answer.index().damage() / 100.0;
        gauge((Quantity::Damage.row().label, figure.to_string()), share, &mut sheet.row(0));
    }
    for (y, (of, term)) in (1..).zip(PARTS) {
        if let (Some(figure), Some(value)) = (Figure::of(answer, of), answer.result(of)) {
            let limit = with_unit(&term.threshold.to_string(), figure.unit);
            let said = format!("{} of {limit}", figure.cell());
            gauge((of.row().label, said), value / term.threshold, &mut sheet.row(y));
        }
    }
}

/// Columns of a gauge's name and of what is said of it.
const NAME: u16 = 18;
const SAID: u16 = 16;

/// A name, a bar whose end is the limit, and figures.
fn gauge((name, said): (&str, String), share: f64, sheet: &mut Sheet) {
    let (area, theme) = (sheet.area, sheet.theme);
    let end = sheet.put((0, 0), capital(name), theme.text()).max(NAME);
    sheet.put_right((area.width, 0), &said, theme.strong());
    let right = area.width.saturating_sub(SAID.max(width(&said)) + 1);
    if right >= end + SHORTEST {
        bar(share, &mut sheet.part((end, 0), (right - end, 1)));
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
