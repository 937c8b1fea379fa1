//! `contrecoup export`: one blow, its frames and traces in files.

use std::io::Write;

use super::{CliError, ExportArgs};

/// Simulates the scenario and writes the files that were asked for.
///
/// # Errors
/// Where the scenario is refused, the simulation fails or a file cannot be written.
pub fn run(args: &ExportArgs, _out: &mut dyn Write) -> Result<(), CliError> {
    args.scenario.scenario()?;
    Err(CliError::Failed("not wired yet".to_owned()))
}
