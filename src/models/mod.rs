//! The models: each turns a scenario into an eye, moves it and reads it off.
//!
//! Here is the one table of them. A further one is a folder beside these with a
//! [`EyeModel`](crate::run::model::EyeModel), its [rules](crate::run::rules::Rules), its readings
//! and its picture, a variant of [`Model`] with its fields, and a line in each function below.
//!
//! Bone has two laws, meant to be rigid both. At the axisymmetric eye it is a plane of rings beyond
//! the opening, each pushing back with 2e11 Pa/m over its area (75 mm of bone of 15e9 Pa): some
//! 1e8 N/m on the square centimetre or so that a body first rests on. In three dimensions it is
//! the rounded edge of a measured orbit, spheres that share 1e9 N/m by length of arc against what
//! is hard, and 3e10 Pa/m against the globe. A body whose own surface gives way is flattened by
//! both alike, by its own law. What is left between the two, a plane all round against an edge with
//! a gap, is a doubt of risks where bone is met.

pub mod axisymmetric;
pub mod paper;
pub mod pulse;
pub mod spatial;
#[cfg(test)]
mod step_tests;

use crate::models::axisymmetric::case::AxisymmetricCase;
use crate::models::paper::case::PaperCase;
use crate::models::spatial::case::{Scene, SpatialCase};
use crate::run::{model::EyeModel, rules::Rules};
use crate::scenario::{CheckedScenario, Impact, Model, Scenario};
use std::sync::Arc;

/// The vectors of this machine, in words; `portable` says what rounds alike everywhere.
pub use paper::forces::kernel::name as kernel_name;

/// Integrators, error estimates and mesh rules of the model that a scenario needs.
pub fn rules(scenario: &Scenario) -> &'static Rules {
    match scenario.geometry() {
        None => &paper::rules::RULES,
        Some(geometry) if geometry.is_spatial() => &spatial::rules::RULES,
        Some(_) => &axisymmetric::rules::RULES,
    }
}

/// The eye of a scenario and what hits it, ready to be run.
pub(crate) fn compiled(scenario: &CheckedScenario) -> Arc<dyn EyeModel> {
    let spatial = scenario.is_spatial();
    match (&scenario.model, &scenario.impact) {
        (Model::Physiological(model), Impact::Projectile(projectile)) if spatial => {
            Arc::new(SpatialCase::new(&Scene::new(scenario, model, projectile)))
        }
        (Model::Physiological(model), _) => Arc::new(AxisymmetricCase::new(scenario, model)),
        (Model::Paper, _) => Arc::new(PaperCase::new(scenario)),
    }
}
