//! `contrecoup validate` and `contrecoup calibrate`: the model against published experiments.

use std::io::Write;
use std::ops::ControlFlow;

use crate::cli::progress::Progress;
use crate::cli::{CalibrateArgs, CliError, ValidateArgs};
use crate::plain_text::write_json;
use crate::report::validate::{fit_json, fit_text, json, text};
use crate::verify::calibrate::calibrate;
use crate::verify::validate::validate;

/// Runs every experiment again and prints measured beside predicted.
///
/// # Errors
/// Where the output cannot be written.
pub fn run(args: &ValidateArgs, out: &mut dyn Write) -> Result<(), CliError> {
    let rows = validate(|scenario| scenario);
    if args.json {
        Ok(write_json(out, &json(&rows))?)
    } else {
        Ok(text(&rows, out)?)
    }
}

/// Repeats the fit of the one free number and prints what it finds.
///
/// # Errors
/// Where the output cannot be written.
pub fn fit(args: &CalibrateArgs, out: &mut dyn Write) -> Result<(), CliError> {
    let mut progress = Progress::new();
    let fit = calibrate(&mut |share| {
        progress.show("fitting", share);
        ControlFlow::Continue(())
    });
    progress.clear();
    let fit = fit?;
    if args.json {
        Ok(write_json(out, &fit_json(&fit))?)
    } else {
        Ok(fit_text(&fit, out)?)
    }
}
