//! The commands whose answers are built from many runs.

use std::io::Write;
use std::ops::ControlFlow;

use crate::cli::{AccuracyArgs, CliError, CompareArgs, EnsembleArgs, ReportArgs, ThresholdArgs};
use crate::cli::{interrupt, print, progress::shown};
use crate::many::comparison::{self, ComparisonColumn, Entry, leading, order};
use crate::many::threshold::{ThresholdSearch, meant, usual, wanted};
use crate::many::{accuracy, ensemble};
use crate::plain_text::{printable, printable_path, quoted, write_json};
use crate::report::{self, command, compare::Table, page, threshold};
use crate::run::{kept::Keep, quantity::Quantity};
use crate::scenario::{CheckedScenario, problem::ScenarioError, problem::five_nearest};
use crate::whole_file;

pub fn measure(args: &AccuracyArgs, out: &mut dyn Write) -> Result<(), CliError> {
    let scenario = args.scenario.scenario()?;
    let changes = &args.scenario.changes;
    if changes.integrator.is_some() || changes.step_us.is_some() {
        let what = "accuracy measures every integrator over its steps";
        let why = format!("{what}: leave out --integrator and --step-us");
        return Err(CliError::Input(why));
    }
    let chosen = args.result.as_ref().map(|key| result("--result", key)).transpose()?;
    let finest = args.finest_level.unwrap_or(accuracy::finest_tried(&scenario));
    let known = shown(|progress| {
        accuracy::measure(&scenario, finest, None, &mut progress.watch("measuring"), &mut |_| {})
    })?;
    let of = known.to_show(chosen).filter(|of| chosen.is_none_or(|chosen| chosen == *of));
    let of = of.ok_or_else(|| {
        let which = chosen.map_or("no result", Quantity::label);
        let why = "finer meshes do not agree, or fold";
        CliError::Input(format!("{which} has no error that is known here: {why}"))
    })?;
    let json = args.json.then(|| report::accuracy::json(&scenario, &known, of));
    Ok(print(out, json, |out| report::accuracy::text(&scenario.name, &known, of, out))?)
}

/// Runs the samples and prints bands and drivers; after Ctrl-C those of the samples done.
pub fn draw(args: &EnsembleArgs, out: &mut dyn Write) -> Result<(), CliError> {
    let scenario = args.scenario.scenario()?;
    let drives = result("--drives", &args.drives)?;
    let stop = interrupt::flag()?;
    let count = (args.samples, args.seed);
    let found = shown(|progress| {
        ensemble::run(&scenario, count, None, &stop, &|so_far| {
            progress.count("samples", so_far.samples.len(), so_far.asked as usize);
            ControlFlow::Continue(())
        })
    })?;
    let json = args.json.then(|| report::ensemble::json(&scenario, &found));
    print(out, json, |out| report::ensemble::text(&scenario.name, &found, drives, out))?;
    out.flush()?;
    if found.stopped() {
        let (done, asked) = (found.samples.len(), found.asked);
        return Err(CliError::Interrupted(format!("interrupted: {done} of {asked} samples done")));
    }
    Ok(())
}

fn result(flag: &str, name: &str) -> Result<Quantity, CliError> {
    meant(name).ok_or_else(|| {
        let near = five_nearest(name, Quantity::ALL.iter().map(|quantity| quantity.key()));
        CliError::Input(format!(
            "{flag} {}: there is no such result; the nearest: {near}; contrecoup run --json lists all",
            quoted(name)
        ))
    })
}

pub fn search(args: &ThresholdArgs, out: &mut dyn Write) -> Result<(), CliError> {
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
    let json = args.json.then(|| threshold::json(&scenario, &question, &found));
    Ok(print(out, json, |out| threshold::text(&scenario, &question, &found, out))?)
}

/// Every blow answered, while progress is shown; `otherwise` says what an interruption leaves.
fn answered(
    asked: &[(String, CheckedScenario)],
    keep: impl Fn(&CheckedScenario) -> Keep + Sync,
    otherwise: &str,
) -> Result<Vec<Entry>, CliError> {
    let stop = interrupt::flag()?;
    let of = Some(asked.len());
    let entries = shown(|progress| {
        comparison::compare(asked, keep, &stop, |share| progress.show_of("simulating", share, of))
    });
    entries.map_err(|refusal| CliError::stopped(refusal, otherwise))
}

pub fn compare(args: &CompareArgs, out: &mut dyn Write) -> Result<(), CliError> {
    let asked = args.scenarios.scenarios()?;
    if let [(only, _)] = &asked[..] {
        return Err(CliError::Input(format!(
            "{} alone compares with nothing: add another, or the same at another speed, as in \
             `contrecoup compare bb-62 squash-ball squash-ball@30`",
            quoted(only)
        )));
    }
    let by = args.sort.as_ref().map(|key| result("--sort", key)).transpose()?;
    let mut entries = answered(&asked, |_| Keep::default(), "nothing is known yet")?;
    if let Some(by) = by {
        entries.sort_by(|a, b| order(a, b, (ComparisonColumn::Result(by), true)));
    }
    if args.json {
        return Ok(write_json(out, &report::compare::json(&entries))?);
    }
    if args.csv {
        return Ok(report::compare::csv(&entries, out)?);
    }
    let table = Table::of(&entries, &leading(&entries, by));
    Ok(if args.md { table.markdown(out) } else { table.text(out) }?)
}

/// Simulates every blow and writes the page, in the place of whatever the file held.
pub fn write_page(args: &ReportArgs, out: &mut dyn Write) -> Result<(), CliError> {
    let name = printable_path(&args.output);
    let Some(form) = page::PageFormat::of(&args.output) else {
        let name = quoted(&args.output.display().to_string());
        let why = "the end of the name says what to write: allowed .html, .md, .svg";
        return Err(CliError::Input(format!("-o {name}: {why}")));
    };
    let asked = args.scenarios.scenarios()?;
    let entries = answered(&asked, |scenario| page::keep(scenario), "nothing was written")?;
    whole_file::write(&args.output, |file| {
        page::write(form, &entries, Some(&repeating(args)), file)
    })
    .map_err(|error| CliError::Failed(format!("cannot write {name}: {error}")))?;
    Ok(writeln!(out, "{name}: written")?)
}

/// What was typed, as a shell takes it.
fn repeating(args: &ReportArgs) -> String {
    let changes = &args.scenarios.changes;
    let mut words = args.scenarios.sources.clone();
    for (path, text) in &changes.assignments {
        words.extend(["--set".to_owned(), format!("{path}={text}")]);
    }
    for (flag, _, text) in changes.short() {
        words.extend([flag.to_owned(), text.clone()]);
    }
    words.extend(["-o".to_owned(), args.output.display().to_string()]);
    printable(&command::line("report", &words)).into_owned()
}
