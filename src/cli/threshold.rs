//! `contrecoup threshold`: at which value of one field a result reaches a value.

use std::io::Write;

use crate::cli::{CliError, ThresholdArgs, interrupt, print, progress::shown};
use crate::many::threshold::{ThresholdSearch, usual, wanted};
use crate::report::threshold::{json, text};
use crate::scenario::problem::ScenarioError;

/// Looks for every crossing and prints it with its errors.
pub fn run(args: &ThresholdArgs, out: &mut dyn Write) -> Result<(), CliError> {
    let scenario = args.scenario.scenario()?;
    let refused =
        |flag: &'static str| move |error: ScenarioError| CliError::Input(format!("{flag} {error}"));
    let (field, target) = usual(&scenario);
    let until = args.until.as_deref().map_or(Ok(target), wanted);
    let until = until.map_err(refused("--until"))?;
    let vary = args.vary.as_deref().unwrap_or(field);
    let question = ThresholdSearch::read((*scenario).clone(), vary, until);
    let question = question.map_err(refused("--vary"))?;
    let stop = interrupt::flag()?;
    let (of, path) = (question.quantity.key(), question.field.path);
    let (from, to) = question.range;
    let found = shown(|progress| {
        progress.announce(&format!("looking for {of} over {path} = {from}:{to} ..."));
        question.answer(&stop, |share| progress.show("looking", share))
    });
    let found = found.map_err(|refusal| CliError::stopped(refusal, "nothing is known yet"))?;
    let json = args.json.then(|| json(&scenario, &question, &found));
    Ok(print(out, json, |out| text(&scenario, &question, &found, out))?)
}
