//! The mesh error of an answer, from two finer meshes, and the limit that they show.
//!
//! From level 2 on every level has the whole lens and measures over the same tissue, so that the
//! levels lie round a limit with no order that could be extrapolated: the shell crumples a little
//! differently on each. With d(a) and d(b) the results of the two levels after the answer's, b the
//! finer,
//!
//!   limit = d(b), known to 2 |d(a) - d(b)| + s f |d(b)|;  error = |d - limit| + what it is known
//!   to.
//!
//! Two levels may agree by chance, so s, the scatter of the result, is what level 3 may be off by
//! in any case, and f the width of the cells of level b over those of level 3, squared for the
//! smoother damage index and meridian of a section. The factor 2 and the shares s were read off 144
//! random scenes, in which the error of the damage index at levels 1 to 3 then holds in 99 % or
//! more, and for the axisymmetric eye off random objects; [`crate::verify::claims`] checks others.
//!
//! No limit and no error is stated where d(a) and d(b) are far apart, the error is several times
//! the result, or the mesh folds at one of the levels. Left out: what all levels share, as the
//! load's sharp edges and the shell without a thickness of its own.

use crate::answer::results::{Limit, Limits, Results};
use crate::answer::{compiled::Compiled, solve::Answer};
use crate::models::rules;
use crate::run::flags::{Flag, FlagKind};
use crate::run::watch::Watch;
use crate::run::{kept::Keep, ordered::until, quantity::Family, refusal::Refusal, threads::beside};
use crate::scenario::{Model, Scenario};
use std::sync::atomic::{AtomicBool, Ordering};

/// Multiplies the difference of the two finer levels.
const SAFETY: f64 = 2.0;
/// The level that the scatter of a result is told for.
const SCATTER_LEVEL: u32 = 3;
/// An error of more than so many times the result says nothing.
const LARGEST_ERROR: f64 = 3.0;

/// Results on one mesh.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct OnMesh {
    /// The results.
    pub results: Results,
    /// When the mesh folded, in s.
    pub folded: Option<f64>,
    /// Springs or cells that were computed.
    pub elements: f64,
}

/// Results of `scenario` on the mesh of `level`.
pub(crate) fn at_level(scenario: &Scenario, level: u32, watch: Watch) -> Result<OnMesh, Refusal> {
    let mut other = scenario.clone();
    // The mesh error is far larger than the step error of the automatic step.
    other.numerics = other.numerics.automatic();
    // A witness may be finer than what anyone may ask for.
    other.eye.level = level.min(rules(scenario).mesh.finest);
    let case = Compiled::new(&other.check()?).at_level(level);
    let plan = case.plan_alone(&other)?;
    let run = case.run(&plan, Keep::default(), watch)?;
    Ok(OnMesh {
        results: case.results(&run),
        folded: run.folded_at(),
        elements: (run.cost.evaluations * case.elements_per_evaluation()) as f64,
    })
}

/// The two levels that tell the error of `level`, the finer last.
pub fn witnesses(scenario: &Scenario, level: u32) -> [u32; 2] {
    (rules(scenario).mesh.witnesses)(level)
}

/// The limit that two levels show, the finer last, which is `finest`.
fn limit(scenario: &Scenario, levels: [&Results; 2], finest: u32) -> Limits {
    let mesh = &rules(scenario).mesh;
    let fineness = (mesh.fineness)(finest) / (mesh.fineness)(SCATTER_LEVEL);
    Limits::from_fn(|quantity| {
        let scatter = (mesh.scatter)(quantity);
        let [coarser, finer] = levels.map(|results| results[quantity]);
        let (coarser, value) = (coarser?, finer?);
        let gap = (coarser - value).abs();
        let size = coarser.abs().max(value.abs());
        let near = gap <= (scatter.apart * size).max(scatter.least);
        (near && quantity.row().family != Family::Unstated).then(|| Limit {
            value,
            error: SAFETY * gap
                + (scatter.share * value.abs() / fineness.powi(scatter.order)).max(scatter.least),
        })
    })
}

/// The error of `results` against `limits`, in % of each.
fn against(limits: &Limits, results: &Results) -> Results {
    results.map(|quantity, value| {
        let (value, limit) = ((*value)?, limits[quantity]?);
        let error = (value - limit.value).abs() + limit.error;
        if error == 0.0 {
            return Some(0.0);
        }
        (error <= LARGEST_ERROR * value.abs()).then(|| 100.0 * error / value.abs())
    })
}

/// What of an answer its mesh error depends on, so that it can be estimated elsewhere.
#[derive(Debug, Clone, Copy)]
pub struct MeshQuery {
    level: u32,
    own: OnMesh,
}

/// A mesh error, ready to be added to the answer that was asked for.
#[derive(Debug, Clone, PartialEq)]
pub struct MeshError {
    /// In % of each result; `None` where it has no limit.
    pub errors: Results,
    /// What finer meshes tend to.
    pub limits: Limits,
    /// Raised if a finer mesh folds and the answer's does not.
    pub flag: Option<Flag>,
}

impl MeshError {
    /// Of `own`, on the mesh of `level`, by the results of its [`witnesses`].
    pub(crate) fn of(scenario: &Scenario, level: u32, own: &OnMesh, witness: [&OnMesh; 2]) -> Self {
        let levels = witnesses(scenario, level);
        let first = levels.into_iter().zip(witness).find_map(|(at, on)| Some((at, on.folded?)));
        let folds = first.is_some() || own.folded.is_some();
        let seen = || limit(scenario, witness.map(|on| &on.results), levels[1]);
        let limits = if folds { Limits::default() } else { seen() };
        let flag = first.filter(|_| own.folded.is_none()).map(|(at, time)| {
            let when = format!("the mesh of level {at} folds at {:.3} ms", time * 1e3);
            let said = format!("{when}: the model is near its end");
            Flag::new(FlagKind::FinerMeshFolds, said, Some(time))
        });
        Self { errors: against(&limits, &own.results), limits, flag }
    }
}

impl MeshQuery {
    /// The question for `answer`.
    pub fn of(answer: &Answer) -> Self {
        Self {
            level: answer.case.level(),
            own: OnMesh {
                results: answer.results(),
                folded: answer.run.folded_at(),
                elements: answer.element_evaluations as f64,
            },
        }
    }

    /// Solves `scenario`, the one that was answered, on two other meshes side by side.
    ///
    /// # Errors
    /// As for any run.
    pub fn estimate(&self, scenario: &Scenario, watch: Watch) -> Result<MeshError, Refusal> {
        let levels = witnesses(scenario, self.level);
        let on = |level: u32, watch: Watch| {
            if level == self.level { Ok(self.own) } else { at_level(scenario, level, watch) }
        };
        let stopped = AtomicBool::new(false);
        // The finer takes longer, so it is the one that is watched.
        let coarse = || on(levels[0], &mut until(&stopped));
        let (coarse, fine) = beside(coarse, || {
            let fine = on(levels[1], watch);
            stopped.store(fine.is_err(), Ordering::Relaxed);
            fine
        });
        let (fine, coarse) = (fine?, coarse?);
        Ok(MeshError::of(scenario, self.level, &self.own, [&coarse, &fine]))
    }
}

impl Answer {
    /// Takes in its mesh error.
    pub fn add(&mut self, mesh: MeshError) {
        self.errors.mesh = Some(mesh.errors);
        self.errors.limits = Some(mesh.limits);
        self.flags.extend(mesh.flag);
    }
}

/// Whether answers to a scenario tell their mesh error unasked: those of the paper's springs, whose
/// mesh is what limits them most. Points of 50 % of an eye of cells were fitted on its own mesh.
pub fn is_asked(scenario: &Scenario) -> bool {
    scenario.model == Model::Paper
}

/// Estimates the mesh error of `answer` and adds it.
///
/// # Errors
/// As for any run.
pub fn add_mesh_error(
    scenario: &Scenario,
    answer: &mut Answer,
    watch: Watch,
) -> Result<(), Refusal> {
    answer.add(MeshQuery::of(answer).estimate(scenario, watch)?);
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::run::quantity::Quantity;

    /// By the usual scenario at a level, with the results there and at its witnesses.
    fn error(level: u32, own: &OnMesh, witness: &[OnMesh; 2]) -> MeshError {
        MeshError::of(&Scenario::default(), level, own, witness.each_ref())
    }

    fn on(damage: f64, front: f64) -> OnMesh {
        let mut results = Results::default();
        results[Quantity::Damage] = Some(damage);
        results[Quantity::ForceFront] = Some(front);
        OnMesh { results, folded: None, elements: 1.0 }
    }

    #[test]
    fn agreement_by_chance_is_no_convergence() {
        let mesh = error(1, &on(20.0, 50.0), &[on(20.0, 50.0), on(20.0, 90.0)]);
        let damage = mesh.errors[Quantity::Damage].unwrap();
        assert!((damage - 5.5).abs() < 1e-12, "{damage}");
        // Two levels that far apart tell nothing, whatever the third says.
        assert_eq!(mesh.errors[Quantity::ForceFront], None);
        assert_eq!(mesh.limits[Quantity::ForceFront], None);
        assert_eq!(mesh.errors[Quantity::Energy], None);
    }

    #[test]
    fn the_error_is_the_way_to_the_limit_and_what_that_is_known_to() {
        let mesh = error(2, &on(25.0, 50.0), &[on(20.5, 50.0), on(20.0, 50.0)]);
        let limit = mesh.limits[Quantity::Damage].unwrap();
        let scatter = 0.75 * 0.75 * 0.055 * 20.0;
        assert!(limit.value == 20.0 && (limit.error - 1.0 - scatter).abs() < 1e-12);
        let error = mesh.errors[Quantity::Damage].unwrap();
        assert!((error - 100.0 * (5.0 + limit.error) / 25.0).abs() < 1e-12);
    }

    #[test]
    fn a_mesh_that_folds_tells_no_limit() {
        let folded = OnMesh { folded: Some(1e-4), ..on(20.0, 50.0) };
        let mesh = error(1, &on(20.0, 50.0), &[on(20.0, 50.0), folded]);
        assert!(mesh.errors.present().next().is_none());
        assert!(mesh.flag.unwrap().message.contains("level 3"));
        let mesh = error(1, &folded, &[folded, folded]);
        assert!(mesh.errors.present().next().is_none() && mesh.flag.is_none());
    }

    #[test]
    fn the_finest_levels_are_their_own_witnesses() {
        let found = [1, 6, 7, 8].map(|level| witnesses(&Scenario::default(), level));
        assert_eq!(found, [[2, 3], [7, 8], [7, 8], [7, 8]]);
    }
}
