//! The question at which value of a number a result reaches what is asked, and its answer.

use ratatui::style::Style;

use crate::report::threshold::{brief, never};
use crate::tui::view::popup::{frame, input};
use crate::tui::view::text::{width, wrapped};
use crate::tui::{form::typed_text, model::AppModel, threshold::Asking, view::sheet::Sheet};

/// Draws it in the middle of `area`.
pub fn draw(model: &AppModel, asking: &Asking, sheet: &mut Sheet) {
    let theme = sheet.theme;
    let field = asking.field;
    let (label, unit) = (field.label.to_lowercase(), field.unit);
    let sheet = &mut frame("At which value?", (58, 14), sheet);
    let room = usize::from(sheet.area.width);
    let now = typed_text(field, &model.work.scenario).unwrap_or_default();
    let row = asking.quantity.row();
    sheet.put((0, 0), format!("At which {label} does"), theme.text());
    let x = sheet.put((2, 1), row.label, theme.heading());
    sheet.put((x + 2, 1), "↑↓ another result", theme.quiet());
    let x = sheet.put((0, 2), "reach ", theme.text());
    let typed = &mut sheet.part((x, 2), (12, 1));
    input(&asking.input, theme.strong(), typed);
    let beside = x + width(asking.input.value()) + 2;
    let asked = format!("{}?  It is {now} {unit} now.", row.unit);
    sheet.put((beside, 2), asked.trim_start(), theme.text());
    let mut y = 4;
    let mut say = |text: &str, style: Style| {
        for line in wrapped(text, room) {
            sheet.put((0, y), &line, style);
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
            say(&format!("Enter takes {taken} {unit}.{next} Esc leaves {now}."), theme.quiet());
        }
    } else {
        say("Enter looks for it over the whole range, for some seconds.", theme.quiet());
    }
}
