//! The models: each turns a scenario into an eye, moves it and reads it off.
//!
//! Here is the one table of them. A further one is a folder beside these with a
//! [case](crate::run::model::EyeModel), its [rules](crate::run::rules::Rules), its readings and its
//! picture, a variant of [`Model`] with its fields, and a line in each function below.

pub mod axisymmetric;
pub mod paper;
pub mod pulse;

use crate::run::model::EyeModel;
use crate::run::rules::Rules;
use crate::scenario::{CheckedScenario, Model};
use std::sync::Arc;

/// What holds for every scene of a model.
pub fn rules(model: &Model) -> &'static Rules {
    match model {
        Model::Paper => &paper::rules::RULES,
        Model::Physiological(_) => &axisymmetric::rules::RULES,
    }
}

/// The eye of a scenario and what hits it, ready to be run.
pub(crate) fn compiled(scenario: &CheckedScenario) -> Arc<dyn EyeModel> {
    match &scenario.model {
        Model::Paper => Arc::new(paper::case::Case::new(scenario)),
        Model::Physiological(model) => {
            Arc::new(axisymmetric::case::RevolutionCase::new(scenario, model))
        }
    }
}
