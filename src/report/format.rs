//! Numbers and lines for people: digits, percent, and text in lines of 80 columns.

use std::io::{self, Write};

use unicode_width::UnicodeWidthStr;

/// A number with four significant digits, in plain notation where that is readable.
pub fn significant(value: f64) -> String {
    digits(value, 4)
}

/// A number with `count` significant digits, in plain notation where that is readable.
pub fn digits(value: f64, count: i32) -> String {
    let size = value.abs();
    if value == 0.0 {
        "0".to_owned()
    } else if !(1e-4..1e6).contains(&size) {
        let after = (count - 1) as usize;
        format!("{value:.after$e}")
    } else {
        let after = (count - 1 - size.log10().floor() as i32).max(0) as usize;
        format!("{value:.after$}")
    }
}

/// A number with four significant digits, but no zeros at the end of what follows its point.
pub fn trimmed(value: f64) -> String {
    let text = significant(value);
    if text.contains('.') && !text.contains('e') {
        return text.trim_end_matches('0').trim_end_matches('.').to_owned();
    }
    text
}

/// An error in percent: two digits are all it can bear.
pub fn percent(value: f64) -> String {
    match value {
        0.0 => "0 %".to_owned(),
        v if v < 1e-4 => "< 0.0001 %".to_owned(),
        v if v < 10.0 => {
            let digits = (1 - v.log10().floor() as i32).max(0) as usize;
            format!("{v:.digits$} %")
        }
        v => format!("{v:.0} %"),
    }
}

/// A figure as it is written; a dash where it is not known.
pub(super) fn or_dash(figure: Option<f64>, written: impl FnOnce(f64) -> String) -> String {
    figure.map_or_else(|| "-".to_owned(), written)
}

pub(super) const WIDTH: usize = 80;

/// `text` in lines of at most `width` cells, broken between words but not before a percent sign.
pub fn wrapped(text: &str, width: usize) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    let held = text.replace(" %", "\u{a0}%");
    for word in held.split_ascii_whitespace() {
        let word = word.replace('\u{a0}', " ");
        match lines.last_mut() {
            Some(line) if line.width() + 1 + word.width() <= width => {
                line.push(' ');
                line.push_str(&word);
            }
            _ => lines.push(word),
        }
    }
    lines
}

/// Prints a text in lines of 80 columns, those that go on indented.
pub(super) fn paragraph(text: &str, out: &mut dyn Write) -> io::Result<()> {
    block(text, "", "    ", out)
}

/// Prints a text in lines of 80 columns, the first and the rest each after its indent.
pub(super) fn block(text: &str, first: &str, rest: &str, out: &mut dyn Write) -> io::Result<()> {
    let mut lines = wrapped(text, WIDTH - rest.len()).into_iter().enumerate();
    lines.try_for_each(|(i, line)| writeln!(out, "{}{line}", if i == 0 { first } else { rest }))
}

/// Values by the keys that they come with, in the order in which keys come first.
pub fn grouped<K: PartialEq, T>(pairs: impl IntoIterator<Item = (K, T)>) -> Vec<(K, Vec<T>)> {
    let mut groups: Vec<(K, Vec<T>)> = Vec::new();
    for (key, value) in pairs {
        match groups.iter_mut().find(|(known, _)| *known == key) {
            Some((_, values)) => values.push(value),
            None => groups.push((key, vec![value])),
        }
    }
    groups
}

pub fn capital(label: &str) -> String {
    let mut letters = label.chars();
    letters.next().map_or_else(String::new, |first| first.to_uppercase().chain(letters).collect())
}

/// A share as whole percent, or finer where it is small.
pub(super) fn share(risk: f64) -> String {
    match 100.0 * risk {
        percent if percent < 0.1 => "< 0.1 %".to_owned(),
        percent if percent < 9.95 => format!("{percent:.1} %"),
        percent => format!("{percent:.0} %"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_carry_four_digits_and_errors_two() {
        let numbers = [26.418_437, 0.004_971_1, 1234.5, 0.0, -2.5e-9].map(significant);
        assert_eq!(numbers, ["26.42", "0.004971", "1234", "0", "-2.500e-9"]);
        let errors = [0.012_34, 3.21, 123.4, 1e-7].map(percent);
        assert_eq!(errors, ["0.012 %", "3.2 %", "123 %", "< 0.0001 %"]);
    }
}
