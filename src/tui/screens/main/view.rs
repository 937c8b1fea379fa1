//! The one screen that answers the question at the bedside: form, answers, eye, traces.

use ratatui::layout::Rect;

use crate::injury::Injury;
use crate::tui::screens::main::{form, form::DIAL, score, traces};
use crate::tui::view::{below, eye::EyePicture, risks::signs, sheet::Sheet};
use crate::tui::{clock::MeshDetail, model::AppModel, shown::ShownAnswer};

/// Where the parts of the screen are.
pub struct Layout {
    pub form: Rect,
    /// All at its right.
    right: Rect,
    /// Whether the answers stand at the right of the eye, with charts below them.
    wide: bool,
    answers: Rect,
    /// What limits those.
    limits: Rect,
    /// The paper's index.
    index: Rect,
    charts: Rect,
    /// The eye with its words.
    pub eye: Rect,
    traces: Rect,
    signs: Rect,
}

/// From so many columns on the answers stand at the right, and the eye fits whole beside them.
const WIDE: u16 = 160;
/// And so many rows.
const HIGH: u16 = 28;
/// Their columns.
const ANSWERS: u16 = 60;
/// Rows of the form where the curves stand below it.
const FORM: u16 = 31;
/// Rows of a heading and a line for each injury.
const LINES: u16 = 1 + Injury::ALL.len() as u16;

/// Divides the screen; `unfolded` says whether the form needs all rows.
pub fn layout(area: Rect, unfolded: bool) -> Layout {
    let left = match area.width {
        ..70 => 25,
        70..100 => 29,
        _ => 34,
    };
    let height = area.height - signs(area.width).len() as u16;
    let wide = area.width >= WIDE && height >= HIGH;
    let mut form = Rect { width: left, height, ..area };
    let right = Rect::new(form.right() + 1, area.y, area.width - left - 1, height);
    // Downwards in one column: what to believe, what limits it, the index, and charts or the eye.
    let (each, limits, index) = match height {
        _ if wide => (2 * LINES - 1, 6, score::BLOCK),
        30.. => (LINES, 3, score::BLOCK),
        _ => (LINES, 2, 1),
    };
    let gap = u16::from(wide);
    let beside = Rect::new(area.right() - ANSWERS, area.y, ANSWERS - 1, height);
    let column = if wide { beside } else { right };
    let answers = Rect { height: each, ..column };
    let limits = Rect { height: limits, ..below(column, each + gap) };
    let index = Rect { y: limits.bottom(), height: index, ..column };
    let rest = below(column, index.bottom() - area.y);
    let left_of_them = Rect { width: right.width.saturating_sub(ANSWERS + 2), ..right };
    let picture = if wide { left_of_them } else { rest };
    let below_form = wide && !unfolded && height > FORM + 12;
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
    Layout { form, right, wide, answers, limits, index, charts, eye, traces, signs }
}

/// Draws the screen; `nodes` says whether the curves are those of node forces, `front` whether the
/// dial looks at the eye from the front.
pub fn draw((pane, nodes, front): (usize, bool, bool), model: &AppModel, sheet: &mut Sheet) {
    let (area, theme) = (sheet.area, sheet.theme);
    let parts = layout(area, model.form.advanced);
    form::draw(pane, model, &mut sheet.at(parts.form));
    let line_before = |part: Rect, columns: u16, sheet: &mut Sheet| {
        let lines = std::iter::repeat_n("│", parts.right.height.into());
        sheet.put_lines((part.x - columns, 0), lines, theme.quiet());
    };
    line_before(parts.right, 1, sheet);
    sheet.at(parts.signs).put_lines((0, 0), signs(area.width), theme.heading());
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
    let each = if parts.wide { 2 } else { 1 };
    score::answers(model, shown, each, &mut sheet.at(parts.answers));
    score::limited(model, shown, &mut sheet.at(parts.limits));
    score::index(shown, &mut sheet.at(parts.index));
    if model.stale().is_some() {
        // All but the line that says so.
        for part in [below(parts.answers, 1), parts.limits, parts.index, parts.eye, parts.traces] {
            sheet.buffer.set_style(part, theme.stale());
        }
    }
}

/// Before the first result: what is being done, or why there is none.
fn waiting(model: &AppModel, sheet: &mut Sheet) {
    let theme = sheet.theme;
    let (text, style) = match (&model.run.complaint, form::simulating(model)) {
        (Some((_, why)), _) => (why.clone(), theme.error()),
        (None, Some(text)) => (text + "  (Esc cancels)", theme.text()),
        (None, None) => ("simulating".to_owned(), theme.text()),
    };
    sheet.put_wrapped((1, 1), &text, style);
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
