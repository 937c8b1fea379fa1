//! What comes in front of the screen: the presets, a name to save under, a question.

use crate::tui::overlay::{Naming, Overlay, Prompt};
use crate::tui::view::popup::{MARGIN, frame, input};
use crate::tui::view::text::{fitted, wrapped};
use crate::tui::view::{changing, picker, threshold};
use crate::tui::{line::TextLine, model::AppModel, view::sheet::Sheet};

/// Draws what is in front, if anything is; the keys are drawn by who knows them all.
pub fn draw(model: &AppModel, sheet: &mut Sheet) {
    match &model.overlay {
        None | Some(Overlay::Help(_)) => {}
        Some(Overlay::Picker(picker)) => picker::draw(model, picker, sheet),
        Some(Overlay::Change(what)) => changing::draw(what, sheet),
        Some(Overlay::Threshold(asking)) => threshold::draw(model, asking, sheet),
        Some(Overlay::Name(naming, name, error)) => {
            typed_name(naming, (name, error.as_deref()), sheet);
        }
        Some(Overlay::Prompt(question)) => ask(question, sheet),
    }
}

fn typed_name(naming: &Naming, (name, error): (&TextLine, Option<&str>), sheet: &mut Sheet) {
    let theme = sheet.theme;
    let title = match naming {
        Naming::Save => "Save as a preset of your own".to_owned(),
        Naming::Rename(from) => format!("Another name for {}", fitted(from, 24)),
    };
    let mut inside = frame(&title, (50, 6), sheet);
    inside.put((0, 0), "Name", theme.text());
    let room = inside.area.width;
    let field = &mut inside.part((6, 0), (room - 6, 1));
    input(name, theme.strong(), field);
    if let Some(error) = error {
        let lines = &wrapped(error, usize::from(room));
        inside.put_lines((0, 2), lines, theme.error());
    }
}

/// Columns of a question.
const WIDE: u16 = 50;

fn ask(question: &Prompt, sheet: &mut Sheet) {
    let theme = sheet.theme;
    let lines = wrapped(&question.text(), usize::from(WIDE - MARGIN));
    let rows = (lines.len() as u16).max(3);
    let mut inside = frame("Sure?", (WIDE, rows + 3), sheet);
    inside.put_lines((0, 0), &lines, theme.text());
    let keys = "Enter or y: yes   Esc or n: no";
    inside.put((0, rows), keys, theme.strong());
}
