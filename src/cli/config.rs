//! `contrecoup config`: the person's settings of the app, each with what it may be.

use std::io::Write;

use crate::cli::CliError;
use crate::plain_text::printable;
use crate::tui::config;
use crate::tui::config::Config;

/// Prints the settings as a file that may be changed and kept.
///
/// # Errors
/// Where the file is refused or the output cannot be written.
pub fn run(out: &mut dyn Write) -> Result<(), CliError> {
    let config = Config::load()?;
    let place = config::path().map(|path| {
        let state = if config::is_there(&path) {
            "is read at every start"
        } else {
            "is not there, so these are the defaults"
        };
        format!("// {} {state}.\n", printable(&path.display().to_string()))
    });
    write!(out, "{}{}", place.unwrap_or_default(), config.to_ron())?;
    Ok(())
}
