//! `contrecoup run`: one blow, its results on standard output.

use std::io::Write;

use super::{CliError, RunArgs};
use crate::recording::Keep;
use crate::report::{json, text};
use crate::study::{solve, unwatched};

/// Simulates the scenario and prints its results.
///
/// # Errors
/// Where the scenario is refused, the simulation fails or the output cannot be written.
pub fn run(args: &RunArgs, out: &mut dyn Write) -> Result<(), CliError> {
    let scenario = args.scenario.scenario()?;
    let answer = solve(&scenario, Keep::default(), &mut unwatched)?;
    if args.json {
        serde_json::to_writer_pretty(&mut *out, &json::answer(&scenario, &answer))
            .map_err(std::io::Error::from)?;
        writeln!(out)?;
    } else {
        text::answer(&scenario, &answer, out)?;
    }
    Ok(())
}
