//! `contrecoup presets`: what there is to run.

use std::io::{self, IsTerminal, Write};

use serde::Serialize;

use crate::cli::{CliError, PresetsArgs, PresetsCommand};
use crate::plain_text::{printable, printable_lines, write_json};
use crate::scenario::library::{self, Origin, Preset};

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

pub fn run(args: &PresetsArgs, out: &mut dyn Write) -> Result<(), CliError> {
    if let Some(PresetsCommand::Show { name }) = &args.command {
        let text = library::find(name)?.text()?;
        // A file or a program gets the bytes; a terminal would obey what stands in a comment.
        let shown =
            if io::stdout().is_terminal() { printable_lines(&text) } else { text.as_ref().into() };
        return Ok(out.write_all(shown.as_bytes())?);
    }
    let rows: Vec<Row> = library::list()?.into_iter().map(row).collect();
    if args.json {
        return Ok(write_json(out, &rows)?);
    }
    let width = rows.iter().map(|row| row.name.chars().count()).max().unwrap_or_default();
    for row in rows {
        let mark = if row.file.is_some() { "  (yours)" } else { "" };
        let said = row.title.or(row.error).unwrap_or_default();
        let said = printable(said.lines().next().unwrap_or_default());
        writeln!(out, "{:width$}  {said}{mark}", printable(&row.name))?;
    }
    Ok(())
}

fn row(preset: Preset) -> Row {
    let (origin, file) = match &preset.origin {
        Origin::BuiltIn(_) => ("built-in", None),
        Origin::User(path) => ("user", Some(path.display().to_string())),
    };
    let title = preset.title();
    let error = title.as_ref().err().map(ToString::to_string);
    Row { origin, file, error, title: title.ok(), name: preset.name }
}
