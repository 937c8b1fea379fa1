//! What to believe of the injuries, the damage index as a gauge, its three parts against their
//! limits, and flags; where there are no risks, what is not known of the inputs. Every figure bears
//! its error; the line above says what of, or what is still being counted.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::Style;

use crate::injury::{Injury, Term};
use crate::report::figure::{Figure, PARTS, SCALE, allowing, times_its_limit, unusable};
use crate::report::limit::alone;
use crate::report::risks::first_line;
use crate::run::flags::Flag;
use crate::run::quantity::Quantity;
use crate::tui::model::AppModel;
use crate::tui::shown::ShownAnswer;
use crate::tui::view::below as rest;
use crate::tui::view::risks::{SIGN_ROWS, counting, longest, signs};
use crate::tui::view::text::{
    fitted, flag_lines, flag_name, longest_fitting, put, put_lines, put_right, width, wrapped,
};
use crate::tui::view::theme::Theme;

/// What the screen answers.
pub const QUESTION: &str = "How bad?";
/// How many rows it takes of so many; `beside` says whether the risks stand beside it.
pub fn height(of: u16, beside: bool) -> u16 {
    match of {
        28.. if beside => ROOM,
        28.. => ROOM + ANSWERS,
        _ => LEAST + ANSWERS,
    }
}

/// Rows of the risks and the signs, and those of the rest: where there is room, and where the
/// parts of the index stand in one line.
const ANSWERS: u16 = Injury::ALL.len() as u16 + SIGN_ROWS;
const ROOM: u16 = 10;
const LEAST: u16 = 4;

/// A bar of a share of its width, the threshold at its end.
fn bar(share: f64, style: Style, theme: Theme, area: Rect, buffer: &mut Buffer) {
    if area.width == 0 {
        return;
    }
    let cells = f64::from(area.width);
    let filled = (share.clamp(0.0, 1.0) * cells).round() as u16;
    for x in 0..area.width {
        if x < filled {
            put(buffer, area, (x, 0), "█", style);
        } else {
            put(buffer, area, (x, 0), "░", theme.quiet());
        }
    }
    if share > 1.0 {
        put(buffer, area, (area.width - 1, 0), "▶", style);
    }
}

/// The fewest columns of a gauge.
const SHORTEST: u16 = 4;
/// Rows of the index and its parts, and of those and what stands below.
const BLOCK: u16 = 4;
const WITH_BELOW: u16 = BLOCK + 1;

/// Draws the score below a line that says whether it is out of date; `beside` says whether the
/// risks stand beside it.
pub fn draw(model: &AppModel, shown: &ShownAnswer, beside: bool, area: Rect, buffer: &mut Buffer) {
    let theme = Theme::of(model.look);
    heading(model, shown, theme, area, buffer);
    let mut area = rest(area, 1);
    if !beside {
        let said = answers(shown, theme, area.width);
        for (y, (text, style)) in (0..).zip(&said) {
            put(buffer, area, (0, y), text, *style);
        }
        area = rest(area, said.len() as u16);
    }
    let whole = area.height > WITH_BELOW;
    let height = if whole {
        BLOCK
    } else {
        area.height.saturating_sub(1).min(2)
    };
    let block = Rect { height, ..area };
    match unusable(&shown.answer) {
        Some(why) => raw(shown, &why, theme, block, buffer),
        None => index(shown, theme, block, buffer),
    }
    area = rest(area, height);
    if whole {
        below(model, shown, theme, area, buffer);
        area = rest(area, 1);
    }
    flags(shown, theme, area, buffer);
}

/// The line above: whether the score is out of date, and what its errors come from, or what the
/// ranges do not hold yet.
fn heading(model: &AppModel, shown: &ShownAnswer, theme: Theme, area: Rect, buffer: &mut Buffer) {
    for x in 0..area.width {
        put(buffer, area, (x, 0), "─", theme.line());
    }
    let (text, style) = match model.stale() {
        Some(why) => (why, theme.warning()),
        None => (QUESTION, theme.heading()),
    };
    let end = put(buffer, area, (1, 0), &format!(" {text} "), style);
    let answer = &shown.answer;
    let mut texts = match (&answer.errors.mesh, model.idle) {
        (Some(_), _) => vec![" ± step and mesh, > for less ", " ± step and mesh ", ""],
        (None, true) => vec![" ± step; mesh to come ", ""],
        (None, false) => vec![" ± step; mesh off ", ""],
    };
    let counting = counting(model, answer).map(|text| {
        let short = text.replace("the ", "").replace(" and", ",");
        let shortest = short.replace("still counting: ", "");
        [
            format!(" {text} "),
            format!(" {short} "),
            format!(" {shortest} to come "),
            String::new(),
        ]
    });
    if let Some(counting) = &counting {
        texts = counting.iter().map(String::as_str).collect();
    }
    let text = longest_fitting(&texts, area.width.saturating_sub(end + 1));
    put_right(buffer, area, (area.width - 1, 0), text, theme.quiet());
}

/// The index with its gauge, and its parts.
fn index(shown: &ShownAnswer, theme: Theme, area: Rect, buffer: &mut Buffer) {
    let answer = &shown.answer;
    let line = |y: u16| Rect::new(area.x, area.y + y, area.width, 1);
    let damage = answer.index().damage();
    if let Some(figure) = Figure::of(answer, Quantity::Damage) {
        put(buffer, area, (0, 0), "Index", theme.heading());
        let end = put(buffer, area, (6, 0), &figure.to_string(), theme.strong());
        let texts = [format!(" ({SCALE})"), " (100 = worst)".to_owned()];
        let text = longest_fitting(&texts, area.width.saturating_sub(end + SHORTEST + 1));
        let end = put(buffer, area, (end, 0), text, theme.quiet()) + 1;
        let gauge = Rect::new(area.x + end, area.y, area.width.saturating_sub(end), 1);
        let share = damage / 100.0;
        if gauge.width >= SHORTEST {
            bar(share, theme.gauge(share), theme, gauge, buffer);
        }
    }
    if area.height < BLOCK {
        let text = &brief(shown)[1];
        put(buffer, area, (0, 1), text, theme.text());
        return;
    }
    for (y, (of, term)) in (1..).zip(PARTS) {
        if let Some(value) = answer.result(of) {
            part(shown, (of, value, term), theme, line(y), buffer);
        }
    }
}

/// The parts of the index, how many times its limit each is, long and short.
fn brief(shown: &ShownAnswer) -> [String; 2] {
    let times = PARTS.iter().filter_map(|(of, term)| {
        let times = times(shown, *of, shown.answer.result(*of)?, *term)?;
        Some(format!("{} {times}", of.row().short))
    });
    let times: Vec<String> = times.collect();
    [
        format!("{} x limit", times.join(", ")),
        format!("x limit: {}", times.join("  ")),
    ]
}

/// In place of an index that means nothing: why, what to do, and the figures without weight.
fn raw(shown: &ShownAnswer, why: &str, theme: Theme, area: Rect, buffer: &mut Buffer) {
    let mut said = wrapped(why, usize::from(area.width));
    let most = usize::from(area.height.max(3) - 1);
    let rest = said.split_off(said.len().min(most - 1)).join(" ");
    if !rest.is_empty() {
        said.push(fitted(&rest, usize::from(area.width)));
    }
    put_lines(buffer, area, (0, 0), &said, theme.warning());
    if said.len() >= area.height.into() {
        return;
    }
    let index = Figure::of(&shown.answer, Quantity::Damage).map_or_else(String::new, |f| f.number);
    let [long, short] = brief(shown);
    let texts = [
        format!("raw: index {index}, {long}"),
        format!("raw {index}: {short}"),
    ];
    let text = longest_fitting(&texts, area.width);
    put(buffer, area, (0, said.len() as u16), text, theme.quiet());
}

/// How many times its limit a part of the index is.
fn times(shown: &ShownAnswer, of: Quantity, value: f64, term: Term) -> Option<String> {
    let figure = Figure::of(&shown.answer, of)?;
    let text = times_its_limit(&figure, value, term);
    Some(text.split(' ').next()?.to_owned())
}

/// What to believe of each injury, the gravest first, or why nothing is said, and the signs.
fn answers(shown: &ShownAnswer, theme: Theme, wide: u16) -> Vec<(String, Style)> {
    let room = usize::from(wide);
    let risks = shown.answer.risks();
    let one = |risk: &crate::injury::Risk| (longest(risk, room), theme.risk(risk));
    let mut said: Vec<(String, Style)> = risks.iter().map(one).collect();
    if said.is_empty() {
        let silence = wrapped(&first_line(&shown.answer), room);
        said.extend(silence.into_iter().map(|line| (line, theme.strong())));
    }
    said.extend(signs(wide).into_iter().map(|line| (line, theme.heading())));
    said
}

/// What is not known of the inputs, and how far the apex moved where there is room.
fn below(model: &AppModel, shown: &ShownAnswer, theme: Theme, area: Rect, buffer: &mut Buffer) {
    let bands = bands(model, shown);
    let apex = Figure::of(&shown.answer, Quantity::Apex);
    let apex = apex.map_or_else(String::new, |apex| format!("apex {apex}"));
    let text = longest_fitting(&bands, area.width);
    let end = put(buffer, area, (0, 0), text, theme.text());
    if end + width(&apex) + 2 <= area.width {
        put_right(buffer, area, (area.width, 0), &apex, theme.text());
    }
}

/// Between what nine in ten samples of the inputs have the index where no risk has a range, the
/// longest words first. Where the band holds fewer than were asked for, or folded ones, it says
/// so, or bears a star that the screen of its own explains.
fn bands(model: &AppModel, shown: &ShownAnswer) -> Vec<String> {
    if shown.answer.silence().is_none() {
        return Vec::new();
    }
    let Some(ensemble) = model.ensemble.of(&shown.scenario) else {
        let waiting = if model.idle { "to come" } else { "off" };
        return vec![format!("inputs unknown: {waiting}")];
    };
    let Some(band) = ensemble.band(Quantity::Damage) else {
        return vec!["inputs unknown: no band".to_owned()];
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
        format!("inputs unknown: {within} (90 % of {reason})"),
        format!("inputs unknown: {within}{mark} (90 %)"),
        format!("inputs unknown: {within}{mark}"),
        format!("inputs: {within}{mark}"),
    ]
}

/// Below so many columns a part has no room for the result behind it, nor for a bar.
const ROOMY: u16 = 46;
/// Where the figure of a part ends, and the columns of a number of times.
const FIGURE: u16 = 27;
const TIMES: u16 = 6;
/// From so many columns on there is room for all words beside a bar.
const SPACIOUS: u16 = 56;
/// From so many on there is room for what it tends to on finer meshes, which ends here.
const BROAD: u16 = 84;
const LIMIT: u16 = FIGURE + 34;

/// One part of the index: its value, and how many times its limit that is.
fn part(
    shown: &ShownAnswer,
    (of, value, term): (Quantity, f64, Term),
    theme: Theme,
    area: Rect,
    buffer: &mut Buffer,
) {
    let (Some(figure), Some(times)) =
        (Figure::of(&shown.answer, of), times(shown, of, value, term))
    else {
        return;
    };
    let words = of.row().label.split(' ').take(2);
    let label = words.collect::<Vec<_>>().join(" ");
    put(buffer, area, (0, 0), &label, theme.text());
    if area.width < ROOMY {
        let texts = [
            format!("{times} x its limit {}", figure.off),
            format!("{times} x limit {}", figure.off),
        ];
        let room = area.width.saturating_sub(width(&label) + 1);
        let text = longest_fitting(&texts, room).trim_end();
        put_right(buffer, area, (area.width, 0), text, theme.strong());
        return;
    }
    put_right(buffer, area, (FIGURE, 0), &figure.to_string(), theme.text());
    let words = if area.width < SPACIOUS {
        "x limit"
    } else {
        "x its limit"
    };
    let text = format!("{times} {words}");
    put_right(buffer, area, (area.width, 0), &text, theme.strong());
    let beside = TIMES + 2 + width(words);
    let mut left = FIGURE + 2;
    if let Some(limit) = alone(&shown.answer, of)
        && area.width >= BROAD
    {
        let text = format!("on finer meshes: {limit}");
        left = put(buffer, area, (left, 0), &text, theme.quiet()).max(LIMIT) + 2;
    }
    let right = area.width.saturating_sub(beside);
    if right >= left + SHORTEST {
        let share = value / term.threshold;
        let field = Rect::new(area.x + left, area.y, right - left, 1);
        bar(share, theme.gauge(share), theme, field, buffer);
    }
}

/// What the index tends to on finer meshes, right of the column where the line begins to be free,
/// if there is room.
fn tends(shown: &ShownAnswer, free: u16, theme: Theme, area: Rect, buffer: &mut Buffer) {
    let Some(limit) = alone(&shown.answer, Quantity::Damage) else {
        return;
    };
    let texts = [
        format!("index on ever finer meshes: {limit}"),
        format!("on finer meshes: {limit}"),
        String::new(),
    ];
    let text = longest_fitting(&texts, area.width.saturating_sub(free + 2));
    put_right(buffer, area, (area.width, 0), text, theme.text());
}

/// A flag's name and its sentence, the name once.
fn sentence(flag: &Flag) -> String {
    let name = flag_name(flag.kind);
    if flag.message.starts_with(&name) {
        format!("FLAG {}", flag.message)
    } else {
        format!("FLAG {name}: {}", flag.message)
    }
}

/// Every flag by name; the sentence where there is room.
fn flags(shown: &ShownAnswer, theme: Theme, area: Rect, buffer: &mut Buffer) {
    let rows = usize::from(area.height);
    let flags = &shown.answer.flags;
    if flags.is_empty() {
        let end = put(buffer, area, (0, 0), "No flags raised", theme.quiet());
        tends(shown, end, theme, area, buffer);
        return;
    }
    let room = usize::from(area.width);
    let whole: Vec<String> = flags.iter().map(sentence).collect();
    let broken: Vec<String> = whole.iter().flat_map(|text| wrapped(text, room)).collect();
    let lines = if broken.len() <= rows {
        broken
    } else {
        flag_lines(flags, room, rows)
    };
    let lines = lines.iter().take(rows);
    put_lines(buffer, area, (0, 0), lines, theme.warning());
}
