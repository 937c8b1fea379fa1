//! Words in cells.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::Style;
use unicode_width::{UnicodeWidthChar, UnicodeWidthStr};

use crate::scenario::problem::printable;

/// How many cells a text takes.
pub fn width(text: &str) -> u16 {
    u16::try_from(text.width()).unwrap_or(u16::MAX)
}

/// Writes `text` at column and row of `area`, cut at its right edge; gives the column after it.
pub fn put(buffer: &mut Buffer, area: Rect, at: (u16, u16), text: &str, style: Style) -> u16 {
    let (x, y) = at;
    if y >= area.height || x >= area.width {
        return x;
    }
    let room = usize::from(area.width - x);
    let (end, _) = buffer.set_stringn(area.x + x, area.y + y, printable(text), room, style);
    end - area.x
}

/// Writes `text` so that it ends before column `right` of `area`.
pub fn put_right(
    buffer: &mut Buffer,
    area: Rect,
    (right, y): (u16, u16),
    text: &str,
    style: Style,
) {
    let left = right.saturating_sub(width(text));
    put(buffer, area, (left, y), text, style);
}

/// Writes a heading at the left of the first row and, cut to the room that is left, a text at its
/// right.
pub fn put_both(buffer: &mut Buffer, area: Rect, left: (&str, Style), right: (&str, Style)) {
    let end = put(buffer, area, (1, 0), left.0, left.1);
    let room = usize::from(area.width.saturating_sub(end + 3));
    let text = fitted(right.0, room);
    put_right(buffer, area, (area.width - 1, 0), &text, right.1);
}

/// A text cut to so many cells, with a mark where something is left out.
pub fn fitted(text: &str, room: usize) -> String {
    if text.width() <= room {
        return text.to_owned();
    }
    let mut cut = String::new();
    let mut used = 1;
    for c in text.chars() {
        used += c.width().unwrap_or(0);
        if used > room {
            break;
        }
        cut.push(c);
    }
    if room > 0 {
        cut.push('…');
    }
    cut
}

/// A text in lines of at most so many cells, broken between words.
pub fn wrapped(text: &str, room: usize) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for word in text.split_whitespace() {
        match lines.last_mut() {
            Some(line) if line.width() + 1 + word.width() <= room => {
                line.push(' ');
                line.push_str(word);
            }
            _ => lines.push(fitted(word, room)),
        }
    }
    lines
}

/// Rewrites a finished screen with ASCII alone.
pub fn to_ascii(buffer: &mut Buffer) {
    for cell in &mut buffer.content {
        let plain = match cell.symbol() {
            text if text.is_ascii() => continue,
            "─" | "━" | "╌" | "—" => "-",
            "│" | "┃" | "▏" | "▎" | "▌" | "▕" => "|",
            "┌" | "┐" | "└" | "┘" | "├" | "┤" | "┬" | "┴" | "┼" | "╵" | "╷" | "±" => {
                "+"
            }
            "█" | "▓" | "▇" => "#",
            "▒" | "▆" | "▅" => "=",
            "░" | "▂" | "▁" | "·" => ".",
            "▸" | "▶" | "→" | "›" => ">",
            "◂" | "←" | "‹" => "<",
            "▾" | "↓" | "▼" => "v",
            "▴" | "↑" | "▲" => "^",
            "●" | "•" | "◆" => "*",
            "○" | "°" => "o",
            "×" => "x",
            "µ" | "μ" => "u",
            "Δ" => "d",
            "…" => "~",
            _ => "?",
        };
        cell.set_symbol(plain);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn long_text_is_cut_and_broken() {
        assert_eq!(fitted("paper-300n", 10), "paper-300n");
        assert_eq!(fitted("paper-300n", 6), "paper…");
        assert_eq!(fitted("paper", 0), "");
        assert_eq!(wrapped("one two three", 7), ["one two", "three"]);
        assert_eq!(wrapped("incomprehensible", 6), ["incom…"]);
    }

    #[test]
    fn nothing_is_written_outside_the_area() {
        let mut buffer = Buffer::empty(Rect::new(0, 0, 10, 2));
        let area = Rect::new(2, 0, 4, 1);
        assert_eq!(put(&mut buffer, area, (0, 0), "abcdefgh", Style::new()), 4);
        put(&mut buffer, area, (0, 1), "below", Style::new());
        put(&mut buffer, area, (9, 0), "right", Style::new());
        let text: String = buffer
            .content
            .iter()
            .map(ratatui::buffer::Cell::symbol)
            .collect();
        assert_eq!(text, "  abcd              ");
    }
}
