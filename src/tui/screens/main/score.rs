//! What to believe of the injuries, the damage index as a gauge, its three parts against their thresholds,
//! errors and flags.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::Style;

use crate::injury::{ENERGY, Injury, MERIDIAN, SHELL, Term, Verdict, lines};
use crate::report::errors::{of_damage, worst};
use crate::report::text::{digits, significant};
use crate::study::{Flag, Quantity};
use crate::tui::ensemble::is_whole;
use crate::tui::model::{Model, Shown};
use crate::tui::view::text::{fitted, flag_name, numeral, put, put_right, width, wrapped};
use crate::tui::view::theme::Theme;

/// How many rows it takes of so many.
pub fn height(of: u16) -> u16 {
    match of {
        ..20 => 8,
        20..28 => 9,
        _ => ROOM + ANSWERS,
    }
}

/// Rows without verdicts where there is room, and how many of those there are then; else there is one,
/// of the gravest injury.
const ROOM: u16 = 10;
const ANSWERS: u16 = Injury::ALL.len() as u16;

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

/// Where the gauge of the index begins, and its fewest columns.
const GAUGE: u16 = 18;
const SHORTEST: u16 = 4;

/// Draws the score below a line that says whether it is out of date.
pub fn draw(model: &Model, shown: &Shown, area: Rect, buffer: &mut Buffer) {
    let theme = Theme::of(model.look);
    let index = &shown.answer.index;
    for x in 0..area.width {
        put(buffer, area, (x, 0), "─", theme.line());
    }
    let heading = match model.stale() {
        Some(why) => format!(" {why} "),
        None => String::new(),
    };
    put(buffer, area, (1, 0), &heading, theme.warning());
    let rows = if area.height >= ROOM + ANSWERS {
        ANSWERS
    } else {
        1
    };
    answers(shown, rows, theme, area, buffer);
    let area = Rect {
        y: area.y + rows,
        height: area.height.saturating_sub(rows),
        ..area
    };
    let line = |y: u16| Rect::new(area.x, area.y + y, area.width, 1);

    let damage = index.damage();
    put(buffer, line(1), (0, 0), "Damage", theme.heading());
    let number = format!("{} %", numeral(damage, 8));
    put_right(buffer, line(1), (17, 0), &number, theme.strong());
    let band = band(model, shown, area.width);
    let beside = if band.is_empty() { 0 } else { width(&band) + 1 };
    put_right(buffer, line(1), (area.width, 0), &band, theme.text());
    let wide = area.width.saturating_sub(GAUGE + beside);
    let gauge = Rect::new(area.x + GAUGE, area.y + 1, wide, 1);
    bar(
        damage / 100.0,
        theme.gauge(damage / 100.0),
        theme,
        gauge,
        buffer,
    );

    let parts = [
        ("S shell", "%", index.shell_growth, SHELL),
        ("M meridian", "%", index.meridian_growth, MERIDIAN),
        ("E energy", "J", index.energy, ENERGY),
    ];
    let points = parts.map(|(_, _, value, term)| points(value, term, area.width));
    // The bars end where the longest of them begins.
    let beside = points.iter().map(|text| width(text)).max().unwrap_or(0) + 1;
    for (y, (of, points)) in (2..).zip(parts.into_iter().zip(&points)) {
        part(of, (points, beside.max(8)), theme, line(y), buffer);
    }
    errors(shown, model.idle, theme, line(5), buffer);
    flags(shown, theme, area, buffer);
}

/// What to believe of each injury, the gravest first, in so many rows from the second on.
fn answers(shown: &Shown, rows: u16, theme: Theme, area: Rect, buffer: &mut Buffer) {
    let verdicts = shown.answer.verdicts();
    let said = lines(&verdicts);
    let room = usize::from(area.width);
    let texts: Vec<String> = if let [(name, words)] = &said[..] {
        let mut whole = wrapped(&format!("{name}: {words}"), room);
        let rest = whole.split_off(whole.len().min(usize::from(rows) - 1));
        whole.push(rest.join(" "));
        whole
    } else {
        let brief = |verdict: &Verdict| match verdict.brief() {
            Some(words) => format!("{} {words}", verdict.injury.name()),
            None => format!("{}: {}", verdict.injury.name(), verdict.words()),
        };
        verdicts.iter().map(brief).collect()
    };
    for (y, text) in (1..=rows).zip(&texts) {
        put(buffer, area, (0, y), &fitted(text, room), theme.strong());
    }
}

/// The errors of the index that the gauge shows, and how far the apex moved where there is room.
fn errors(shown: &Shown, idle: bool, theme: Theme, area: Rect, buffer: &mut Buffer) {
    let errors = &shown.answer.errors;
    let waiting = if idle { "…" } else { "off" };
    let mesh = errors
        .mesh
        .as_ref()
        .map_or_else(|| waiting.to_owned(), of_damage);
    let step = of_damage(&errors.time_step);
    let apex = shown.answer.result(Quantity::Apex).unwrap_or_default();
    let apex = format!("apex {} mm", significant(apex));
    let beside = width(&apex) + 1;
    let full = format!("Index error: step {step}, mesh {mesh}");
    let tight = full.replace(" %", "%").replace("< ", "<");
    let brief = tight.replace(" error:", " ±");
    let bare = brief.replace("Index ", "");
    // The index may be the least of the errors: where there is room, the largest is named too.
    let whole = format!("{full}; largest step {}", worst(&errors.time_step));
    let candidates = [
        (&whole, beside + 1),
        (&full, beside + 1),
        (&tight, beside),
        (&brief, beside),
        (&full, 0),
        (&tight, 0),
        (&brief, 0),
        (&bare, 0),
    ];
    let fits = |(text, beside): &(&String, u16)| width(text) + beside <= area.width;
    let (text, beside) = candidates.into_iter().find(fits).unwrap_or((&bare, 0));
    put(buffer, area, (0, 0), text, theme.text());
    if beside > 0 {
        put_right(buffer, area, (area.width, 0), &apex, theme.text());
    }
}

/// Where nine in ten samples of the inputs lie, once that is known. Where it holds fewer than were asked
/// for it says so, or bears a star that the screen of its own explains.
fn band(model: &Model, shown: &Shown, room: u16) -> String {
    let Some(ensemble) = model.ensemble.of(&shown.scenario) else {
        return String::new();
    };
    let Some(band) = ensemble.band(Quantity::Damage) else {
        return String::new();
    };
    let span = |count| {
        let (low, high) = (digits(band.low, count), digits(band.high, count));
        format!("5-95 %: {low} to {high}")
    };
    let held = ensemble.valid().count();
    let (mark, reason) = if is_whole(ensemble) {
        ("", String::new())
    } else if held < ensemble.asked as usize {
        ("*", format!(" ({held} of {})", ensemble.asked))
    } else {
        ("*", format!(" ({} folded)", ensemble.folded()))
    };
    let marked = [4, 3, 2].map(|count| span(count) + mark);
    let mut texts = std::iter::once(span(4) + &reason).chain(marked);
    let free = room.saturating_sub(GAUGE + SHORTEST + 1);
    let fitting = texts.find(|text| width(text) <= free);
    fitting.unwrap_or_else(|| format!("{:.0}-{:.0}{mark}", band.low, band.high))
}

/// Below so many columns units and weights give way.
const ROOMY: u16 = 40;

/// What a part adds to the index, and the points of its threshold where there is room.
fn points(value: f64, term: Term, room: u16) -> String {
    let points = match term.points(value) {
        points if points.abs() >= 1e5 => format!("{points:.1e}"),
        points if points.abs() >= 1e3 => format!("{points:.0}"),
        points => format!("{points:.1}"),
    };
    if room < ROOMY {
        points
    } else {
        format!("{points}/{:.0}", term.weight)
    }
}

/// One part of the index: its value, its threshold, and how near it comes.
fn part(
    (label, unit, value, term): (&str, &str, f64, Term),
    (points, beside): (&str, u16),
    theme: Theme,
    area: Rect,
    buffer: &mut Buffer,
) {
    put(buffer, area, (0, 0), label, theme.text());
    let room = 20 - width(label) - width(unit) - 2;
    let number = format!("{} {unit}", numeral(value, room));
    put_right(buffer, area, (20, 0), &number, theme.strong());
    let limit = if area.width < ROOMY {
        format!("of {}", term.threshold)
    } else {
        format!("of {} {unit}", term.threshold)
    };
    put(buffer, area, (21, 0), &limit, theme.quiet());
    put_right(buffer, area, (area.width, 0), points, theme.quiet());
    let (left, right) = (31, area.width.saturating_sub(beside));
    if right > left + 3 {
        let share = value / term.threshold;
        let field = Rect::new(area.x + left, area.y, right - left, 1);
        bar(share, theme.gauge(share), theme, field, buffer);
    }
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
fn flags(shown: &Shown, theme: Theme, area: Rect, buffer: &mut Buffer) {
    let rows = usize::from(area.height.saturating_sub(6));
    let flags = &shown.answer.flags;
    if flags.is_empty() {
        let style = theme.quiet();
        put(buffer, area, (0, 6), "No flags raised", style);
        return;
    }
    let room = usize::from(area.width);
    let whole: Vec<String> = flags.iter().map(sentence).collect();
    let broken: Vec<String> = whole.iter().flat_map(|text| wrapped(text, room)).collect();
    let lines = if broken.len() <= rows {
        broken
    } else if whole.len() <= rows {
        whole.iter().map(|text| fitted(text, room)).collect()
    } else {
        let names: Vec<String> = flags.iter().map(|flag| flag_name(flag.kind)).collect();
        let mut lines = wrapped(&format!("FLAGS {}", names.join(", ")), room);
        if lines.len() > rows {
            let rest = lines.split_off(rows.saturating_sub(1)).join(" ");
            lines.push(fitted(&rest, room));
        }
        lines
    };
    for (i, line) in lines.iter().take(rows).enumerate() {
        put(buffer, area, (0, 6 + i as u16), line, theme.warning());
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tui::model::Look;
    use crate::tui::terminal::caps::{Depth, Symbols};

    #[test]
    fn a_long_number_leaves_the_name_of_its_part_whole() {
        let look = Look {
            depth: Depth::Mono,
            symbols: Symbols::Braille,
        };
        for value in [1.016e-13, -0.0063, -1.016e-13, 0.2091, 1e9] {
            for wide in [34, 50, 85] {
                let area = Rect::new(0, 0, wide, 1);
                let mut buffer = Buffer::empty(area);
                let of = ("M meridian", "%", value, MERIDIAN);
                part(of, ("0.0", 8), Theme::of(look), area, &mut buffer);
                let cells = buffer.content.iter();
                let text: String = cells.map(ratatui::buffer::Cell::symbol).collect();
                let words: Vec<&str> = text.split_whitespace().collect();
                assert_eq!((words[0], words[1], words[3]), ("M", "meridian", "%"));
                let shown: f64 = words[2].parse().unwrap();
                assert!((shown / value - 1.0).abs() < 0.05, "{text}");
            }
        }
    }
}
