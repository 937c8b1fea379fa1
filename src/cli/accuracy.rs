//! `contrecoup accuracy`: total error against time on one scenario.

use std::io::Write;

use crate::cli::{AccuracyArgs, CliError};
use crate::cli::{ensemble::result, progress::Progress};
use crate::many::accuracy::{finest_tried, measure};
use crate::plain_text::write_json;
use crate::report::accuracy;
use crate::run::quantity::Quantity;

/// Measures every level, integrator and step and prints the report.
pub fn run(args: &AccuracyArgs, out: &mut dyn Write) -> Result<(), CliError> {
    let scenario = args.scenario.scenario()?;
    let asked = &args.scenario;
    if asked.changes.integrator.is_some() || asked.changes.step_us.is_some() {
        return Err(CliError::Input(
            "accuracy measures every integrator over its steps: leave out --integrator and --step-us"
                .to_owned(),
        ));
    }
    let chosen = args.result.as_ref().map(|key| result("--result", key));
    let chosen = chosen.transpose()?;
    let progress = Progress::new();
    let mut watch = |share| progress.measured(share);
    let finest = args.finest_level.unwrap_or(finest_tried(&scenario));
    let known = measure(&scenario, finest, None, &mut watch, &mut |_| {})?;
    progress.clear();
    let of = known.to_show(chosen);
    let of = of.filter(|of| chosen.is_none_or(|chosen| chosen == *of));
    let of = of.ok_or_else(|| {
        let which = chosen.map_or("no result", Quantity::label);
        let why = "finer meshes do not agree, or fold";
        CliError::Input(format!("{which} has no error that is known here: {why}"))
    })?;
    if args.json {
        write_json(out, &accuracy::json(&scenario, &known, of))?;
    } else {
        accuracy::text(&scenario.name, &known, of, out)?;
    }
    Ok(())
}
