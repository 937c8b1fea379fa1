//! The answer to the form, asked for at every edit, and what its ranges do not hold yet: the mesh
//! error, and what the inputs are not known to.

use crate::answer::mesh_error::{MeshError, MeshQuery};
use crate::answer::solve::{Answer, solve};
use crate::answer::{input_doubt::InputQuery, results::InputDoubt};
use crate::run::kept::{Keep, Spacing};
use crate::run::{refusal::Refusal, watch::Watch};
use crate::scenario::{Geometry, Impact, Scenario};
use crate::tui::{request::TaskQuestion, worker::idle_pool, worker::run_watched};

/// Frames that a replay keeps.
const FRAMES: f64 = 400.0;
/// The time in which most happens after a short blow, in s.
const LIVELY: f64 = 5e-3;
/// The time of the first half of them in a run whose end is not known, in s.
const EARLY: f64 = 0.8e-3;
/// Numbers of nodes times frames that a replay may keep: some 100 MB.
const MAX_KEPT: f64 = 4e6;

/// Asks for the answer to a scenario, with all that the screens show.
#[derive(Debug)]
pub struct Simulate(pub Scenario);

impl TaskQuestion for Simulate {
    type Answer = Answer;

    fn answer(&self, watch: Watch) -> Result<Answer, Refusal> {
        solve(&self.0.check()?, keep(&self.0), watch)
    }

    fn fill_in(&self, watch: Watch, show: &mut dyn FnMut(Answer)) -> Result<Answer, Refusal> {
        if let Some(first) = first_estimate(&self.0) {
            let first = Self(first).answer(&mut |_| watch(0.0));
            if let Ok(first) = first {
                show(first);
            }
        }
        self.answer(watch)
    }
}

/// The same blow straight on, where the eye in three dimensions takes long to answer.
pub fn first_estimate(scenario: &Scenario) -> Option<Scenario> {
    let mut first = scenario.clone();
    first.numerics.geometry = Geometry::Auto;
    if let Impact::Projectile(projectile) = &mut first.impact {
        (projectile.angle_deg, projectile.offset_mm) = (0.0, 0.0);
    }
    let slow = scenario.is_spatial();
    (slow && first.check().is_ok()).then_some(first)
}

/// Asks for what the ranges of an answer do not hold yet.
#[derive(Debug)]
pub struct Complete {
    /// What was answered.
    pub scenario: Scenario,
    mesh: Option<MeshQuery>,
    inputs: InputQuery,
}

/// What completes an answer: first the mesh error, then both.
#[derive(Debug, Clone)]
pub struct Completion {
    /// None where it is known already or was refused.
    pub mesh: Option<MeshError>,
    /// None while it is being counted.
    pub inputs: Option<InputDoubt>,
}

impl Complete {
    /// The question for the answer to a scenario.
    pub fn of(scenario: &Scenario, answer: &Answer) -> Self {
        Self {
            scenario: scenario.clone(),
            mesh: answer.errors.mesh.is_none().then(|| MeshQuery::of(answer)),
            inputs: InputQuery::of(answer),
        }
    }
}

impl Completion {
    /// Takes it into its answer, whose ranges it only widens: by an error, and in quadrature.
    pub fn put(self, answer: &mut Answer) {
        if let Some(mesh) = self.mesh.filter(|_| answer.errors.mesh.is_none()) {
            answer.add(mesh);
        }
        answer.inputs = self.inputs.or(answer.inputs);
    }
}

impl TaskQuestion for Complete {
    type Answer = Completion;

    fn answer(&self, watch: Watch) -> Result<Completion, Refusal> {
        self.fill_in(watch, &mut |_| {})
    }

    fn fill_in(
        &self,
        watch: Watch,
        show: &mut dyn FnMut(Completion),
    ) -> Result<Completion, Refusal> {
        let (scenario, mut first) = (&self.scenario, |share: f64| watch(0.5 * share));
        let mesh = match self.mesh.map(|mesh| mesh.estimate(scenario, &mut first)) {
            Some(Err(Refusal::Cancelled)) => return Err(Refusal::Cancelled),
            mesh => mesh.and_then(Result::ok),
        };
        let mut parts = Completion { mesh, inputs: None };
        show(parts.clone());
        let mut second = |share: f64| watch(0.5 + 0.5 * share);
        let inputs = run_watched(&mut second, &mut |()| {}, |stop, progress| {
            // `stop` tells it to end.
            let told = |share| _ = progress.report(share, || ());
            idle_pool().install(|| self.inputs.estimate(scenario, stop, told))
        });
        parts.inputs = Some(inputs?);
        Ok(parts)
    }

    fn is_idle(&self) -> bool {
        true
    }
}

/// Whether two scenarios have one answer, which neither a title nor a doubt changes.
pub(super) fn is_alike(a: &Scenario, b: &Scenario) -> bool {
    let same = Scenario { name: b.name.clone(), doubt: b.doubt.clone(), ..a.clone() };
    same == *b
}

/// In a long window half of the frames fall into the time in which most happens.
fn spacing(scenario: &Scenario, frames: f64) -> Spacing {
    let Some(window) = scenario.known_window_ms().map(|ms| ms * 1e-3) else {
        // All of them by 3.2 ms, and a quarter more each time that it lasts twice as long.
        let early = (0.5 * frames).round();
        return Spacing::doubling(early as u32, EARLY / early);
    };
    let pulse = match &scenario.impact {
        Impact::ForcePulse(pulse) => pulse.duration_ms * 1e-3,
        Impact::Projectile(_) => 0.0,
    };
    let lively = LIVELY.max(2.0 * pulse);
    if window < 2.0 * lively {
        return Spacing::even(window / frames);
    }
    let early = (0.5 * frames).round();
    let (early_every, every) = (lively / early, (window - lively) / (frames - early));
    Spacing { early: early as u32, early_every, every, doubles: false }
}

/// Everything that the screens show; fewer frames of a mesh too fine to keep them all.
pub fn keep(scenario: &Scenario) -> Keep {
    let side = 15.0 * f64::from(scenario.eye.level) + 1.0;
    let frames = FRAMES.min(MAX_KEPT / (side * side)).max(20.0);
    Keep { traces: true, frames: Some(spacing(scenario, frames)) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::run::watch::unwatched;
    use crate::scenario::library::find;

    /// The ranges of all risks.
    fn ranges(answer: &Answer) -> Vec<(f64, f64)> {
        answer.risks().iter().map(|risk| risk.range).collect()
    }

    #[test]
    fn each_part_of_what_completes_an_answer_only_widens_its_ranges() {
        for preset in ["bb-56", "squash-ball", "paper-300n"] {
            let scenario = find(preset).unwrap().scenario().unwrap();
            let mut answer = Simulate(scenario.clone()).answer(&mut unwatched).unwrap();
            let mut before = ranges(&answer);
            let question = Complete::of(&scenario, &answer);
            let mut parts = Vec::new();
            let whole = question.fill_in(&mut unwatched, &mut |part| parts.push(part)).unwrap();
            assert!(parts.len() == 1 && parts[0].inputs.is_none() && parts[0].mesh.is_some());
            parts.push(whole);
            for part in parts {
                part.put(&mut answer);
                let after = ranges(&answer);
                for (before, after) in before.iter().zip(&after) {
                    assert!(after.0 <= before.0 && before.1 <= after.1);
                }
                before = after;
            }
            assert!(answer.uncounted().is_empty());
        }
    }
}
