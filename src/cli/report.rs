//! `contrecoup report`: a page of one blow or several, to read, print and send.

use std::io::Write;

use crate::cli::compare::answered;
use crate::cli::{CliError, ReportArgs};
use crate::plain_text::{printable, printable_path, quoted};
use crate::report::command::line;
use crate::report::page::{PageFormat, keep, write};
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
    let command = repeating(args);
    let entries = answered(&asked, |scenario| keep(scenario), "nothing was written")?;
    let failed = |error| CliError::Failed(format!("cannot write {name}: {error}"));
    whole_file::write(&args.output, |file| write(form, &entries, Some(&command), file))
        .map_err(failed)?;
    writeln!(out, "{name}: written")?;
    Ok(())
}

/// What was typed, as a shell takes it.
fn repeating(args: &ReportArgs) -> String {
    let changes = &args.scenarios.changes;
    let mut words = args.scenarios.sources.clone();
    for set in &changes.assignments {
        words.extend(["--set".to_owned(), format!("{}={}", set.path, set.text)]);
    }
    let flags = [
        ("--level", &changes.level),
        ("--integrator", &changes.integrator),
        ("--step-us", &changes.step_us),
    ];
    for (flag, text) in flags {
        words.extend(text.iter().flat_map(|text| [flag.to_owned(), text.clone()]));
    }
    words.extend(["-o".to_owned(), args.output.display().to_string()]);
    printable(&line("report", &words)).into_owned()
}
