//! `contrecoup ensemble`: how far the answer may be off because the inputs are not known.

use std::io::Write;
use std::ops::ControlFlow;

use crate::cli::{CliError, EnsembleArgs, interrupt, print, progress::shown};
use crate::many::ensemble::run as run_samples;
use crate::many::threshold::meant;
use crate::plain_text::quoted;
use crate::report::ensemble::{json, text};
use crate::run::quantity::Quantity;
use crate::scenario::problem::five_nearest;

/// Runs the samples and prints bands and drivers; after Ctrl-C those of the samples done.
pub fn run(args: &EnsembleArgs, out: &mut dyn Write) -> Result<(), CliError> {
    let scenario = args.scenario.scenario()?;
    let drives = result("--drives", &args.drives)?;
    let stop = interrupt::flag()?;
    let count = (args.samples, args.seed);
    let ensemble = shown(|progress| {
        run_samples(&scenario, count, None, &stop, &|so_far| {
            progress.count("samples", so_far.samples.len(), so_far.asked as usize);
            ControlFlow::Continue(())
        })
    })?;
    let json = args.json.then(|| json(&scenario, &ensemble));
    print(out, json, |out| text(&scenario, &ensemble, drives, out))?;
    out.flush()?;
    if ensemble.stopped() {
        let (done, asked) = (ensemble.samples.len(), ensemble.asked);
        return Err(CliError::Interrupted(format!("interrupted: {done} of {asked} samples done")));
    }
    Ok(())
}

/// The result that is called so, see [`meant`].
pub(super) fn result(flag: &str, name: &str) -> Result<Quantity, CliError> {
    meant(name).ok_or_else(|| {
        let near = five_nearest(name, Quantity::ALL.iter().map(|quantity| quantity.key()));
        CliError::Input(format!(
            "{flag} {}: there is no such result; the nearest: {near}; contrecoup run --json lists all",
            quoted(name)
        ))
    })
}
