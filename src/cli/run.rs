//! `contrecoup run`: one blow, its results on standard output.

use std::io::{self, IsTerminal, Write};

use super::{CliError, RunArgs};
use crate::recording::Keep;
use crate::report::{json, text};
use crate::study::{add_mesh_error, choose, solve, unwatched};

/// Simulates the scenario and prints its results.
///
/// On a terminal the results appear at once and the mesh error, which takes a finer mesh, follows.
///
/// # Errors
/// Where the scenario is refused, the simulation fails or the output cannot be written.
pub fn run(args: &RunArgs, out: &mut dyn Write) -> Result<(), CliError> {
    let mut scenario = args.scenario.scenario()?;
    let mut reasons = Vec::new();
    let mut answer = if let Some(percent) = args.tolerance {
        let chosen = choose::within(&scenario, percent, Keep::default(), &mut unwatched)?;
        (scenario, reasons) = (chosen.scenario, chosen.reasons);
        chosen.answer
    } else {
        solve(&scenario, Keep::default(), &mut unwatched)?
    };
    let known = answer.errors.mesh.is_some();
    if args.json {
        if args.mesh_error && !known {
            add_mesh_error(&scenario, &mut answer, &mut unwatched)?;
        }
        let object = json::answer(&scenario, &answer, &reasons);
        serde_json::to_writer_pretty(&mut *out, &object).map_err(io::Error::from)?;
        writeln!(out)?;
        return Ok(());
    }
    text::results(&scenario, &answer, out)?;
    if !known && (args.mesh_error || io::stdout().is_terminal()) {
        out.flush()?;
        add_mesh_error(&scenario, &mut answer, &mut unwatched)?;
    }
    text::trust(&answer, &reasons, out)?;
    Ok(())
}
