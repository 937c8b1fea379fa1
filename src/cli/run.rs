//! `contrecoup run`: one blow, its results on standard output.

use std::io::Write;
use std::time::{Duration, Instant};

use crate::answer::mesh_error::{add_mesh_error, is_asked};
use crate::answer::{choose, solve::solve};
use crate::cli::{CliError, RunArgs, progress::Progress};
use crate::plain_text::write_json;
use crate::report::{first_page, json, text};
use crate::run::{kept::Keep, refusal::Refusal};
use crate::scenario::{EyeInput, Scenario, set::full_path};

/// A simulation after which what takes many of them is announced, where no progress is seen.
const LONG: Duration = Duration::from_secs(3);

/// Prints the results, each with its errors of step and, where they are asked for, of the mesh.
pub fn run(args: &RunArgs, out: &mut dyn Write) -> Result<(), CliError> {
    let mut scenario = args.scenario.scenario()?;
    let mut reasons = Vec::new();
    let (began, progress) = (Instant::now(), Progress::new());
    let mut watch = progress.watch("simulating");
    if let (Some(_), Some(path)) = (args.tolerance, numerics_set(args, &scenario)) {
        let why = "--tolerance chooses mesh level, integrator and step itself";
        return Err(CliError::Input(format!("--set {path}: {why}")));
    }
    let mut answer = if let Some(percent) = args.tolerance {
        let ladder = &mut choose::Ladder::default();
        let chosen = choose::within(ladder, &scenario, percent, &mut watch)?;
        (scenario, reasons) = (chosen.scenario, chosen.reasons);
        chosen.answer
    } else {
        solve(&scenario, Keep::default(), &mut watch).map_err(|refusal| placed(args, refusal))?
    };
    let asked = !args.quick && (args.meshes || is_asked(&scenario));
    if asked && answer.errors.mesh.is_none() {
        if began.elapsed() > LONG {
            progress.announce("two finer meshes follow, 10 to 50 times as long");
        }
        add_mesh_error(&scenario, &mut answer, &mut progress.watch("meshes"))?;
    }
    progress.clear();
    if args.json {
        write_json(out, &json::answer(&scenario, &answer, &reasons))?;
    } else if args.all {
        text::results(&scenario, &answer, out)?;
        text::trust(&answer, &reasons, out)?;
    } else {
        write!(out, "{}", first_page::text(&scenario, &answer, args.tolerance.is_some()))?;
    }
    Ok(())
}

/// The path of a `--set` that gives mesh level, integrator or step, or a group with them.
fn numerics_set<'a>(args: &'a RunArgs, scenario: &Scenario) -> Option<&'a str> {
    let level_is_given = scenario.eye.level != EyeInput::default().level;
    let mut paths = args.scenario.changes.assignments.iter().map(|(path, _)| path.as_str());
    paths.find(|path| match full_path(scenario, path) {
        "eye.level" => true,
        "eye" => level_is_given,
        path => path.starts_with("numerics"),
    })
}

/// A refusal with the place in the file that asked for it.
fn placed(args: &RunArgs, refusal: Refusal) -> CliError {
    let field = match refusal {
        Refusal::StepAboveLimit { .. } | Refusal::StepTooShort { .. } => "numerics.step_us",
        Refusal::WindowTooLong { .. } => "window_ms",
        _ => return refusal.into(),
    };
    match args.scenario.place_of(field) {
        Some(place) => CliError::Input(format!("{place}: {refusal}")),
        None => refusal.into(),
    }
}
