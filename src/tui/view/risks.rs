//! The risks of an answer: a row an injury, what each rests on, what limits them, and the signs
//! that count more. The words are those of [`Risk`], fitted into the room that there is.

use ratatui::layout::Rect;
use ratatui::style::Style;

use crate::answer::solve::Answer;
use crate::injury::{BURST, Equivalent, Injury, Risk, SIGNS, in_short, span};
use crate::many::bands::Band;
use crate::report::figure::{Figure, unusable, with_unit};
use crate::report::{format::digits, risks::uncounted};
use crate::run::flags::FlagKind;
use crate::tui::model::{AppModel, FIRST_ESTIMATE};
use crate::tui::view::text::{fitted, longest_fitting, wrapped};
use crate::tui::{ensemble::widened, view::below, view::sheet::Sheet};

/// What [`SIGNS`] comes to where room is short, and where it is shortest.
const SHORT_SIGNS: [&str; 2] = [
    "Pain, poor vision, blood: eye doctor today; a low figure is no reassurance. Not a diagnosis.",
    "Pain or poor vision: eye doctor today, however low the figures.",
];
/// Rows that the signs take.
pub const SIGN_ROWS: u16 = 2;

/// The signs that need an eye doctor, in the longest words that fit into [`SIGN_ROWS`].
pub fn signs(room: u16) -> Vec<String> {
    let [short, shortest] = SHORT_SIGNS;
    let fits = |text: &&str| wrapped(text, room.into()).len() <= SIGN_ROWS.into();
    wrapped([SIGNS, short].into_iter().find(fits).unwrap_or(shortest), room.into())
}

/// Whether finer meshes and inputs are still to come, which widen the ranges.
pub fn comes(model: &AppModel, answer: &Answer) -> bool {
    model.idle && answer.inputs.is_none() && uncounted(answer).is_some()
}

/// What the ranges do not hold yet, in words; none where they hold all.
pub fn counting(model: &AppModel, answer: &Answer) -> Option<String> {
    let missing = uncounted(answer)?;
    let how = if comes(model, answer) { "still counting:" } else { "without" };
    Some(format!("{how} {missing}"))
}

/// An injury and what is said of it, in the longest words that there is room for.
pub fn longest(risk: &Risk, room: usize) -> String {
    let (name, word, percent) = (risk.injury.name(), risk.injury.word(), risk.percent());
    let forms = risk.forms();
    let (others, burst) =
        if risk.bursts() { (", others too", format!("; {BURST}")) } else { ("", String::new()) };
    let long = forms.iter().take(3).map(|form| format!("{name}: {form}{burst}"));
    let short = [&forms[2], &percent].into_iter();
    let short = short.flat_map(|said| [name, word].map(|of| format!("{of}: {said}{others}")));
    let texts: Vec<String> = long.chain(short).collect();
    fitted(longest_fitting(&texts, room as u16), room)
}

/// What the tissue felt, and where half of all eyes are hurt.
fn felt(answer: &Answer, risk: &Risk, room: u16) -> String {
    let measure = risk.injury.measure();
    let row = measure.row();
    let felt = Figure::of(answer, measure).map_or_else(String::new, |felt| felt.to_string());
    let half = with_unit(&digits(risk.injury.curve().half * row.factor, 2), row.unit);
    let short = format!("{felt}; half are hurt at {half}");
    let long = format!("{} {felt}; half of all eyes are hurt at {half}", row.label);
    let texts = [long, format!("{} {short}", row.label), short];
    longest_fitting(&texts, room).to_owned()
}

/// Columns of what is said of an injury: where its word begins, its middle, range and BB end.
const NARROW: [u16; 4] = [14, 35, 43, 50];
const BROAD: [u16; 4] = [20, 52, 61, 71];

/// An injury's name of at most 13 letters.
fn short_name(injury: Injury) -> &'static str {
    match injury {
        Injury::RetinaBack => "retina, back",
        Injury::RetinaFront => "retina, edge",
        Injury::LensDislocation => "lens torn off",
        Injury::CornealAbrasion => injury.word(),
        Injury::GlobeRupture | Injury::Hyphema => injury.name(),
    }
}

/// What is said in words, in signs.
fn in_signs(text: &str) -> String {
    text.replace("at least ", "≥").replace("under ", "<").replace("over ", ">")
}

/// The fewest columns of a bar.
const SHORTEST: u16 = 11;

/// Draws each risk below a heading, in `each` rows: the second says what the tissue felt.
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
    let (area, theme) = (sheet.area, sheet.theme);
    sheet.put((0, 0), heading, style);
    let columns = [BROAD, NARROW].into_iter().find(|columns| columns[3] <= area.width);
    let tight = columns == Some(NARROW);
    let bar = columns.map_or(0, |[.., like]| like + 2);
    let bar = Rect { x: area.x + bar, width: area.width.saturating_sub(bar + 1), ..area };
    let with_bar = columns.is_some() && bar.width >= SHORTEST;
    if let Some([_, ends @ ..]) = columns {
        let broad = ["about", "range", "like a BB"];
        let heads = if tight { ["about %", "range %", "BB m/s"] } else { broad };
        for (right, head) in ends.into_iter().zip(heads) {
            sheet.put_right((right, 0), head, theme.quiet());
        }
    }
    if with_bar {
        sheet.at(bar).put((0, 0), "0", theme.quiet());
        sheet.at(bar).put_right((bar.width, 0), "100 %", theme.quiet());
    }
    for (i, risk) in answer.risks().iter().enumerate() {
        let y = 1 + each * i as u16;
        let style = theme.risk(risk);
        let here = chosen == Some(i);
        let name = if here { theme.focus() } else { theme.text() };
        if here {
            sheet.buffer[(area.x - 1, area.y + y)].set_char('▸').set_style(theme.strong());
        }
        let Some([word, about, range, like]) = columns else {
            let said = longest(risk, usize::from(area.width));
            sheet.put((0, y), &said, style);
            sheet.put((0, y), said.split(':').next().unwrap_or_default(), name);
            continue;
        };
        let (own, said) = if tight {
            let said = risk.word().replace(" to almost certain", "-certain");
            (short_name(risk.injury), said.replace(" to ", "-"))
        } else {
            (risk.injury.name(), risk.word())
        };
        sheet.put((0, y), own, name);
        sheet.put((word, y), &said, style);
        // In tight columns the unit stands above them.
        let share = |said: &str| in_signs(if tight { said.trim_end_matches(" %") } else { said });
        sheet.put_right((range, y), share(&risk.percent()), style);
        sheet.put_right((about, y), share(&risk.middle()), theme.text());
        if risk.usable {
            let (sign, speed) = match risk.equivalent {
                Equivalent::Under(speed) => ("<", speed),
                Equivalent::At(speed) => ("", speed),
                Equivalent::Over(speed) => (">", speed),
            };
            let unit = if tight { "" } else { " m/s" };
            sheet.put_right((like, y), format!("{sign}{speed:.0}{unit}"), theme.text());
        }
        if with_bar {
            draw_bar(risk, &mut sheet.at(below(bar, y)));
        }
        if each > 1 {
            sheet.put((2, y + 1), felt(answer, risk, area.width - 2), theme.quiet());
        }
    }
}

/// By how much the samples of the inputs widen the ranges, once they are there.
fn wider(model: &AppModel, answer: &Answer) -> Option<String> {
    let ensemble = model.ensemble.of(&model.shown.as_ref()?.scenario)?;
    let said = |(injury, band): &(Injury, Band)| {
        format!("{} {}", injury.word(), span((band.low / 100.0, band.high / 100.0)))
    };
    let all: Vec<String> = widened(ensemble, answer).iter().map(said).collect();
    (!all.is_empty()).then(|| format!("wider by doubt in the inputs: {}", all.join(", ")))
}

/// What limits an answer, the gravest first: why it is not usable, what was raised, and what is
/// still to be counted. In short where `rows` are few, and as much of it as they hold.
pub fn limits(model: &AppModel, answer: &Answer, room: usize, rows: usize) -> Vec<String> {
    let (risks, spoiled) = (answer.risks(), unusable(answer));
    let (counting, wider) = (counting(model, answer), wider(model, answer));
    let straight = model.stale() == Some(FIRST_ESTIMATE);
    let states = [
        (straight, "as if straight on, with the error of its step alone"),
        (answer.pressed_flat(), "eye pressed flat, flatter than any tested (±?)"),
        (risks.iter().any(Risk::bursts), BURST),
    ];
    let said = |brief: bool| -> Vec<&str> {
        let states = states.iter().filter(|(holds, _)| *holds).map(|(_, words)| *words);
        let notes = risks.iter().flat_map(|risk| risk.notes.iter().copied());
        let notes = notes.map(|note| if brief { in_short(note) } else { note });
        // What spoils or ends an answer is said already.
        let said_already = |kind: FlagKind| match kind {
            FlagKind::MeshFolded => spoiled.is_some(),
            FlagKind::EyeFlat | FlagKind::BeyondTests => answer.pressed_flat(),
            _ => false,
        };
        let flags = answer.flags.iter().filter(|flag| !said_already(flag.kind));
        let flags = flags.map(|flag| if brief { flag.kind.words() } else { &flag.message });
        // What still widens the ranges is said before it is cut off.
        let first = spoiled.as_deref().into_iter().chain(states).chain(counting.as_deref());
        let mut said = Vec::new();
        for part in first.chain(notes).chain(flags).chain(wider.as_deref()) {
            if !said.contains(&part) {
                said.push(part);
            }
        }
        said
    };
    let (long, brief) = (said(false), said(true));
    let whole = [long.join("; "), brief.join("; ")].into_iter();
    let fewer = (1..brief.len()).rev().map(|count| brief[..count].join("; ") + "; F8: more");
    let mut all = whole.chain(fewer).map(|said| wrapped(&said, room));
    let fitting = all.find(|lines| lines.len() <= rows);
    fitting.unwrap_or_else(|| wrapped(brief.first().unwrap_or(&""), room))
}

/// The range of a risk from 0 to 100 %, and the risk itself.
fn draw_bar(risk: &Risk, sheet: &mut Sheet) {
    let (area, theme) = (sheet.area, sheet.theme);
    let column = |share: f64| (share * f64::from(area.width - 1)).round() as u16;
    let (low, high) = (column(risk.range.0), column(risk.range.1));
    for x in 0..area.width {
        let (mark, style) = match x {
            x if risk.has_middle() && x == column(risk.risk) => ("◆", theme.risk(risk)),
            x if (low..=high).contains(&x) => ("═", theme.risk(risk)),
            _ => ("·", theme.quiet()),
        };
        sheet.put((x, 0), mark, style);
    }
}

/// Draws the signs into the last rows of an area.
pub fn draw_signs(sheet: &mut Sheet) {
    let (area, theme) = (sheet.area, sheet.theme);
    let signs = signs(area.width - 1);
    let top = area.height.saturating_sub(signs.len() as u16);
    sheet.put_lines((1, top), signs, theme.heading());
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::injury::{Blow, Known};
    use crate::tui::view::text::width;

    #[test]
    fn every_risk_has_its_range_in_the_narrowest_place_and_a_burst_globe_the_others() {
        for injury in Injury::ALL {
            for times in [0.01, 0.5, 1.0, 1.5, 2.0, 100.0] {
                let value = times * injury.curve().half;
                let risk = injury.assess(&Blow::default(), Known { value, ..Known::default() });
                for room in 34..120 {
                    let text = longest(&risk, room);
                    assert!(usize::from(width(&text)) <= room, "{text}");
                    assert!(text.contains(&risk.percent()), "{text} in {room}");
                    assert_eq!(text.contains("others"), risk.bursts(), "{text}");
                }
            }
        }
    }

    #[test]
    fn the_signs_keep_what_counts_at_every_width() {
        for room in 32..200 {
            let signs = signs(room);
            assert!(signs.len() <= SIGN_ROWS.into(), "{signs:?}");
            let signs = signs.join(" ");
            for word in ["ain", "vision", "eye doctor today", "low"] {
                assert!(signs.contains(word), "{signs}");
            }
        }
    }
}
