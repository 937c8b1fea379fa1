//! `contrecoup presets`: what there is to run.

use std::io::{self, IsTerminal, Write};

use serde::Serialize;

use crate::cli::{CliError, PresetsArgs, PresetsCommand};
use crate::plain_text::{printable, printable_lines, write_json};
use crate::scenario::{library, library::Origin};

/// One preset as JSON and as a line of the list.
#[derive(Serialize)]
struct Row {
    name: String,
    /// `built-in` or `user`.
    origin: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    file: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    title: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    error: Option<String>,
}

/// Lists the presets, or prints the text of one.
pub fn run(args: &PresetsArgs, out: &mut dyn Write) -> Result<(), CliError> {
    if let Some(PresetsCommand::Show { name }) = &args.command {
        let text = library::find(name)?.text()?;
        // A file or a program gets the bytes; a terminal would obey what stands in a comment.
        let shown =
            if io::stdout().is_terminal() { printable_lines(&text) } else { text.as_ref().into() };
        out.write_all(shown.as_bytes())?;
        return Ok(());
    }
    let rows = rows()?;
    if args.json {
        write_json(out, &rows)?;
        return Ok(());
    }
    let width = rows.iter().map(|row| row.name.chars().count()).max();
    let width = width.unwrap_or_default();
    for row in rows {
        let mark = if row.file.is_some() { "  (yours)" } else { "" };
        let said = row.title.or(row.error).unwrap_or_default();
        let said = said.lines().next().unwrap_or_default();
        writeln!(out, "{:width$}  {}{mark}", printable(&row.name), printable(said))?;
    }
    Ok(())
}

fn rows() -> Result<Vec<Row>, CliError> {
    let row = |preset: library::Preset| {
        let title = preset.title();
        Row {
            origin: match preset.origin {
                Origin::BuiltIn(_) => "built-in",
                Origin::User(_) => "user",
            },
            file: match &preset.origin {
                Origin::BuiltIn(_) => None,
                Origin::User(path) => Some(path.display().to_string()),
            },
            error: title.as_ref().err().map(ToString::to_string),
            title: title.ok(),
            name: preset.name,
        }
    };
    Ok(library::list()?.into_iter().map(row).collect())
}
