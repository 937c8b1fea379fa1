//! What is typed or pasted into a field of the form or into a name.

use crossterm::event::{KeyCode, KeyEvent};

use crate::scenario::fields::{Field, Kind};
use crate::scenario::{Scenario, doubt::begun};
use crate::tui::form::{Typing, admitted, typed_text, with_text};
use crate::tui::line::{TextLine, letter};
use crate::tui::{changes::edit::change, changes::threshold, model::AppModel};
use crate::tui::{overlay::Overlay, save::check_name};

/// Begins to type into the row with the cursor, with what is there or with nothing.
pub(crate) fn begin(model: &mut AppModel, empty: bool) {
    let Some(field) = model.form.selected.field() else { return };
    model.form.complaint = None;
    let text = typed_text(field, &model.work.scenario).unwrap_or_default();
    let input = TextLine::of(if empty { String::new() } else { text });
    model.form.typing = Some(Typing { field, input, fresh: empty, error: None });
}

/// A key that is no binding. A letter that no number has is refused: it was meant as a key.
pub(crate) fn key(model: &mut AppModel, event: KeyEvent) {
    let (mut event, mut doubt) = (event, false);
    let typing = model.form.typing.as_ref().filter(|_| model.overlay.is_none());
    if let (Some(typing), Some(c)) = (typing, letter(event)) {
        let Some(c) = admitted(typing.field, c) else {
            model.notice = Some("A number is being typed: Enter accepts, Esc cancels".to_owned());
            return;
        };
        // A doubt goes behind the number that is there.
        doubt = matches!(typing.field.kind, Kind::Number(..)) && matches!(c, ' ' | '+' | '±');
        event = KeyEvent::from(KeyCode::Char(c));
    }
    type_into(model, |line| {
        line.selected &= !doubt;
        line.key(event);
    });
}

/// Pasted text, which `begins_value` where the cursor is on a number; nowhere is it taken for keys.
pub(crate) fn paste(model: &mut AppModel, text: &str, begins_value: bool) {
    let signs: Vec<char> = text.chars().filter(|c| !c.is_control()).take(LONGEST_PASTE).collect();
    if signs.iter().all(|sign| sign.is_whitespace()) {
        return;
    }
    if begins_value {
        begin(model, true);
    }
    if model.overlay.is_none() && model.form.typing.is_none() {
        model.notice = Some("nothing is typed here, so nothing is pasted".to_owned());
        return;
    }
    type_into(model, |line| signs.iter().for_each(|sign| line.put(*sign)));
}

/// Signs of a paste that are taken.
const LONGEST_PASTE: usize = 200;

/// Changes the text that is being typed and says what is wrong with it, but changes no value.
pub(crate) fn type_into(model: &mut AppModel, change: impl FnOnce(&mut TextLine)) {
    match &mut model.overlay {
        Some(Overlay::Name(_, input, error)) => {
            change(input);
            *error = check_name(input.value()).err().map(|e| e.to_string());
        }
        Some(Overlay::Picker(picker)) => {
            let before = picker.input.value().to_owned();
            change(&mut picker.input);
            if picker.input.value() != before {
                picker.search(&model.choices);
            }
        }
        Some(Overlay::Change(what)) => {
            change(&mut what.input);
            what.error = None;
        }
        Some(Overlay::Threshold(_)) => {
            threshold::ask_otherwise(model, |asking| asking.retype(change));
        }
        _ => {
            let Some(mut typing) = model.form.typing.take() else { return };
            change(&mut typing.input);
            let mut known = typing.input.value();
            if matches!(typing.field.kind, Kind::Number(..)) {
                known = begun(known).unwrap_or(known);
            }
            typing.error = meant(model, typing.field, known).err();
            model.form.typing = Some(typing);
        }
    }
}

/// The scenario with this text in a field, if it may be worked on.
fn meant(model: &AppModel, field: &Field, text: &str) -> Result<Scenario, String> {
    let scenario = with_text(&model.work.scenario, field, text)?;
    model.allows(&scenario).map(|()| scenario)
}

/// Ends typing with what was typed, unless it makes no sense; whether nothing is typed any more.
pub(crate) fn accept(model: &mut AppModel) -> bool {
    let Some(mut typing) = model.form.typing.take() else { return true };
    match meant(model, typing.field, typing.input.value()) {
        Ok(scenario) => change(model, model.work.with(scenario), ""),
        Err(why) => {
            typing.error = Some(why);
            model.form.typing = Some(typing);
        }
    }
    model.form.typing.is_none()
}

/// Ends typing as [`accept`] does and moves the cursor by so many rows.
pub(crate) fn accept_and_move(model: &mut AppModel, by: isize) {
    if accept(model) {
        model.form.move_cursor(&model.work.scenario, by);
    }
}

/// A sideways arrow: through a text that was there, else it ends typing.
pub(crate) fn sideways(model: &mut AppModel, code: KeyCode) {
    if model.form.typing.as_ref().is_some_and(|typing| typing.fresh) {
        accept(model);
    } else {
        type_into(model, |line| line.key(KeyEvent::from(code)));
    }
}
