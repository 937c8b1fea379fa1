//! The bottom line: what was just done, or what is computed ahead and the keys that work here.

use crate::tui::view::text::{fitted, width};
use crate::tui::{model::AppModel, overlay::Overlay, page::writing, view::sheet::Sheet};

/// Draws the footer with the keys that work now and their words.
pub fn draw(model: &AppModel, live: Vec<(String, &str)>, sheet: &mut Sheet) {
    let (area, bar) = (sheet.area, sheet.theme.bar());
    let strong = bar.bold();
    sheet.buffer.set_style(area, bar);
    let mut x = 1;
    if model.slow_link {
        x = sheet.put((x, 0), "slow link ", strong);
    }
    if let Some(notice) = &model.notice {
        sheet.put((x, 0), fitted(notice, usize::from(area.width - x)), strong);
        return;
    }
    if let Some(Overlay::Prompt(question)) = &model.overlay {
        x = sheet.put((x, 0), question.brief(), strong) + 2;
    }
    if let Some(writing) = writing(&model.page) {
        x = sheet.put((x, 0), &writing, strong) + 2;
    } else if let Some(ahead) = model.ahead() {
        x = sheet.put((x, 0), format!("computing ahead: {ahead}"), bar) + 2;
    }
    // The keys for help and for leaving are always there.
    let is_last = |word: &str| word == "keys" || word == "quit";
    let (last, first): (Vec<_>, Vec<_>) = live.into_iter().partition(|(_, word)| is_last(word));
    let wide = |(keys, word): &(String, &str)| width(keys) + width(word) + 3;
    let reserved: u16 = last.iter().map(wide).sum();
    let mut show = |entry: &(String, &str), x: u16| {
        let after = sheet.put((x, 0), &entry.0, strong);
        sheet.put((after + 1, 0), entry.1, bar) + 2
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
