//! `contrecoup sweep`: a grid of runs, in shards, to be gone on with after a kill.
//!
//! Rows are appended to the file whole and in order, so what a killed run leaves is the beginning
//! of the shard and at most one torn line. The next run cuts the torn line off, reads which rows
//! are there and does the rest. The heading holds a fingerprint of scenario, grid and version, by
//! which a file of another sweep is known and left alone.

use std::fs::{File, TryLockError};
use std::io::{self, BufRead, BufReader, Read, Seek, SeekFrom, Write};
use std::path::Path;

use crate::cli::{CliError, SweepArgs, arguments::complaints, interrupt, progress::shown};
use crate::many::{falling::FallingRows, sweep::Sweep};
use crate::plain_text::{printable_path, quoted};
use crate::report::{self, sweep::SweepFormat};
use crate::run::{ordered, watch::stop_if};

/// No row is longer, in bytes.
const LONGEST_LINE: u64 = 64 * 1024;

/// Which rows: those of a shard, counted from 1, of so many.
#[derive(Debug, Clone, Copy)]
pub struct Shard(usize, usize);

impl Shard {
    pub fn read(typed: &str) -> Result<Self, &'static str> {
        let wanted = "expected I/N with I from 1 to N and N up to 1000000, as in 3/8";
        let (index, of) = typed.split_once('/').ok_or(wanted)?;
        match (index.trim().parse(), of.trim().parse()) {
            (Ok(index), Ok(of)) if (1..=of).contains(&index) && of <= 1_000_000 => {
                Ok(Self(index, of))
            }
            _ => Err(wanted),
        }
    }

    fn rows(self, all: usize) -> Vec<usize> {
        let Self(index, of) = self;
        (index - 1..all).step_by(of).collect()
    }
}

/// Runs the rows of a shard that are not there yet.
pub fn run(args: &SweepArgs, out: &mut (dyn Write + Send)) -> Result<(), CliError> {
    let scenario = args.scenario.scenario()?;
    let sweep = Sweep::new(scenario.into(), args.vary.clone())
        .map_err(|error| complaints(&error, |p| format!("--vary {}", quoted(&p.field))))?;
    let form = if args.json { SweepFormat::Json } else { SweepFormat::Csv };
    let rows = args.shard.rows(sweep.rows());
    let Some(path) = &args.out else {
        out.write_all(form.heading(&sweep).as_bytes())?;
        return work(&sweep, form, &rows, 0, |line| {
            out.write_all(line.as_bytes())?;
            out.flush()
        });
    };
    let (mut file, done) = open(path, &sweep, form, &rows)?;
    let left = rows.len() - done;
    let said = |what: &str| format!("{}: {what}", printable_path(path));
    if left == 0 {
        let text = format!("all {} rows are there: nothing to do", rows.len());
        return Ok(writeln!(out, "{}", said(&text))?);
    }
    // One call, so that a kill tears at most this line.
    let put = |line: &str| file.write_all(line.as_bytes());
    work(&sweep, form, &rows, done, put).map_err(|error| match error {
        CliError::Output(error) => CliError::Failed(said(&format!("cannot be written: {error}"))),
        other => other,
    })?;
    let before = if done > 0 { format!(" to the {done} that were there") } else { String::new() };
    Ok(writeln!(out, "{}", said(&format!("{left} rows added{before}")))?)
}

/// Does rows from the `done`th on and writes each as one line, in their order.
fn work(
    sweep: &Sweep,
    form: SweepFormat,
    rows: &[usize],
    done: usize,
    mut write: impl FnMut(&str) -> io::Result<()> + Send,
) -> Result<(), CliError> {
    let stop = interrupt::flag()?;
    let (mut written, mut outcome) = (done, Ok(()));
    let mut falling = FallingRows::new(sweep);
    shown(|progress| {
        let job = |at: usize| sweep.run(rows[at], &mut ordered::until(&stop));
        ordered::run((done, rows.len()), &stop, job, |_, row| {
            outcome = write(&form.row(sweep, &row));
            falling.take(&row);
            written += usize::from(outcome.is_ok());
            progress.count("rows", written, rows.len());
            stop_if(outcome.is_err())
        });
    });
    outcome?;
    if let Some(said) = report::sweep::falling(&falling) {
        // Nobody is hurt if it is lost.
        let _ = writeln!(io::stderr(), "{said}");
    }
    if written < rows.len() {
        return Err(CliError::Interrupted(format!(
            "interrupted: {written} of {} rows done; the same command with --out goes on from there",
            rows.len()
        )));
    }
    Ok(())
}

/// Opens a file to append to, cut off at a damaged line; gives how many of `rows` it holds.
fn open(
    path: &Path,
    sweep: &Sweep,
    form: SweepFormat,
    rows: &[usize],
) -> Result<(File, usize), CliError> {
    let heading = &form.heading(sweep);
    let name = printable_path(path);
    let failed = |error: io::Error| CliError::Failed(format!("cannot write {name}: {error}"));
    let refused = |why: String| CliError::Input(format!("--out {name}: {why}"));
    if path.metadata().is_ok_and(|m| !m.is_file()) {
        let why = "is not a regular file; without --out rows go to standard output";
        return Err(refused(why.to_owned()));
    }
    let file = File::options().read(true).write(true).create(true).truncate(false).open(path);
    let mut file = file.map_err(failed)?;
    // Some network file systems have no locks; then nobody is told of a second writer.
    if let Err(TryLockError::WouldBlock) = file.try_lock() {
        return Err(CliError::Failed(format!("{name} is being written by another run")));
    }
    let mut reader = BufReader::new(&file);
    let mut head = Vec::new();
    let length = heading.len() as u64;
    reader.by_ref().take(length).read_to_end(&mut head).map_err(failed)?;
    let first_line = |text: &str| quoted(text.lines().next().unwrap_or_default());
    if !heading.as_bytes().starts_with(&head) {
        return Err(refused(format!(
            "holds something else: {} where {} was expected; choose another file",
            first_line(&String::from_utf8_lossy(&head)),
            first_line(heading)
        )));
    }
    // A heading that is torn holds no rows.
    let fresh = head.len() < heading.len();
    let (mut done, mut whole) = (0, length);
    loop {
        let mut line = Vec::new();
        let read = reader.by_ref().take(LONGEST_LINE).read_until(b'\n', &mut line);
        let read = read.map_err(failed)? as u64;
        if read < LONGEST_LINE && line.last() != Some(&b'\n') {
            // The end, or a line that a kill tore.
            break;
        }
        let text = String::from_utf8_lossy(&line);
        let line_number = heading.lines().count() + done + 1;
        let number = form.number(sweep, &text);
        // What is longer than a row, or stands behind the last, is no row that was damaged.
        if number.is_none() && done < rows.len() && read < LONGEST_LINE {
            // Nobody is hurt if it is lost.
            let what = format!("line {line_number} is damaged");
            let _ = writeln!(io::stderr(), "{name}: {what}: from there on rows are computed again");
            break;
        }
        if number.is_none() || number != rows.get(done).copied() {
            let held = quoted(text.trim_end());
            let why = format!("line {line_number}: {held} is not the next row of this shard");
            return Err(refused(why));
        }
        done += 1;
        whole += read;
    }
    file.set_len(if fresh { 0 } else { whole }).map_err(failed)?;
    file.seek(SeekFrom::End(0)).map_err(failed)?;
    if fresh {
        file.write_all(heading.as_bytes()).map_err(failed)?;
    }
    Ok((file, done))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shards_are_read_and_may_be_empty() {
        for bad in ["", "1", "0/2", "3/2", "a/b", "-1/2", "1/0"] {
            assert!(Shard::read(bad).is_err(), "{bad}");
        }
        assert_eq!(Shard::read("2/3").unwrap().rows(10), [1, 4, 7]);
        assert!(Shard::read("5/5").unwrap().rows(3).is_empty());
    }
}
