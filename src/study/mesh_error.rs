//! The mesh error of an answer, from the next finer mesh: grid convergence by Richardson's
//! extrapolation.
//!
//! The results of levels k and k + 1 differ by about C/(k (k + 1)) if they converge with the first
//! order of the spacing, which is the slowest seen; the error of level k is then C/k, or k + 1 times
//! the difference. At the finest level the next coarser one takes its place. Node forces scale with
//! node mass, so levels are compared by acceleration.
//!
//! On the standard case at levels 1 to 3 this gives about 27, 14 and 5 % for damage, where levels
//! 4 and 5 show that 20, 5 and 1 % would do: it is a bound with room, not a correction.

use super::case::{Case, Refusal, Watch};
use super::flags::{Flag, FlagKind};
use super::quantity::Family;
use super::results::Results;
use super::solve::Answer;
use crate::recording::Keep;
use crate::scenario::{NumericsInput, Scenario};

/// The finest level a scenario may ask for.
pub const FINEST_LEVEL: u32 = 8;

/// Mass of a node of the globe, in kg.
fn node_mass(case: &Case) -> f64 {
    case.eye.nodes[case.eye.landmarks.monitors[0]].mass
}

/// Results of `scenario` on the mesh of `level`, in terms of the node mass of `like`.
pub(super) fn at_level(
    scenario: &Scenario,
    level: u32,
    like: &Case,
    watch: Watch,
) -> Result<(Results, Option<f64>), Refusal> {
    with_mass(scenario, level, node_mass(like), watch)
}

fn with_mass(
    scenario: &Scenario,
    level: u32,
    mass: f64,
    watch: Watch,
) -> Result<(Results, Option<f64>), Refusal> {
    let mut other = scenario.clone();
    other.eye.level = level;
    // The mesh error is far larger than the step error of the automatic step.
    other.numerics = NumericsInput::default();
    let case = Case::new(&other.check()?);
    let plan = case.plan_alone(&other)?;
    let solution = case.run(&plan, Keep::default(), watch)?;
    let extremes = &solution.recording.extremes;
    let results = with_forces_times(case.results(extremes), mass / node_mass(&case));
    Ok((results, extremes.folded_at))
}

/// `results` of `from` in terms of the node mass of `to`.
pub(super) fn rescaled(results: Results, from: &Case, to: &Case) -> Results {
    with_forces_times(results, node_mass(to) / node_mass(from))
}

fn with_forces_times(results: Results, ratio: f64) -> Results {
    results.map(|quantity, value| {
        let ratio = if quantity.row().per_node_mass {
            ratio
        } else {
            1.0
        };
        value.map(|value| value * ratio)
    })
}

/// Mesh error in % of each result at `level`, from the results of a neighbouring level.
pub(super) fn between(level: u32, results: &Results, neighbour: u32, others: &Results) -> Results {
    let steps = f64::from(neighbour) / f64::from(level.abs_diff(neighbour));
    results.map(|quantity, value| {
        let (value, other) = ((*value)?, others[quantity]?);
        let difference = (value - other).abs();
        (quantity.row().family != Family::Unstated).then(|| {
            if difference == 0.0 {
                0.0
            } else {
                100.0 * steps * difference / value.abs()
            }
        })
    })
}

/// What of an answer its mesh error depends on, so that it can be estimated elsewhere.
#[derive(Debug, Clone, Copy)]
pub struct MeshQuery {
    level: u32,
    mass: f64,
    results: Results,
    folded: bool,
}

/// A mesh error, ready to be added to the answer that was asked for.
#[derive(Debug, Clone, PartialEq)]
pub struct MeshError {
    /// In % of each result.
    pub errors: Results,
    /// Raised if the finer mesh folds and the answer's does not.
    pub flag: Option<Flag>,
}

impl MeshQuery {
    /// The question for `answer`.
    pub fn of(answer: &Answer) -> Self {
        let extremes = &answer.recording.extremes;
        Self {
            level: answer.case.eye.level,
            mass: node_mass(&answer.case),
            results: answer.results(),
            folded: extremes.folded_at.is_some(),
        }
    }

    /// Solves `scenario`, the one that was answered, on a neighbouring mesh.
    ///
    /// # Errors
    /// As for any run.
    pub fn estimate(&self, scenario: &Scenario, watch: Watch) -> Result<MeshError, Refusal> {
        let neighbour = if self.level < FINEST_LEVEL {
            self.level + 1
        } else {
            self.level - 1
        };
        let (others, folded) = with_mass(scenario, neighbour, self.mass, watch)?;
        let flag = folded.filter(|_| !self.folded).map(|time| Flag {
            kind: FlagKind::FinerMeshFolds,
            message: format!(
                "the mesh of level {neighbour} folds at {:.3} ms: the model is near its end",
                time * 1e3
            ),
            time: Some(time),
        });
        Ok(MeshError {
            errors: between(self.level, &self.results, neighbour, &others),
            flag,
        })
    }
}

impl Answer {
    /// Takes in its mesh error.
    pub fn add(&mut self, mesh: MeshError) {
        self.errors.mesh = Some(mesh.errors);
        self.flags.extend(mesh.flag);
    }
}

/// Estimates the mesh error of `answer` and adds it, with a flag if the finer mesh folds.
///
/// # Errors
/// As for any run.
pub fn add_mesh_error(
    scenario: &Scenario,
    answer: &mut Answer,
    watch: Watch,
) -> Result<(), Refusal> {
    let mesh = MeshQuery::of(answer).estimate(scenario, watch)?;
    answer.add(mesh);
    Ok(())
}
