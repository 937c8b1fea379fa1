//! One error for whoever goes through several rooms with `?`.

use crate::run::refusal::Refusal;
use crate::scenario::{CurveError, problem::ScenarioError};
use std::io;

/// Whatever can go wrong from the text of a scenario to a written file, ready to be shown.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// A scenario, or a field of it, makes no sense.
    #[error(transparent)]
    Scenario(#[from] ScenarioError),
    /// A recorded force curve cannot be taken.
    #[error(transparent)]
    Curve(#[from] CurveError),
    /// A scenario cannot be run, or not to its end.
    #[error(transparent)]
    Refused(#[from] Refusal),
    /// A file cannot be read or written.
    #[error(transparent)]
    Io(#[from] io::Error),
    /// A table cannot be read or written.
    #[error(transparent)]
    Csv(#[from] csv::Error),
}

impl Error {
    /// Whether another input would help.
    pub fn is_of_input(&self) -> bool {
        match self {
            Self::Scenario(_) | Self::Curve(_) => true,
            Self::Refused(refusal) => refusal.is_of_input(),
            Self::Io(_) | Self::Csv(_) => false,
        }
    }
}
