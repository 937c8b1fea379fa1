//! `contrecoup coverage`: how often the stated step or mesh errors hold, and tolerances are kept.

use std::io::Write;
use std::ops::ControlFlow;
use std::sync::{Mutex, PoisonError};

use crate::cli::progress::Progress;
use crate::cli::{CliError, CoverageArgs};
use crate::plain_text::write_json;
use crate::report::coverage::{Asked, json, text};
use crate::report::tolerance;
use crate::verify::coverage::{Drawn, check};
use crate::verify::{mesh_coverage, tolerance_coverage};

/// Solves random scenes, each with its reference, and prints how the claims compare.
///
/// # Errors
/// Where a simulation fails or the output cannot be written.
pub fn run(args: &CoverageArgs, out: &mut dyn Write) -> Result<(), CliError> {
    let progress = Mutex::new(Progress::new());
    let lock = || progress.lock().unwrap_or_else(PoisonError::into_inner);
    let watch = |share| {
        lock().show("checking scenes", share);
        ControlFlow::Continue(())
    };
    if args.tolerance {
        let kept = tolerance_coverage::check(args.scenes, args.seed, &watch);
        lock().clear();
        let kept = kept?;
        if args.json {
            write_json(out, &tolerance::json(&kept, args.seed))?;
        } else {
            tolerance::text(&kept, args.seed, out)?;
        }
        return Ok(());
    }
    let asked = Asked {
        drawn: if args.objects {
            Drawn::Objects
        } else {
            Drawn::Pulses
        },
        seed: args.seed,
        mesh: args.mesh,
    };
    let checked = match args.mesh {
        Some(level) => mesh_coverage::check(asked.drawn, args.scenes, args.seed, level, &watch),
        None => check(asked.drawn, args.scenes, args.seed, &watch),
    };
    lock().clear();
    let checked = checked?;
    if args.json {
        write_json(out, &json(&checked, asked))?;
    } else {
        text(&checked, asked, out)?;
    }
    Ok(())
}
