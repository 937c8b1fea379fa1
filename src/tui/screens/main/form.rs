//! The form at the left of the main screen.

use ratatui::layout::Rect;
use ratatui::style::Style;

use crate::report::format::digits;
use crate::scenario::doubt::begun;
use crate::scenario::fields::{Field, Kind};
use crate::tui::form::{FormRow, Typing, allowed, is_unverified, rows, typed_text, unverified};
use crate::tui::view::text::{fitted, width, wrapped};
use crate::tui::view::{overlay::input, sheet::Sheet, theme::Theme};
use crate::tui::{model::AppModel, overlay::Overlay, screens::main::pulse, view::PURPOSE};

/// The places of the panes.
pub const FORM: usize = 0;
pub const DIAL: usize = 1;
/// Lines that are said about a field at most.
const MAX_NOTE_LINES: usize = 7;

pub fn draw(pane: usize, model: &AppModel, sheet: &mut Sheet) {
    let (area, theme) = (sheet.area, sheet.theme);
    // A name to save under stands in front without taking the form away.
    let in_front = matches!(model.overlay, None | Some(Overlay::Name(..)));
    let focused = pane == FORM && in_front;
    let purpose = purpose(area);
    let shown = visible(model, pane, area);
    for (y, row) in (0..).zip(&shown) {
        let chosen = *row == model.form.selected;
        draw_row(model, *row, (chosen, focused), &mut sheet.row(y));
    }
    let (text, style) = note(model, pane);
    let lines = wrapped(&text, usize::from(area.width - 2)).into_iter().take(MAX_NOTE_LINES);
    sheet.put_lines((1, shown.len() as u16 + 1), lines, style(theme));
    let after = area.height - purpose.len() as u16;
    if is_marked(model, area) {
        sheet.put((1, after - 2), UNVERIFIED, theme.warning());
    }
    sheet.put((1, after - 1), model.work.scenario.model.title(), theme.text());
    sheet.put_lines((1, after), &purpose, theme.quiet());
}

pub const UNVERIFIED: &str = "? unverified figure";
/// From so many columns on the form is one beside signs that say all.
const NARROWEST: u16 = 28;
/// From so many rows on there is room to say it always, not only of the chosen value.
const TALL: u16 = 20;

/// What the program is for, where the narrowest screen has no room for it below the signs.
fn purpose(area: Rect) -> Vec<String> {
    if area.width < NARROWEST { wrapped(PURPOSE, usize::from(area.width - 1)) } else { Vec::new() }
}

/// Whether what the mark means is said at the foot of the form.
fn is_marked(model: &AppModel, area: Rect) -> bool {
    !unverified(&model.work.scenario).is_empty() && area.height >= TALL
}

/// The rows that there is room for, from the top; the one with the cursor is among them.
pub fn visible(model: &AppModel, pane: usize, area: Rect) -> Vec<FormRow> {
    let said = wrapped(&note(model, pane).0, usize::from(area.width - 2));
    let foot = purpose(area).len() + 1 + usize::from(is_marked(model, area));
    let taken = foot + said.len().min(MAX_NOTE_LINES) + 1;
    let room = usize::from(area.height).saturating_sub(taken);
    let rows = rows(&model.work.scenario, model.form.advanced);
    let here = rows.iter().position(|row| *row == model.form.selected);
    let first = here.unwrap_or(0).saturating_sub(room.saturating_sub(1));
    rows.into_iter().skip(first).take(room).collect()
}

/// What there is to say about the newest edit, or about the chosen field, and how it looks.
fn note(model: &AppModel, pane: usize) -> (String, fn(Theme) -> Style) {
    let typed = model.form.typing.as_ref().and_then(|typing| typing.error.as_ref());
    let refused = || model.run.complaint.as_ref().map(|(_, why)| why);
    if let Some(why) = typed.or(model.form.complaint.as_ref()).or_else(refused) {
        return (why.clone(), Theme::error);
    }
    match simulating(model) {
        Some(text) => (text + ", Esc cancels", Theme::warning),
        None => (help(model, pane), Theme::quiet),
    }
}

/// How a number is typed whose value is in doubt, once it has one.
fn doubtful(typing: &Typing) -> Option<String> {
    let Kind::Number(..) = typing.field.kind else { return None };
    let text = typing.input.value().trim();
    let value = begun(text).unwrap_or(text);
    let tenth = 0.1 * value.parse::<f64>().ok()?.abs();
    (tenth > 0.0).then(|| format!("not sure? {value} +- {}", digits(tenth, 1)))
}

/// How far the answer is, once it takes long.
pub fn simulating(model: &AppModel) -> Option<String> {
    let share = model.run.job.as_ref()?.pace?.share;
    Some(format!("simulating {:.0} %", share * 100.0))
}

fn help(model: &AppModel, pane: usize) -> String {
    if pane == DIAL && model.overlay.is_none() {
        let other = match model.work.scenario.projectile() {
            Some(_) => "or the hour it comes from",
            None => "or widen the arc it acts on",
        };
        return format!("Turn the blow, {other}");
    }
    let typing = model.form.typing.as_ref();
    let hint = typing.and_then(doubtful).unwrap_or_else(|| described(model));
    match typing {
        Some(typing) if typing.input.selected => format!("Type over it; ← → edit it. {hint}"),
        _ => hint,
    }
}

/// What there is to do in the chosen row.
fn described(model: &AppModel) -> String {
    let field = match model.form.selected {
        FormRow::Preset => return "← → open the next preset, Enter lists them".to_owned(),
        FormRow::Fold => return "mesh, materials, numerics".to_owned(),
        FormRow::Field(field) => field,
    };
    let scenario = &model.work.scenario;
    let mut accepted = match &field.kind {
        Kind::Choice(choices) => {
            let names = choices.names().into_iter().map(in_words);
            let written = choices.written().iter().map(|form| (*form).to_owned());
            names.chain(written).collect::<Vec<_>>().join(", ")
        }
        _ => allowed(scenario, field),
    };
    if let Some(pulse) = pulse::described(scenario, field.path) {
        accepted = format!("{pulse}; {accepted}");
    }
    let mut said = format!("{}: {accepted}", field.help);
    if scenario.doubt.contains_key(field.path) {
        said = format!("F6 shows what its doubt does. {said}");
    }
    if is_unverified(scenario, field) {
        said = format!("{UNVERIFIED}. {said}");
    }
    said
}

fn draw_row(model: &AppModel, row: FormRow, (chosen, focused): (bool, bool), sheet: &mut Sheet) {
    let (area, theme) = (sheet.area, sheet.theme);
    let scenario = &model.work.scenario;
    let lit = chosen && focused;
    sheet.put((0, 0), if lit { "▸" } else { " " }, theme.strong());
    let style = if lit { theme.strong() } else { theme.text() };
    let (label, text, doubtful) = match (row, &model.form.typing) {
        (FormRow::Fold, _) => {
            let sign = if model.form.advanced { "▾" } else { "▸" };
            let more = rows(scenario, true).len() - rows(scenario, false).len();
            let style = if lit { theme.focus() } else { theme.text() };
            sheet.put((1, 0), format!("{sign} Advanced ({more} more)"), style);
            return;
        }
        (FormRow::Field(field), Some(Typing { input: line, error, .. })) if chosen => {
            sheet.put((1, 0), field.label, style);
            let label = width(field.label) + 2;
            let room = area.width.saturating_sub(label).max(8).min(area.width - 1);
            let style = if error.is_some() { theme.error() } else { theme.strong() };
            input(line, style, &mut sheet.part((area.width - room, 0), (room, 1)));
            return;
        }
        (FormRow::Preset, _) => {
            let mark = if model.is_edited() { " *" } else { "" };
            ("Preset", format!("{}{mark}", model.work.name()), false)
        }
        (FormRow::Field(field), _) => {
            (field.label, shown_value(model, field), is_unverified(scenario, field))
        }
    };
    let room = area.width - if doubtful { 2 } else { 0 };
    let text = fitted(&text, usize::from(room - 2));
    sheet.put((1, 0), label_within(label, &text, room), style);
    if doubtful {
        let right = area.width.saturating_sub(width(&text) + 1);
        sheet.put_right((right, 0), "?", theme.warning());
    }
    let style = if lit { theme.focus() } else { theme.text() };
    sheet.put_right((area.width, 0), text, style);
}

/// As many words of a label as there is room for beside a value.
fn label_within<'a>(label: &'a str, value: &str, room: u16) -> &'a str {
    let shorter = label.rmatch_indices(' ').map(|(at, _)| &label[..at]);
    let fits = |text: &&str| 2 + width(text) + width(value) <= room;
    std::iter::once(label).chain(shorter).find(fits).unwrap_or("")
}

/// A value with its unit, in a person's words.
fn shown_value(model: &AppModel, field: &Field) -> String {
    let text = typed_text(field, &model.work.scenario).unwrap_or_default();
    let text = match (&field.kind, &text[..], &model.shown) {
        (Kind::OptionalNumber(..), "auto", Some(shown)) => match field.path {
            "numerics.step_us" => format!("auto, {:.3}", shown.answer.plan.step * 1e6),
            "window_ms" => format!("auto, {:.1}", shown.answer.window() * 1e3),
            _ => text,
        },
        (Kind::Choice(_), name, _) => in_words(name),
        _ => text,
    };
    if field.unit.is_empty() { text } else { format!("{text} {}", field.unit) }
}

fn in_words(name: &str) -> String {
    match name {
        "Inflated" => "gas or foam".to_owned(),
        "Splashing" => "liquid in a skin".to_owned(),
        "Elastic" => "elastic solid".to_owned(),
        "Linear" => "like a spring".to_owned(),
        _ => spaced(name),
    }
}

/// `SmoothRectangle` as "smooth rectangle".
fn spaced(name: &str) -> String {
    let mut text = String::new();
    for c in name.chars() {
        if c.is_uppercase() && !text.is_empty() {
            text.push(' ');
            text.extend(c.to_lowercase());
        } else {
            text.push(c);
        }
    }
    text
}

#[cfg(test)]
mod tests {
    #[test]
    fn variants_are_written_in_words() {
        assert_eq!(super::spaced("SmoothRectangle"), "Smooth rectangle");
        assert_eq!(super::spaced("Srkn6b"), "Srkn6b");
    }
}
