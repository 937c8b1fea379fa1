//! `contrecoup completions` and `contrecoup man`: made from the definition of the arguments, so
//! that they cannot disagree with it.

use std::io::Write;

use clap::CommandFactory;
use clap::builder::Resettable;
use clap_complete::Shell;
use clap_mangen::Man;

use crate::cli::{Cli, CliError};

/// Prints the completion script of a shell.
///
/// # Errors
/// Where the output cannot be written.
pub fn completions(shell: Shell, out: &mut dyn Write) -> Result<(), CliError> {
    // The generator panics if its writer fails, so it writes to memory.
    let mut script = Vec::new();
    clap_complete::generate(shell, &mut Cli::command(), "contrecoup", &mut script);
    out.write_all(&script)?;
    Ok(())
}

/// Prints the manual page of the program, or of one of its commands.
///
/// # Errors
/// Where there is no such command or the output cannot be written.
pub fn man(command: Option<&str>, out: &mut dyn Write) -> Result<(), CliError> {
    // A page is for every machine, so it names no kernel.
    let mut program = Cli::command().long_version(Resettable::Reset);
    program.build();
    let page = match command {
        None => program,
        Some(name) => program.find_subcommand(name).cloned().ok_or_else(|| {
            let name = crate::plain_text::quoted(name);
            CliError::Input(format!("man {name}: there is no such command"))
        })?,
    };
    Man::new(page).render(out)?;
    Ok(())
}
