//! `contrecoup accuracy`: speed against error on one scenario.

use std::io::Write;

use crate::answer::accuracy::measure;
use crate::cli::progress::Progress;
use crate::cli::{AccuracyArgs, CliError};
use crate::plain_text::write_json;
use crate::report::accuracy;

/// Measures every integrator and level and prints the report.
///
/// # Errors
/// Where the scenario is refused or the output cannot be written.
pub fn run(args: &AccuracyArgs, out: &mut dyn Write) -> Result<(), CliError> {
    let scenario = args.scenario.scenario()?;
    let asked = &args.scenario;
    if asked.changes.integrator.is_some() || asked.changes.step_us.is_some() {
        return Err(CliError::Input(
            "accuracy measures every integrator over its steps: leave out --integrator and --step-us"
                .to_owned(),
        ));
    }
    let progress = Progress::new();
    let finest = args.finest_level.max(scenario.eye.level);
    let report = measure(&scenario, finest, &mut |share| progress.measured(share))?;
    progress.clear();
    if args.json {
        write_json(out, &accuracy::json(&scenario, &report))?;
    } else {
        accuracy::text(&scenario, &report, out)?;
    }
    Ok(())
}
