//! `contrecoup export`: one blow, its frames and traces in files.

use std::fs::File;
use std::io::{self, BufWriter, Write};
use std::path::Path;

use super::progress::Progress;
use super::{CliError, ExportArgs};
use crate::eye::side_at_level;
use crate::plain_text::printable;
use crate::recording::{Keep, Spacing, write_frames, write_traces};
use crate::scenario::Scenario;
use crate::study::solve;

/// Time between two frames unless asked otherwise, in us.
const FRAMES_EVERY_US: f64 = 10.0;
/// More node positions than this would not fit in memory on a small machine.
const MOST_POSITIONS: f64 = 5e7;

/// Simulates the scenario and writes the files that were asked for.
///
/// # Errors
/// Where the scenario is refused, the simulation fails or a file cannot be written.
pub fn run(args: &ExportArgs, out: &mut dyn Write) -> Result<(), CliError> {
    let scenario = args.scenario.scenario()?;
    if args.frames.is_some() && args.frames == args.traces {
        return Err(CliError::Input(
            "--frames and --traces name the same file".to_owned(),
        ));
    }
    let every_us = args.every_us.unwrap_or(FRAMES_EVERY_US);
    if args.frames.is_some() {
        check_size(&scenario, every_us)?;
    }
    let keep = Keep {
        traces: args.traces.is_some(),
        frames: args
            .frames
            .is_some()
            .then_some(Spacing::even(every_us * 1e-6)),
    };
    let mut progress = Progress::new();
    let answer = solve(&scenario, keep, &mut |share| progress.simulated(share))?;
    if let Some(path) = &args.frames {
        let frames = &answer.recording.frames;
        save(path, |file| {
            write_frames(&answer.case.eye, frames, file, |done| {
                progress.show("writing frames", done as f64 / frames.len() as f64);
            })
        })?;
        writeln!(out, "{}: {} frames", shown(path), frames.len())?;
    }
    if let (Some(path), Some(traces)) = (&args.traces, &answer.recording.traces) {
        save(path, |file| write_traces(traces, file))?;
        writeln!(out, "{}: {} rows", shown(path), traces.time.len())?;
    }
    progress.clear();
    for flag in &answer.flags {
        writeln!(out, "FLAG {}: {}", flag.kind.name(), flag.message)?;
    }
    Ok(())
}

fn shown(path: &Path) -> String {
    printable(&path.display().to_string()).into_owned()
}

fn check_size(scenario: &Scenario, every_us: f64) -> Result<(), CliError> {
    let nodes = (side_at_level(scenario.eye.level) as f64).powi(2);
    let least_us = scenario.window_ms * 1e3 * nodes / MOST_POSITIONS;
    if every_us < least_us {
        return Err(CliError::Input(format!(
            "--every-us {every_us}: too many frames for this mesh and window: allowed from {least_us:.4}"
        )));
    }
    Ok(())
}

/// Writes a file whole or not at all; what is not a plain file, such as /dev/stdout, is written to.
fn save(
    path: &Path,
    write: impl FnOnce(&mut dyn Write) -> csv::Result<()>,
) -> Result<(), CliError> {
    let failed = |error: &dyn std::fmt::Display| {
        CliError::Failed(format!("cannot write {}: {error}", shown(path)))
    };
    let plain = path.metadata().map_or(true, |m| m.is_file());
    // A link stays a link: what it leads to is replaced.
    let resolved = path.canonicalize().unwrap_or_else(|_| path.to_owned());
    let path = resolved.as_path();
    if plain {
        let folder = path
            .parent()
            .filter(|p| !p.as_os_str().is_empty())
            .unwrap_or(Path::new("."));
        let mut builder = tempfile::Builder::new();
        builder.prefix(".contrecoup-");
        // Temporary files are private; an export is as readable as any new file.
        #[cfg(unix)]
        builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
        let mut file = builder.tempfile_in(folder).map_err(|e| failed(&e))?;
        let mut buffered = BufWriter::new(file.as_file_mut());
        write(&mut buffered).map_err(|e| failed(&e))?;
        buffered.flush().map_err(|e| failed(&e))?;
        drop(buffered);
        file.persist(path).map_err(|e| failed(&e.error))?;
        Ok(())
    } else {
        let mut file = BufWriter::new(File::create(path).map_err(|e| failed(&e))?);
        let written = write(&mut file).map_err(csv_to_io);
        match written.and_then(|()| file.flush()) {
            Err(error) if error.kind() == io::ErrorKind::BrokenPipe => Err(CliError::Output(error)),
            other => other.map_err(|e| failed(&e)),
        }
    }
}

fn csv_to_io(error: csv::Error) -> io::Error {
    match error.into_kind() {
        csv::ErrorKind::Io(error) => error,
        other => io::Error::other(format!("{other:?}")),
    }
}
