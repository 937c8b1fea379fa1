//! Somebody else's text, made safe for a terminal.
//!
//! Characters that a terminal obeys (escape sequences), that reorder what stands around them
//! (bidirectional marks) or that nobody sees (zero width) are written out, as in `\u{202e}`, and so
//! is a longer pile of combining marks than any language has. JSON has an escape of its own for
//! every character, so there the text also stays what it was. Messages repeat somebody else's text
//! cut, with a count. Left out: letters that look alike in two scripts.

use std::borrow::Cow;
use std::fmt::Write as _;
use unicode_width::UnicodeWidthChar;

/// The longest piece of somebody else's text that a message repeats, in characters.
pub const LONGEST_QUOTE: usize = 60;
/// The longest message, in characters: a list of every field fits.
const LONGEST_MESSAGE: usize = 1200;
/// The most lines of one complaint.
pub const MAX_LINES: usize = 20;
/// Combining marks on one letter: Hebrew and Vietnamese need three.
const MAX_MARKS: usize = 3;

/// Whether a character would do something to a terminal rather than be seen, or looks like a space.
pub fn is_unprintable(c: char) -> bool {
    c.is_control()
        || matches!(c,
            '\u{a0}' | '\u{ad}' | '\u{34f}' | '\u{61c}' | '\u{115f}' | '\u{1160}' | '\u{1680}' | '\u{17b4}'
            | '\u{17b5}' | '\u{180b}'..='\u{180f}' | '\u{2000}'..='\u{200f}' | '\u{2028}'..='\u{202f}'
            | '\u{205f}'..='\u{206f}' | '\u{2800}' | '\u{3000}' | '\u{3164}' | '\u{fe00}'..='\u{fe0f}'
            | '\u{feff}' | '\u{ffa0}' | '\u{fff0}'..='\u{fffb}' | '\u{13430}'..='\u{1343f}' | '\u{16fe4}'
            | '\u{1bca0}'..='\u{1bca3}' | '\u{1d159}' | '\u{1d173}'..='\u{1d17a}'
            | '\u{e0000}'..='\u{e0fff}')
}

/// One line: the text with every unprintable character written out.
pub fn printable(text: &str) -> Cow<'_, str> {
    escaped(text, |_| false, write_out)
}

/// A file's path as [`printable`].
#[cfg(feature = "app")]
pub fn printable_path(path: &std::path::Path) -> String {
    printable(&path.display().to_string()).into_owned()
}

/// Several lines: as [`printable`], with line ends and tabs kept.
#[cfg(feature = "app")]
pub fn printable_lines(text: &str) -> Cow<'_, str> {
    escaped(text, |c| matches!(c, '\n' | '\t'), write_out)
}

fn write_out(c: char, text: &mut String) {
    match c {
        '\n' | '\r' | '\t' => text.extend(c.escape_debug()),
        c => text.extend(c.escape_unicode()),
    }
}

fn escaped(
    text: &str,
    keeps: impl Fn(char) -> bool,
    write_out: impl Fn(char, &mut String),
) -> Cow<'_, str> {
    // What most text is made of, told apart at a glance.
    if text.bytes().all(|b| (0x20..0x7f).contains(&b)) {
        return Cow::Borrowed(text);
    }
    let mut shown = String::with_capacity(text.len() + 8);
    let mut marks = 0;
    for c in text.chars() {
        marks = if c.width() == Some(0) { marks + 1 } else { 0 };
        if (is_unprintable(c) && !keeps(c)) || marks > MAX_MARKS {
            write_out(c, &mut shown);
        } else {
            shown.push(c);
        }
    }
    if shown == text { Cow::Borrowed(text) } else { Cow::Owned(shown) }
}

/// A piece of somebody else's text in a message: printable, and cut where it would swamp it.
pub fn quoted(text: &str) -> String {
    cut(text, LONGEST_QUOTE)
}

/// What begins a formula; some spreadsheets take the wide letters of East Asia for the same.
#[cfg(feature = "app")]
const FORMULA: [char; 8] = ['=', '+', '-', '@', '＝', '＋', '－', '＠'];

/// A printable cell of CSV that no spreadsheet takes for a formula.
#[cfg(feature = "app")]
pub fn cell(text: &str) -> String {
    let text = printable(text);
    let is_formula = text.trim_start().starts_with(FORMULA) && text.parse::<f64>().is_err();
    if is_formula { format!("'{text}") } else { text.into_owned() }
}

/// Text that Markdown shows as it stands: no links, images, tables, or tags.
#[cfg(feature = "app")]
pub fn markdown(text: &str) -> String {
    let mut shown = String::with_capacity(text.len());
    for c in printable(text).chars() {
        match c {
            '<' => shown.push_str("&lt;"),
            '&' => shown.push_str("&amp;"),
            '|' | '[' | ']' | '!' | '*' | '`' | '\\' | '#' | '~' => shown.extend(['\\', c]),
            _ => shown.push(c),
        }
    }
    // An address is made a link even where it stands bare.
    shown.replace("://", "&#58;//").replace("www.", "www&#46;").replace('@', "&#64;")
}

/// A whole message of one line, printable and bounded.
pub fn message(text: &str) -> String {
    cut(text, LONGEST_MESSAGE)
}

fn cut(text: &str, most: usize) -> String {
    match text.char_indices().nth(most) {
        Some((at, _)) => {
            let more = text[at..].chars().count();
            format!("{}... ({more} characters more)", printable(&text[..at]))
        }
        None => printable(text).into_owned(),
    }
}

/// A complaint of several lines: the first ones, and how many more there are.
pub fn lines(each: impl ExactSizeIterator<Item = String>) -> String {
    let more = each.len().saturating_sub(MAX_LINES);
    let mut text = each.take(MAX_LINES).collect::<Vec<_>>().join("\n");
    if more > 0 {
        let _ = write!(text, "\n... and {more} more like these");
    }
    text
}

/// Writes JSON of several lines, with its escapes for what is not printable: it reads as it was.
#[cfg(feature = "app")]
pub fn write_json(
    out: &mut dyn std::io::Write,
    value: &impl serde::Serialize,
) -> std::io::Result<()> {
    let json = serde_json::to_string_pretty(value)?;
    // Beyond strings JSON is ASCII, and its own line ends are the only control characters left.
    let written = escaped(
        &json,
        |c| c == '\n',
        |c, text| {
            for unit in c.encode_utf16(&mut [0; 2]) {
                let _ = write!(text, "\\u{unit:04x}");
            }
        },
    );
    writeln!(out, "{written}")
}

#[cfg(all(test, feature = "app"))]
mod tests {
    use super::*;

    /// Every character that the terminal or the reader could be fooled by.
    fn hostile() -> impl Iterator<Item = char> {
        let single = "\u{ad}\u{34f}\u{61c}\u{17b4}\u{17b5}\u{2800}\u{feff}\u{a0}\u{1680}\u{3000}\u{16fe4}\u{1d159}";
        ('\0'..='\u{1f}')
            .chain('\u{7f}'..='\u{9f}')
            .chain('\u{180b}'..='\u{180f}')
            .chain('\u{2000}'..='\u{200f}')
            .chain('\u{2028}'..='\u{202f}')
            .chain('\u{205f}'..='\u{206f}')
            .chain('\u{fe00}'..='\u{fe0f}')
            .chain('\u{fff0}'..='\u{fffb}')
            .chain('\u{13430}'..='\u{1343f}')
            .chain('\u{1bca0}'..='\u{1bca3}')
            .chain('\u{e0000}'..='\u{e007f}')
            .chain('\u{e0100}'..='\u{e01ef}')
            .chain(single.chars())
    }

    #[test]
    fn nothing_that_a_terminal_obeys_or_hides_gets_through() {
        for c in hostile() {
            let text = format!("a{c}b");
            assert!(!printable(&text).contains(c), "{:x}", u32::from(c));
            let kept = matches!(c, '\n' | '\t');
            assert_eq!(printable_lines(&text).contains(c), kept, "{:x}", u32::from(c));
        }
        assert_eq!(printable("a\u{1b}[31m\n"), "a\\u{1b}[31m\\n");
    }

    #[test]
    fn every_language_stays_as_it_is_and_a_pile_of_marks_is_written_out() {
        let all =
            "300 N for 0.2 ms;Größe µm ≥ ±;ק\u{5b8}\u{5bc}\u{5b2};e\u{302}\u{323};कि;眼球;العين;🎾";
        for text in all.split(';') {
            assert_eq!(printable(text), text);
        }
        let pile = format!("a{}b", "\u{301}".repeat(50));
        assert_eq!(printable(&pile).matches('\u{301}').count(), MAX_MARKS);
    }

    #[test]
    fn no_spreadsheet_takes_text_for_a_formula_and_numbers_stay() {
        let formulas = "=cmd|' /C calc'!A0;+1+1;-2+3;@SUM(A1); =1;\t=1;＝1+1;＋1+1;－2+3;＠SUM(A1)";
        for text in formulas.split(';') {
            let cell = cell(text);
            assert!(cell.starts_with(['\'', '\\']), "{cell}");
        }
        for text in ["-2.5", "+3", "1e-5", "a=b", "bb-62"] {
            assert_eq!(cell(text), text);
        }
    }

    #[test]
    fn no_link_image_or_tag_gets_into_markdown() {
        let texts = "![x](http://a.example/y.png);[x](javascript:alert);<img src=x>;https://a.example;\
                     www.a.example;me@a.example;a | b;`rm`";
        for text in texts.split(';') {
            let shown = markdown(text);
            for live in ["](", "<", "://", "www.", "@", " |", " `", "!["] {
                let live_at = shown.match_indices(live).any(|(at, _)| !shown[..at].ends_with('\\'));
                assert!(!live_at, "{live} in {shown}");
            }
        }
        assert_eq!(markdown("300 N for 0.2 ms; 9.5 %"), "300 N for 0.2 ms; 9.5 %");
    }

    #[test]
    fn long_text_is_cut_with_a_count() {
        let said = quoted(&"é".repeat(500));
        assert_eq!(said, format!("{}... (440 characters more)", "é".repeat(60)));
        assert_eq!(quoted("short"), "short");
        let said = lines((0..5000).map(|i| format!("{i} is wrong")));
        assert_eq!(said.lines().count(), MAX_LINES + 1);
        assert!(said.ends_with("... and 4980 more like these"), "{said}");
        assert_eq!(lines((1..3).map(|i| i.to_string())), "1\n2");
    }

    #[test]
    fn json_is_safe_to_print_and_reads_back_as_it_was() {
        let text: String = hostile().chain("\"\\é🎾".chars()).collect();
        let mut printed = Vec::new();
        write_json(&mut printed, &vec![&text]).unwrap();
        let printed = String::from_utf8(printed).unwrap();
        assert!(hostile().filter(|c| *c != '\n').all(|c| !printed.contains(c)), "{printed}");
        assert_eq!(serde_json::from_str::<Vec<String>>(&printed).unwrap(), [text]);
    }
}
