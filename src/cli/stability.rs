//! `contrecoup stability`: the hard cases and what the program makes of them.

use std::io::Write;
use std::sync::Mutex;

use crate::cli::progress::Progress;
use crate::cli::{CliError, StabilityArgs};
use crate::plain_text::write_json;
use crate::report::stability;
use crate::verify::hard_cases;
use crate::verify::hard_cases::Verdict;

/// Runs the hard cases and prints a table or JSON.
///
/// # Errors
/// Where a case is silently wrong, after printing, and where the output cannot be written.
pub fn run(args: &StabilityArgs, out: &mut dyn Write) -> Result<(), CliError> {
    let progress = Mutex::new(Progress::new());
    let outcomes = hard_cases::run(|done, of| {
        if let Ok(mut progress) = progress.lock() {
            progress.count("hard cases", done, of);
        }
    });
    if let Ok(mut progress) = progress.lock() {
        progress.clear();
    }
    if args.json {
        write_json(out, &stability::json(&outcomes))?;
    } else {
        stability::table(&outcomes, out)?;
    }
    out.flush()?;
    let wrong: Vec<&str> = outcomes
        .iter()
        .filter(|outcome| outcome.verdict == Verdict::Wrong)
        .map(|outcome| outcome.name)
        .collect();
    if wrong.is_empty() {
        Ok(())
    } else {
        Err(CliError::Failed(format!(
            "silently wrong: {}",
            wrong.join(", ")
        )))
    }
}
