//! `contrecoup threshold`: at which value of one field a result reaches a value.

use std::io::Write;

use crate::cli::{CliError, ThresholdArgs};
use crate::cli::{interrupt, progress::Progress};
use crate::many::threshold::{ThresholdSearch, usual, wanted};
use crate::plain_text::write_json;
use crate::report::threshold::{json, text};
use crate::scenario::problem::ScenarioError;

/// Looks for every crossing and prints it with its errors.
pub fn run(args: &ThresholdArgs, out: &mut dyn Write) -> Result<(), CliError> {
    let scenario = args.scenario.scenario()?;
    let refused = |flag: &str| {
        let flag = flag.to_owned();
        move |error: ScenarioError| CliError::Input(format!("{flag} {error}"))
    };
    let (field, target) = usual(&scenario);
    let until = args.until.as_deref().map_or(Ok(target), wanted);
    let until = until.map_err(refused("--until"))?;
    let vary = args.vary.as_deref().unwrap_or(field);
    let question = ThresholdSearch::read((*scenario).clone(), vary, until);
    let question = question.map_err(refused("--vary"))?;
    let stop = interrupt::flag()?;
    let progress = Progress::new();
    let (of, path) = (question.quantity.key(), question.field.path);
    let (from, to) = question.range;
    progress.announce(&format!("looking for {of} over {path} = {from}:{to} ..."));
    let found = question.answer(&stop, |share| progress.show("looking", share));
    progress.clear();
    let found = found.map_err(|refusal| CliError::stopped(refusal, "nothing is known yet"))?;
    if args.json {
        write_json(out, &json(&scenario, &question, &found))?;
    } else {
        text(&scenario, &question, &found, out)?;
    }
    Ok(())
}
