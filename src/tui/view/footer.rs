//! The bottom line: what was just done, or the keys that work here.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;

use super::text::{fitted, put, width};
use super::theme::Theme;
use crate::tui::keys::live;
use crate::tui::model::{Model, Overlay, Question};

/// Draws it.
pub fn draw(model: &Model, area: Rect, buffer: &mut Buffer) {
    let theme = Theme::of(model.look);
    buffer.set_style(area, theme.bar());
    let mut x = 1;
    if model.slow_link {
        x = put(buffer, area, (x, 0), "slow link ", theme.bar_strong());
    }
    if let Some(notice) = &model.notice {
        let text = fitted(notice, usize::from(area.width - x));
        put(buffer, area, (x, 0), &text, theme.bar_strong());
        return;
    }
    if let Some(Overlay::Question(question)) = &model.overlay {
        let text = match question {
            Question::Quit => "Quit without saving the changes?".to_owned(),
            Question::Replace(name) => format!("Replace the preset {name}?"),
        };
        x = put(buffer, area, (x, 0), &text, theme.bar_strong()) + 2;
    }
    // The keys for help and for leaving are always there.
    let bindings: Vec<_> = live(model.context()).collect();
    let is_last = |short: &str| short == "keys" || short == "quit";
    let word = |binding: &crate::tui::keys::Binding| {
        let keys: Vec<String> = binding.presses[..1].iter().map(|p| p.name()).collect();
        (keys.join(""), format!(" {}  ", binding.short))
    };
    let reserved: u16 = bindings
        .iter()
        .filter(|b| is_last(b.short))
        .map(|b| {
            let (key, text) = word(b);
            width(&key) + width(&text)
        })
        .sum();
    let (last, first): (Vec<_>, Vec<_>) = bindings.into_iter().partition(|b| is_last(b.short));
    for binding in first {
        let (key, text) = word(binding);
        if x + width(&key) + width(&text) + reserved > area.width + 1 {
            continue;
        }
        x = put(buffer, area, (x, 0), &key, theme.bar_strong());
        x = put(buffer, area, (x, 0), &text, theme.bar());
    }
    for binding in last {
        let (key, text) = word(binding);
        x = put(buffer, area, (x, 0), &key, theme.bar_strong());
        x = put(buffer, area, (x, 0), &text, theme.bar());
    }
}
