//! The one screen that answers the question at the bedside: the answer in a sentence, a line for
//! each injury or the paper's own answer, the eye and its traces beside the form.

use ratatui::layout::Rect;

use crate::injury::Injury;
use crate::tui::screens::main::{form, form::DIAL, score, traces};
use crate::tui::view::risks::{SIGN_ROWS, draw_signs};
use crate::tui::view::{below, eye::EyePicture, sheet::Sheet};
use crate::tui::{clock::MeshDetail, model::AppModel, shown::ShownAnswer};

/// Where the parts of the screen are.
pub struct Layout {
    pub form: Rect,
    /// All at its right.
    right: Rect,
    /// Whether the answers stand at the right of the eye, with charts below them.
    wide: bool,
    /// The answer in one sentence, before all else.
    said: Rect,
    /// A line for each injury, or the paper's own answer.
    answers: Rect,
    /// What limits those.
    limits: Rect,
    /// The paper's index, or why no injury is told of.
    index: Rect,
    charts: Rect,
    /// The eye with its words.
    pub eye: Rect,
    traces: Rect,
    signs: Rect,
}

/// From so many columns on the answers stand at the right, and the eye fits whole beside them.
const WIDE: u16 = 180;
/// And so many rows.
const HIGH: u16 = 28;
/// From so many rows on there is room for air.
const TALL: u16 = 30;
/// Columns of the answers: names, words, figures, what was seen, and bars.
const ANSWERS: u16 = 90;
/// Rows of the form where the curves stand below it.
const FORM: u16 = 31;
/// Rows of a heading and a line for each injury.
const LINES: u16 = 1 + Injury::ALL.len() as u16;
/// Rows of the sentence at least, where rows are few: it may be longer after the next key.
const SENTENCE: u16 = 3;

/// Divides the screen.
pub fn layout(area: Rect, model: &AppModel) -> Layout {
    let left = match area.width {
        ..70 => 25,
        70..100 => 29,
        _ => 34,
    };
    let height = area.height - SIGN_ROWS;
    let wide = area.width >= WIDE && height >= HIGH;
    let tall = height >= TALL;
    let mut form = Rect { width: left, height, ..area };
    let right = Rect::new(form.right() + 1, area.y, area.width - left - 1, height);
    let silent = model.shown.as_ref().is_some_and(|shown| shown.answer.silence().is_some());
    let sentence = score::sentence(model, right.width).len() as u16;
    let said =
        Rect { height: if tall || silent { sentence } else { sentence.max(SENTENCE) }, ..right };
    // Downwards in one column: what to believe, what limits it, the index, and charts or the eye.
    let gap = u16::from(tall);
    let (each, limits, index) = match height {
        _ if silent => (score::PAPER, 1, 1),
        _ if wide => (2 * LINES - 1, 6, score::BLOCK),
        TALL.. => (LINES, 2, 1),
        _ => (LINES, 1, 0),
    };
    let under = below(right, said.height + gap);
    let beside = Rect::new(area.right() - ANSWERS, under.y, ANSWERS - 1, under.height);
    let column = if wide { beside } else { under };
    let answers = Rect { height: each, ..column };
    let limits = Rect { height: limits, ..below(column, each + gap) };
    let index = Rect { height: index, ..below(limits, limits.height) };
    let rest = below(column, index.bottom() - column.y + gap);
    let left_of_them = Rect { width: under.width.saturating_sub(ANSWERS + 2), ..under };
    let picture = if wide { left_of_them } else { rest };
    let below_form = wide && !model.form.advanced && height > FORM + 12;
    let (mut eye, mut traces) = (picture, picture);
    if below_form {
        traces = below(form, FORM);
        form.height = FORM;
    } else {
        // Room for the object beside the eye.
        let most = picture.width.saturating_sub(traces::NARROWEST + 1);
        eye.width = (picture.height * 27 / 10).min(picture.width * 6 / 10).min(most);
        traces.x = eye.right() + 1;
        traces.width = picture.right() - traces.x;
    }
    let (charts, signs) = (below(rest, 1), below(area, height));
    Layout { form, right, wide, said, answers, limits, index, charts, eye, traces, signs }
}

/// Draws the screen; `nodes` says whether the curves are those of node forces, `front` whether the
/// dial looks at the eye from the front.
pub fn draw((pane, nodes, front): (usize, bool, bool), model: &AppModel, sheet: &mut Sheet) {
    let (area, theme) = (sheet.area, sheet.theme);
    let parts = layout(area, model);
    form::draw(pane, model, &mut sheet.at(parts.form));
    let line_before = |part: Rect, columns: u16, sheet: &mut Sheet| {
        let lines = std::iter::repeat_n("│", (parts.right.bottom() - part.y).into());
        sheet.at(Rect { y: part.y, ..area }).put_lines((part.x - columns, 0), lines, theme.quiet());
    };
    line_before(parts.right, 1, sheet);
    draw_signs(&mut sheet.at(parts.signs));
    let Some(shown) = &model.shown else {
        waiting(model, &mut sheet.at(parts.right));
        return;
    };
    if parts.wide {
        line_before(parts.answers, 2, sheet);
        traces::charts(model, shown, &mut sheet.at(parts.charts));
    }
    eye(model, shown, (pane == DIAL, front), parts.eye, sheet);
    traces::draw(model, (shown, nodes), &mut sheet.at(parts.traces));
    let style = if model.stale().is_some() { theme.warning() } else { theme.strong() };
    sheet.at(parts.said).put_lines((0, 0), score::sentence(model, parts.said.width), style);
    if shown.answer.silence().is_some() {
        score::paper(model, shown, &mut sheet.at(parts.answers));
        score::silence(shown, &mut sheet.at(parts.index));
    } else {
        score::answers(shown, if parts.wide { 2 } else { 1 }, &mut sheet.at(parts.answers));
        score::index(shown, &mut sheet.at(parts.index));
    }
    score::limited(model, shown, &mut sheet.at(parts.limits));
    if model.stale().is_some() {
        // All but the line that says so.
        for part in [parts.answers, parts.limits, parts.index, parts.eye, parts.traces] {
            sheet.buffer.set_style(part, theme.stale());
        }
    }
}

/// Columns of the bar of what is being computed, at most.
const LONGEST_BAR: u16 = 60;

/// Before the first result: what is being done, or why there is none.
fn waiting(model: &AppModel, sheet: &mut Sheet) {
    let theme = sheet.theme;
    let pace = model.run.job.as_ref().and_then(|job| job.pace);
    let (text, style) = match (&model.run.complaint, pace) {
        (Some((_, why)), _) => (why.clone(), theme.error()),
        (None, Some(pace)) => {
            (format!("simulating {}, Esc cancels", pace.words(None)), theme.text())
        }
        (None, None) => ("simulating".to_owned(), theme.text()),
    };
    let below = sheet.put_wrapped((1, 1), &text, style);
    if let Some(pace) = pace.filter(|_| model.run.complaint.is_none()) {
        let room = sheet.area.width.saturating_sub(2).min(LONGEST_BAR);
        score::bar(pace.share, &mut sheet.part((1, below), (room, 1)));
    }
}

fn eye(
    model: &AppModel,
    shown: &ShownAnswer,
    (on_dial, front): (bool, bool),
    picture: Rect,
    sheet: &mut Sheet,
) {
    let theme = sheet.theme;
    let aiming = on_dial && model.overlay.is_none();
    let time = model.time();
    let plain = EyePicture::of(model, shown, time);
    let front = on_dial && front && shown.has_front();
    let drawn = EyePicture { blow: Some(&model.work.scenario), aiming, front, ..plain };
    drawn.draw(drawn_in(picture, drawn.detail), sheet.buffer);
    if drawn.detail == MeshDetail::Anatomy {
        return;
    }
    let zoom = match model.clock.zoom() {
        1 => String::new(),
        times => format!(" shown {times}x larger"),
    };
    let state = if model.clock.playing { "▶ " } else { "" };
    let caption = format!(" {state}{:.3} ms{zoom} ", time * 1e3);
    let style = [theme.heading(), theme.focus()][usize::from(aiming)];
    sheet.at(picture).put((0, 0), &caption, style);
}

/// Where in a picture the eye is drawn: a mesh has its caption above, the anatomy its own words.
pub fn drawn_in(picture: Rect, detail: MeshDetail) -> Rect {
    if detail == MeshDetail::Anatomy { picture } else { below(picture, 1) }
}
