//! Bytes from the terminal to keys, pastes and replies.
//!
//! A sequence may arrive in pieces, so the parser keeps what is unfinished; [`Parser::flush`] says
//! that nothing more came, which makes a lone ESC the Escape key. Unknown sequences are dropped
//! whole, so no reply of a terminal is ever taken for a key. Kept by hand, in 300 lines, for the
//! replies: crossterm hides those to a question for the cursor's place from whoever reads its
//! events, and the pacer lives by them.

use std::time::Duration;

use crossterm::event::{KeyCode, KeyEvent, KeyModifiers, MouseEvent};

use crate::tui::terminal::mouse;

/// Something that the terminal sent.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum TerminalInput {
    /// A key.
    Key(KeyEvent),
    /// Pasted text.
    Paste(String),
    /// The mouse did something.
    Mouse(MouseEvent),
    /// The reply to a question for the cursor's place, with its column.
    CursorReport(u8),
}

/// A paste beyond this is cut: no field takes so much.
const LONGEST_PASTE: usize = 4096;
/// No sequence of keys is longer; anything beyond is rubbish.
const LONGEST_SEQUENCE: usize = 64;
/// A lone ESC becomes a key after this long. A slow link may split a sequence between two packets.
const ESCAPE_PATIENCE: Duration = Duration::from_millis(50);
/// A paste whose end does not come, as when the link loses it, is over after this long.
const PASTE_PATIENCE: Duration = Duration::from_secs(1);
const PASTE_END: &[u8] = b"\x1b[201~";

/// Takes bytes and gives inputs.
#[derive(Debug, Default)]
pub struct Parser {
    held: Vec<u8>,
    pasted: Option<Vec<u8>>,
}

/// What the held bytes begin with.
enum Parsed {
    Unfinished,
    Dropped(usize),
    Found(usize, TerminalInput),
    PasteBegins(usize),
}

impl Parser {
    /// Takes bytes as they came and gives everything that is complete.
    pub fn feed(&mut self, bytes: &[u8]) -> Vec<TerminalInput> {
        let mut inputs = Vec::new();
        for &byte in bytes {
            if let Some(pasted) = &mut self.pasted {
                pasted.push(byte);
                if pasted.ends_with(PASTE_END) {
                    pasted.truncate(pasted.len() - PASTE_END.len());
                    inputs.push(paste(std::mem::take(pasted)));
                    self.pasted = None;
                } else if pasted.len() > 2 * LONGEST_PASTE {
                    // Keep the tail, which may hold the beginning of the end mark.
                    pasted.drain(LONGEST_PASTE..pasted.len() - PASTE_END.len());
                }
                continue;
            }
            self.held.push(byte);
            self.drain(&mut inputs);
        }
        inputs
    }

    /// Whether something is unfinished.
    pub fn is_waiting(&self) -> bool {
        !self.held.is_empty() || self.pasted.is_some()
    }

    /// How long after the last byte what is unfinished counts as all there is.
    pub fn patience(&self) -> Duration {
        if self.pasted.is_some() { PASTE_PATIENCE } else { ESCAPE_PATIENCE }
    }

    /// Nothing more came: a lone ESC is a key, a paste is over, any other remainder is dropped.
    pub fn flush(&mut self) -> Option<TerminalInput> {
        if let Some(pasted) = self.pasted.take() {
            return Some(paste(pasted));
        }
        let held = std::mem::take(&mut self.held);
        match held.as_slice() {
            [0x1b] => Some(key(KeyCode::Esc, KeyModifiers::NONE)),
            [0x1b, b'['] => Some(key(KeyCode::Char('['), KeyModifiers::ALT)),
            [0x1b, b'O'] => Some(key(KeyCode::Char('O'), KeyModifiers::ALT)),
            _ => None,
        }
    }

    fn drain(&mut self, inputs: &mut Vec<TerminalInput>) {
        while !self.held.is_empty() {
            let used = match parse(&self.held) {
                Parsed::Unfinished if self.held.len() < LONGEST_SEQUENCE => return,
                Parsed::Unfinished if is_string(&self.held) => {
                    // However long, it is none of our keys: the last byte may begin its end.
                    self.held.drain(2..self.held.len() - 1);
                    return;
                }
                Parsed::Unfinished => self.held.len(),
                Parsed::Dropped(used) => used,
                Parsed::Found(used, input) => {
                    inputs.push(input);
                    used
                }
                Parsed::PasteBegins(used) => {
                    self.pasted = Some(Vec::new());
                    used
                }
            };
            self.held.drain(..used);
        }
    }
}

fn paste(mut bytes: Vec<u8>) -> TerminalInput {
    bytes.truncate(LONGEST_PASTE);
    TerminalInput::Paste(String::from_utf8_lossy(&bytes).into_owned())
}

fn key(code: KeyCode, modifiers: KeyModifiers) -> TerminalInput {
    TerminalInput::Key(KeyEvent::new(code, modifiers))
}

/// Whether these bytes begin an OSC, DCS, APC or PM, which run to ST or BEL.
fn is_string(held: &[u8]) -> bool {
    matches!(held, [0x1b, b']' | b'P' | b'_' | b'^', ..])
}

fn parse(held: &[u8]) -> Parsed {
    match held {
        [0x1b] | [0x1b, b'[' | b'O'] | [0x1b, b'[', b'['] => Parsed::Unfinished,
        // The console of Linux sends its first five function keys in a way of its own.
        [0x1b, b'[', b'[', last, ..] => match last {
            b'A'..=b'E' => Parsed::Found(4, key(KeyCode::F(last - b'A' + 1), KeyModifiers::NONE)),
            _ => Parsed::Dropped(4),
        },
        [0x1b, b'[', rest @ ..] => csi(rest),
        [0x1b, b'O', last, ..] => match function_key(*last) {
            Some(code) => Parsed::Found(3, key(code, KeyModifiers::NONE)),
            None => Parsed::Dropped(3),
        },
        [_, _, rest @ ..] if is_string(held) => {
            let end = rest.iter().enumerate().find_map(|(i, byte)| match byte {
                0x07 => Some(i + 3),
                b'\\' if i > 0 && rest[i - 1] == 0x1b => Some(i + 3),
                _ => None,
            });
            end.map_or(Parsed::Unfinished, Parsed::Dropped)
        }
        // Two presses of Escape, or Escape before a sequence.
        [0x1b, 0x1b, ..] => Parsed::Found(1, key(KeyCode::Esc, KeyModifiers::NONE)),
        [0x1b, rest @ ..] => match character(rest) {
            Parsed::Found(used, TerminalInput::Key(event)) => {
                let held = event.modifiers | KeyModifiers::ALT;
                Parsed::Found(used + 1, key(event.code, held))
            }
            other => other,
        },
        _ => character(held),
    }
}

fn character(held: &[u8]) -> Parsed {
    let found = |code, modifiers| Parsed::Found(1, key(code, modifiers));
    let ctrl = |byte| found(KeyCode::Char(char::from(byte)), KeyModifiers::CONTROL);
    let none = KeyModifiers::NONE;
    match held[0] {
        b'\r' | b'\n' => found(KeyCode::Enter, none),
        b'\t' => found(KeyCode::Tab, none),
        0x7f | 0x08 => found(KeyCode::Backspace, none),
        0 => ctrl(b' '),
        byte @ 1..=26 => ctrl(byte - 1 + b'a'),
        byte @ 0x1c..=0x1f => ctrl(byte - 0x1c + b'4'),
        byte @ 0x20..=0x7e => found(KeyCode::Char(char::from(byte)), none),
        byte => {
            let length = match byte {
                0xc2..=0xdf => 2,
                0xe0..=0xef => 3,
                0xf0..=0xf4 => 4,
                _ => return Parsed::Dropped(1),
            };
            let Some(bytes) = held.get(..length) else {
                return if held[1..].iter().all(|b| (0x80..0xc0).contains(b)) {
                    Parsed::Unfinished
                } else {
                    Parsed::Dropped(1)
                };
            };
            let text = std::str::from_utf8(bytes).unwrap_or_default();
            match text.chars().next() {
                Some(c) => Parsed::Found(length, key(KeyCode::Char(c), none)),
                None => Parsed::Dropped(1),
            }
        }
    }
}

/// A control sequence, after its `ESC [`.
fn csi(rest: &[u8]) -> Parsed {
    let Some(end) = rest.iter().position(|byte| (0x40..=0x7e).contains(byte)) else {
        let broken = rest.iter().position(|byte| !(0x20..=0x3f).contains(byte));
        return broken.map_or(Parsed::Unfinished, |at| Parsed::Dropped(at + 2));
    };
    if let Some(broken) = rest[..end].iter().position(|b| !(0x20..=0x3f).contains(b)) {
        return Parsed::Dropped(broken + 2);
    }
    let used = end + 3;
    let private = (0x3c..=0x3f).contains(&rest[0]);
    if private {
        let report = rest[..end].strip_prefix(b"<");
        let event = report.and_then(|numbers| mouse::report(numbers, rest[end]));
        return match event {
            Some(event) => Parsed::Found(used, TerminalInput::Mouse(event)),
            None => Parsed::Dropped(used),
        };
    }
    let text = String::from_utf8_lossy(&rest[..end]);
    let numbers = text.split(';').map(|part| part.parse().unwrap_or(0));
    let numbers: Vec<u8> = numbers.collect();
    let modifiers = numbers.get(1).map_or(KeyModifiers::NONE, |&n| held_keys(n));
    let code = match (rest[end], numbers.first()) {
        // A report has a row and a column; F3 with modifiers looks the same and is given up.
        (b'R', _) if numbers.len() == 2 => {
            return Parsed::Found(used, TerminalInput::CursorReport(numbers[1]));
        }
        (b'~', Some(200)) => return Parsed::PasteBegins(used),
        (b'~', Some(&number)) => tilde_key(number),
        (b'Z', _) => Some(KeyCode::BackTab),
        (last, _) => function_key(last),
    };
    match code {
        Some(code) => Parsed::Found(used, key(code, modifiers)),
        None => Parsed::Dropped(used),
    }
}

/// The modifiers of `ESC [ 1 ; n A`.
fn held_keys(number: u8) -> KeyModifiers {
    let bits = number.saturating_sub(1);
    let all = [KeyModifiers::SHIFT, KeyModifiers::ALT, KeyModifiers::CONTROL];
    let held = all.into_iter().enumerate();
    let held = held.filter(|(bit, _)| bits >> bit & 1 == 1);
    held.map(|(_, modifier)| modifier).collect()
}

fn function_key(last: u8) -> Option<KeyCode> {
    Some(match last {
        b'A' => KeyCode::Up,
        b'B' => KeyCode::Down,
        b'C' => KeyCode::Right,
        b'D' => KeyCode::Left,
        b'F' => KeyCode::End,
        b'H' => KeyCode::Home,
        b'M' => KeyCode::Enter,
        b'P'..=b'S' => KeyCode::F(last - b'P' + 1),
        _ => return None,
    })
}

fn tilde_key(number: u8) -> Option<KeyCode> {
    Some(match number {
        1 | 7 => KeyCode::Home,
        2 => KeyCode::Insert,
        3 => KeyCode::Delete,
        4 | 8 => KeyCode::End,
        5 => KeyCode::PageUp,
        6 => KeyCode::PageDown,
        11..=15 => KeyCode::F(number - 10),
        17..=21 => KeyCode::F(number - 11),
        23 | 24 => KeyCode::F(number - 12),
        _ => return None,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;
    use proptest::test_runner::RngSeed;

    fn keys(bytes: &[u8]) -> Vec<TerminalInput> {
        Parser::default().feed(bytes)
    }

    fn plain(code: KeyCode) -> TerminalInput {
        key(code, KeyModifiers::NONE)
    }

    #[test]
    fn keys_are_read_with_their_modifiers() {
        let shift = KeyModifiers::SHIFT;
        let held = |c, modifiers| key(KeyCode::Char(c), modifiers);
        let f = |n| plain(KeyCode::F(n));
        let (up, down) = (plain(KeyCode::Up), plain(KeyCode::Down));
        let (page, back) = (plain(KeyCode::PageUp), plain(KeyCode::BackTab));
        for (bytes, expected) in [
            ("a", vec![plain(KeyCode::Char('a'))]),
            ("é", vec![plain(KeyCode::Char('é'))]),
            ("\x1b[A\x1bOB", vec![up, down]),
            ("\x1b[1;2C", vec![key(KeyCode::Right, shift)]),
            ("\x1b[5~\x1b[Z", vec![page, back]),
            ("\x03", vec![held('c', KeyModifiers::CONTROL)]),
            ("\x1bOP\x1b[[B\x1b[13~\x1b[17~", vec![f(1), f(2), f(3), f(6)]),
            ("\x1bx", vec![held('x', KeyModifiers::ALT)]),
            ("\r", vec![plain(KeyCode::Enter)]),
        ] {
            assert_eq!(keys(bytes.as_bytes()), expected, "{bytes:?}");
        }
    }

    #[test]
    fn a_lone_escape_is_a_key_only_when_nothing_follows() {
        let mut parser = Parser::default();
        assert!(parser.feed(b"\x1b").is_empty() && parser.is_waiting());
        assert_eq!(parser.flush(), Some(plain(KeyCode::Esc)));
        assert!(parser.feed(b"\x1b").is_empty());
        assert_eq!(parser.feed(b"[D"), [plain(KeyCode::Left)]);
        assert!(!parser.is_waiting());
    }

    #[test]
    fn replies_are_never_taken_for_keys() {
        assert_eq!(keys(b"\x1b[12;40R"), [TerminalInput::CursorReport(40)]);
        for reply in [
            "\x1b[?2026;2$y",
            "\x1b[?62;4c",
            "\x1b[0n",
            "\x1b]11;rgb:0000/0000/0000\x1b\\",
            "\x1b]11;rgb:0000/0000/0000\x07",
            "\x1bP>|XTerm(380)\x1b\\",
            "\x1b[I",
            "\x1b[<35;10;10M",
        ] {
            let mut parser = Parser::default();
            assert_eq!(parser.feed(reply.as_bytes()), [], "{reply:?}");
            assert_eq!(parser.feed(b"x"), [plain(KeyCode::Char('x'))], "{reply:?}");
        }
    }

    #[test]
    fn a_reply_of_any_length_is_dropped_whole() {
        for end in ["\x07", "\x1b\\"] {
            for letters in 50..80 {
                let reply = format!("\x1b]52;c;{}{end}x", "q".repeat(letters));
                assert_eq!(keys(reply.as_bytes()), [plain(KeyCode::Char('x'))]);
            }
            let reply = format!("\x1bP1+r{}{end}", "q".repeat(100_000));
            assert_eq!(keys(reply.as_bytes()), []);
        }
    }

    #[test]
    fn pasted_text_comes_as_one_piece_without_its_marks() {
        let mut parser = Parser::default();
        assert!(parser.feed(b"\x1b[200~4\x1b[A5").is_empty());
        assert_eq!(parser.feed(b"0\x1b[201~q").len(), 2);
        let inputs = keys(b"\x1b[200~450\x1b[201~");
        assert_eq!(inputs, [TerminalInput::Paste("450".to_owned())]);
        let mut long = b"\x1b[200~".to_vec();
        long.extend(vec![b'x'; 100_000]);
        long.extend(PASTE_END);
        let inputs = keys(&long);
        assert!(matches!(&inputs[..], [TerminalInput::Paste(text)] if text.len() == LONGEST_PASTE));
    }

    #[test]
    fn a_paste_that_never_ends_is_over_after_a_silence_and_keys_are_keys_again() {
        let mut parser = Parser::default();
        assert!(parser.feed(b"\x1b[200~450").is_empty());
        assert!(parser.is_waiting() && parser.patience() == PASTE_PATIENCE);
        assert_eq!(parser.flush(), Some(TerminalInput::Paste("450".to_owned())));
        assert!(!parser.is_waiting());
        assert_eq!(parser.feed(b"q"), [plain(KeyCode::Char('q'))]);
    }

    proptest! {
        #![proptest_config(ProptestConfig {
            rng_seed: RngSeed::Fixed(1),
            failure_persistence: None,
            ..ProptestConfig::default()
        })]
        #[test]
        fn any_bytes_in_any_pieces_give_the_same_and_end(bytes in prop::collection::vec(any::<u8>(), 0..200), cut in 0usize..200) {
            let whole = keys(&bytes);
            let (head, tail) = bytes.split_at(cut.min(bytes.len()));
            let mut parser = Parser::default();
            let mut pieces = parser.feed(head);
            pieces.extend(parser.feed(tail));
            prop_assert_eq!(whole, pieces);
            prop_assert!(parser.held.len() <= LONGEST_SEQUENCE);
        }
    }
}
