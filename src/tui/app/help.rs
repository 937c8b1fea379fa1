//! The help: every key with what it does, and every word explained.

use crate::guide;
use crate::tui::app::{App, tables};
use crate::tui::view::overlay::{MARGIN, frame};
use crate::tui::view::{PURPOSE, SMALLEST};
use crate::tui::{keys::KeyList, view::sheet::Sheet, view::text::wrapped};

/// Columns of the help, and of the keys in it.
const HELP: u16 = 76;
const KEYS: u16 = 18;

/// The help as lines, a heading or keys and what they do: first those of the screen on show.
fn lines(app: &App, room: usize) -> Vec<(String, String)> {
    let screen = app.about();
    let heading = |text: String| (text, String::new());
    let mut lines =
        vec![heading(format!("{} {}: {}", app.screen + 1, screen.title, screen.question))];
    let own = tables::of_panes(app.on_show());
    let is_own = |list: &KeyList| own.iter().any(|own| own.title == list.title);
    let rest = tables::all().into_iter().filter(|list| !is_own(list));
    for list in own.iter().cloned().chain(rest) {
        lines.push(heading(list.title.to_owned()));
        for key in list.keys {
            let keys = wrapped(&key.names(&app.model.keys).join(" "), usize::from(KEYS) - 3);
            let words = wrapped(key.help, room - usize::from(KEYS));
            for row in 0..keys.len().max(words.len()) {
                let [key, word] = [&keys, &words].map(|of| of.get(row).map_or("", String::as_str));
                lines.push((format!("  {key}"), format!(" {word}")));
            }
        }
    }
    lines.push(heading("Words".to_owned()));
    lines.extend(glossary(room));
    lines.push(heading(PURPOSE.to_owned()));
    lines
}

/// How many lines the help has where it is narrowest, and the most of them.
pub fn rows(app: &App) -> u16 {
    let room = SMALLEST.0 - MARGIN;
    u16::try_from(lines(app, room.into()).len()).unwrap_or(u16::MAX)
}

/// The glossary of the guide, wrapped; its headings without their marks.
fn glossary(room: usize) -> Vec<(String, String)> {
    let mut lines = Vec::new();
    let mut entry = String::new();
    let end = |entry: &mut String, lines: &mut Vec<(String, String)>| {
        for (i, line) in wrapped(entry, room - 4).iter().enumerate() {
            lines.push((String::new(), format!("{}{line}", if i == 0 { "" } else { "  " })));
        }
        entry.clear();
    };
    let page = guide::TOPICS.iter().find(|topic| topic.name == "glossary");
    for line in page.into_iter().flat_map(|topic| topic.page.lines()) {
        if let Some(text) = line.strip_prefix("- ") {
            end(&mut entry, &mut lines);
            text.clone_into(&mut entry);
        } else if let Some(text) = line.strip_prefix("## ") {
            end(&mut entry, &mut lines);
            lines.push((text.to_owned(), String::new()));
        } else if !line.starts_with('#') {
            entry.extend([" ", line.trim()]);
        }
    }
    end(&mut entry, &mut lines);
    lines
}

/// Draws the help from this line on.
pub fn draw(app: &App, line: u16, sheet: &mut Sheet) {
    let (area, theme) = (sheet.area, sheet.theme);
    let sheet = &mut frame("Help", (HELP, area.height), sheet);
    let inside = sheet.area;
    let lines = lines(app, usize::from(inside.width));
    let last = (lines.len() as u16).saturating_sub(inside.height);
    let shown = lines.iter().skip(usize::from(line.min(last)));
    for (y, (keys, what)) in shown.take(usize::from(inside.height)).enumerate() {
        let style = if what.is_empty() { theme.heading() } else { theme.strong() };
        sheet.put((0, y as u16), keys, style);
        // Words of the glossary have no keys before them.
        let x = if keys.is_empty() { 2 } else { KEYS - 1 };
        sheet.put((x, y as u16), what, theme.text());
    }
}
