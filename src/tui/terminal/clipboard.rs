//! The clipboard of whoever sits at the terminal, by OSC 52: it works over ssh, since the terminal
//! has it.
//!
//! Left out: asking whether the terminal takes it. Most that do not pass over it in silence, and
//! those known to print it get none.

use crossterm::Command;
use crossterm::clipboard::CopyToClipboard;

/// The way to the clipboard.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Clipboard {
    /// There is none.
    None,
    /// Straight.
    Plain,
    /// Through tmux.
    Tmux,
}

/// The way from here, by the environment.
pub fn clipboard(env: impl Fn(&str) -> Option<String>) -> Clipboard {
    let term = env("TERM").unwrap_or_default();
    // Consoles without a clipboard, and real terminals.
    if term == "linux" || term == "dumb" || term.starts_with("vt") {
        Clipboard::None
    } else if env("TMUX").is_some_and(|tmux| !tmux.is_empty()) {
        Clipboard::Tmux
    } else {
        Clipboard::Plain
    }
}

/// The escape sequence that puts a text on the clipboard.
pub fn copied(text: &str, way: Clipboard) -> String {
    let mut plain = String::new();
    // A string takes whatever it is given.
    let _ = CopyToClipboard::to_clipboard_from(text).write_ansi(&mut plain);
    match way {
        Clipboard::None => String::new(),
        Clipboard::Plain => plain,
        // Within a passage through tmux every escape is doubled.
        Clipboard::Tmux => {
            let passed = plain.replace('\x1b', "\x1b\x1b");
            format!("{plain}\x1bPtmux;{passed}\x1b\\")
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_text_goes_out_in_base64_and_through_tmux_both_ways() {
        let plain = copied("a summary\n", Clipboard::Plain);
        assert_eq!(plain, "\x1b]52;c;YSBzdW1tYXJ5Cg==\x1b\\");
        let tmux = copied("a summary\n", Clipboard::Tmux);
        let wrapped = "\x1bPtmux;\x1b\x1b]52;c;YSBzdW1tYXJ5Cg==\x1b\x1b\\\x1b\\";
        assert_eq!(tmux, format!("{plain}{wrapped}"));
    }

    #[test]
    fn consoles_get_none() {
        let way = |term: &str, tmux: &str| {
            clipboard(|name| match name {
                "TERM" => Some(term.to_owned()),
                "TMUX" => Some(tmux.to_owned()),
                _ => None,
            })
        };
        assert_eq!(way("linux", ""), Clipboard::None);
        assert_eq!(way("vt100", ""), Clipboard::None);
        assert_eq!(way("xterm-256color", ""), Clipboard::Plain);
        assert_eq!(way("tmux-256color", "/tmp/tmux"), Clipboard::Tmux);
    }
}
