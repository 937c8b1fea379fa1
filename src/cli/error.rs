//! Why a command did not do what was asked, and the exit code that says so.

use std::io;

use crate::scenario::problem::ScenarioError;
use crate::study::Refusal;

/// Why a command did not do what was asked.
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
    /// The scenario makes no sense. Its lines begin with a place, as editors expect.
    #[error(transparent)]
    Scenario(#[from] ScenarioError),
    /// The answer could not be written to standard output.
    #[error("error: cannot write the output: {0}")]
    Output(#[from] io::Error),
}

impl From<Refusal> for CliError {
    fn from(refusal: Refusal) -> Self {
        match refusal {
            Refusal::StepAboveLimit { .. }
            | Refusal::TooMuchWork { .. }
            | Refusal::IntegratorUnfit { .. } => Self::Input(refusal.to_string()),
            Refusal::Diverged(_) | Refusal::ToleranceNotMet { .. } | Refusal::Cancelled => {
                Self::Failed(refusal.to_string())
            }
        }
    }
}

impl CliError {
    /// 0 where there is nothing to complain about, 1 for failures, 2 for bad input, 130 if it was
    /// stopped.
    pub fn exit_code(&self) -> u8 {
        match self {
            _ if self.is_broken_pipe() => 0,
            Self::Failed(_) | Self::Output(_) => 1,
            Self::Input(_) | Self::Scenario(_) => 2,
            Self::Interrupted(_) => 130,
        }
    }

    /// Whether the reader of the output has simply read enough.
    pub fn is_broken_pipe(&self) -> bool {
        matches!(self, Self::Output(error) if error.kind() == io::ErrorKind::BrokenPipe)
    }
}
