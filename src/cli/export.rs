//! `contrecoup export`: one blow, its frames and traces in files.

use std::io::{self, Write};
use std::ops::ControlFlow;
use std::path::Path;
use std::sync::atomic::AtomicBool;

use crate::answer::{compiled::Compiled, solve::Answer, solve::solve};
use crate::cli::{CliError, ExportArgs, interrupt, progress::Progress};
use crate::plain_text::printable_path;
use crate::run::kept::{Keep, Spacing};
use crate::run::{export::FrameWriter, ordered::until, refusal::Refusal, trace::write_traces};
use crate::whole_file;

const FRAMES_EVERY_US: f64 = 10.0;
const UNWRITTEN: &str = "nothing was written";
/// More node positions than this would be a file of more than 5 GB.
const MAX_POSITIONS: f64 = 5e7;

pub fn run(args: &ExportArgs, out: &mut dyn Write) -> Result<(), CliError> {
    let scenario = args.scenario.scenario()?;
    if let (Some(frames), Some(traces)) = (&args.frames, &args.traces)
        && whole_file::resolved(frames) == whole_file::resolved(traces)
    {
        return Err(CliError::Input("--frames and --traces name the same file".to_owned()));
    }
    let every_us = args.every_us.unwrap_or(FRAMES_EVERY_US);
    let case = Compiled::new(&scenario);
    let least_us = case.window() * 1e6 * case.eye.regions().len() as f64 / MAX_POSITIONS;
    if args.frames.is_some() && every_us < least_us {
        let why = format!("too many frames for this mesh and window: allowed from {least_us:.4}");
        return Err(CliError::Input(format!("--every-us {every_us}: {why}")));
    }
    let keep = Keep { traces: args.traces.is_some(), frames: None };
    // Who is told to stop takes the unfinished file away.
    let stop = interrupt::flag()?;
    let progress = Progress::new();
    let answer = solve(&scenario, keep, &mut |share| {
        progress.show("simulating", share);
        until(&stop)(share)
    });
    let answer = answer.map_err(|refusal| CliError::stopped(refusal, UNWRITTEN))?;
    if let Some(path) = &args.frames {
        let mut count = 0;
        save(path, |file| {
            count = write_frames(&answer, every_us * 1e-6, file, &stop, &progress)?;
            Ok(())
        })?;
        writeln!(out, "{}: {count} frames", printable_path(path))?;
    }
    if let (Some(path), Some(traces)) = (&args.traces, &answer.run.traces) {
        save(path, |file| write_traces(traces, file).map_err(csv_to_io))?;
        writeln!(out, "{}: {} rows", printable_path(path), traces.time.len())?;
    }
    progress.clear();
    for flag in &answer.flags {
        writeln!(out, "FLAG {}: {}", flag.kind.name(), flag.whole())?;
    }
    Ok(())
}

/// Writes each frame as it is computed; gives how many there are.
fn write_frames(
    answer: &Answer,
    every: f64,
    file: &mut dyn Write,
    stop: &AtomicBool,
    progress: &Progress,
) -> io::Result<usize> {
    let regions = answer.case.eye.regions();
    let mut writer = FrameWriter::new(file).map_err(csv_to_io)?;
    let mut written = Ok(0);
    let mut take = |frame| {
        written = writer.write(&regions, &frame).map_err(csv_to_io);
        let share = frame.time / answer.window();
        progress.show("writing frames", share);
        if written.is_ok() { until(stop)(share) } else { ControlFlow::Break(()) }
    };
    let taken = answer.case.frames(&answer.plan, Spacing::even(every), &mut take);
    let count = written?;
    taken.map_err(|_| io::Error::from(io::ErrorKind::Interrupted))?;
    writer.finish().map_err(csv_to_io)?;
    Ok(count)
}

/// Writes a file whole or not at all.
fn save(path: &Path, write: impl FnOnce(&mut dyn Write) -> io::Result<()>) -> Result<(), CliError> {
    whole_file::write(path, write).map_err(|error| match error.kind() {
        io::ErrorKind::Interrupted => CliError::stopped(Refusal::Cancelled, UNWRITTEN),
        io::ErrorKind::BrokenPipe => CliError::Output(error),
        _ => CliError::Failed(format!("cannot write {}: {error}", printable_path(path))),
    })
}

fn csv_to_io(error: csv::Error) -> io::Error {
    match error.into_kind() {
        csv::ErrorKind::Io(error) => error,
        other => io::Error::other(format!("{other:?}")),
    }
}
