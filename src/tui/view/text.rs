//! Words in cells.

use ratatui::buffer::{Buffer, Cell};
use unicode_width::{UnicodeWidthChar, UnicodeWidthStr};

use crate::report::format::{self, digits};
use crate::run::flags::Flag;

/// How many cells a text takes.
pub fn width(text: &str) -> u16 {
    u16::try_from(text.width()).unwrap_or(u16::MAX)
}

/// A text cut to so many cells, with a mark where something is left out.
pub fn fitted(text: &str, room: usize) -> String {
    if text.width() <= room {
        return text.to_owned();
    }
    let mut used = 1;
    let fits = |c: &char| {
        used += c.width().unwrap_or(0);
        used <= room
    };
    text.chars().take_while(fits).chain((room > 0).then_some('…')).collect()
}

/// A text in lines of at most so many cells; a word that is longer is cut.
pub fn wrapped(text: &str, room: usize) -> Vec<String> {
    format::wrapped(text, room).iter().map(|line| fitted(line, room)).collect()
}

/// The first of some texts that fits, or else the last.
pub fn longest_fitting<T: AsRef<str>>(texts: &[T], room: u16) -> &str {
    let mut texts = texts.iter().map(AsRef::as_ref);
    let fits = |text: &&str| width(text) <= room;
    texts.clone().find(fits).or(texts.next_back()).unwrap_or("")
}

/// As many whole sentences as so many rows hold, the first at least.
pub fn whole_sentences(sentences: &[String], room: usize, rows: usize) -> Vec<String> {
    let some = |count: usize| wrapped(&sentences[..count].join(" "), room);
    let mut fitting = (1..=sentences.len()).rev().map(some);
    fitting.find(|lines| lines.len() <= rows).unwrap_or_else(|| some(1))
}

/// Parts in as few lines as fit, none of them broken.
pub fn flowed(parts: &[String], room: u16) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for part in parts {
        match lines.last_mut() {
            Some(line) if width(line) + 2 + width(part) <= room => line.extend(["  ", part]),
            _ => lines.push(fitted(part, usize::from(room))),
        }
    }
    lines
}

/// A number in so many cells: four digits, or as many as there is room for.
pub fn numeral(value: f64, room: u16) -> String {
    let mut written = (1..=4).rev().map(|count| digits(value, count));
    written.find(|text| width(text) <= room).unwrap_or_else(|| format!("{value:.0e}"))
}

/// The names of flags in so many rows at most; none where there are none.
pub fn flag_lines(flags: &[Flag], room: usize, rows: usize) -> Vec<String> {
    if flags.is_empty() {
        return Vec::new();
    }
    let names: Vec<&str> = flags.iter().map(|flag| flag.kind.words()).collect();
    let mut lines = wrapped(&format!("! {}", names.join(", ")), room);
    if lines.len() > rows {
        let rest = lines.split_off(rows.saturating_sub(1)).join(" ");
        lines.push(fitted(&rest, room));
    }
    lines
}

/// Which of the rows of a list are seen, with a mark at each end that goes on; nothing if all are.
pub fn seen(first: usize, shown: usize, all: usize) -> String {
    if shown >= all {
        return String::new();
    }
    let above = if first > 0 { "▴ " } else { "" };
    let below = if first + shown < all { " ▾" } else { "" };
    format!("{above}{} to {} of {all}{below}", first + 1, first + shown)
}

/// Rewrites a finished screen with ASCII alone.
pub fn to_ascii(buffer: &mut Buffer) {
    let is_figure = |c: char| c.is_ascii_digit() || "<?".contains(c);
    for row in buffer.content.chunks_mut(usize::from(buffer.area.width.max(1))) {
        for at in (0..row.len()).filter(|at| row[*at].symbol() == "±").collect::<Vec<_>>() {
            let before = at.checked_sub(1).map(|at| row[at].symbol());
            let after = row.get(at + 1).map(Cell::symbol);
            // A plus alone would make a sum of a doubt: a space behind or before takes the other.
            let first = match (before, after) {
                (_, Some(" ")) => at,
                (Some(" "), Some(error)) if error.starts_with(is_figure) => at - 1,
                _ => continue,
            };
            row[first].set_symbol("+");
            row[first + 1].set_symbol("-");
        }
    }
    for cell in &mut buffer.content {
        let plain = match cell.symbol() {
            text if text.is_ascii() => continue,
            "─" | "━" | "╸" | "╌" | "—" | "▃" | "▄" => "-",
            "│" | "┃" | "▏" | "▎" | "▌" | "▕" => "|",
            corner if "┌┐└┘├┤┬┴┼╵╷".contains(corner) => "+",
            "█" | "▓" | "▇" => "#",
            "▒" | "▆" | "▅" | "═" => "=",
            "░" | "▂" | "▁" | "·" => ".",
            "▸" | "▶" | "→" | "›" => ">",
            "◂" | "←" | "‹" => "<",
            "▾" | "↓" | "▼" => "v",
            "▴" | "↑" | "▲" => "^",
            "●" | "•" => "*",
            // Apart from the star that marks a band.
            "◆" => "@",
            "○" | "°" => "o",
            "×" => "x",
            "µ" | "μ" => "u",
            "Δ" => "d",
            "…" | "±" => "~",
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
    fn numbers_give_up_digits_for_room() {
        let values = [26.418_437, -0.0063, 1.016e-13, -1.016e-13, 123_456.0, 0.0];
        let texts = ["26.42", "-0.00630", "1.02e-13", "-1.0e-13", "123456", "0"];
        assert_eq!(values.map(|value| numeral(value, 8)), texts);
        assert_eq!(numeral(0.000_123_4, 5), "1e-4");
    }

    #[test]
    fn a_list_says_which_of_its_rows_are_seen() {
        assert_eq!(seen(0, 9, 9), "");
        assert_eq!(seen(0, 8, 9), "1 to 8 of 9 ▾");
        assert_eq!(seen(1, 7, 9), "▴ 2 to 8 of 9 ▾");
        assert_eq!(seen(1, 8, 9), "▴ 2 to 9 of 9");
    }

    #[test]
    fn a_doubt_in_ascii_is_no_sum() {
        for (text, plain) in [
            ("300 ± 30 N", "300 +-30 N"),
            ("300±30 N  ", "300~30 N  "),
            ("x   300 ± ", "x   300 +-"),
            ("x    300 ±", "x    300 ~"),
            ("73 N ±48 %", "73 N+-48 %"),
        ] {
            let mut buffer = Buffer::with_lines([text]);
            to_ascii(&mut buffer);
            assert_eq!(buffer, Buffer::with_lines([plain]));
        }
    }
}
