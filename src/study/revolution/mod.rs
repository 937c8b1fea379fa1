//! Scenarios with the axisymmetric model, and which of the two machines answers a scenario.
//!
//! `case` compiles one, `answer` runs it with its errors, `flags` says what limits the results. Sweeps,
//! ensembles and all else that is built from many runs know the section alone so far: there
//! [`super::Case::plan`] refuses this model.

mod answer;
mod case;
mod flags;

pub use answer::RevolutionAnswer;
pub use case::RevolutionCase;

use super::case::{Refusal, Watch};
use super::flags::Flag;
use super::mesh_error::add_mesh_error;
use super::results::Results;
use super::solve::{Answer, Errors, solve};
use crate::recording::Keep;
use crate::scenario::CheckedScenario;

/// An answer by the machine that a scenario's model needs.
#[derive(Debug, Clone)]
pub enum Solved {
    /// Springs in a section.
    Section(Box<Answer>),
    /// A body of revolution.
    Revolution(Box<RevolutionAnswer>),
}

/// Answers any scenario under the eyes of `watch`.
///
/// # Errors
/// What [`solve`] refuses, an object that goes through the eye, and what the watch stops.
pub fn solve_any(scenario: &CheckedScenario, keep: Keep, watch: Watch) -> Result<Solved, Refusal> {
    Ok(match RevolutionCase::new(scenario) {
        Some(case) => Solved::Revolution(Box::new(answer::solve(case, keep, watch)?)),
        None => Solved::Section(Box::new(solve(scenario, keep, watch)?)),
    })
}

impl Solved {
    /// Every result.
    pub fn results(&self) -> Results {
        match self {
            Self::Section(answer) => answer.results(),
            Self::Revolution(answer) => answer.results(),
        }
    }

    /// How far the results may be off.
    pub fn errors(&self) -> &Errors {
        match self {
            Self::Section(answer) => &answer.errors,
            Self::Revolution(answer) => &answer.errors,
        }
    }

    /// What limits them.
    pub fn flags(&self) -> &[Flag] {
        match self {
            Self::Section(answer) => &answer.flags,
            Self::Revolution(answer) => &answer.flags,
        }
    }

    /// Estimates the mesh error from a neighbouring level and adds it.
    ///
    /// # Errors
    /// As for any run.
    pub fn add_mesh_error(
        &mut self,
        scenario: &CheckedScenario,
        watch: Watch,
    ) -> Result<(), Refusal> {
        match self {
            Self::Section(answer) => add_mesh_error(scenario, answer, watch),
            Self::Revolution(answer) => answer.add_mesh_error(watch),
        }
    }
}

#[cfg(test)]
mod tests;
