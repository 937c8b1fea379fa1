//! An answer made whole: its mesh error, and what its inputs are not known to.

use crate::answer::{input_doubt::InputQuery, mesh_error::add_mesh_error, solve::Answer};
use crate::run::{ordered::until, refusal::Refusal};
use crate::scenario::Scenario;
use std::sync::atomic::AtomicBool;

/// The share of the progress of [`complete`] that stands for the meshes.
const MESHES: f64 = 0.6;

/// Adds mesh error, if there is none, and doubt of the inputs; `progress` is told the share done.
///
/// # Errors
/// As [`solve`](crate::answer::solve::solve).
pub fn complete(
    scenario: &Scenario,
    answer: &mut Answer,
    stop: &AtomicBool,
    mut progress: impl FnMut(f64) + Send,
) -> Result<(), Refusal> {
    if answer.errors.mesh.is_none() {
        add_mesh_error(scenario, answer, &mut |share| {
            progress(MESHES * share);
            until(stop)(share)
        })?;
    }
    let rest = |share| progress(MESHES + (1.0 - MESHES) * share);
    answer.inputs = Some(InputQuery::of(answer).estimate(scenario, stop, rest)?);
    Ok(())
}
