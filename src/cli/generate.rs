//! `contrecoup generate`: the manual page and completions, made from the definition of the
//! arguments, so that they cannot disagree with it.

use std::fs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use clap::builder::Resettable;
use clap::{CommandFactory, Subcommand};
use clap_complete::Shell;
use clap_mangen::Man;

use crate::cli::{Cli, CliError, example};
use crate::plain_text::{printable_path, quoted};
use crate::whole_file;

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
    /// Write the manual pages and the completions of bash, zsh and fish into a folder such as
    /// ~/.local/share, where shells look for them
    #[command(after_help = example("generate into ~/.local/share"))]
    Into {
        /// The folder
        #[arg(value_name = "FOLDER")]
        folder: PathBuf,
    },
}

pub fn run(what: &GenerateCommand, out: &mut dyn Write) -> Result<(), CliError> {
    match what {
        GenerateCommand::Completions { shell } => Ok(out.write_all(&script(*shell))?),
        GenerateCommand::Man { command } => man(command.as_deref(), out),
        GenerateCommand::Into { folder } => into(folder, out),
    }
}

/// Where a shell looks for its script below a folder of shared files.
const PLACES: [(Shell, &str); 3] = [
    (Shell::Bash, "bash-completion/completions/contrecoup"),
    (Shell::Zsh, "zsh/site-functions/_contrecoup"),
    (Shell::Fish, "fish/vendor_completions.d/contrecoup.fish"),
];

fn into(folder: &Path, out: &mut dyn Write) -> Result<(), CliError> {
    let mut files = PLACES.map(|(shell, place)| (place.to_owned(), script(shell))).to_vec();
    let commands = Cli::command();
    let names = commands.get_subcommands().map(|command| Some(command.get_name().to_owned()));
    for command in std::iter::once(None).chain(names) {
        let mut page = Vec::new();
        man(command.as_deref(), &mut page)?;
        let end = command.map_or_else(String::new, |name| format!("-{name}"));
        files.push((format!("man/man1/contrecoup{end}.1"), page));
    }
    for (place, text) in files {
        let path = folder.join(place);
        let said = printable_path(&path);
        let failed = |error: io::Error| CliError::Failed(format!("cannot write {said}: {error}"));
        fs::create_dir_all(path.parent().unwrap_or(folder)).map_err(failed)?;
        whole_file::write(&path, |file| file.write_all(&text)).map_err(failed)?;
        writeln!(out, "{said}")?;
    }
    Ok(())
}

/// The script that completes; the generator panics if its writer fails, so it writes to memory.
fn script(shell: Shell) -> Vec<u8> {
    let mut script = Vec::new();
    clap_complete::generate(shell, &mut Cli::command(), "contrecoup", &mut script);
    script
}

fn man(command: Option<&str>, out: &mut dyn Write) -> Result<(), CliError> {
    // A page is for every machine, so it names no kernel.
    let mut program = Cli::command().long_version(Resettable::Reset);
    program.build();
    let page = match command {
        None => program,
        Some(name) => program.find_subcommand(name).cloned().ok_or_else(|| {
            CliError::Input(format!("man {}: there is no such command", quoted(name)))
        })?,
    };
    Ok(Man::new(page).render(out)?)
}
