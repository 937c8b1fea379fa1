//! The risks of an answer: a row an injury, what limits them, and the signs that count more. The
//! words are those of [`Risk`], fitted into the room that there is.

use ratatui::layout::Rect;
use ratatui::style::Style;

use crate::answer::solve::Answer;
use crate::injury::{BURST, Injury, Risk, SIGNS, Share};
use crate::report::figure::{Figure, unusable, with_unit};
use crate::report::{bone, format::digits};
use crate::run::flags::FlagKind;
use crate::scenario::direction::Directions;
use crate::tui::view::text::{fitted, longest_fitting, width, wrapped};
use crate::tui::{shown::ShownAnswer, view::below, view::sheet::Sheet};

/// What [`SIGNS`] comes to where room is short, and where it is shortest.
const SHORT_SIGNS: [&str; 3] = [
    "Pain, poor vision, blood: eye doctor today; a low figure is no reassurance. Not a diagnosis.",
    "Pain, poor vision, blood: eye doctor today, however low a risk. Not a diagnosis",
    "Pain or poor vision: eye doctor today, however low a risk.",
];
/// Rows that the signs take.
pub const SIGN_ROWS: u16 = 1;

/// The signs that need an eye doctor, in the longest words that fit into [`SIGN_ROWS`].
pub fn signs(room: u16) -> &'static str {
    let mut texts = [SIGNS].into_iter().chain(SHORT_SIGNS);
    texts.find(|text| width(text) <= room).unwrap_or(SHORT_SIGNS[2])
}

/// An injury and what is said of it, in the longest words that there is room for.
pub fn longest(risk: &Risk, room: usize) -> String {
    let (parts, name) = (risk.parts(), risk.injury.name());
    let long =
        (1..=parts.len()).rev().map(|count| format!("{name}: {}", parts[..count].join("; ")));
    let mut texts: Vec<String> = long.collect();
    let (word, short) = (risk.word(), short_name(risk.injury));
    if is_told(risk) {
        let [told, range] = [risk.middle(), risk.range()].map(|said| bare(&said));
        texts.push(format!("{name}: {word}, {told} ({range}) %"));
        texts.push(format!("{short}: {word}, {told} ({range}) %"));
        texts.push(format!("{short}: {word}, {told} %"));
        texts.push(format!("{short}: {told} ({range}) %"));
    } else {
        texts.push(format!("{short}: {word}"));
    }
    fitted(longest_fitting(&texts, room as u16), room)
}

/// Whether figures are said of a risk.
fn is_told(risk: &Risk) -> bool {
    risk.usable && !risk.is_open()
}

/// What the tissue felt, and where half of all eyes are hurt.
fn felt(answer: &Answer, risk: &Risk, room: u16) -> String {
    let (measure, blow) = (risk.injury.measure(), answer.case.blow.as_ref());
    let (Some(felt), Some(blow)) = (Figure::of(answer, measure), blow) else {
        return String::new();
    };
    let (row, point) = (measure.row(), blow.point(risk.injury));
    let half = with_unit(&digits(libm::exp10(point.log) * row.factor, 2), row.unit);
    let known = digits(libm::exp10(point.known), 2);
    let short = format!("{felt}; half are hurt at {half}");
    let long = format!("{} {felt}; half of all eyes are hurt at {half}", row.label);
    let texts = [format!("{long}, x or / {known}"), long, format!("{} {short}", row.label), short];
    longest_fitting(&texts, room).to_owned()
}

/// An injury's name of at most 13 letters.
pub fn short_name(injury: Injury) -> &'static str {
    match injury {
        Injury::RetinaBack => "retina, back",
        Injury::RetinaFront => "retina, edge",
        Injury::LensDislocation => "lens",
        Injury::CornealAbrasion => injury.word(),
        Injury::GlobeRupture | Injury::Hyphema => injury.name(),
    }
}

/// A share without its unit, and in signs what is said in words.
pub fn bare(share: &str) -> String {
    share.trim_end_matches(" %").replace("under ", "<").replace("over ", ">")
}

/// Where a word begins, and where told, its range, of eyes hit so, and what was seen end.
struct Columns {
    name: fn(Injury) -> &'static str,
    word: u16,
    ends: [u16; 3],
    seen: u16,
}

const BROAD: Columns = Columns { name: Injury::name, word: 20, ends: [44, 53, 60], seen: 72 };
const NARROW: Columns = Columns { name: short_name, word: 14, ends: [36, 43, 48], seen: 59 };
/// Columns of the longest word.
const WORD: u16 = 18;
/// The fewest columns of a bar.
pub const SHORTEST: u16 = 10;

impl Columns {
    /// The widest that fit, all of them or all but what was seen.
    fn within(room: u16) -> Option<Self> {
        match room {
            _ if room >= BROAD.seen => Some(BROAD),
            _ if room >= NARROW.ends[2] => Some(NARROW),
            _ => None,
        }
    }

    /// The unit of the figures and what stands in the columns.
    fn heads(&self, clinic: bool, sheet: &mut Sheet) {
        let quiet = sheet.theme.quiet();
        let [_, range, hit] = self.ends;
        if !clinic {
            sheet.put_right((range, 0), "of 100 hit so", quiet);
            return;
        }
        sheet.put_right((range, 0), "of 100 who come", quiet);
        sheet.put_right((hit, 0), "hit", quiet);
        if self.seen <= sheet.area.width {
            sheet.put_right((self.seen, 0), "seen", quiet);
        }
    }

    /// The word and figures of a risk.
    fn row(&self, risk: &Risk, sheet: &mut Sheet) {
        let (room, theme) = (sheet.area.width, sheet.theme);
        let style = theme.risk(risk);
        sheet.put((self.word, 0), risk.word(), style);
        if !is_told(risk) {
            let left = self.word + WORD;
            let felt = risk.felt();
            if risk.usable && left + width(&felt) <= room {
                sheet.put((left, 0), felt, theme.quiet());
            }
            return;
        }
        let hit = risk.clinic.map_or_else(String::new, |_| risk.hit.percent());
        let said = [(risk.middle(), style), (risk.range(), style), (hit, theme.text())];
        for (end, (figure, style)) in self.ends.into_iter().zip(said) {
            // The unit stands above them.
            sheet.put_right((end, 0), bare(&figure), style);
        }
        let seen = risk.counted.map_or_else(String::new, |(outcome, _)| outcome.count());
        if self.seen <= room && self.ends[2] + width(&seen) < self.seen {
            sheet.put_right((self.seen, 0), seen, theme.text());
        }
    }

    /// The place of the bars, where there is room for any.
    fn bar(&self, area: Rect) -> Option<Rect> {
        let after = if self.seen <= area.width { self.seen } else { self.ends[2] } + 2;
        let wide = area.width.saturating_sub(after + 1);
        (wide >= SHORTEST).then_some(Rect { x: area.x + after, width: wide, ..area })
    }
}

/// Draws each risk below a heading, in `each` rows: the second says what was seen and felt.
pub fn rows(
    answer: &Answer,
    (heading, style): (&str, Style),
    (chosen, each): (Option<usize>, u16),
    sheet: &mut Sheet,
) {
    // The mark of the chosen one stands before its name.
    let mark = u16::from(chosen.is_some());
    let (wide, high) = (sheet.area.width.saturating_sub(mark), sheet.area.height);
    let sheet = &mut sheet.part((mark, 0), (wide, high));
    let (area, theme, risks) = (sheet.area, sheet.theme, answer.risks());
    sheet.put((0, 0), heading, style);
    let columns = Columns::within(area.width);
    let bar = columns.as_ref().and_then(|columns| columns.bar(area));
    if let Some(columns) = &columns {
        columns.heads(risks.iter().any(|risk| risk.clinic.is_some()), sheet);
    }
    if let Some(bar) = bar {
        sheet.at(bar).put((0, 0), "0", theme.quiet());
        sheet.at(bar).put_right((bar.width, 0), "100", theme.quiet());
    }
    for (i, risk) in risks.iter().enumerate() {
        let y = 1 + each * i as u16;
        let here = chosen == Some(i);
        let style = if here { theme.focus() } else { theme.text() };
        if here {
            sheet.buffer[(area.x - 1, area.y + y)].set_char('▸').set_style(theme.strong());
        }
        let Some(columns) = &columns else {
            let said = longest(risk, usize::from(area.width));
            sheet.put((0, y), &said, theme.risk(risk));
            sheet.put((0, y), said.split(':').next().unwrap_or_default(), style);
            continue;
        };
        sheet.put((0, y), (columns.name)(risk.injury), style);
        columns.row(risk, &mut sheet.row(y));
        if let Some(bar) = bar.filter(|_| is_told(risk)) {
            draw_bar(&risk.share(), theme.risk(risk), &mut sheet.at(below(bar, y)));
        }
        if each > 1 {
            let felt = felt(answer, risk, area.width - 2);
            let seen = risk.seen().map(|seen| format!("seen {seen}"));
            let texts = seen.map(|seen| [format!("{seen}; {felt}"), seen, felt.clone()]);
            let text =
                texts.as_ref().map_or(&felt[..], |texts| longest_fitting(texts, area.width - 2));
            sheet.put((2, y + 1), text, theme.quiet());
        }
    }
}

/// From where the blow of risks may have come, where that is not the one that is drawn.
fn directions(shown: &ShownAnswer) -> Option<String> {
    let others = shown.answer.others.len();
    let object = shown.scenario.projectile().filter(|_| others > 0)?;
    let drawn = match object.directions {
        Directions::NotKnown => "straight on",
        Directions::AsGiven => "as given",
    };
    Some(format!("risks: {} directions; the picture: {drawn}", others + 1))
}

/// What limits an answer, the gravest first: why it is not usable, what became of bone, from where
/// it may have come, and what was raised. In short where `rows` are few, and as much as they hold.
pub fn limits(shown: &ShownAnswer, room: usize, rows: usize) -> Vec<String> {
    let answer = &shown.answer;
    let (spoiled, directions) = (unusable(answer), directions(shown));
    let bone = bone::line(answer);
    let states = [
        (answer.pressed_flat(), "eye pressed flat, flatter than any tested (±?)"),
        (answer.risks().iter().any(Risk::opens), BURST),
    ];
    let said = |brief: bool| -> Vec<&str> {
        let states = states.iter().filter(|(holds, _)| *holds).map(|(_, words)| *words);
        // What it brought stands behind the last colon.
        let bone = bone.as_deref().map(|line| match line.rsplit_once(": ") {
            Some((word, _)) if brief => word,
            _ => line,
        });
        // What spoils or ends an answer is said already.
        let said_already = |kind: FlagKind| match kind {
            FlagKind::MeshFolded => spoiled.is_some(),
            FlagKind::EyeFlat | FlagKind::BeyondTests => answer.pressed_flat(),
            _ => false,
        };
        let flags = answer.flags.iter().filter(|flag| !said_already(flag.kind));
        let flags = flags.map(|flag| if brief { flag.kind.words() } else { &flag.message });
        let first = spoiled.as_deref().into_iter().chain(states);
        first.chain(bone).chain(directions.as_deref()).chain(flags).collect()
    };
    let (long, brief) = (said(false), said(true));
    let whole = [long.join("; "), brief.join("; ")].into_iter();
    let fewer = (1..brief.len()).rev().map(|count| brief[..count].join("; ") + "; F8: more");
    let mut all = whole.chain(fewer).map(|said| wrapped(&said, room));
    let fitting = all.find(|lines| lines.len() <= rows);
    fitting.unwrap_or_else(|| wrapped(brief.first().unwrap_or(&""), room))
}

/// A bar from 0 to 100 % with a range on it, and in that what is told.
pub fn draw_bar(share: &Share, style: Style, sheet: &mut Sheet) {
    let (area, theme) = (sheet.area, sheet.theme);
    let column = |share: f64| (share * f64::from(area.width - 1)).round() as u16;
    let (low, high) = (column(share.low), column(share.high));
    for x in 0..area.width {
        let (mark, style) = match x {
            x if x == column(share.told) => ("◆", style),
            x if (low..=high).contains(&x) => ("━", style),
            _ => ("·", theme.quiet()),
        };
        sheet.put((x, 0), mark, style);
    }
}

/// Draws the signs into the last row of an area.
pub fn draw_signs(sheet: &mut Sheet) {
    let area = sheet.area;
    let row = area.height.saturating_sub(SIGN_ROWS);
    sheet.put((0, row), signs(area.width), sheet.theme.text());
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::injury::{Blow, Felt, PerInjury, assess};
    use crate::scenario::library::tests::preset;

    /// The risks of an object whose tissues felt so many times what hurts half of all eyes.
    fn risks(name: &str, times: f64) -> impl Iterator<Item = Risk> {
        let blow = Blow::of(&preset(name, &[]));
        let measures = blow.points.map(|point| times * libm::exp10(point.log));
        let felt = Felt { measures, errors: measures.map(|_| 0.0), way_in: None, weight: 1.0 };
        assess(&blow, &[felt], &PerInjury::default()).into_iter()
    }

    #[test]
    fn every_risk_has_its_figures_in_the_narrowest_place_and_none_where_nobody_counted() {
        for (name, times) in [("bb-56", 0.01), ("squash-ball", 0.5), ("fist", 1.0), ("bb-56", 9.0)]
        {
            for risk in risks(name, times) {
                for room in 34..120 {
                    let text = longest(&risk, room);
                    assert!(usize::from(width(&text)) <= room, "{text}");
                    let told =
                        text.contains(&risk.middle()) || text.contains(&bare(&risk.middle()));
                    assert!(told != risk.is_open(), "{text} in {room}");
                }
            }
        }
    }

    #[test]
    fn the_signs_keep_what_counts_in_one_row_at_every_width() {
        for room in 60..200 {
            let signs = signs(room);
            assert!(width(signs) <= room, "{signs} in {room}");
            for word in ["ain", "vision", "eye doctor", "today", "low"] {
                assert!(signs.contains(word), "{signs}");
            }
        }
        assert!(signs(80).ends_with("Not a diagnosis"));
    }
}
