//! Reports of the mouse: how they are asked for, and what they say.
//!
//! Only presses, drags and the wheel are asked for. A mouse that merely moves sends nothing.

use crossterm::event::{KeyModifiers, MouseButton, MouseEvent, MouseEventKind};

/// Asks for presses and drags, with coordinates of any size.
#[cfg(unix)]
pub const ON: &[u8] = b"\x1b[?1002h\x1b[?1006h";
/// Asks for nothing any more.
#[cfg(unix)]
pub const OFF: &[u8] = b"\x1b[?1002l\x1b[?1006l";

/// The event of `ESC [ < button ; column ; row M`, given what stands between `<` and the last
/// letter. Buttons that mean nothing to the app give nothing.
pub fn report(numbers: &[u8], last: u8) -> Option<MouseEvent> {
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
    let shift = button & 0b100 != 0;
    Some(MouseEvent {
        kind,
        // Terminals count from one.
        column: column.checked_sub(1)?,
        row: row.checked_sub(1)?,
        modifiers: if shift { KeyModifiers::SHIFT } else { KeyModifiers::NONE },
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use MouseButton::Left;
    use MouseEventKind::{Down, Drag, ScrollDown, ScrollUp, Up};

    #[test]
    fn reports_are_read_and_others_are_nothing() {
        let read = |text: &str| {
            let (numbers, last) = text.split_at(text.len() - 1);
            report(numbers.as_bytes(), last.as_bytes()[0]).map(|e| (e.kind, e.column, e.row))
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
}
