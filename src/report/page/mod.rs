//! One page that holds an answer whole: to read, to print, to send and to repeat.
//!
//! HTML is one file that needs nothing else: pictures are drawn in it, the replay is a small
//! script in it, and its own rules forbid it to load anything. Markdown has the words and tables,
//! SVG the picture alone.
//!
//! Left out: bands over the inputs, which take minutes (`contrecoup ensemble`).

mod charts;
mod content;
mod eye;
mod fundus;
pub(crate) mod html;
mod markdown;

use std::io::{self, Write};
use std::path::Path;

use crate::many::comparison::Entry;
use crate::run::watch::unwatched;

pub use crate::report::page::content::keep;

#[derive(Debug, Clone, Copy, PartialEq, Eq, strum::EnumString)]
#[strum(ascii_case_insensitive)]
pub enum PageFormat {
    #[strum(serialize = "html", serialize = "htm")]
    Html,
    #[strum(serialize = "md")]
    Markdown,
    Svg,
}

impl PageFormat {
    /// By the end of a file's name.
    pub fn of(path: &Path) -> Option<Self> {
        path.extension()?.to_str()?.parse().ok()
    }
}

/// Writes a page of one blow or several; `command` repeats it, if one can.
pub fn write(
    form: PageFormat,
    entries: &[Entry],
    command: Option<&str>,
    out: &mut dyn Write,
) -> io::Result<()> {
    match form {
        PageFormat::Html => {
            let page = html::page(entries, command, &mut unwatched);
            out.write_all(page.continue_value().unwrap_or_default().as_bytes())
        }
        PageFormat::Markdown => markdown::write(entries, command, out),
        PageFormat::Svg => out.write_all(eye::pictures(entries).as_bytes()),
    }
}
