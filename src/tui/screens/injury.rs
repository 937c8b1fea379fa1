//! The published injury curves beside the paper's index: one line a curve, the chosen one
//! explained.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;

use crate::injury::{Caution, Injury, MARKS, Part, Risk, Verdict, lines, span};
use crate::report::figure::{Figure, Off, SCALE, unusable, within};
use crate::report::verdict::{VOID, part_of};
use crate::run::quantity::Quantity;
use crate::tui::keys::TimeKeys;
use crate::tui::keys::press::{DOWN, UP, c};
use crate::tui::model::AppModel;
use crate::tui::screens::screen::{About, Pane, PaneKeys, Panes, Screen, bind};
use crate::tui::shown::ShownAnswer;
use crate::tui::view::below;
use crate::tui::view::text::{
    fitted, flag_name, flowed, put, put_lines, put_right, seen, width, wrapped,
};
use crate::tui::view::theme::Theme;

/// Columns of the injury's name, of the range of a risk, and of all figures behind the bar.
const NAME: u16 = 18;
const RANGE: u16 = 10;
const FIGURES: u16 = 32;
/// In fewer columns what was measured has no room: the columns of what is left then.
const NARROW: u16 = 60;
const FEW_FIGURES: u16 = 16;
/// Columns that the screen takes at most.
const WIDEST: u16 = 120;

pub(super) const ABOUT: About = About {
    title: "Injury",
    question: "What would experiments say?",
    purpose: "what published injury curves say",
    new: || Box::new(InjuryCurves::default()),
};

/// The place of the injury curve that is explained.
#[derive(Default)]
pub struct InjuryCurves {
    row: usize,
}

impl Panes for InjuryCurves {
    const PANES: &'static [Pane<Self>] = &[Pane::new("curves", TimeKeys::Absent, &[KEYS])];
}

#[rustfmt::skip]
const KEYS: PaneKeys<InjuryCurves> = PaneKeys::new("Injury", &[
    bind(&[UP, c('k')], |s, m| s.move_cursor(m, -1), "curve", "the curve above"),
    bind(&[DOWN, c('j')], |s, m| s.move_cursor(m, 1), "&", "the curve below"),
]);

impl InjuryCurves {
    fn move_cursor(&mut self, model: &AppModel, by: isize) {
        let count = model.shown.as_ref().map_or(0, |s| s.answer.risks().len());
        self.row = self
            .row
            .saturating_add_signed(by)
            .min(count.saturating_sub(1));
    }
}

impl Screen for InjuryCurves {
    fn draw(&self, model: &AppModel, area: Rect, buffer: &mut Buffer) {
        draw(self.row, model, area, buffer);
    }
}

fn draw(row: usize, model: &AppModel, area: Rect, buffer: &mut Buffer) {
    let theme = Theme::of(model.look);
    // Bars that are longer are no easier to read.
    let area = Rect {
        width: area.width.min(WIDEST),
        ..area
    };
    let Some(shown) = &model.shown else {
        put(buffer, area, (1, 1), "no result yet", theme.text());
        return;
    };
    let risks = shown.answer.risks();
    let figure = Figure::of(&shown.answer, Quantity::Damage);
    let figure = figure.map_or_else(String::new, |figure| figure.to_string());
    let (index, style) = match unusable(&shown.answer) {
        None => (format!("Paper's index {figure} ({SCALE})"), theme.strong()),
        Some(why) => (why, theme.warning()),
    };
    let room = usize::from(area.width.saturating_sub(2));
    let index = wrapped(&index, room);
    let end = 1 + index.last().map_or(0, |line| width(line));
    put_lines(buffer, area, (1, 0), &index, style);
    let last = index.len() as u16 - 1;
    let (right, style) = match model.stale() {
        Some(why) => (why, theme.warning()),
        None => (ABOUT.question, theme.heading()),
    };
    if end + width(right) + 2 < area.width {
        put_right(buffer, area, (area.width - 1, last), right, style);
    }
    let flags = flags(shown, room);
    put_lines(buffer, area, (1, last + 1), &flags, theme.warning());
    let above = last + flags.len() as u16;
    let area = below(area, above);
    let verdicts = shown.answer.verdicts();
    let rows = answers(&verdicts, false, theme, area, buffer);
    if risks.is_empty() {
        return;
    }
    let area = below(area, rows);
    let causes = match shown.answer.errors.mesh {
        Some(_) => "± step and mesh",
        None => "± step alone",
    };
    let marks = std::iter::once(causes).chain(MARKS.split("  "));
    let marks: Vec<String> = marks.map(str::to_owned).collect();
    let marks = flowed(&marks, area.width.saturating_sub(2));
    let last = area.height.saturating_sub(marks.len() as u16);
    put_lines(buffer, area, (1, last), &marks, theme.quiet());
    let area = Rect {
        height: last,
        ..area
    };
    let chosen = row % risks.len();
    let part = part_of(&verdicts, risks[chosen].curve);
    let all = u16::try_from(risks.len()).unwrap_or(u16::MAX);
    let most = area.height.saturating_sub(ABOVE + all.min(LISTED) + 1);
    let said = explained(&risks[chosen], part, room, most.into());
    let taken = said.len() as u16 + 1;
    let list = Rect {
        height: area.height.saturating_sub(taken),
        ..area
    };
    curves((&risks, &verdicts), Some(chosen), theme, list, buffer);
    let foot = below(area, list.height);
    for x in 0..foot.width {
        put(buffer, foot, (x, 0), "─", theme.line());
    }
    put_lines(buffer, foot, (1, 1), &said, theme.text());
}

/// Rows above the first curve, and the curves that are seen at least, whatever there is to
/// explain.
const ABOVE: u16 = 2;
const LISTED: u16 = 3;

/// What stands in place of a risk that means nothing here, in so many columns.
pub fn void(room: u16) -> &'static str {
    let mut texts = [VOID, "not valid", "-"].into_iter();
    texts.find(|text| width(text) <= room).unwrap_or("")
}

/// What each curve says, a line for each below a scale, as many as fit; round the chosen one, if
/// one is.
pub fn curves(
    (risks, verdicts): (&[Risk], &[Verdict]),
    chosen: Option<usize>,
    theme: Theme,
    area: Rect,
    buffer: &mut Buffer,
) {
    if risks.is_empty() || area.height < 3 {
        return;
    }
    let figures = match area.width {
        ..NARROW => FEW_FIGURES,
        _ => FIGURES,
    };
    let bar = Rect::new(
        area.x + NAME,
        area.y,
        area.width.saturating_sub(NAME + figures),
        area.height,
    );
    put(buffer, area, (1, 1), "published curves", theme.heading());
    put(buffer, bar, (0, 1), "0", theme.quiet());
    if bar.width > 15 {
        put_right(buffer, bar, (bar.width / 2 + 2, 1), "50 %", theme.quiet());
    }
    put_right(buffer, bar, (bar.width, 1), "100 %", theme.quiet());
    let room = area.height - 2;
    let first = (chosen.unwrap_or(0) + 1).saturating_sub(usize::from(room));
    let shown = usize::from(room).min(risks.len());
    let text = seen(first, shown, risks.len());
    put_right(buffer, area, (area.width - 1, 1), &text, theme.quiet());
    let mut before: Option<Injury> = first.checked_sub(1).map(|i| risks[i].curve.injury);
    for (i, risk) in risks.iter().enumerate().skip(first).take(room.into()) {
        let y = 2 + (i - first) as u16;
        let new = before != Some(risk.curve.injury);
        before = Some(risk.curve.injury);
        let name = if new { risk.curve.injury.name() } else { "" };
        let valid = !matches!(part_of(verdicts, risk.curve), Some(Part::NotValid(_)));
        line(
            risk,
            (name, chosen == Some(i), valid),
            y,
            theme,
            (area, bar),
            buffer,
        );
    }
}

/// The verdicts, a line for each injury or, if all words are wanted, as many as they take; returns
/// the rows taken. The words of a single one are wrapped.
pub fn answers(
    verdicts: &[Verdict],
    whole: bool,
    theme: Theme,
    area: Rect,
    buffer: &mut Buffer,
) -> u16 {
    let lines = lines(verdicts);
    let room = usize::from(area.width.saturating_sub(NAME + 1));
    let single = lines.len() == 1;
    let mut y = 1;
    for ((name, words), verdict) in lines.iter().zip(verdicts) {
        put(buffer, area, (1, y), name, theme.text());
        let words = if whole || single {
            wrapped(words, room)
        } else {
            let mut forms = verdict.forms().into_iter();
            let form = forms.find(|form| usize::from(width(form)) <= room);
            vec![form.unwrap_or_else(|| fitted(words, room))]
        };
        let style = match verdict.range {
            Some((_, high)) if !verdict.is_unclear() => theme.risk(high),
            _ => theme.text(),
        };
        for line in &words {
            put(buffer, area, (NAME, y), line, style);
            y += 1;
        }
    }
    y - 1
}

/// The names of the flags of the answer, which the curves rest on, in two lines at most.
fn flags(shown: &ShownAnswer, room: usize) -> Vec<String> {
    let names: Vec<String> = shown
        .answer
        .flags
        .iter()
        .map(|f| flag_name(f.kind))
        .collect();
    if names.is_empty() {
        return Vec::new();
    }
    let mut lines = wrapped(&format!("FLAGS {}", names.join(", ")), room);
    if lines.len() > 2 {
        lines = vec![fitted(&lines.join(" "), room)];
    }
    lines
}

fn line(
    risk: &Risk,
    (name, chosen, valid): (&str, bool, bool),
    y: u16,
    theme: Theme,
    (area, bar): (Rect, Rect),
    buffer: &mut Buffer,
) {
    let style = if chosen { theme.focus() } else { theme.text() };
    if chosen {
        put(buffer, area, (0, y), "▸", style);
    }
    put(buffer, area, (1, y), name, style);
    let last = f64::from(bar.width.saturating_sub(1));
    let column = |share: f64| (share.clamp(0.0, 1.0) * last).round() as u16;
    let (low, high) = (column(risk.band.0), column(risk.band.1));
    for x in 0..bar.width {
        let (mark, style) = if !valid {
            (" ", theme.quiet())
        } else if x == column(risk.risk) {
            ("◆", theme.risk(risk.risk))
        } else if (low..=high).contains(&x) {
            ("═", theme.risk(risk.risk))
        } else {
            ("·", theme.quiet())
        };
        put(buffer, bar, (x, y), mark, style);
    }
    if !valid {
        put(buffer, bar, (0, y), void(bar.width), theme.quiet());
    }
    let style = if valid { theme.strong() } else { theme.quiet() };
    let end = NAME + bar.width + RANGE;
    put_right(buffer, area, (end, y), &span(risk.band), style);
    let (unit, scale) = risk.curve.measure.unit();
    let marks = risk.marks();
    let error = 100.0 * risk.error;
    // Of what is asked, not computed, it is none.
    let off = Off::Both(error).to_string().replace(' ', "");
    let value = format!("{} {unit} {off}", within(risk.value / scale, Some(error)));
    if area.width >= NARROW {
        put(buffer, area, (end + 1, y), &value, theme.text());
    }
    put_right(buffer, area, (area.width, y), &marks, theme.warning());
}

/// What one curve says, its part in the verdict, and what stands behind it: as many whole
/// sentences as so many rows hold, the most needed first.
fn explained(risk: &Risk, part: Option<&Part>, room: usize, rows: usize) -> Vec<String> {
    let curve = risk.curve;
    let (low, high) = (100.0 * risk.band.0, 100.0 * risk.band.1);
    let best = format!(": {}", span((risk.risk, risk.risk)));
    let range = if high - low < 1.0 {
        best
    } else {
        format!("{best}, {low:.0} to {high:.0} % over the range of curve and measure")
    };
    let (injury, measure) = (curve.injury.name(), curve.measure.name());
    let mut sentences = vec![format!("{injury} by {measure}{range}.")];
    sentences.extend(match part {
        Some(Part::Believed) => Some("Believed.".to_owned()),
        Some(Part::Agrees) => Some("Agrees with what is believed.".to_owned()),
        Some(Part::Disagrees(why)) => Some(format!("Counts less: {why}.")),
        Some(Part::NotValid(why)) => Some(format!("NOT VALID HERE: {why}.")),
        None => None,
    });
    if risk.extrapolated {
        sentences.push("EXTRAPOLATED beyond its data.".to_owned());
    }
    if risk.caution == Some(Caution::LargerThanEye) {
        sentences.push(format!("CAUTION: {}.", Caution::LargerThanEye.text()));
    }
    sentences.push(format!(
        "{}; {}; {}; {}.",
        curve.source,
        curve.species.name(),
        curve.data,
        curve.standing.name(),
    ));
    if !curve.remark.is_empty() {
        sentences.push(format!("({}.)", curve.remark));
    }
    let some = |count: usize| wrapped(&sentences[..count].join(" "), room);
    let fits = |lines: &Vec<String>| lines.len() <= rows;
    let mut fitting = (1..=sentences.len()).rev().map(some).filter(fits);
    fitting.next().unwrap_or_else(|| some(1))
}
