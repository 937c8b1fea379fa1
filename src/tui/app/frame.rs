//! Drawing: a pure function of the app. The title above, the screen on show, the keys below, and
//! what stands in front; for a terminal with only ASCII it is rewritten once, at the end.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;

use crate::tui::app::{App, help, tables};
use crate::tui::view::{SMALLEST, footer, overlay, text};
use crate::tui::{model::AppModel, overlay::Overlay, screens::SCREENS, screens::screen::About};
use crate::tui::{terminal::caps::Symbols, view::sheet::Sheet};

/// What stands in the upper left corner.
const PROGRAM: &str = "contrecoup ";

/// Columns that the preset's name can claim in the title.
const LONGEST_NAME: u16 = 26;
/// What is left of it, at least, beside the names of all screens: the mark of an edit.
const MARK: u16 = 2;

/// Draws the whole screen.
pub fn draw(app: &App, buffer: &mut Buffer) {
    let (model, area) = (&app.model, buffer.area);
    buffer.reset();
    let sheet = &mut Sheet::new(buffer, area, model.look);
    if area.width < SMALLEST.0 || area.height < SMALLEST.1 {
        too_small(model, sheet);
    } else {
        title(app, sheet);
        footer::draw(model, tables::footer_keys(app), &mut sheet.row(area.height - 1));
        let body = &mut sheet.at(body(area));
        app.on_show().draw(model, body);
        match model.overlay {
            Some(Overlay::Help(line)) => help::draw(app, line, body),
            _ => overlay::draw(model, body),
        }
    }
    if model.look.symbols == Symbols::Ascii {
        text::to_ascii(buffer);
    }
}

/// What is left between title and footer.
pub fn body(area: Rect) -> Rect {
    Rect::new(0, 1, area.width, area.height - 2)
}

fn too_small(model: &AppModel, sheet: &mut Sheet) {
    let area = sheet.area;
    // A question takes every key, so it is asked here too.
    let question = match &model.overlay {
        Some(Overlay::Prompt(question)) => question.brief() + " y or n",
        _ => String::new(),
    };
    let mut lines = text::wrapped(&question, usize::from(area.width));
    lines.extend([
        "terminal too small".to_owned(),
        format!("need {}x{}", SMALLEST.0, SMALLEST.1),
        format!("have {}x{}", area.width, area.height),
    ]);
    let top = area.height.saturating_sub(lines.len() as u16) / 2;
    for (i, line) in lines.iter().enumerate() {
        let left = area.width.saturating_sub(text::width(line)) / 2;
        sheet.put((left, top + i as u16), line, sheet.theme.text());
    }
}

/// Where the names of the screens begin in the title, and how they are written.
pub fn tabs(app: &App, columns: u16) -> Vec<(u16, String)> {
    // A long name gives way before the screens do.
    let name = text::width(&app.model.title()).min(LONGEST_NAME) + 2;
    // Where room is short the program's name gives way, then the question of the screen on show,
    // then the space between the names of the screens, then those of the others.
    let label = |place: usize, screen: &About, (form, asks): (Form, bool)| {
        let name = format!("F{} {}", place + 1, screen.title);
        match form {
            _ if place == app.screen && asks => format!("[{name}: {}]", screen.question),
            _ if place == app.screen => format!("[{name}]"),
            // The bracket before it is space enough.
            Form::Tight if place == app.screen + 1 => name,
            Form::Brief => format!(" F{} ", place + 1),
            Form::Tight => format!(" {name}"),
            Form::Wide => format!(" {name} "),
        }
    };
    let length = |form| {
        let labels = SCREENS.iter().enumerate();
        labels.map(|(place, screen)| text::width(&label(place, screen, form))).sum::<u16>()
    };
    let candidates = [
        ((Form::Wide, true), name),
        ((Form::Wide, false), name),
        ((Form::Tight, false), MARK),
        ((Form::Brief, true), name),
    ];
    let fits = |(form, name): &((Form, bool), u16)| length(*form) + name <= columns;
    let form = candidates.into_iter().find(fits).map_or((Form::Brief, false), |(form, _)| form);
    let named = columns.saturating_sub(length((Form::Wide, true)) + name) > text::width(PROGRAM);
    let mut x = match (form.0, named) {
        (_, true) => 1 + text::width(PROGRAM),
        (Form::Tight, _) => 0,
        _ => 1,
    };
    let tab = |(place, screen): (usize, &About)| {
        let label = label(place, screen, form);
        let at = x;
        x += text::width(&label);
        (at, label)
    };
    SCREENS.iter().enumerate().map(tab).collect()
}

/// The place of the screen whose name is written at a cell of a screen of this size.
pub fn tab_at(app: &App, (width, height): (u16, u16), (x, y): (u16, u16)) -> Option<usize> {
    if y > 0 || width < SMALLEST.0 || height < SMALLEST.1 {
        return None;
    }
    tabs(app, width).iter().position(|(at, label)| (*at..at + text::width(label)).contains(&x))
}

/// How the names of the screens are written.
#[derive(Clone, Copy)]
enum Form {
    Wide,
    Tight,
    Brief,
}

/// The name of the program, the screens with their keys, and the preset.
fn title(app: &App, sheet: &mut Sheet) {
    let (area, theme, model) = (sheet.area, sheet.theme, &app.model);
    let row = Rect::new(0, 0, area.width, 1);
    sheet.buffer.set_style(row, theme.bar());
    let name = model.title();
    let tabs = tabs(app, area.width);
    let mut x = 0;
    if tabs[0].0 > 1 {
        x = sheet.at(row).put((x, 0), PROGRAM, theme.bar().bold());
    }
    // Where the names of the screens are tight, so is the space round the preset's.
    let margin = u16::from(tabs[0].0 > 0);
    for (place, (at, label)) in tabs.into_iter().enumerate() {
        let style = if place == app.screen { theme.bar_chosen() } else { theme.bar() };
        debug_assert!(at >= x);
        x = sheet.at(row).put((at, 0), &label, style);
    }
    let room = usize::from(area.width.saturating_sub(x + 1 + margin));
    // The mark of an edit is worth more than the name, parts of a short one are worth nothing.
    let mark = if model.is_edited() { "*" } else { "" };
    let short = format!("{} {mark}", model.work.name());
    let fits = |name: &&String| usize::from(text::width(name)) <= room;
    let name = match [&name, &short].into_iter().find(fits) {
        Some(name) => name.clone(),
        None if room < usize::from(LONGEST_NAME) => mark.to_owned(),
        None => text::fitted(&name, room),
    };
    let left = area.width.saturating_sub(text::width(&name) + margin);
    sheet.at(row).put((left, 0), &name, theme.bar());
}
