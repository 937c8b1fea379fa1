//! The form at the left of the main screen.

use ratatui::layout::Rect;

use crate::report::format::digits;
use crate::scenario::doubt::begun;
use crate::scenario::fields::{FIELDS, Field, Kind};
use crate::tui::form::{FormRow, Typing, allowed, is_unverified, rows, typed_text, unverified};
use crate::tui::view::text::{fitted, width, wrapped};
use crate::tui::view::{overlay::input, sheet::Sheet};
use crate::tui::{model::AppModel, overlay::Overlay, screens::main::pulse, view::PURPOSE};

/// The places of the panes.
pub const FORM: usize = 0;
pub const DIAL: usize = 1;
/// Lines that are said about a field at most.
const MAX_NOTE_LINES: usize = 7;

/// Draws the form.
pub fn draw(pane: usize, model: &AppModel, sheet: &mut Sheet) {
    let (area, theme) = (sheet.area, sheet.theme);
    // A name to save under stands in front without taking the form away.
    let in_front = matches!(model.overlay, None | Some(Overlay::Name(..)));
    let focused = pane == FORM && in_front;
    let purpose = purpose(area);
    let bottom = area.height - foot(model, area);
    let note = note(model, pane);
    let said = wrapped(&note.0, usize::from(area.width - 2));
    let shown = visible(model, pane, area);
    for (y, row) in shown.iter().enumerate() {
        let chosen = *row == model.form.selected;
        draw_row(model, *row, (chosen, focused), &mut sheet.row(y as u16));
    }
    let used = shown.len() as u16;
    let style = match note.1 {
        Tone::Quiet => theme.quiet(),
        Tone::Error => theme.error(),
        Tone::Warning => theme.warning(),
    };
    let lines = said.iter().take(MAX_NOTE_LINES);
    sheet.put_lines((1, used + 1), lines, style);
    let after = area.height - purpose.len() as u16;
    if after - bottom > 1 {
        sheet.put((1, bottom), UNVERIFIED, theme.warning());
    }
    sheet.put((1, after - 1), model.material(), theme.text());
    sheet.put_lines((1, after), &purpose, theme.quiet());
}

/// What the mark beside a value means.
pub const UNVERIFIED: &str = "? unverified figure";
/// From so many columns on the form is one beside signs that say all.
const NARROWEST: u16 = 28;
/// From so many rows on there is room to say it always, not only of the chosen value.
const TALL: u16 = 20;

/// What the program is for, where the narrowest screen has no room for it below the signs.
fn purpose(area: Rect) -> Vec<String> {
    match area.width {
        ..NARROWEST => wrapped(PURPOSE, usize::from(area.width - 1)),
        _ => Vec::new(),
    }
}

/// Rows at the foot of the form.
fn foot(model: &AppModel, area: Rect) -> u16 {
    let purpose = purpose(area).len() as u16;
    let marked = !unverified(&model.work.scenario).is_empty() && area.height >= TALL;
    purpose + 1 + u16::from(marked)
}

/// The rows that there is room for, from the top; the one with the cursor is among them.
pub fn visible(model: &AppModel, pane: usize, area: Rect) -> Vec<FormRow> {
    let said = wrapped(&note(model, pane).0, usize::from(area.width - 2));
    let taken = usize::from(foot(model, area)) + said.len().min(MAX_NOTE_LINES) + 1;
    let room = usize::from(area.height).saturating_sub(taken);
    let rows = rows(&model.work.scenario, model.form.advanced);
    let here = rows.iter().position(|row| *row == model.form.selected);
    let first = here.unwrap_or(0).saturating_sub(room.saturating_sub(1));
    rows.into_iter().skip(first).take(room).collect()
}

enum Tone {
    Quiet,
    Error,
    Warning,
}

/// What there is to say about the newest edit, or about the chosen field.
fn note(model: &AppModel, pane: usize) -> (String, Tone) {
    if let Some(Typing { error: Some(why), .. }) = &model.form.typing {
        return (why.clone(), Tone::Error);
    }
    if let Some(why) = &model.form.complaint {
        return (why.clone(), Tone::Error);
    }
    if let Some((_, why)) = &model.run.complaint {
        return (why.clone(), Tone::Error);
    }
    match simulating(model) {
        Some(text) => (text + ", Esc cancels", Tone::Warning),
        None => (help(model, pane), Tone::Quiet),
    }
}

/// How a number is typed whose value is in doubt, once it has one.
fn doubtful(typing: &Typing) -> Option<String> {
    let Kind::Number(..) = typing.field.kind else {
        return None;
    };
    let text = typing.input.value().trim();
    let value = begun(text).unwrap_or(text);
    let tenth = 0.1 * value.parse::<f64>().ok()?.abs();
    (tenth > 0.0).then(|| format!("not sure? {value} +- {}", digits(tenth, 1)))
}

/// How far the answer is, once it takes long.
pub fn simulating(model: &AppModel) -> Option<String> {
    let share = model.run.job.as_ref()?.pace?.share();
    Some(format!("simulating {:.0} %", share * 100.0))
}

fn help(model: &AppModel, pane: usize) -> String {
    if pane == DIAL && model.overlay.is_none() {
        return "Turn the blow, or widen the arc it acts on".to_owned();
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
    match model.form.selected {
        FormRow::Preset => "← → open the next preset, Enter lists them".to_owned(),
        FormRow::Fold => "mesh, materials, numerics".to_owned(),
        FormRow::Field(field) => {
            let scenario = &model.work.scenario;
            let pulse = pulse::described(scenario, field.path);
            let accepted = match pulse {
                Some(pulse) => format!("{pulse}; {}", allowed(scenario, field)),
                None => allowed(scenario, field),
            };
            let mut said = format!("{}: {accepted}", field.help);
            if model.work.scenario.doubt.contains_key(field.path) {
                said = format!("F6 shows what its doubt does. {said}");
            }
            if is_unverified(&model.work.scenario, field) {
                said = format!("{UNVERIFIED}. {said}");
            }
            said
        }
    }
}

fn draw_row(model: &AppModel, row: FormRow, (chosen, focused): (bool, bool), sheet: &mut Sheet) {
    let (area, theme) = (sheet.area, sheet.theme);
    let mark = if chosen && focused { "▸" } else { " " };
    sheet.put((0, 0), mark, theme.strong());
    let style = if chosen && focused { theme.strong() } else { theme.text() };
    match row {
        FormRow::Preset => {
            let mark = if model.is_edited() { " *" } else { "" };
            let name = format!("{}{mark}", model.work.name());
            let name = fitted(&name, usize::from(area.width - 2));
            sheet.put((1, 0), label_within("Preset", &name, area.width), style);
            value(&name, chosen && focused, sheet);
        }
        FormRow::Fold => {
            let count = FIELDS.len();
            let sign = if model.form.advanced { "▾" } else { "▸" };
            let shown =
                rows(&model.work.scenario, true).len() - rows(&model.work.scenario, false).len();
            debug_assert!(shown < count);
            let text = format!("{sign} Advanced ({shown} more)");
            let style = if chosen && focused { theme.focus() } else { theme.text() };
            sheet.put((1, 0), &text, style);
        }
        FormRow::Field(field) => match &model.form.typing {
            Some(typing) if chosen => {
                sheet.put((1, 0), field.label, style);
                typed(typing, sheet);
            }
            _ => {
                let doubtful = is_unverified(&model.work.scenario, field);
                let marked = if doubtful { 2 } else { 0 };
                let room = area.width - marked;
                let text = fitted(&shown_value(model, field), usize::from(room - 2));
                sheet.put((1, 0), label_within(field.label, &text, room), style);
                if doubtful {
                    let right = area.width.saturating_sub(width(&text) + 1);
                    sheet.put_right((right, 0), "?", theme.warning());
                }
                value(&text, chosen && focused, sheet);
            }
        },
    }
}

/// As many words of a label as there is room for beside a value.
fn label_within<'a>(label: &'a str, value: &str, room: u16) -> &'a str {
    let ends = label.match_indices(' ').map(|(at, _)| &label[..at]);
    let mut shorter: Vec<&str> = ends.chain([label]).collect();
    shorter.reverse();
    let fits = |text: &&str| 2 + width(text) + width(value) <= room;
    shorter.into_iter().find(fits).unwrap_or("")
}

fn value(text: &str, lit: bool, sheet: &mut Sheet) {
    let (area, theme) = (sheet.area, sheet.theme);
    let style = if lit { theme.focus() } else { theme.text() };
    sheet.put_right((area.width, 0), text, style);
}

/// A value with its unit, in a person's words.
fn shown_value(model: &AppModel, field: &Field) -> String {
    let text = typed_text(field, &model.work.scenario).unwrap_or_default();
    let text = match (&field.kind, text.as_str()) {
        (Kind::OptionalNumber(..), "auto") => match &model.shown {
            Some(shown) if field.path == "numerics.step_us" => {
                format!("auto, {:.3}", shown.answer.plan.step * 1e6)
            }
            Some(shown) if field.path == "window_ms" => {
                format!("auto, {:.1}", shown.answer.window() * 1e3)
            }
            _ => text,
        },
        (Kind::Choice(_), name) => in_words(name),
        _ => text,
    };
    if field.unit.is_empty() { text } else { format!("{text} {}", field.unit) }
}

/// A choice as a person would say it.
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
    for (i, c) in name.chars().enumerate() {
        if i > 0 && c.is_uppercase() {
            text.push(' ');
        }
        if i > 0 {
            text.extend(c.to_lowercase());
        } else {
            text.push(c);
        }
    }
    text
}

/// A value being typed, with its cursor.
fn typed(typing: &Typing, sheet: &mut Sheet) {
    let (area, theme) = (sheet.area, sheet.theme);
    let label = width(typing.field.label) + 2;
    let room = area.width.saturating_sub(label).max(8).min(area.width - 1);
    let field = &mut sheet.part((area.width - room, 0), (room, 1));
    let style = if typing.error.is_some() { theme.error() } else { theme.strong() };
    input(&typing.input, style, field);
}

#[cfg(test)]
mod tests {
    #[test]
    fn variants_are_written_in_words() {
        assert_eq!(super::spaced("SmoothRectangle"), "Smooth rectangle");
        assert_eq!(super::spaced("Srkn6b"), "Srkn6b");
    }
}
