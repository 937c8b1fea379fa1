//! The cheapest mesh, integrator and step that give the damage index to a tolerance.
//!
//! Levels are tried from the coarsest. A level's mesh error comes from the two levels above it,
//! which are tried next, so nothing is computed twice. What a mesh error leaves of the tolerance
//! goes to the step: velocity Verlet, the cheapest at low accuracy, if its own estimate allows,
//! else the fourth-order composition, with shorter steps as needed.

use crate::answer::mesh_error::{MeshError, OnMesh, at_level, witnesses};
use crate::answer::solve::{Answer, solve_by};
use crate::answer::{compiled::Compiled, results::Results};
use crate::run::{quantity::Quantity, refusal::Refusal, rules::next_share, watch::Watch};
use crate::scenario::{CheckedScenario, Integrator, Scenario};

/// The finest level that is tried, by levels 6 and 7, so that level 8 can tell whether it is true.
pub const FINEST_TRIED: u32 = 5;
/// Below this tolerance, in %, Verlet cannot be the cheapest.
const VERLET_FROM_PERCENT: f64 = 0.2;
/// How often the step is shortened.
const MAX_ATTEMPTS: usize = 8;

/// An answer within a tolerance, and why it was computed that way.
#[derive(Debug, Clone)]
pub struct Chosen {
    /// The answer, its mesh error included.
    pub answer: Answer,
    /// The scenario with the chosen level.
    pub scenario: CheckedScenario,
    /// What was tried and chosen, a sentence each.
    pub reasons: Vec<String>,
    /// Springs or cells that were computed for it, those of coarser and finer meshes included.
    pub elements: f64,
}

/// Results of one scenario on the meshes of levels 1, 2, 3, ..., each computed once.
#[derive(Debug, Default)]
pub struct Ladder(Vec<OnMesh>);

impl Ladder {
    /// The results on the mesh of `level`, computed at the first call.
    pub(crate) fn at(
        &mut self,
        scenario: &Scenario,
        level: u32,
        watch: Watch,
    ) -> Result<OnMesh, Refusal> {
        while self.0.len() < level as usize {
            let next = self.0.len() as u32 + 1;
            self.0.push(at_level(scenario, next, watch)?);
        }
        Ok(self.0[level as usize - 1])
    }

    /// Springs or cells that levels 1 to `level` took.
    pub(crate) fn elements(&self, level: u32) -> f64 {
        self.0.iter().take(level as usize).map(|on| on.elements).sum()
    }
}

/// The error of the damage index, in %; one that is not known meets no tolerance.
fn of_damage(errors: &Results) -> f64 {
    errors[Quantity::Damage].unwrap_or(f64::INFINITY)
}

/// Answers `scenario` with the damage index within `percent` of its converged value, by a step and
/// level of our own; `ladder` holds the meshes of this scenario that were computed before.
///
/// # Errors
/// Refuses if no level up to [`FINEST_TRIED`] meets the tolerance, or the mesh folds.
pub fn within(
    ladder: &mut Ladder,
    scenario: &CheckedScenario,
    percent: f64,
    watch: Watch,
) -> Result<Chosen, Refusal> {
    let mut reasons = Vec::new();
    let mut best = f64::INFINITY;
    for level in 1..=FINEST_TRIED {
        let levels = witnesses(scenario, level);
        let own = ladder.at(scenario, level, watch)?;
        if let Some(ms) = own.folded.map(|time| time * 1e3) {
            let reason = format!(
                "the mesh of level {level} folds at {ms:.3} ms, beyond the model's validity"
            );
            return Err(Refusal::ToleranceNotMet { percent, reason });
        }
        let coarser = ladder.at(scenario, levels[0], watch)?;
        let finer = ladder.at(scenario, levels[1], watch)?;
        let mesh = MeshError::of(scenario, level, &own, [&coarser, &finer]);
        let Some(mesh_error) = mesh.errors[Quantity::Damage] else {
            reasons.push(format!("level {level}: finer meshes do not agree"));
            continue;
        };
        if mesh_error < percent {
            let mut at = Scenario::from(scenario.clone());
            at.eye.level = level;
            let at = at.check()?;
            let left = percent - mesh_error;
            reasons.push(format!(
                "level {level}: mesh error {mesh_error:.2} %, which leaves {left:.2} % for the step"
            ));
            let mut answer = meet(&Compiled::new(&at), left, watch, &mut reasons)?;
            answer.add(mesh);
            return Ok(Chosen {
                // An answer is two runs of about the same length.
                elements: ladder.elements(levels[1]) + 2.0 * answer.element_evaluations as f64,
                answer,
                scenario: at,
                reasons,
            });
        }
        best = best.min(mesh_error);
        reasons.push(format!("level {level}: mesh error {mesh_error:.2} %, too much"));
    }
    let reason = format!("the best of levels 1 to {FINEST_TRIED} has a mesh error of {best:.2} %");
    Err(Refusal::ToleranceNotMet { percent, reason })
}

/// The cheapest step on `case` whose damage error is at most `percent`.
fn meet(
    case: &Compiled,
    percent: f64,
    watch: Watch,
    reasons: &mut Vec<String>,
) -> Result<Answer, Refusal> {
    let rule = case.rules().answer;
    let plan = |integrator| case.plan_at(integrator, rule.share);
    if percent >= VERLET_FROM_PERCENT {
        let verlet = plan(Integrator::VelocityVerlet);
        let answer = solve_by(case.clone(), verlet, watch)?;
        let error = of_damage(&answer.errors.time_step);
        if error <= percent {
            reasons.push(format!(
                "velocity-verlet at {} of its stability limit: step error {error:.3} %, the cheapest",
                rule.share
            ));
            return Ok(answer);
        }
        reasons.push(format!("velocity-verlet: step error {error:.3} %, too much"));
    }
    let mut plan = plan(rule.integrator);
    let mut error = f64::INFINITY;
    for _ in 0..MAX_ATTEMPTS {
        let answer = solve_by(case.clone(), plan, watch)?;
        error = of_damage(&answer.errors.time_step);
        if error <= percent {
            reasons.push(format!(
                "{} at {:.2} of its stability limit: step error {error:.4} %",
                rule.integrator.name(),
                plan.step / answer.step_limit
            ));
            return Ok(answer);
        }
        plan.step *= next_share(percent, error, case.order(plan.integrator));
    }
    let reason = format!("the step error stays at {error:.3} %");
    Err(Refusal::ToleranceNotMet { percent, reason })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::run::watch::unwatched;

    #[test]
    fn what_is_answered_is_within_the_tolerance_by_step_and_mesh_and_meshes_are_computed_once() {
        let scenario = CheckedScenario::default();
        let mut ladder = Ladder::default();
        let mut ask = |percent| within(&mut ladder, &scenario, percent, &mut unwatched).unwrap();
        let rough = ask(50.0);
        let finer = ask(20.0);
        for (chosen, percent) in [(&rough, 50.0), (&finer, 20.0)] {
            let errors = &chosen.answer.errors;
            let mesh = errors.mesh.unwrap()[Quantity::Damage].unwrap();
            let stated = errors.time_step[Quantity::Damage].unwrap() + mesh;
            assert!(stated <= percent, "{stated}");
            assert_eq!(chosen.scenario.eye.level, chosen.answer.case.level());
        }
        assert!(finer.answer.case.level() > rough.answer.case.level());
        assert!(finer.elements > rough.elements);
        assert_eq!(ladder.0.len(), 4);
    }
}
