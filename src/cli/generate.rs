//! `contrecoup generate`: the manual page and completions, made from the definition of the
//! arguments, so that they cannot disagree with it.

use std::io::Write;

use clap::builder::Resettable;
use clap::{CommandFactory, Subcommand};
use clap_complete::Shell;
use clap_mangen::Man;

use crate::cli::{Cli, CliError, example};

/// What is printed.
#[derive(Debug, Subcommand)]
pub enum GenerateCommand {
    /// Print a script that completes commands in a shell
    #[command(after_help = example("generate completions bash"))]
    Completions {
        /// The shell
        shell: Shell,
    },
    /// Print the manual page, of the program or of one command
    #[command(after_help = example("generate man run"))]
    Man {
        /// The command
        command: Option<String>,
    },
}

/// Prints what was asked for.
///
/// # Errors
/// Where there is no such command or the output cannot be written.
pub fn run(what: &GenerateCommand, out: &mut dyn Write) -> Result<(), CliError> {
    match what {
        GenerateCommand::Completions { shell } => completions(*shell, out),
        GenerateCommand::Man { command } => man(command.as_deref(), out),
    }
}

fn completions(shell: Shell, out: &mut dyn Write) -> Result<(), CliError> {
    // The generator panics if its writer fails, so it writes to memory.
    let mut script = Vec::new();
    clap_complete::generate(shell, &mut Cli::command(), "contrecoup", &mut script);
    out.write_all(&script)?;
    Ok(())
}

fn man(command: Option<&str>, out: &mut dyn Write) -> Result<(), CliError> {
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
