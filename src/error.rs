//! One error for whoever goes through several rooms with `?`.

use std::io;

use crate::run::refusal::Refusal;
use crate::scenario::{CurveError, problem::ScenarioError};

/// Whatever can go wrong from the text of a scenario to a written file. Each is displayed as it
/// stands, ready to be shown to a person.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// A scenario, or a field of it, makes no sense: each problem with its place, its value and
    /// what is allowed.
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
    /// Whether another input would help: else the run failed, was stopped, or a file could not be
    /// had.
    pub fn is_of_input(&self) -> bool {
        match self {
            Self::Scenario(_) | Self::Curve(_) => true,
            Self::Refused(refusal) => refusal.is_of_input(),
            Self::Io(_) | Self::Csv(_) => false,
        }
    }
}
