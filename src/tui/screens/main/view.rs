//! The one screen that answers the question at the bedside: form, answers, eye, traces.

use ratatui::layout::Rect;

use crate::injury::Injury;
use crate::tui::screens::main::{form, score, traces};
use crate::tui::view::{below, eye::EyePicture, risks::signs, sheet::Sheet, text::wrapped};
use crate::tui::{
    clock::MeshDetail, model::AppModel, screens::main::form::DIAL, shown::ShownAnswer,
};

/// Where the parts of the screen are.
pub struct Layout {
    /// The form.
    pub form: Rect,
    /// All at its right.
    right: Rect,
    /// Whether the answers stand at the right of the eye, with charts below them.
    wide: bool,
    /// What to believe of each injury.
    answers: Rect,
    /// What limits that.
    limits: Rect,
    /// The paper's index.
    index: Rect,
    charts: Rect,
    /// The eye with its words.
    pub eye: Rect,
    traces: Rect,
    signs: Rect,
}

/// From so many columns on the answers stand at the right.
const WIDE: u16 = 140;
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
    let signs = signs(area.width).len() as u16;
    let height = area.height - signs;
    let wide = area.width >= WIDE && height >= HIGH;
    let form = Rect { width: left, height, ..area };
    let right = Rect::new(area.x + left + 1, area.y, area.width - left - 1, height);
    // From top to bottom in one column: what to believe, what limits it, the index.
    let (each, limits, index) = match height {
        _ if wide => (2 * LINES - 1, 6, score::BLOCK),
        30.. => (LINES, 3, score::BLOCK),
        _ => (LINES, 2, 1),
    };
    let (x, width) =
        if wide { (area.x + area.width - ANSWERS, ANSWERS) } else { (right.x, right.width) };
    let part = |y: u16, height: u16| Rect::new(x, area.y + y, width - u16::from(wide), height);
    let answers = part(0, each);
    let gap = u16::from(wide);
    let limits = part(each + gap, limits);
    let index = part(each + gap + limits.height, index);
    let used = each + gap + limits.height + index.height;
    let upper = if wide { 0 } else { used };
    let picture = Rect {
        y: right.y + upper,
        width: if wide { right.width - ANSWERS - 2 } else { right.width },
        height: height - upper,
        ..right
    };
    let below_form = wide && !unfolded && height > FORM + 12;
    let (form, traces, eye) = if below_form {
        let rows = Rect { height: FORM, ..form };
        (rows, below(form, FORM), picture.width)
    } else {
        // Room for the object beside the eye.
        let eye = (picture.height * 27 / 10).min(picture.width * 6 / 10);
        let eye = eye.min(picture.width.saturating_sub(traces::NARROWEST + 1));
        let at = picture.x + eye + 1;
        let beside = Rect::new(at, picture.y, picture.right() - at, picture.height);
        (form, beside, eye)
    };
    Layout {
        form,
        right,
        wide,
        answers,
        limits,
        index,
        charts: part(used + 1, height.saturating_sub(used + 1)),
        eye: Rect::new(picture.x, picture.y, eye, picture.height),
        traces,
        signs: below(area, height),
    }
}

/// Draws the screen; `nodes` says whether the curves are those of node forces.
pub fn draw((pane, nodes): (usize, bool), model: &AppModel, sheet: &mut Sheet) {
    let (area, theme) = (sheet.area, sheet.theme);
    let parts = layout(area, model.form.advanced);
    form::draw(pane, model, &mut sheet.at(parts.form));
    for y in 0..parts.right.height {
        sheet.put((parts.right.x - 1, y), "│", theme.quiet());
    }
    let signs = signs(area.width);
    sheet.put_lines((0, area.height - parts.signs.height), signs, theme.heading());
    let Some(shown) = &model.shown else {
        waiting(model, &mut sheet.at(parts.right));
        return;
    };
    if parts.wide {
        for y in 0..parts.right.height {
            sheet.put((parts.answers.x - 2, y), "│", theme.quiet());
        }
        traces::charts(model, shown, &mut sheet.at(parts.charts));
    }
    eye(model, shown, pane == DIAL, parts.eye, sheet);
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
    let (area, theme) = (sheet.area, sheet.theme);
    let (text, style) = match (&model.run.complaint, form::simulating(model)) {
        (Some((_, why)), _) => (why.clone(), theme.error()),
        (None, Some(text)) => (text + "  (Esc cancels)", theme.text()),
        (None, None) => ("simulating".to_owned(), theme.text()),
    };
    let lines = wrapped(&text, usize::from(area.width - 2));
    sheet.put_lines((1, 1), &lines, style);
}

fn eye(model: &AppModel, shown: &ShownAnswer, on_dial: bool, picture: Rect, sheet: &mut Sheet) {
    let theme = sheet.theme;
    let aiming = on_dial && model.overlay.is_none();
    let time = model.time();
    let drawn = EyePicture {
        blow: Some(&model.work.scenario),
        aiming,
        ..EyePicture::of(model, shown, time)
    };
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

/// Where in a picture the eye itself is drawn: a mesh has its caption above it, the anatomy places
/// its own words.
pub fn drawn_in(picture: Rect, detail: MeshDetail) -> Rect {
    match detail {
        MeshDetail::Anatomy => picture,
        _ => below(picture, 1),
    }
}
