//! Bytes from the terminal to keys, pastes and replies.
//!
//! A sequence may arrive in pieces, so the parser keeps what is unfinished; [`Parser::flush`] says
//! that nothing more came, which makes a lone ESC the Escape key. Unknown sequences are dropped
//! whole, so no reply of a terminal is ever taken for a key. Kept by hand, in 300 lines, for the
//! replies: crossterm hides those to a question for the cursor's place from whoever reads its
//! events, and the pacer lives by them.

use std::time::Duration;

use crossterm::event::{KeyCode, KeyEvent, KeyModifiers, MouseButton, MouseEvent, MouseEventKind};

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
const PASTE_BEGIN: &[u8] = b"\x1b[200~";
const PASTE_END: &[u8] = b"\x1b[201~";

/// Takes bytes and gives inputs.
#[derive(Debug, Default)]
pub struct Parser {
    held: Vec<u8>,
    pasted: Option<Vec<u8>>,
}

/// How many of the held bytes are done with and what they say; nothing where they are unfinished.
type Parsed<T = TerminalInput> = Option<(usize, Option<T>)>;

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
        match std::mem::take(&mut self.held).as_slice() {
            [0x1b] => Some(plain(KeyCode::Esc)),
            [0x1b, c @ (b'[' | b'O')] => Some(key(KeyCode::Char((*c).into()), KeyModifiers::ALT)),
            _ => None,
        }
    }

    fn drain(&mut self, inputs: &mut Vec<TerminalInput>) {
        while !self.held.is_empty() {
            let used = match parse(&self.held) {
                None if self.held.len() < LONGEST_SEQUENCE => return,
                None if is_string(&self.held) => {
                    // However long, it is none of our keys: the last byte may begin its end.
                    self.held.drain(2..self.held.len() - 1);
                    return;
                }
                None => self.held.len(),
                Some((used, input)) => {
                    inputs.extend(input);
                    used
                }
            };
            if self.held[..used] == *PASTE_BEGIN {
                self.pasted = Some(Vec::new());
            }
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

fn plain(code: KeyCode) -> TerminalInput {
    key(code, KeyModifiers::NONE)
}

/// Whether these bytes begin an OSC, DCS, APC or PM, which run to ST or BEL.
fn is_string(held: &[u8]) -> bool {
    matches!(held, [0x1b, b']' | b'P' | b'_' | b'^', ..])
}

fn parse(held: &[u8]) -> Parsed {
    match held {
        [0x1b] | [0x1b, b'[' | b'O'] | [0x1b, b'[', b'['] => None,
        // The console of Linux sends its first five function keys in a way of its own.
        [0x1b, b'[', b'[', last, ..] => {
            let number = (b'A'..=b'E').contains(last).then(|| last - b'A' + 1);
            Some((4, number.map(|number| plain(KeyCode::F(number)))))
        }
        [0x1b, b'[', rest @ ..] => csi(rest),
        [0x1b, b'O', last, ..] => Some((3, function_key(*last).map(plain))),
        [_, _, rest @ ..] if is_string(held) => {
            let ends = |at: &usize| rest[*at] == 0x07 || rest[..=*at].ends_with(b"\x1b\\");
            (0..rest.len()).find(ends).map(|at| (at + 3, None))
        }
        // Two presses of Escape, or Escape before a sequence.
        [0x1b, 0x1b, ..] => Some((1, Some(plain(KeyCode::Esc)))),
        [0x1b, rest @ ..] => {
            let (used, found) = character(rest)?;
            Some((used + 1, found.map(|(code, held)| key(code, held | KeyModifiers::ALT))))
        }
        _ => character(held).map(|(used, found)| (used, found.map(|(code, held)| key(code, held)))),
    }
}

fn character(held: &[u8]) -> Parsed<(KeyCode, KeyModifiers)> {
    let ctrl = |byte| Some((1, Some((KeyCode::Char(char::from(byte)), KeyModifiers::CONTROL))));
    let (used, code) = match held[0] {
        b'\r' | b'\n' => (1, KeyCode::Enter),
        b'\t' => (1, KeyCode::Tab),
        0x7f | 0x08 => (1, KeyCode::Backspace),
        0 => return ctrl(b' '),
        byte @ 1..=26 => return ctrl(byte - 1 + b'a'),
        byte @ 0x1c..=0x1f => return ctrl(byte - 0x1c + b'4'),
        _ => match std::str::from_utf8(held) {
            Ok(text) => {
                let letter = text.chars().next()?;
                (letter.len_utf8(), KeyCode::Char(letter))
            }
            // An error without a length is a letter whose end is still to come.
            Err(error) => return error.error_len().map(|_| (1, None)),
        },
    };
    Some((used, Some((code, KeyModifiers::NONE))))
}

/// A control sequence, after its `ESC [`.
fn csi(rest: &[u8]) -> Parsed {
    let end = rest.iter().position(|byte| !(0x20..=0x3f).contains(byte))?;
    let (numbers, last, used) = (&rest[..end], rest[end], end + 3);
    if !(0x40..=0x7e).contains(&last) {
        return Some((end + 2, None));
    }
    if matches!(rest[0], 0x3c..=0x3f) {
        let event = numbers.strip_prefix(b"<").and_then(|numbers| mouse_report(numbers, last));
        return Some((used, event.map(TerminalInput::Mouse)));
    }
    let text = String::from_utf8_lossy(numbers);
    let numbers: Vec<u8> = text.split(';').map(|part| part.parse().unwrap_or(0)).collect();
    let modifiers = numbers.get(1).map_or(KeyModifiers::NONE, |&n| held_keys(n));
    let code = match (last, &numbers[..]) {
        // A report has a row and a column; F3 with modifiers looks the same and is given up.
        (b'R', &[_, column]) => return Some((used, Some(TerminalInput::CursorReport(column)))),
        (b'~', [number, ..]) => tilde_key(*number),
        (b'Z', _) => Some(KeyCode::BackTab),
        _ => function_key(last),
    };
    Some((used, code.map(|code| key(code, modifiers))))
}

/// The event of `ESC [ < button ; column ; row M`, given what stands between `<` and the last
/// letter. Buttons that mean nothing to the app give nothing.
fn mouse_report(numbers: &[u8], last: u8) -> Option<MouseEvent> {
    let text = std::str::from_utf8(numbers).ok()?;
    let numbers: Vec<u16> = text.split(';').map(str::parse).collect::<Result<_, _>>().ok()?;
    let [button, column, row] = numbers.try_into().ok()?;
    let kind = match (button & !0b1_1100, last) {
        (0, b'M') => MouseEventKind::Down(MouseButton::Left),
        (0, b'm') => MouseEventKind::Up(MouseButton::Left),
        (32, b'M') => MouseEventKind::Drag(MouseButton::Left),
        (64, b'M') => MouseEventKind::ScrollUp,
        (65, b'M') => MouseEventKind::ScrollDown,
        _ => return None,
    };
    let modifiers = if button & 0b100 != 0 { KeyModifiers::SHIFT } else { KeyModifiers::NONE };
    // Terminals count from one.
    let (column, row) = (column.checked_sub(1)?, row.checked_sub(1)?);
    Some(MouseEvent { kind, column, row, modifiers })
}

/// The modifiers of `ESC [ 1 ; n A`.
fn held_keys(number: u8) -> KeyModifiers {
    let all = [(1, KeyModifiers::SHIFT), (2, KeyModifiers::ALT), (4, KeyModifiers::CONTROL)];
    let held = all.into_iter().filter(|(bit, _)| number.saturating_sub(1) & bit != 0);
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
    use MouseButton::Left;
    use MouseEventKind::{Down, Drag, ScrollDown, ScrollUp, Up};
    use proptest::prelude::*;
    use proptest::test_runner::RngSeed;

    fn keys(bytes: &[u8]) -> Vec<TerminalInput> {
        Parser::default().feed(bytes)
    }

    #[test]
    fn keys_are_read_with_their_modifiers() {
        use KeyCode::{BackTab, Char, Down, Enter, F, PageUp, Right, Up};
        for (bytes, held, codes) in [
            ("a", KeyModifiers::NONE, &[Char('a')][..]),
            ("é", KeyModifiers::NONE, &[Char('é')]),
            ("\x1b[A\x1bOB", KeyModifiers::NONE, &[Up, Down]),
            ("\x1b[1;2C", KeyModifiers::SHIFT, &[Right]),
            ("\x1b[5~\x1b[Z", KeyModifiers::NONE, &[PageUp, BackTab]),
            ("\x03", KeyModifiers::CONTROL, &[Char('c')]),
            ("\x1bOP\x1b[[B\x1b[13~\x1b[17~", KeyModifiers::NONE, &[F(1), F(2), F(3), F(6)]),
            ("\x1bx", KeyModifiers::ALT, &[Char('x')]),
            ("\r", KeyModifiers::NONE, &[Enter]),
        ] {
            let expected: Vec<_> = codes.iter().map(|code| key(*code, held)).collect();
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
            let read = keys(&[reply.as_bytes(), b"x"].concat());
            assert_eq!(read, [plain(KeyCode::Char('x'))], "{reply:?}");
        }
    }

    #[test]
    fn reports_of_the_mouse_are_read_and_others_are_nothing() {
        let read = |text: &str| {
            let (last, numbers) = text.as_bytes().split_last().unwrap();
            mouse_report(numbers, *last).map(|e| (e.kind, e.column, e.row))
        };
        assert_eq!(read("0;1;1M"), Some((Down(Left), 0, 0)));
        assert_eq!(read("0;300;90m"), Some((Up(Left), 299, 89)));
        assert_eq!(read("32;5;6M"), Some((Drag(Left), 4, 5)));
        assert_eq!(read("68;5;6M"), Some((ScrollUp, 4, 5)));
        assert_eq!(read("65;5;6M"), Some((ScrollDown, 4, 5)));
        for other in ["35;10;10M", "2;1;1M", "0;0;1M", "0;1M", "0;1;1;1M", "0;70000;1M", "M"] {
            assert_eq!(read(other), None, "{other}");
        }
    }

    #[test]
    fn a_reply_of_any_length_is_dropped_whole() {
        for end in ["\x07", "\x1b\\"] {
            for letters in 50..80 {
                let reply = format!("\x1b]52;c;{}{end}x", "q".repeat(letters));
                assert_eq!(keys(reply.as_bytes()), [plain(KeyCode::Char('x'))]);
            }
            assert_eq!(keys(format!("\x1bP1+r{}{end}", "q".repeat(100_000)).as_bytes()), []);
        }
    }

    #[test]
    fn pasted_text_comes_as_one_piece_without_its_marks() {
        let mut parser = Parser::default();
        assert!(parser.feed(b"\x1b[200~4\x1b[A5").is_empty());
        assert_eq!(parser.feed(b"0\x1b[201~q").len(), 2);
        let inputs = keys(b"\x1b[200~450\x1b[201~");
        assert_eq!(inputs, [TerminalInput::Paste("450".to_owned())]);
        let inputs = keys(&[PASTE_BEGIN, &vec![b'x'; 100_000], PASTE_END].concat());
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
