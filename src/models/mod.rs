//! The models: each turns a scenario into an eye, moves it and reads it off.
//!
//! Here is the one table of them. A further one is a folder beside these with a
//! [`EyeModel`](crate::run::model::EyeModel), its [rules](crate::run::rules::Rules), its readings
//! and its picture, a variant of [`Model`] with its fields, and a line in each function below.

pub mod axisymmetric;
pub mod paper;
pub mod pulse;
pub mod spatial;

use crate::run::model::EyeModel;
use crate::run::rules::Rules;
use crate::scenario::{CheckedScenario, Model};
use std::sync::Arc;

/// The vectors that this machine computes by, in words; `portable` says what rounds alike
/// everywhere.
pub use paper::forces::kernel::name as kernel_name;

/// Integrators, error estimates and mesh rules of a model.
pub fn rules(model: &Model) -> &'static Rules {
    match model {
        Model::Paper => &paper::rules::RULES,
        Model::Physiological(_) => &axisymmetric::rules::RULES,
    }
}

/// The eye of a scenario and what hits it, ready to be run.
pub(crate) fn compiled(scenario: &CheckedScenario) -> Arc<dyn EyeModel> {
    match &scenario.model {
        Model::Paper => Arc::new(paper::case::PaperCase::new(scenario)),
        Model::Physiological(model) => {
            Arc::new(axisymmetric::case::AxisymmetricCase::new(scenario, model))
        }
    }
}
