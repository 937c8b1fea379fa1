//! `contrecoup config`: the person's settings of the app, each with what it may be.

use std::io::Write;

use crate::cli::CliError;
use crate::plain_text::printable_path;
use crate::tui::{config, config::Config};

/// Prints the settings as a file that may be changed and kept.
pub fn run(out: &mut dyn Write) -> Result<(), CliError> {
    let config = Config::load()?;
    // Kept in a file, this line must stay true: it says where the file belongs, not whether it is.
    let place = config::path().map(|path| {
        let path = printable_path(&path);
        format!("// Read at every start, where it is there, from {path}.\n")
    });
    write!(out, "{}{}", place.unwrap_or_default(), config.to_ron())?;
    Ok(())
}
