//! `contrecoup validate` and `contrecoup calibrate`: the model against published experiments.

use std::io::{self, Write};
use std::ops::ControlFlow;

use super::progress::Progress;
use super::{CalibrateArgs, CliError, ValidateArgs};
use crate::report::validate::{fit_json, fit_text, json, text};
use crate::study::calibrate::calibrate;
use crate::study::validate::validate;
use serde_json::Value;

/// Runs every experiment again and prints measured beside predicted.
///
/// # Errors
/// Where the output cannot be written.
pub fn run(args: &ValidateArgs, out: &mut dyn Write) -> Result<(), CliError> {
    let rows = validate(|scenario| scenario);
    if args.json {
        print(&json(&rows), out)
    } else {
        Ok(text(&rows, out)?)
    }
}

/// Repeats the fit of the Physiological model and prints what it finds.
///
/// # Errors
/// Where the output cannot be written.
pub fn fit(args: &CalibrateArgs, out: &mut dyn Write) -> Result<(), CliError> {
    let mut progress = Progress::new();
    let fit = calibrate(args.scan, &mut |share| {
        progress.show("fitting", share);
        ControlFlow::Continue(())
    });
    progress.clear();
    let fit = fit?;
    if args.json {
        print(&fit_json(&fit), out)
    } else {
        Ok(fit_text(&fit, out)?)
    }
}

fn print(value: &Value, out: &mut dyn Write) -> Result<(), CliError> {
    serde_json::to_writer_pretty(&mut *out, value).map_err(io::Error::from)?;
    writeln!(out)?;
    Ok(())
}
