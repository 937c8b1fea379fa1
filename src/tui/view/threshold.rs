//! The question at which value of a number a result reaches what is asked, and its answer.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::Style;

use crate::report::threshold::{brief, never};
use crate::tui::form::typed_text;
use crate::tui::model::AppModel;
use crate::tui::threshold::Asking;
use crate::tui::view::popup::{frame, input};
use crate::tui::view::text::{put, width, wrapped};
use crate::tui::view::theme::Theme;

/// Draws it in the middle of `area`.
pub fn draw(model: &AppModel, asking: &Asking, area: Rect, buffer: &mut Buffer) {
    let theme = Theme::of(model.look);
    let field = asking.field;
    let (label, unit) = (field.label.to_lowercase(), field.unit);
    let inside = frame("At which value?", (58, 14), theme, area, buffer);
    let now = typed_text(field, &model.work.scenario).unwrap_or_default();
    let row = asking.quantity.row();
    put(
        buffer,
        inside,
        (0, 0),
        &format!("At which {label} does"),
        theme.text(),
    );
    let x = put(buffer, inside, (2, 1), row.label, theme.heading());
    put(
        buffer,
        inside,
        (x + 2, 1),
        "↑↓ another result",
        theme.quiet(),
    );
    let x = put(buffer, inside, (0, 2), "reach ", theme.text());
    let typed = Rect::new(inside.x + x, inside.y + 2, 12, 1);
    input(&asking.input, theme.strong(), theme.focus(), typed, buffer);
    let beside = x + width(asking.input.value()) + 2;
    let asked = format!("{}?  It is {now} {unit} now.", row.unit);
    put(
        buffer,
        inside,
        (beside, 2),
        asked.trim_start(),
        theme.text(),
    );
    let mut y = 4;
    let mut say = |text: &str, style: Style| {
        for line in wrapped(text, usize::from(inside.width)) {
            put(buffer, inside, (0, y), &line, style);
            y += 1;
        }
    };
    if let Some(pace) = asking.task.pace(None) {
        say(&format!("looking: {pace}"), theme.text());
        say("Esc stops.", theme.quiet());
    } else if let Some(why) = &asking.error {
        say(why, theme.error());
    } else if let Some((_, why)) = &asking.task.complaint {
        say(why, theme.error());
    } else if let Some((asked, found)) = &asking.found {
        for (i, crossing) in found.crossings.iter().enumerate() {
            let chosen = i == asking.row;
            let mark = if chosen { "▸" } else { " " };
            let style = if chosen { theme.strong() } else { theme.text() };
            say(&format!("{mark} {}", brief(&asked.0, crossing)), style);
        }
        if found.crossings.is_empty() {
            say(&never(&asked.0, found), theme.strong());
        }
        if let Some(crossing) = asking.chosen() {
            let flags: Vec<&str> = crossing.flags.iter().map(|f| f.kind.words()).collect();
            if !flags.is_empty() {
                say(&format!("There: {}", flags.join(", ")), theme.warning());
            }
            for note in crossing.risk.iter().flat_map(|there| &there.risk.notes) {
                say(&format!("beware: {note}"), theme.warning());
            }
        }
        if let Some(taken) = asking.taken() {
            let next = match found.crossings.len() {
                1 => "",
                _ => " Tab goes to the next.",
            };
            say(
                &format!("Enter takes {taken} {unit}.{next} Esc leaves {now}."),
                theme.quiet(),
            );
        }
    } else {
        say(
            "Enter looks for it over the whole range, for some seconds.",
            theme.quiet(),
        );
    }
}
