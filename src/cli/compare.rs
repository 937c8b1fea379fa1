//! `contrecoup compare`: several blows side by side.

use std::io::Write;

use crate::cli::ensemble::result;
use crate::cli::interrupt;
use crate::cli::progress::Progress;
use crate::cli::{CliError, CompareArgs};
use crate::many::comparison::{columns, compare, sort};
use crate::models::paper::case::Refusal;
use crate::plain_text::write_json;
use crate::report::compare::{Table, csv, json};
use crate::run::kept::Keep;

/// Simulates every blow and prints them as rows of one table.
///
/// # Errors
/// Where a scenario is refused, the output cannot be written, or the work was interrupted.
pub fn run(args: &CompareArgs, out: &mut dyn Write) -> Result<(), CliError> {
    let asked = args.scenarios.scenarios()?;
    let by = args
        .sort
        .as_ref()
        .map(|key| result("--sort", key))
        .transpose()?;
    let stop = interrupt::flag()?;
    let progress = Progress::new();
    let entries = compare(
        asked,
        |_| Keep::default(),
        &stop,
        |done, of| progress.count("simulating", done, of),
    );
    progress.clear();
    let mut entries = entries.map_err(|refusal| match refusal {
        Refusal::Cancelled => CliError::Interrupted("interrupted: nothing is known yet".to_owned()),
        other => other.into(),
    })?;
    if let Some(by) = by {
        sort(&mut entries, by);
    }
    if args.json {
        return Ok(write_json(out, &json(&entries))?);
    }
    if args.csv {
        return Ok(csv(&entries, out)?);
    }
    let table = Table::of(&entries, &columns(&entries, by));
    if args.md {
        table.markdown(out)?;
    } else {
        table.text(out)?;
    }
    Ok(())
}
