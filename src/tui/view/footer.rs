//! The bottom line: what was just done, or what is computed ahead and the keys that work here.

use crate::tui::view::text::{fitted, width};
use crate::tui::{model::AppModel, overlay::Overlay, page::writing, view::sheet::Sheet};

/// Draws the footer with the keys that work now and their words.
pub fn draw(model: &AppModel, live: Vec<(String, &str)>, sheet: &mut Sheet) {
    let (area, theme) = (sheet.area, sheet.theme);
    sheet.buffer.set_style(area, theme.bar());
    let mut x = 1;
    if model.slow_link {
        x = sheet.put((x, 0), "slow link ", theme.bar_strong());
    }
    if let Some(notice) = &model.notice {
        let text = fitted(notice, usize::from(area.width - x));
        sheet.put((x, 0), &text, theme.bar_strong());
        return;
    }
    if let Some(Overlay::Prompt(question)) = &model.overlay {
        x = sheet.put((x, 0), question.brief(), theme.bar_strong()) + 2;
    }
    if let Some(writing) = writing(&model.page) {
        x = sheet.put((x, 0), &writing, theme.bar_strong()) + 2;
    } else if let Some(ahead) = model.ahead() {
        x = sheet.put((x, 0), format!("computing ahead: {ahead}"), theme.bar()) + 2;
    }
    // The keys for help and for leaving are always there.
    let is_last = |word: &str| word == "keys" || word == "quit";
    let (last, first): (Vec<_>, Vec<_>) = live.into_iter().partition(|(_, word)| is_last(word));
    let wide = |(keys, word): &(String, &str)| width(keys) + width(word) + 3;
    let reserved: u16 = last.iter().map(wide).sum();
    let mut show = |entry: &(String, &str), x: u16| {
        let after = sheet.put((x, 0), &entry.0, theme.bar_strong());
        sheet.put((after + 1, 0), entry.1, theme.bar()) + 2
    };
    for entry in first {
        if x + wide(&entry) + reserved <= area.width + 2 {
            x = show(&entry, x);
        }
    }
    for entry in last {
        x = show(&entry, x);
    }
}
