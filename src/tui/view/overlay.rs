//! What comes in front of the screen: the presets, a name to save under, a question, a field of a
//! marked preset, and the value at which a result reaches what is asked.

use ratatui::style::Style;
use ratatui::text::{Line, Span};
use ratatui::widgets::{Block, Clear, Widget};

use crate::plain_text::printable;
use crate::report::threshold::{brief, never};
use crate::tui::changing::Changing;
use crate::tui::form::{allowed, typed_text};
use crate::tui::overlay::{Naming, Overlay, Prompt};
use crate::tui::picker::{LAST, Picker, facts};
use crate::tui::view::text::{fitted, seen, width, wrapped};
use crate::tui::view::{chart::mark, sheet::Sheet};
use crate::tui::{line::TextLine, model::AppModel, picker::Choice, threshold::Asking};

/// Draws what is in front, if anything is; the keys are drawn by who knows them all.
pub fn draw(model: &AppModel, sheet: &mut Sheet) {
    match &model.overlay {
        None | Some(Overlay::Help(_)) => {}
        Some(Overlay::Picker(picker)) => pick(model, picker, sheet),
        Some(Overlay::Change(what)) => change(what, sheet),
        Some(Overlay::Threshold(asking)) => threshold(model, asking, sheet),
        Some(Overlay::Name(naming, name, error)) => {
            typed_name(naming, name, error.as_deref().unwrap_or_default(), sheet);
        }
        Some(Overlay::Prompt(question)) => ask(question, sheet),
    }
}

fn typed_name(naming: &Naming, name: &TextLine, error: &str, sheet: &mut Sheet) {
    let theme = sheet.theme;
    let title = match naming {
        Naming::Save => "Save as a preset of your own".to_owned(),
        Naming::Rename(from) => format!("Another name for {}", fitted(from, 24)),
    };
    let mut inside = frame(&title, (50, 6), sheet);
    inside.put((0, 0), "Name", theme.text());
    let room = inside.area.width;
    input(name, theme.strong(), &mut inside.part((6, 0), (room - 6, 1)));
    inside.put_lines((0, 2), wrapped(error, usize::from(room)), theme.error());
}

fn ask(question: &Prompt, sheet: &mut Sheet) {
    let (theme, wide) = (sheet.theme, 50);
    let lines = wrapped(&question.text(), usize::from(wide - MARGIN));
    let rows = (lines.len() as u16).max(3);
    let mut inside = frame("Sure?", (wide, rows + 3), sheet);
    inside.put_lines((0, 0), &lines, theme.text());
    inside.put((0, rows), "Enter or y: yes   Esc or n: no", theme.strong());
}

/// A field of a marked preset that is being changed.
fn change(changing: &Changing, sheet: &mut Sheet) {
    let theme = sheet.theme;
    let field = changing.field();
    let sheet = &mut frame(&changing.name, (54, 8), sheet);
    let wide = sheet.area.width;
    let x = sheet.put((0, 0), field.label, theme.heading()) + 2;
    let unit = width(field.unit);
    let room = wide.saturating_sub(x + unit + 1);
    input(&changing.input, theme.strong(), &mut sheet.part((x, 0), (room, 1)));
    let beside = (x + width(changing.input.value()) + 1).min(wide - unit);
    sheet.put((beside, 0), field.unit, theme.text());
    let (said, style) = match &changing.error {
        Some(why) => (why.clone(), theme.error()),
        None => (format!("{}: {}", field.help, allowed(&changing.scenario, field)), theme.quiet()),
    };
    sheet.put_lines((0, 2), wrapped(&said, usize::from(wide)).iter().take(3), style);
    sheet.put((0, 5), "↑↓ another field   Enter takes it   Esc leaves it", theme.strong());
}

/// At which value of a number a result reaches what is asked, and the answer.
fn threshold(model: &AppModel, asking: &Asking, sheet: &mut Sheet) {
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
    input(&asking.input, theme.strong(), &mut sheet.part((x, 2), (12, 1)));
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
    let complaint = asking.task.complaint.as_ref().map(|(_, why)| why);
    if let Some(pace) = asking.task.pace(None) {
        say(&format!("looking: {pace}"), theme.text());
        say("Esc stops.", theme.quiet());
    } else if let Some(why) = asking.error.as_ref().or(complaint) {
        say(why, theme.error());
    } else if let Some((asked, found)) = &asking.found {
        for (i, crossing) in found.crossings.iter().enumerate() {
            let chosen = i == asking.row;
            let (mark, style) = if chosen { ("▸", theme.strong()) } else { (" ", theme.text()) };
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
        }
        if let Some(taken) = asking.taken() {
            let next = if found.crossings.len() == 1 { "" } else { " Tab goes to the next." };
            say(&format!("Enter takes {taken} {unit}.{next} Esc leaves {now}."), theme.quiet());
        }
    } else {
        say("Enter looks for it over the whole range, for some seconds.", theme.quiet());
    }
}

/// Columns of a name, and the ends of the three facts.
const NAME: u16 = 20;
/// Where the mark of a comparison stands.
const MARK: u16 = 17;
const FACTS: [u16; 3] = [28, 37, 47];
/// Where a title or the origin begins.
const REST: u16 = 49;
/// Rows above the list and below it.
const ABOVE: u16 = 2;

/// What is said below the list at the start, with a last blow on top of it and without.
const WELCOME: [[&str; 2]; 2] = [
    [
        "Enter opens, Esc takes the first: the last blow, as it was left.",
        "Letters find a preset, squash@30 gives it a speed. p: this list again.",
    ],
    [
        "Enter opens, Esc takes a squash ball at 40 m/s.",
        "Letters find a preset, squash@30 gives it a speed. p: this list again.",
    ],
];

/// The list of everything that can be opened.
fn pick(model: &AppModel, picker: &Picker, sheet: &mut Sheet) {
    let (area, theme) = (sheet.area, sheet.theme);
    let title = match picker {
        _ if picker.first => "What hit the eye?",
        _ if picker.marked.is_some() => "Mark two to six",
        _ => "Open",
    };
    let below = if picker.first { 1 + WELCOME[0].len() as u16 } else { 0 };
    let high = model.choices.len() as u16 + ABOVE + below + 2;
    let sheet = &mut frame(title, (area.width.min(92), high), sheet);
    let inside = sheet.area;
    let room = usize::from(inside.height.saturating_sub(ABOVE + below));
    let first = picker.row.saturating_sub(room.saturating_sub(1));
    let count = seen(first, room, picker.shown.len());
    sheet.put_right((inside.width, 0), &count, theme.quiet());
    let after = sheet.put((0, 0), "Find ", theme.heading());
    let field = inside.width.saturating_sub(after + width(&count) + 1);
    input(&picker.input, theme.strong(), &mut sheet.part((after, 0), (field, 1)));
    for (right, head) in FACTS.into_iter().zip(["mass", "size", "speed"]) {
        sheet.put_right((right, 1), head, theme.quiet());
    }
    sheet.put((0, 1), "preset", theme.quiet());
    for (y, (i, at)) in (ABOVE..).zip(picker.shown.iter().enumerate().skip(first).take(room)) {
        let (line, choice) = (&mut sheet.row(y), &model.choices[*at]);
        choice_row(choice, line);
        if i == picker.row {
            line.buffer.set_style(line.area, theme.focus());
        }
        if let Some(place) = picker.marked.iter().flatten().position(|name| *name == choice.name) {
            line.put((MARK, 0), format!("[{}]", mark(place)), theme.curve(place));
        }
    }
    if picker.shown.is_empty() {
        sheet.put((0, ABOVE), "nothing is called so", theme.quiet());
    }
    if picker.first {
        let top = inside.height.saturating_sub(WELCOME[0].len() as u16);
        let goes_on = model.choices.iter().any(|choice| choice.origin == LAST);
        let lines =
            WELCOME[usize::from(!goes_on)].map(|text| fitted(text, usize::from(inside.width)));
        sheet.put_lines((0, top), lines, theme.text());
    }
}

fn choice_row(choice: &Choice, sheet: &mut Sheet) {
    let theme = sheet.theme;
    sheet.put((0, 0), fitted(&choice.name, usize::from(NAME)), theme.strong());
    if let Err(why) = &choice.scenario {
        let room = usize::from(sheet.area.width - NAME - 1);
        sheet.put((NAME + 1, 0), fitted(why, room), theme.error());
    }
    let Ok(scenario) = &choice.scenario else { return };
    for (right, fact) in FACTS.into_iter().zip(facts(scenario)) {
        sheet.put_right((right, 0), &fact, theme.text());
    }
    let room = usize::from(sheet.area.width.saturating_sub(REST));
    let rest = match choice.origin {
        // A title that is cut to a word or two says nothing.
        origin if room < 20 => origin.to_owned(),
        "" => scenario.name.clone(),
        origin => format!("{origin}: {}", scenario.name),
    };
    sheet.put((REST, 0), fitted(&rest, room), theme.text());
}

/// Columns that a frame takes.
pub const MARGIN: u16 = 4;

/// A frame in the middle; gives what is inside.
pub fn frame<'a>(title: &str, (wide, high): (u16, u16), sheet: &'a mut Sheet) -> Sheet<'a> {
    let (area, theme) = (sheet.area, sheet.theme);
    let (wide, high) = (wide.min(area.width), high.min(area.height));
    let (x, y) = ((area.width - wide) / 2, (area.height - high) / 2);
    let place = sheet.part((x, y), (wide, high)).area;
    let title = Span::styled(format!(" {} ", printable(title)), theme.heading());
    let title = Line::from(vec![Span::styled("─", theme.quiet()), title]);
    Clear.render(place, sheet.buffer);
    Block::bordered().border_style(theme.quiet()).title(title).render(place, sheet.buffer);
    sheet.part((x + 2, y + 1), (wide - MARGIN, high - 2))
}

/// Text that is being typed, scrolled so that its cursor is seen; all of it is one if selected.
pub fn input(line: &TextLine, style: Style, sheet: &mut Sheet) {
    let (area, cursor) = (sheet.area, sheet.theme.focus());
    let input = &line.input;
    let style = if line.selected { cursor } else { style };
    let hidden = input.visual_scroll(usize::from(area.width.saturating_sub(1)));
    let (mut x, mut skipped) = (0, 0);
    for text in input.value().chars().map(String::from) {
        if skipped < hidden {
            skipped += usize::from(width(&text));
        } else {
            x = sheet.put((x, 0), &text, style);
        }
    }
    let at = input.visual_cursor().saturating_sub(hidden) as u16;
    if at < area.width {
        sheet.cell((at, 0)).set_style(cursor);
    }
}
