//! `contrecoup compare`: several blows side by side.

use std::io::Write;

use crate::cli::{CliError, CompareArgs, ensemble::result, interrupt, progress::shown};
use crate::many::comparison::{ComparisonColumn, Entry, compare, leading, order};
use crate::plain_text::{quoted, write_json};
use crate::report::compare::{Table, csv, json};
use crate::run::kept::Keep;
use crate::scenario::CheckedScenario;

/// Every blow answered, while progress is shown; `otherwise` says what an interruption leaves.
pub(super) fn answered(
    asked: &[(String, CheckedScenario)],
    keep: impl Fn(&CheckedScenario) -> Keep + Sync,
    otherwise: &str,
) -> Result<Vec<Entry>, CliError> {
    let stop = interrupt::flag()?;
    let of = Some(asked.len());
    let entries = shown(|progress| {
        compare(asked, keep, &stop, |share| progress.show_of("simulating", share, of))
    });
    entries.map_err(|refusal| CliError::stopped(refusal, otherwise))
}

/// Simulates every blow and prints them as rows of one table.
pub fn run(args: &CompareArgs, out: &mut dyn Write) -> Result<(), CliError> {
    let asked = args.scenarios.scenarios()?;
    if let [(only, _)] = &asked[..] {
        return Err(CliError::Input(format!(
            "{} alone compares with nothing: add another, or the same at another speed, as in \
             `contrecoup compare bb-62 squash-ball squash-ball@30`",
            quoted(only)
        )));
    }
    let by = args.sort.as_ref().map(|key| result("--sort", key)).transpose()?;
    let mut entries = answered(&asked, |_| Keep::default(), "nothing is known yet")?;
    if let Some(by) = by {
        entries.sort_by(|a, b| order(a, b, (ComparisonColumn::Result(by), true)));
    }
    if args.json {
        return Ok(write_json(out, &json(&entries))?);
    }
    if args.csv {
        return Ok(csv(&entries, out)?);
    }
    let table = Table::of(&entries, &leading(&entries, by));
    Ok(if args.md { table.markdown(out) } else { table.text(out) }?)
}
