//! Where in a RON text the value of a field stands.
//!
//! A range error is found after reading, when the reader no longer knows where the value came
//! from. This walks the text again, without recursion, so that no nesting can exhaust the stack.
//!
//! The text is known to parse, so nothing is checked here; on other text the walk still ends and
//! gives some place inside it.

use std::iter::Peekable;
use std::str::CharIndices;

/// Line and column (from 1, in characters) of the value at a dotted path, or of its deepest
/// ancestor that the text holds. Variant names are passed through: `impact.force_n` is found
/// inside `impact: ForcePulse(...)`.
pub fn locate(text: &str, path: &str) -> (usize, usize) {
    // Doubts are a map by paths in quotes.
    match path.strip_prefix("doubt.") {
        Some(of) => line_and_column(text, offset_of(text, ["doubt", of])),
        None => line_and_column(text, offset_of(text, path.split('.'))),
    }
}

/// Whether there is nothing but white space and comments.
#[cfg(feature = "app")]
pub(crate) fn is_blank(text: &str) -> bool {
    Walk::new(text).here() == text.len()
}

fn offset_of<'a>(text: &str, path: impl IntoIterator<Item = &'a str>) -> usize {
    let mut walk = Walk::new(text);
    walk.skip_attributes();
    let mut found = walk.here();
    for segment in path {
        if !walk.enter() || !walk.find(segment) {
            break;
        }
        found = walk.here();
    }
    found
}

fn line_and_column(text: &str, offset: usize) -> (usize, usize) {
    let before = &text[..offset];
    let line_start = before.rfind('\n').map_or(0, |at| at + 1);
    (before.matches('\n').count() + 1, before[line_start..].chars().count() + 1)
}

/// What the text is made of, as far as nesting is concerned.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Token {
    Open,
    Close,
    Comma,
    Colon,
    /// A name, from byte to byte; a raw name without its `r#`, one in quotes without these.
    Name(usize, usize),
    /// A number, a string, a character: nothing to look into.
    Other,
}

struct Walk<'a> {
    text: &'a str,
    chars: Peekable<CharIndices<'a>>,
}

impl<'a> Walk<'a> {
    fn new(text: &'a str) -> Self {
        Self { text, chars: text.char_indices().peekable() }
    }

    fn offset(&mut self) -> usize {
        self.chars.peek().map_or(self.text.len(), |(at, _)| *at)
    }

    /// The offset of the next token.
    fn here(&mut self) -> usize {
        self.skip_gaps();
        self.offset()
    }

    fn jump(&mut self, offset: usize) {
        while self.chars.next_if(|(at, _)| *at < offset).is_some() {}
    }

    /// Passes `#![enable(...)]` lines.
    fn skip_attributes(&mut self) {
        while self.here() < self.text.len() && self.text[self.offset()..].starts_with('#') {
            let end = self.text[self.offset()..].find(']').map_or(self.text.len(), |at| at + 1);
            let target = self.offset() + end;
            self.jump(target);
        }
    }

    /// Passes the name of a struct or variant and its opening bracket.
    fn enter(&mut self) -> bool {
        loop {
            match self.token() {
                Some(Token::Name(..)) => {}
                token => return token == Some(Token::Open),
            }
        }
    }

    /// Stops before the value of the named field of the struct just entered.
    fn find(&mut self, field: &str) -> bool {
        let mut depth = 0_usize;
        let mut last = None;
        while let Some(token) = self.token() {
            match token {
                Token::Open => depth += 1,
                Token::Close if depth == 0 => return false,
                Token::Close => depth -= 1,
                Token::Colon if depth == 0 => {
                    if let Some(Token::Name(start, end)) = last
                        && &self.text[start..end] == field
                    {
                        return true;
                    }
                }
                Token::Comma | Token::Colon | Token::Name(..) | Token::Other => {}
            }
            last = Some(token);
        }
        false
    }

    fn token(&mut self) -> Option<Token> {
        self.skip_gaps();
        let (start, first) = self.chars.next()?;
        Some(match first {
            '(' | '[' | '{' => Token::Open,
            ')' | ']' | '}' => Token::Close,
            ',' => Token::Comma,
            ':' => Token::Colon,
            '"' => {
                self.quoted('"');
                Token::Name(start + 1, self.offset().saturating_sub(1))
            }
            '\'' => self.quoted('\''),
            c if c.is_alphanumeric() || matches!(c, '_' | '+' | '-' | '.') => {
                self.word(start, first)
            }
            _ => Token::Other,
        })
    }

    /// A name or a number; or a string, if the word turns out to be its prefix.
    fn word(&mut self, start: usize, first: char) -> Token {
        let part = |c: char| c.is_alphanumeric() || matches!(c, '_' | '+' | '-' | '.');
        while self.chars.next_if(|(_, c)| part(*c)).is_some() {}
        let end = self.offset();
        let next = self.chars.peek().map(|(_, c)| *c);
        match (&self.text[start..end], next) {
            ("b", Some('"')) => self.prefixed('"'),
            ("b", Some('\'')) => self.prefixed('\''),
            ("r" | "br", Some('"' | '#')) => self.raw(),
            _ if first.is_alphabetic() || first == '_' => Token::Name(start, end),
            _ => Token::Other,
        }
    }

    fn prefixed(&mut self, quote: char) -> Token {
        self.chars.next();
        self.quoted(quote)
    }

    /// The rest of a string or character, after its opening quote.
    fn quoted(&mut self, quote: char) -> Token {
        while let Some((_, c)) = self.chars.next() {
            if c == '\\' {
                self.chars.next();
            } else if c == quote {
                break;
            }
        }
        Token::Other
    }

    /// The rest of `r#"..."#` or of `r#name`, after the `r`.
    fn raw(&mut self) -> Token {
        let mut hashes = 0;
        while self.chars.next_if(|(_, c)| *c == '#').is_some() {
            hashes += 1;
        }
        if self.chars.next_if(|(_, c)| *c == '"').is_none() {
            let start = self.offset();
            while self.chars.next_if(|(_, c)| c.is_alphanumeric() || *c == '_').is_some() {}
            return Token::Name(start, self.offset());
        }
        while let Some((_, c)) = self.chars.next() {
            let closes = |walk: &mut Self| {
                (0..hashes).all(|_| walk.chars.next_if(|(_, c)| *c == '#').is_some())
            };
            if c == '"' && closes(self) {
                break;
            }
        }
        Token::Other
    }

    /// Passes white space and comments.
    fn skip_gaps(&mut self) {
        loop {
            while self.chars.next_if(|(_, c)| c.is_whitespace()).is_some() {}
            let rest = &self.text[self.offset()..];
            if rest.starts_with("//") {
                while self.chars.next_if(|(_, c)| *c != '\n').is_some() {}
            } else if rest.starts_with("/*") {
                self.skip_block();
            } else {
                return;
            }
        }
    }

    /// Block comments nest, so their depth is counted.
    fn skip_block(&mut self) {
        let mut depth = 0_usize;
        while let Some((_, c)) = self.chars.next() {
            let next = self.chars.peek().map(|(_, c)| *c);
            match (c, next) {
                ('/', Some('*')) => depth += 1,
                ('*', Some('/')) => depth -= 1,
                _ => continue,
            }
            self.chars.next();
            if depth == 0 {
                return;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The text with a mark before the expected place, which is taken out first.
    fn assert_found(path: &str, marked: &str) {
        let offset = marked.find('@').unwrap();
        let text = marked.replacen('@', "", 1);
        assert_eq!(locate(&text, path), line_and_column(&text, offset), "{path} in {text}");
    }

    #[test]
    fn values_are_found_through_variants_and_nested_structs() {
        let path = "impact.force_n";
        assert_found(path, "(name: \"a\", impact: ForcePulse(duration_ms: 1, force_n: @-5))");
        assert_found(
            path,
            "Scenario(\n  eye: (force_n: 1),\n  impact:\n ForcePulse(force_n:@ 5)"
                .replace(":@ ", ": @")
                .as_str(),
        );
        assert_found("impact.shape.edge_fraction", "(impact: F(shape: S (edge_fraction: @9, ), ))");
        assert_found("eye.filament_hops", "(eye: (lens: true, filament_hops: @[1, 2], level: 1))");
        assert_found("r", "#![enable(implicit_some)]\n#![enable(unwrap_newtypes)] (r#r: @1)");
    }

    #[test]
    fn what_looks_like_a_field_inside_text_or_comments_is_passed_over() {
        assert_found("a", "(b: \"a: 1, \\\" a: 2)\", a: @3)");
        assert_found("a", "(b: r#\"a: 1\" a: 2\"#, a: @3)");
        assert_found("a", "(b: r\"\\\", a: @3)");
        assert_found("a", "(b: '\"', c: '\\'', d: b'(', e: b\"(\", a: @3)");
        assert_found("a", "/* ( /* a: 1 */ ( */ (// a: 2, (\n a /* : 4 */ : /**/ @3)");
        assert_found("a", "(b: [a, (a: 1)], c: {\"a\": 2}, a: @3)");
        assert_found("a", "(ä: \"é€\", a: @3)");
    }

    #[test]
    fn a_field_that_is_not_there_falls_back_to_what_holds_it() {
        assert_found("eye.level", "(impact: F(level: 1), eye: @(lens: true))");
        assert_found("eye.level", "(eye: @3, level: 4)");
        assert_found("window_ms", " // x\n @(name: \"a\")");
        assert_eq!(locate("", "a.b"), (1, 1));
    }

    #[test]
    fn deep_nesting_and_unfinished_text_end_quietly() {
        let deep = format!("(a: {}", "(".repeat(100_000));
        assert_eq!(locate(&deep, "b"), (1, 1));
        assert_eq!(locate(&"/*".repeat(100_000), "b").0, 1);
        for text in ["(a: \"", "(a: r##\"x\"#", "(a: '", "#![", "/*", "(a: '\\"] {
            locate(text, "b");
        }
    }
}
