//! Why a command did not do what was asked, and the exit code that says so.

use std::io;

use crate::run::refusal::Refusal;
use crate::scenario::problem::ScenarioError;
use crate::tui::OpenError;

#[derive(Debug, thiserror::Error)]
pub enum CliError {
    /// The input was sound, but something went wrong.
    #[error("error: {0}")]
    Failed(String),
    /// Somebody stopped it; what was done has been printed.
    #[error("{0}")]
    Interrupted(String),
    /// What was asked for makes no sense.
    #[error("{0}")]
    Input(String),
    /// A scenario makes no sense; the text begins with a place, as editors expect.
    #[error(transparent)]
    Scenario(#[from] ScenarioError),
    /// A run was refused; what speaks of the scenario begins with a place as well.
    #[error("{lead}{0}", lead = if .0.is_of_input() { "" } else { "error: " })]
    Refused(#[from] Refusal),
    #[error(transparent)]
    App(#[from] OpenError),
    #[error("error: cannot write the output: {0}")]
    Output(#[from] io::Error),
}

impl CliError {
    /// A refusal; of somebody who stopped the work, with what that leaves.
    pub(super) fn stopped(refusal: Refusal, left: &str) -> Self {
        match refusal {
            Refusal::Cancelled => Self::Interrupted(format!("interrupted: {left}")),
            other => other.into(),
        }
    }

    /// 0 if nothing is to complain about, 1 for failures, 2 for bad input, 130 if it was stopped.
    pub fn exit_code(&self) -> u8 {
        match self {
            _ if self.is_broken_pipe() => 0,
            Self::Refused(refusal) if refusal.is_of_input() => 2,
            Self::Failed(_) | Self::Output(_) | Self::Refused(_) => 1,
            Self::Input(_) | Self::Scenario(_) => 2,
            Self::App(error) => error.exit_code(),
            Self::Interrupted(_) => 130,
        }
    }

    /// Whether the reader of the output has simply read enough.
    pub fn is_broken_pipe(&self) -> bool {
        matches!(self, Self::Output(error) if error.kind() == io::ErrorKind::BrokenPipe)
    }
}
