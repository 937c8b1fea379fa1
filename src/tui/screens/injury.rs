//! The risk of each injury beside the paper's index: a row an injury, the chosen one explained and
//! what to look for.

use ratatui::layout::Rect;

use crate::injury::{Injury, Risk};
use crate::report::figure::{Figure, SCALE, unusable};
use crate::report::format::{capital, digits};
use crate::report::ladder::{Rung, between, ladder};
use crate::report::look_for::{hours, look_for};
use crate::report::risks::{basis, silence};
use crate::report::sentence::sentence;
use crate::run::quantity::{Quantity, Row};
use crate::run::sectors::{HOURS, QUADRANTS, Sectors};
use crate::scenario::Projectile;
use crate::tui::keys::press::{DOWN, UP, c};
use crate::tui::screens::screen::{Pane, PaneKeys, Panes, Screen, bind};
use crate::tui::view::risks::{SIGN_ROWS, draw_signs, rows};
use crate::tui::view::text::{flag_lines, whole_sentences, width, wrapped};
use crate::tui::view::{eye::EyePicture, sheet::Sheet};
use crate::tui::{keys::TimeKeys, model::AppModel, shown::ShownAnswer};
use crate::tui::{view::below, view::fundus};

/// What the screen answers.
pub(super) const QUESTION: &str = "What is hurt?";
/// Columns that the screen takes at most: longer bars are no easier to read.
const WIDEST: u16 = 120;
/// Columns beside it from which on there is room for the eye.
const PICTURED: u16 = 40;
/// Rows of what explains the chosen injury, at least.
const EXPLAINED: u16 = 3;
/// Rows of what explains it above the ladder of known objects.
const LADDER_BELOW: u16 = 7;
/// Rungs that a ladder has at least.
const FEWEST: usize = 5;
/// Columns of a figure on that ladder.
const FIGURE: u16 = 7;

/// The place of the injury that is explained, and what is shown.
#[derive(Default)]
pub struct Injuries {
    row: usize,
    /// Whether the retina is shown as a clock face instead.
    fundus: bool,
}

impl Panes for Injuries {
    const PANES: &'static [Pane<Self>] = &[Pane::new("injuries", TimeKeys::Absent, &[KEYS])];
}

#[rustfmt::skip]
const KEYS: PaneKeys<Injuries> = PaneKeys::new("Injury", &[
    bind(&[UP, c('k')], |s, _| s.row = s.row.saturating_sub(1), "injury", "the injury above"),
    bind(&[DOWN, c('j')], |s, _| s.row = (s.row + 1).min(Injury::ALL.len() - 1), "&", "the injury below"),
    bind(&[c('f')], |s, _| s.fundus = !s.fundus, "fundus", "the retina as a clock face"),
]);

impl Screen for Injuries {
    fn draw(&self, model: &AppModel, sheet: &mut Sheet) {
        let area = sheet.area;
        let rest = area.width.saturating_sub(WIDEST + 1);
        let right = Rect::new(area.right() - rest, area.y, rest, area.height);
        if let (Some(shown), PICTURED..) = (&model.shown, rest) {
            pictured(self.row, model, shown, &mut sheet.at(right));
        }
        let sheet = &mut sheet.at(Rect { width: area.width.min(WIDEST), ..area });
        match &model.shown {
            Some(shown) if self.fundus => fundus(shown, sheet),
            Some(shown) => draw(self.row, model, shown, sheet),
            None => {
                sheet.put((1, 1), "no result yet", sheet.theme.text());
            }
        }
    }
}

/// Draws the eye when the tissue of the chosen injury felt most.
fn pictured(row: usize, model: &AppModel, shown: &ShownAnswer, sheet: &mut Sheet) {
    let area = sheet.area;
    let risks = shown.answer.risks();
    let peak = risks.get(row).and_then(|risk| shown.answer.peak(risk.injury.measure()));
    let time = peak.map_or(model.time(), |peak| peak.time);
    let height = area.height.min(area.width / 2);
    EyePicture::of(model, shown, time).draw(Rect { height, ..area }, sheet.buffer);
}

/// Said where a section is hit from the side.
const NO_HOURS: &str = "At which hour the retina feels most is not told: this eye is computed as a \
    section. The row Geometry, among the advanced ones, takes the whole eye.";

fn fundus(shown: &ShownAnswer, sheet: &mut Sheet) {
    draw_signs(sheet);
    let area = sheet.area;
    let sheet = &mut sheet.at(Rect { height: area.height.saturating_sub(SIGN_ROWS), ..area });
    let (answer, side) = (&shown.answer, shown.scenario.eye_side());
    // A section has no hours: straight on it is the same all round, from the side nothing is known.
    let round = || {
        let felt = |of: Injury| Some(answer.result(of.measure())? / of.measure().row().factor);
        let straight = shown.scenario.projectile().is_some_and(Projectile::is_straight_on);
        let [edge, back] = [Injury::RetinaFront, Injury::RetinaBack].map(felt);
        let (edge, back) = edge.zip(back).filter(|_| straight)?;
        let (edge, back) = ([edge; HOURS], [back; QUADRANTS]);
        Some(Sectors { edge, back, ..Sectors::default() })
    };
    let sectors = answer.run.sectors.or_else(round);
    if let (Some(sectors), Some(blow)) = (sectors, &answer.case.blow) {
        fundus::draw(&sectors, &blow.points, side, sheet);
    } else {
        let why = silence(answer).unwrap_or_else(|| NO_HOURS.to_owned());
        sheet.put_wrapped((1, 1), &why, sheet.theme.text());
    }
}

fn draw(row: usize, model: &AppModel, shown: &ShownAnswer, sheet: &mut Sheet) {
    let (area, theme) = (sheet.area, sheet.theme);
    let room = usize::from(area.width.saturating_sub(2));
    let used = above(model, shown, sheet);
    draw_signs(sheet);
    let height = area.height.saturating_sub(SIGN_ROWS);
    let sheet = &mut sheet.at(below(Rect { height, ..area }, used));
    let area = sheet.area;
    let risks = shown.answer.risks();
    let Some(risk) = risks.get(row) else {
        let said = sentence(&shown.scenario, &shown.answer);
        let below = sheet.put_wrapped((1, 1), &said, theme.text());
        let why = silence(&shown.answer).unwrap_or_default();
        sheet.put_wrapped((1, below + 1), &why, theme.quiet());
        return;
    };
    let count = risks.len() as u16;
    let each = if area.height >= 2 + 2 * count + EXPLAINED { 2 } else { 1 };
    let heading = ("80 % ranges", theme.heading());
    rows(&shown.answer, heading, (Some(row), each), sheet);
    let foot = &mut sheet.at(below(area, 1 + each * count));
    foot.put((0, 0), "─".repeat(area.width.into()), theme.quiet());
    let rungs = ladder(&shown.answer, risk.injury);
    let left = usize::from(foot.area.height.saturating_sub(1 + LADDER_BELOW)).saturating_sub(2);
    let near = nearest(&rungs, left.min(rungs.len()));
    let drawn = if near.len() < FEWEST { 0 } else { near.len() as u16 + 2 };
    let rows = usize::from(foot.area.height.saturating_sub(1 + drawn));
    let said = whole_sentences(&explained(shown, risk, each), room, rows);
    foot.put_lines((1, 1), &said, theme.text());
    if drawn > 0 {
        let foot = &mut foot.at(below(foot.area, 2 + said.len() as u16));
        draw_ladder(near, risk.injury.measure().row(), foot);
    }
}

/// So many rungs round that of the blow itself.
fn nearest(rungs: &[Rung], count: usize) -> &[Rung] {
    let own = rungs.iter().position(|rung| rung.objects.is_none()).unwrap_or_default();
    let from = own.saturating_sub(count / 2).min(rungs.len() - count);
    &rungs[from..from + count]
}

/// Draws what the tissue felt of this blow among known objects, a bar each.
fn draw_ladder(rungs: &[Rung], measure: Row, sheet: &mut Sheet) {
    let theme = sheet.theme;
    let label = format!("{}, {}, beside usual blows", capital(measure.label), measure.unit);
    sheet.put((1, 0), label, theme.heading());
    let names = rungs.iter().filter_map(|rung| rung.objects.as_deref()).map(width);
    let bar = 1 + names.max().unwrap_or_default() + FIGURE + 1;
    let most = rungs.first().map_or(1.0, |rung| rung.felt);
    let room = f64::from(sheet.area.width.saturating_sub(bar + 1));
    for (y, rung) in (1..).zip(rungs) {
        let own = rung.objects.is_none();
        let style = if own { theme.focus() } else { theme.text() };
        sheet.put((1, y), rung.objects.as_deref().unwrap_or("this blow"), style);
        sheet.put_right((bar - 1, y), digits(rung.felt, 2), style);
        let long = (room * rung.felt / most).round() as usize;
        let style = if own { theme.strong() } else { theme.quiet() };
        sheet.put((bar, y), if own { "█" } else { "▄" }.repeat(long.max(1)), style);
    }
}

/// All that is said of an injury in sentences: what is believed, what to look for unless it is
/// excluded, and what that rests on beside what stands in its `each` rows.
fn explained(shown: &ShownAnswer, risk: &Risk, each: u16) -> Vec<String> {
    let mut said = vec![format!("{}: {}.", capital(risk.injury.name()), risk.words())];
    let not_excluded = !risk.usable || risk.is_open() || risk.gravity() > 0;
    if risk.clinic.is_some() && not_excluded {
        said.extend(look_for(risk.injury).map(str::to_owned));
        let hours = hours(&shown.answer, risk.injury, shown.scenario.eye_side());
        said.extend(hours.map(|hours| format!("Most at {hours}.")));
    }
    said.extend(between(&shown.answer, risk.injury).map(|text| capital(&text) + "."));
    let basis = basis(&shown.answer, risk).into_iter().skip(usize::from(each > 1));
    said.extend(basis.map(|text| capital(&text) + "."));
    said
}

/// The paper's index, the flags and what the screen asks; gives the rows taken.
fn above(model: &AppModel, shown: &ShownAnswer, sheet: &mut Sheet) -> u16 {
    let (area, theme) = (sheet.area, sheet.theme);
    let figure = Figure::of(&shown.answer, Quantity::Damage);
    let figure = figure.map_or_else(String::new, |figure| figure.to_string());
    let (index, style) = match unusable(&shown.answer) {
        None => (format!("Paper's index {figure} ({SCALE})"), theme.strong()),
        Some(why) => (why, theme.warning()),
    };
    let room = usize::from(area.width.saturating_sub(2));
    let index = wrapped(&index, room);
    let end = 1 + index.last().map_or(0, |line| width(line));
    sheet.put_lines((1, 0), &index, style);
    let last = index.len() as u16 - 1;
    let (right, style) = match model.stale() {
        Some(why) => (why, theme.warning()),
        None => (QUESTION, theme.heading()),
    };
    if end + width(right) + 2 < area.width {
        sheet.put_right((area.width - 1, last), right, style);
    }
    let flags = flag_lines(&shown.answer.flags, room, 2);
    sheet.put_lines((1, last + 1), &flags, theme.warning());
    last + 1 + flags.len() as u16
}
