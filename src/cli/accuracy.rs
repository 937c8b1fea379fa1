//! `contrecoup accuracy`: total error against time on one scenario.

use std::io::Write;

use crate::cli::{AccuracyArgs, CliError, ensemble::result, print, progress::shown};
use crate::many::accuracy::{finest_tried, measure};
use crate::report::accuracy;
use crate::run::quantity::Quantity;

/// Measures every level, integrator and step and prints the report.
pub fn run(args: &AccuracyArgs, out: &mut dyn Write) -> Result<(), CliError> {
    let scenario = args.scenario.scenario()?;
    let changes = &args.scenario.changes;
    if changes.integrator.is_some() || changes.step_us.is_some() {
        return Err(CliError::Input(
            "accuracy measures every integrator over its steps: leave out --integrator and --step-us"
                .to_owned(),
        ));
    }
    let chosen = args.result.as_ref().map(|key| result("--result", key)).transpose()?;
    let finest = args.finest_level.unwrap_or(finest_tried(&scenario));
    let known = shown(|progress| {
        measure(&scenario, finest, None, &mut progress.watch("measuring"), &mut |_| {})
    })?;
    let of = known.to_show(chosen).filter(|of| chosen.is_none_or(|chosen| chosen == *of));
    let of = of.ok_or_else(|| {
        let which = chosen.map_or("no result", Quantity::label);
        let why = "finer meshes do not agree, or fold";
        CliError::Input(format!("{which} has no error that is known here: {why}"))
    })?;
    let json = args.json.then(|| accuracy::json(&scenario, &known, of));
    Ok(print(out, json, |out| accuracy::text(&scenario, &known, of, out))?)
}
