//! `contrecoup run`: one blow, its results on standard output.

use std::io::Write;

use super::{CliError, RunArgs};

/// Simulates the scenario and prints its results.
///
/// # Errors
/// Where the scenario is refused, the simulation fails or the output cannot be written.
pub fn run(args: &RunArgs, _out: &mut dyn Write) -> Result<(), CliError> {
    args.scenario.scenario()?;
    Err(CliError::Failed("not wired yet".to_owned()))
}
