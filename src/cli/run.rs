//! `contrecoup run`: one blow, its results on standard output.

use std::io::Write;
use std::sync::atomic::AtomicBool;
use std::time::{Duration, Instant};

use crate::answer::{choose, complete::complete, solve::solve};
use crate::cli::progress::Progress;
use crate::cli::{CliError, RunArgs};
use crate::plain_text::write_json;
use crate::report::{first_page, json, text};
use crate::run::{kept::Keep, refusal::Refusal};
use crate::scenario::set::full_path;
use crate::scenario::{EyeInput, Scenario};

/// A simulation after which what takes many of them is announced, where no progress is seen.
const LONG: Duration = Duration::from_secs(3);

/// Simulates the scenario and prints its results.
///
/// The mesh error, which takes two finer meshes, and what the inputs are not known to, which takes
/// a run for each, are estimated first, wherever the output goes: each figure bears its error.
pub fn run(args: &RunArgs, out: &mut dyn Write) -> Result<(), CliError> {
    let mut scenario = args.scenario.scenario()?;
    let mut reasons = Vec::new();
    let (began, progress) = (Instant::now(), Progress::new());
    let mut watch = |share| progress.simulated(share);
    if let (Some(_), Some(path)) = (args.tolerance, numerics_set(args, &scenario)) {
        return Err(CliError::Input(format!(
            "--set {path}: --tolerance chooses mesh level, integrator and step itself"
        )));
    }
    let mut answer = if let Some(percent) = args.tolerance {
        let ladder = &mut choose::Ladder::default();
        let chosen = choose::within(ladder, &scenario, percent, &mut watch)?;
        (scenario, reasons) = (chosen.scenario, chosen.reasons);
        chosen.answer
    } else {
        solve(&scenario, Keep::default(), &mut watch).map_err(|refusal| placed(args, refusal))?
    };
    if !args.quick {
        if began.elapsed() > LONG {
            progress.announce(
                "finer meshes and inputs follow, 10 to 50 times as long; --quick leaves them out",
            );
        }
        let stop = AtomicBool::new(false);
        complete(&scenario, &mut answer, &stop, |share| {
            progress.show("meshes and inputs (--quick leaves them out)", share);
        })?;
    }
    if args.json {
        write_json(out, &json::answer(&scenario, &answer, &reasons))?;
        return Ok(());
    }
    progress.clear();
    if args.all {
        text::results(&scenario, &answer, out)?;
        text::trust(&answer, &reasons, out)?;
    } else {
        first_page::write(&scenario, &answer, args.tolerance.is_some(), out)?;
    }
    Ok(())
}

/// The path of a `--set` that gives mesh level, integrator or step, by whichever of its names or
/// as part of a group.
fn numerics_set<'a>(args: &'a RunArgs, scenario: &Scenario) -> Option<&'a str> {
    let level_is_given = scenario.eye.level != EyeInput::default().level;
    let paths = args.scenario.changes.assignments.iter().map(|a| a.path.as_str());
    paths.into_iter().find(|path| match full_path(scenario, path) {
        "eye.level" => true,
        "eye" => level_is_given,
        path => path.starts_with("numerics"),
    })
}

/// A refusal with the place in the file that asked for it.
fn placed(args: &RunArgs, refusal: Refusal) -> CliError {
    let place = match refusal {
        Refusal::StepAboveLimit { .. } | Refusal::StepTooShort { .. } => {
            args.scenario.place_of("numerics.step_us")
        }
        Refusal::WindowTooLong { .. } => args.scenario.place_of("window_ms"),
        _ => None,
    };
    match place {
        Some(place) => CliError::Input(format!("{place}: {refusal}")),
        None => refusal.into(),
    }
}
