//! `contrecoup guide`: the pages of the guide, through a pager where somebody sits at a terminal.
//!
//! The pager is that of `PAGER`, or `less`. It is started without a shell, and `less` is told to
//! open neither files nor programs, since a page of text needs none; where it cannot be started
//! the page is printed as it is.

use std::env;
use std::io::{self, IsTerminal, Write};
use std::process::{Command, Stdio};
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use clap::builder::PossibleValue;
use signal_hook::consts::SIGINT;

use crate::cli::CliError;
use crate::guide::{TOPICS, contents};

/// What may be asked for, each with the title of its page.
pub(super) fn topics() -> Vec<PossibleValue> {
    let value = |topic: &crate::guide::Topic| PossibleValue::new(topic.name).help(topic.title());
    TOPICS.iter().map(value).collect()
}

/// Prints the page of a topic, or the list of topics.
pub fn run(topic: Option<&str>, out: &mut dyn Write) -> Result<(), CliError> {
    let Some(topic) = TOPICS.iter().find(|known| Some(known.name) == topic) else {
        return Ok(write!(out, "{}\n`contrecoup guide TOPIC` prints one.\n", contents())?);
    };
    let page = topic.plain();
    match pager() {
        Some(words) if io::stdout().is_terminal() && shown(&words, &page)? => {}
        _ => out.write_all(page.as_bytes())?,
    }
    Ok(())
}

/// The pager with its arguments, where one is wanted and the terminal can move its cursor.
fn pager() -> Option<Vec<String>> {
    let dumb = env::var("TERM").map_or(true, |term| term == "dumb");
    let asked = env::var_os("PAGER").unwrap_or_else(|| "less".into());
    let words = shell_words::split(asked.to_str()?).ok()?;
    (!dumb && !words.is_empty()).then_some(words)
}

/// Shows a page through a pager; false if it could not be started.
fn shown(words: &[String], page: &str) -> io::Result<bool> {
    let mut command = Command::new(&words[0]);
    command.args(&words[1..]).stdin(Stdio::piped());
    command.env("LESSSECURE", "1");
    if env::var_os("LESS").is_none() {
        // Leave at once if the page fits on the screen, and leave it standing there.
        command.env("LESS", "FRX");
    }
    // Ctrl-C is for the pager, which would otherwise be left with the terminal to itself.
    let ignored = signal_hook::flag::register(SIGINT, Arc::new(AtomicBool::new(false)))?;
    let Ok(mut child) = command.spawn() else {
        signal_hook::low_level::unregister(ignored);
        return Ok(false);
    };
    let written = child.stdin.take().map_or(Ok(()), |mut to| to.write_all(page.as_bytes()));
    child.wait()?;
    match written {
        // Nobody has to read to the end.
        Err(error) if error.kind() != io::ErrorKind::BrokenPipe => Err(error),
        _ => Ok(true),
    }
}
