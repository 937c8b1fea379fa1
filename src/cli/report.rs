//! `contrecoup report`: a page of one blow or several, to read, print and send.

use std::io::Write;

use crate::cli::{CliError, ReportArgs, compare::answered};
use crate::plain_text::{printable, printable_path, quoted};
use crate::report::{command::line, page::PageFormat, page::keep, page::write};
use crate::whole_file;

/// Simulates every blow and writes the page, in the place of whatever the file held.
pub fn run(args: &ReportArgs, out: &mut dyn Write) -> Result<(), CliError> {
    let name = printable_path(&args.output);
    let Some(form) = PageFormat::of(&args.output) else {
        let name = quoted(&args.output.display().to_string());
        return Err(CliError::Input(format!(
            "-o {name}: the end of the name says what to write: allowed .html, .md, .svg"
        )));
    };
    let asked = args.scenarios.scenarios()?;
    let entries = answered(&asked, |scenario| keep(scenario), "nothing was written")?;
    whole_file::write(&args.output, |file| write(form, &entries, Some(&repeating(args)), file))
        .map_err(|error| CliError::Failed(format!("cannot write {name}: {error}")))?;
    Ok(writeln!(out, "{name}: written")?)
}

/// What was typed, as a shell takes it.
fn repeating(args: &ReportArgs) -> String {
    let changes = &args.scenarios.changes;
    let mut words = args.scenarios.sources.clone();
    for (path, text) in &changes.assignments {
        words.extend(["--set".to_owned(), format!("{path}={text}")]);
    }
    for (flag, _, text) in changes.short() {
        words.extend([flag.to_owned(), text.clone()]);
    }
    words.extend(["-o".to_owned(), args.output.display().to_string()]);
    printable(&line("report", &words)).into_owned()
}
