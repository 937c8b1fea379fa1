//! The risks of an answer: a row an injury, what each rests on, and the signs that count more.
//!
//! The words and figures are those of [`Risk`] everywhere; here they are only fitted into the room
//! that there is.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;

use crate::answer::solve::Answer;
use crate::injury::{BURST, Risk, SIGNS, whole};
use crate::report::figure::{Figure, with_unit};
use crate::report::format::significant;
use crate::report::risks::uncounted;
use crate::tui::model::AppModel;
use crate::tui::view::below;
use crate::tui::view::text::{fitted, longest_fitting, put, put_lines, put_right, width, wrapped};
use crate::tui::view::theme::Theme;

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
    let texts = [SIGNS, short].map(|text| wrapped(text, room.into()));
    let fits = |lines: &Vec<String>| lines.len() <= SIGN_ROWS.into();
    let long = texts.into_iter().find(fits);
    long.unwrap_or_else(|| wrapped(shortest, room.into()))
}

/// What the ranges do not hold yet, in words; none where they hold all.
pub fn counting(model: &AppModel, answer: &Answer) -> Option<String> {
    let missing = uncounted(answer)?;
    let comes = model.idle && answer.inputs.is_none();
    let how = if comes { "still counting:" } else { "without" };
    Some(format!("{how} {missing}"))
}

/// An injury and what is said of it, in the longest words that there is room for.
pub fn longest(risk: &Risk, room: usize) -> String {
    let (name, word, percent) = (risk.injury.name(), risk.injury.word(), risk.percent());
    let mut forms = risk.forms();
    forms.truncate(3);
    let others = if risk.bursts() { ", others too" } else { "" };
    let short = format!("{}{others}", forms[2]);
    if risk.bursts() {
        for form in &mut forms {
            form.extend(["; ", BURST]);
        }
    }
    let mut texts: Vec<String> = forms.iter().map(|form| format!("{name}: {form}")).collect();
    texts.extend([
        format!("{name}: {short}"),
        format!("{word}: {short}"),
        format!("{name}: {percent}{others}"),
        format!("{word}: {percent}{others}"),
    ]);
    fitted(longest_fitting(&texts, room as u16), room)
}

/// What the tissue felt, where 50 % lies, and the BB that it would feel as much of.
fn felt(answer: &Answer, risk: &Risk, room: u16) -> String {
    let (measure, like) = (risk.injury.measure(), risk.equivalent);
    let row = measure.row();
    let felt = Figure::of(answer, measure).map_or_else(String::new, |felt| felt.to_string());
    let half = significant(risk.injury.curve().half * row.factor);
    let whole = with_unit(&half, row.unit);
    let texts = [
        format!("{} {felt}, 50 % at {whole}; like {like}", row.label),
        format!("{} {felt}, 50 % at {half}; like {like}", row.label),
        format!("{felt}, 50 % at {half}; like {like}"),
    ];
    longest_fitting(&texts, room).to_owned()
}

/// Columns of an injury's name and a word of it; where the range and the risk end.
const NAME: u16 = 21;
const RANGE: u16 = 61;
const ABOUT: u16 = 73;
/// The fewest columns of a bar.
const SHORTEST: u16 = 12;

/// Draws each risk below a heading, in `each` rows: the second says what the tissue felt.
pub fn rows(
    (model, answer): (&AppModel, &Answer),
    (chosen, each): (Option<usize>, u16),
    area: Rect,
    buffer: &mut Buffer,
) {
    let theme = Theme::of(model.look);
    let parts = ["80 % ranges".to_owned()]
        .into_iter()
        .chain(counting(model, answer));
    let heading = parts.collect::<Vec<_>>().join(", ");
    put(buffer, area, (1, 0), &heading, theme.heading());
    let in_columns = area.width > ABOUT;
    let bar = Rect {
        x: area.x + ABOUT + 2,
        width: area.width.saturating_sub(ABOUT + 3),
        ..area
    };
    if in_columns {
        put_right(buffer, area, (ABOUT, 0), "about", theme.quiet());
    }
    if bar.width >= SHORTEST {
        put(buffer, bar, (0, 0), "0", theme.quiet());
        put_right(buffer, bar, (bar.width, 0), "100 %", theme.quiet());
    }
    for (i, risk) in answer.risks().iter().enumerate() {
        let y = 1 + each * i as u16;
        let style = theme.risk(risk);
        let (sign, here) = match chosen {
            Some(at) if at == i => ("▸", theme.focus()),
            _ => (" ", theme.text()),
        };
        put(buffer, area, (0, y), sign, theme.strong());
        if in_columns {
            put(buffer, area, (1, y), risk.injury.name(), here);
            put(buffer, area, (NAME, y), &risk.word(), style);
            put_right(buffer, area, (RANGE, y), &risk.percent(), style);
            if risk.usable {
                put_right(buffer, area, (ABOUT, y), &whole(risk.risk), theme.text());
            }
        } else {
            let said = longest(risk, usize::from(area.width - 2));
            let name = said.split(':').next().map_or(0, width);
            put(buffer, area, (1, y), &said, style);
            put(buffer, area, (1, y), &said[..name.into()], here);
        }
        if bar.width >= SHORTEST {
            draw_bar(risk, theme, below(bar, y), buffer);
        }
        if each > 1 {
            let felt = felt(answer, risk, area.width - 4);
            put(buffer, area, (3, y + 1), &felt, theme.quiet());
        }
    }
}

/// The range of a risk from 0 to 100 %, and the risk itself.
fn draw_bar(risk: &Risk, theme: Theme, area: Rect, buffer: &mut Buffer) {
    let column = |share: f64| (share * f64::from(area.width - 1)).round() as u16;
    let (low, high) = (column(risk.range.0), column(risk.range.1));
    for x in 0..area.width {
        let (mark, style) = match x {
            x if risk.usable && x == column(risk.risk) => ("◆", theme.risk(risk)),
            x if (low..=high).contains(&x) => ("═", theme.risk(risk)),
            _ => ("·", theme.quiet()),
        };
        put(buffer, area, (x, 0), mark, style);
    }
}

/// Draws the signs into the last rows of an area.
pub fn draw_signs(theme: Theme, area: Rect, buffer: &mut Buffer) {
    let signs = signs(area.width.saturating_sub(2));
    let top = area.height.saturating_sub(signs.len() as u16);
    put_lines(buffer, area, (1, top), &signs, theme.heading());
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::injury::{Blow, Injury, Known};

    fn risk(injury: Injury, times: f64) -> Risk {
        let value = times * injury.curve().half;
        let known = Known {
            value,
            ..Known::default()
        };
        injury.assess(&Blow::default(), known)
    }

    #[test]
    fn every_risk_has_its_range_in_the_narrowest_place_and_a_burst_globe_the_others() {
        for injury in Injury::ALL {
            for times in [0.01, 0.5, 1.0, 1.5, 2.0, 100.0] {
                let risk = risk(*injury, times);
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
