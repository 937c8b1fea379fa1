//! The list of everything that can be opened.

use crate::tui::picker::{Picker, facts};
use crate::tui::view::popup::{frame, input};
use crate::tui::view::text::{fitted, seen, width};
use crate::tui::{model::AppModel, picker::Choice, view::chart::mark, view::sheet::Sheet};

/// Columns of a name, and the ends of the three facts.
const NAME: u16 = 20;
/// Where the mark of a comparison stands.
const MARK: u16 = 17;
const FACTS: [u16; 3] = [28, 37, 47];
/// Where a title or the origin begins.
const REST: u16 = 49;
/// Rows above the list and below it.
const ABOVE: u16 = 2;

/// What the first start says below the list.
const WELCOME: [&str; 2] = [
    "Speed and all else can be changed afterwards. p: this list again.",
    "Esc: the blow of the paper, a force of 300 N for 0.2 ms.",
];

/// Draws the list in the middle of `area`.
pub fn draw(model: &AppModel, picker: &Picker, sheet: &mut Sheet) {
    let (area, theme) = (sheet.area, sheet.theme);
    let title = match picker {
        _ if picker.first => "What hit the eye?",
        _ if picker.marked.is_some() => "Mark two to six",
        _ => "Open",
    };
    let below = if picker.first { 1 + WELCOME.len() as u16 } else { 0 };
    let high = model.choices.len() as u16 + ABOVE + below + 2;
    let sheet = &mut frame(title, (area.width.min(92), high), sheet);
    let inside = sheet.area;
    let room = usize::from(inside.height.saturating_sub(ABOVE + below));
    let first = picker.row.saturating_sub(room.saturating_sub(1));
    let count = seen(first, room, picker.shown.len());
    sheet.put_right((inside.width, 0), &count, theme.quiet());
    let after = sheet.put((0, 0), "Find ", theme.heading());
    let field = inside.width.saturating_sub(after + width(&count) + 1);
    let field = &mut sheet.part((after, 0), (field, 1));
    input(&picker.input, theme.strong(), field);
    for (right, head) in FACTS.into_iter().zip(["mass", "size", "speed"]) {
        sheet.put_right((right, 1), head, theme.quiet());
    }
    sheet.put((0, 1), "preset", theme.quiet());
    let rows = picker.shown.iter().enumerate().skip(first).take(room);
    for (y, (i, at)) in (ABOVE..).zip(rows) {
        let line = &mut sheet.row(y);
        let choice = &model.choices[*at];
        row(choice, i == picker.row, line);
        let marked = picker.marked.iter().flatten();
        let place = marked.enumerate().find(|(_, name)| **name == choice.name);
        if let Some((place, _)) = place {
            let sign = format!("[{}]", mark(place));
            line.put((MARK, 0), &sign, theme.curve(place));
        }
    }
    if picker.shown.is_empty() {
        sheet.put((0, ABOVE), "nothing is called so", theme.quiet());
    }
    if picker.first {
        let top = inside.height.saturating_sub(WELCOME.len() as u16);
        for (y, text) in (top..).zip(WELCOME) {
            sheet.put((0, y), fitted(text, usize::from(inside.width)), theme.text());
        }
    }
}

fn row(choice: &Choice, chosen: bool, sheet: &mut Sheet) {
    let theme = sheet.theme;
    let style = if chosen { theme.focus() } else { theme.strong() };
    sheet.put((0, 0), fitted(&choice.name, usize::from(NAME)), style);
    let scenario = match &choice.scenario {
        Ok(scenario) => scenario,
        Err(why) => {
            let room = usize::from(sheet.area.width - NAME - 1);
            sheet.put((NAME + 1, 0), fitted(why, room), theme.error());
            return;
        }
    };
    for (right, fact) in FACTS.into_iter().zip(facts(scenario)) {
        sheet.put_right((right, 0), &fact, theme.text());
    }
    let room = usize::from(sheet.area.width.saturating_sub(REST));
    let rest = match choice.origin {
        "" => scenario.name.clone(),
        origin if room < 20 => origin.to_owned(),
        origin => format!("{origin}: {}", scenario.name),
    };
    // A title that is cut to a word or two says nothing.
    if room >= 20 || !choice.origin.is_empty() {
        sheet.put((REST, 0), fitted(&rest, room), theme.text());
    }
}
