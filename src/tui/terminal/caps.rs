//! What the terminal can show, from flags and environment alone.
//!
//! Left out: asking the terminal. Its answers arrive among the keys, late on a slow link, and not
//! at all from some terminals.

use clap::ValueEnum;

/// How many colours to use.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum ColorFlag {
    /// By the environment
    Auto,
    /// None: bold, dim and reverse only
    Never,
    /// The 16 of every colour terminal
    #[value(name = "16")]
    Sixteen,
    /// The 256 of xterm
    #[value(name = "256")]
    TwoFiveSix,
}

/// How to draw the mesh and the curves.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, ValueEnum)]
pub enum Symbols {
    /// Eight dots in a character
    #[default]
    Braille,
    /// Eight dots, and pictures in eight blocks a character, which few fonts have (Unicode 16)
    Octant,
    /// Four blocks in a character
    Block,
    /// Nothing beyond ASCII
    Ascii,
}

/// How many colours there are.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Depth {
    /// No colours.
    #[default]
    Mono,
    /// The 16 of every terminal.
    Sixteen,
    /// The 256 of most terminals.
    TwoFiveSix,
}

/// The colours to use; `None` where no screen can be drawn at all. A terminal of 24 bits gets 256:
/// more colours only cost bytes on the wire.
pub fn depth(flag: ColorFlag, env: impl Fn(&str) -> Option<String>) -> Option<Depth> {
    let term = env("TERM").unwrap_or_default();
    if term == "dumb" {
        return None;
    }
    let wide = ["256color", "kitty", "alacritty", "foot", "tmux"];
    let is_wide = term.ends_with("-direct") || wide.iter().any(|name| term.contains(name));
    let is_rich = matches!(env("COLORTERM").unwrap_or_default().as_str(), "truecolor" | "24bit");
    Some(match flag {
        ColorFlag::Never => Depth::Mono,
        ColorFlag::TwoFiveSix => Depth::TwoFiveSix,
        ColorFlag::Auto if env("NO_COLOR").is_some_and(|set| !set.is_empty()) => Depth::Mono,
        ColorFlag::Auto if is_rich || is_wide => Depth::TwoFiveSix,
        ColorFlag::Auto if term.starts_with("vt") => Depth::Mono,
        ColorFlag::Sixteen | ColorFlag::Auto => Depth::Sixteen,
    })
}

/// The symbols to use: no braille on the consoles of Linux and of real terminals, nothing beyond
/// ASCII in a locale that is not in UTF-8, and all where no locale is set, as most have all of it.
pub fn symbols(flag: Option<Symbols>, env: impl Fn(&str) -> Option<String>) -> Symbols {
    let mut locales = ["LC_ALL", "LC_CTYPE", "LANG"].into_iter().filter_map(&env);
    let locale = locales.find(|value| !value.is_empty()).map(|value| value.to_ascii_lowercase());
    let is_utf8 = locale.is_none_or(|value| value.contains("utf-8") || value.contains("utf8"));
    flag.unwrap_or_else(|| match env("TERM").unwrap_or_default().as_str() {
        _ if !is_utf8 => Symbols::Ascii,
        "linux" => Symbols::Block,
        term if term.starts_with("vt") => Symbols::Ascii,
        _ => Symbols::Braille,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What is set by words such as `TERM=xterm`.
    fn env(set: &str) -> impl Fn(&str) -> Option<String> + '_ {
        move |name| {
            let mut values = set.split(' ').filter_map(|word| word.strip_prefix(name));
            values.find_map(|value| value.strip_prefix('=')).map(str::to_owned)
        }
    }

    #[test]
    fn colours_follow_the_flag_then_no_color_then_the_terminal() {
        use ColorFlag::{Auto, Never, Sixteen, TwoFiveSix};
        let (few, many) = (Some(Depth::Sixteen), Some(Depth::TwoFiveSix));
        for (flag, set, expected) in [
            (Auto, "", few),
            (Auto, "TERM=xterm", few),
            (Auto, "TERM=xterm-256color", many),
            (Auto, "TERM=tmux", many),
            (Auto, "TERM=xterm-direct", many),
            (Auto, "TERM=xterm COLORTERM=truecolor", many),
            (Auto, "TERM=vt220", Some(Depth::Mono)),
            (Auto, "TERM=xterm-256color NO_COLOR=1", Some(Depth::Mono)),
            (Auto, "TERM=xterm NO_COLOR=", few),
            (TwoFiveSix, "TERM=xterm NO_COLOR=1", many),
            (Never, "TERM=kitty", Some(Depth::Mono)),
            (Sixteen, "TERM=dumb", None),
        ] {
            assert_eq!(depth(flag, env(set)), expected, "{flag:?} {set}");
        }
    }

    #[test]
    fn braille_is_left_out_where_the_font_lacks_it_or_the_locale_is_not_in_utf_8() {
        for (set, expected) in [
            ("TERM=linux", Symbols::Block),
            ("TERM=vt100", Symbols::Ascii),
            ("TERM=xterm", Symbols::Braille),
            ("LC_ALL=C LANG=en_US.UTF-8", Symbols::Ascii),
            ("LC_ALL= LANG=POSIX", Symbols::Ascii),
            ("LC_ALL=C.UTF-8", Symbols::Braille),
            ("LC_CTYPE=de_DE.utf8 LANG=C", Symbols::Braille),
        ] {
            assert_eq!(symbols(None, env(set)), expected, "{set}");
        }
        assert_eq!(symbols(Some(Symbols::Ascii), env("")), Symbols::Ascii);
    }
}
