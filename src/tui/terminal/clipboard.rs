//! The clipboard of whoever sits at the terminal, by OSC 52, which works over ssh.
//!
//! Left out: asking whether the terminal takes it. Most that do not pass over it in silence, and
//! those known to print it get none.

use crossterm::Command;
use crossterm::clipboard::CopyToClipboard;

/// The escape sequence that puts a text on the clipboard, by the environment; none where there is
/// no clipboard. Through tmux it goes both ways, since tmux may pass on one or the other.
pub fn copied(text: &str, env: impl Fn(&str) -> Option<String>) -> Option<String> {
    let term = env("TERM").unwrap_or_default();
    // Consoles without a clipboard, and real terminals.
    if term == "linux" || term == "dumb" || term.starts_with("vt") {
        return None;
    }
    let mut plain = String::new();
    // A string takes whatever it is given.
    let _ = CopyToClipboard::to_clipboard_from(text).write_ansi(&mut plain);
    if env("TMUX").is_some_and(|tmux| !tmux.is_empty()) {
        // Within a passage through tmux every escape is doubled.
        let passed = plain.replace('\x1b', "\x1b\x1b");
        plain += &format!("\x1bPtmux;{passed}\x1b\\");
    }
    Some(plain)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_text_goes_out_in_base64_through_tmux_both_ways_and_to_no_console() {
        let plain = "\x1b]52;c;YSBzdW1tYXJ5Cg==\x1b\\";
        let wrapped = "\x1bPtmux;\x1b\x1b]52;c;YSBzdW1tYXJ5Cg==\x1b\x1b\\\x1b\\";
        for (term, tmux, expected) in [
            ("linux", "", None),
            ("vt100", "", None),
            ("xterm-256color", "", Some(plain.to_owned())),
            ("tmux-256color", "/tmp/tmux", Some(format!("{plain}{wrapped}"))),
        ] {
            let env = |name: &str| Some(if name == "TERM" { term } else { tmux }.to_owned());
            assert_eq!(copied("a summary\n", env), expected, "{term}");
        }
    }
}
