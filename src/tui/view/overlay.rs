//! What comes in front of the screen: the presets, a name to save under, a question.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;

use crate::tui::line::TextLine;
use crate::tui::model::AppModel;
use crate::tui::overlay::{Naming, Overlay, Prompt};
use crate::tui::view::popup::{MARGIN, frame, input};
use crate::tui::view::text::{fitted, put, put_lines, wrapped};
use crate::tui::view::theme::Theme;
use crate::tui::view::{changing, picker, threshold};

/// Draws what is in front, if anything is; the keys are drawn by who knows them all.
pub fn draw(model: &AppModel, area: Rect, buffer: &mut Buffer) {
    match &model.overlay {
        None | Some(Overlay::Help(_)) => {}
        Some(Overlay::Picker(picker)) => picker::draw(model, picker, area, buffer),
        Some(Overlay::Change(what)) => changing::draw(model, what, area, buffer),
        Some(Overlay::Threshold(asking)) => threshold::draw(model, asking, area, buffer),
        Some(Overlay::Name(naming, name, error)) => {
            typed_name(model, naming, (name, error.as_deref()), area, buffer);
        }
        Some(Overlay::Prompt(question)) => ask(model, question, area, buffer),
    }
}

fn typed_name(
    model: &AppModel,
    naming: &Naming,
    (name, error): (&TextLine, Option<&str>),
    area: Rect,
    buffer: &mut Buffer,
) {
    let theme = Theme::of(model.look);
    let title = match naming {
        Naming::Save => "Save as a preset of your own".to_owned(),
        Naming::Rename(from) => format!("Another name for {}", fitted(from, 24)),
    };
    let inside = frame(&title, (50, 6), theme, area, buffer);
    put(buffer, inside, (0, 0), "Name", theme.text());
    let field = Rect::new(inside.x + 6, inside.y, inside.width - 6, 1);
    input(name, theme.strong(), theme.focus(), field, buffer);
    if let Some(error) = error {
        let lines = &wrapped(error, usize::from(inside.width));
        put_lines(buffer, inside, (0, 2), lines, theme.error());
    }
}

/// Columns of a question.
const WIDE: u16 = 50;

fn ask(model: &AppModel, question: &Prompt, area: Rect, buffer: &mut Buffer) {
    let theme = Theme::of(model.look);
    let lines = wrapped(&question.text(), usize::from(WIDE - MARGIN));
    let rows = (lines.len() as u16).max(3);
    let inside = frame("Sure?", (WIDE, rows + 3), theme, area, buffer);
    put_lines(buffer, inside, (0, 0), &lines, theme.text());
    let keys = "Enter or y: yes   Esc or n: no";
    put(buffer, inside, (0, rows), keys, theme.strong());
}
