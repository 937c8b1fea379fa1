//! The answer to the form: asked for at every edit, and its mesh error once nothing newer is wanted.

use std::sync::Arc;

use crate::answer::mesh_error::{MeshError, MeshQuery};
use crate::answer::solve::{Answer, solve};
use crate::run::kept::{Keep, Spacing};
use crate::run::refusal::Refusal;
use crate::run::watch::Watch;
use crate::scenario::{Impact, Scenario};
use crate::tui::model::{Model, Shown};
use crate::tui::task::{Question, Report};

/// Frames that a replay keeps.
const FRAMES: f64 = 400.0;
/// The time in which most happens after a short blow, in s.
const LIVELY: f64 = 5e-3;
/// Numbers of nodes times frames that a replay may keep: some 100 MB.
const MAX_KEPT: f64 = 4e6;

/// Asks for the answer to a scenario, with all that the screens show.
#[derive(Debug)]
pub struct Simulate(pub Scenario);

impl Question for Simulate {
    type Answer = Answer;

    fn answer(&self, watch: Watch) -> Result<Answer, Refusal> {
        solve(&self.0.check()?, keep(&self.0), watch)
    }
}

/// Asks for the mesh error of the answer on show.
#[derive(Debug)]
pub struct EstimateMesh {
    /// What was answered.
    pub scenario: Scenario,
    /// What of the answer matters.
    pub query: MeshQuery,
}

impl Question for EstimateMesh {
    type Answer = MeshError;

    fn answer(&self, watch: Watch) -> Result<MeshError, Refusal> {
        self.query.estimate(&self.scenario, watch)
    }

    fn is_idle(&self) -> bool {
        true
    }
}

/// Whether two scenarios have one answer: neither a title nor the doubt in an input changes a single run.
pub(super) fn is_alike(a: &Scenario, b: &Scenario) -> bool {
    let same = Scenario {
        name: b.name.clone(),
        doubt: b.doubt.clone(),
        ..a.clone()
    };
    same == *b
}

/// The form holds what the answer on show, or the one on its way, is the answer to as well.
pub(super) fn follow(model: &mut Model) {
    let scenario = &model.work.scenario;
    if let Some(shown) = &mut model.shown
        && is_alike(&shown.scenario, scenario)
    {
        shown.scenario.clone_from(scenario);
    }
}

/// Simulates the form.
pub(super) fn start(model: &mut Model) {
    let scenario = model.work.scenario.clone();
    model.run.ask(Simulate(scenario), &mut model.out);
}

/// What the workers say of the answer and of its mesh error.
pub(super) fn hear(model: &mut Model, report: &mut Option<Report>) {
    if let Some((asked, outcome)) = model.run.hear(report) {
        match outcome {
            Some(answer) => {
                model.shown = Some(Shown::new(asked.0.clone(), answer));
                follow(model);
            }
            None => explain_cancelling(model),
        }
    }
    if let Some((_, Some(mesh))) = model.mesh.hear(report)
        && let Some(shown) = model.shown.as_mut()
    {
        Arc::make_mut(&mut shown.answer).add(mesh);
    }
}

/// The answer on show, if its mesh error is not known and was not refused.
pub(super) fn lacks_mesh_error(model: &Model) -> Option<&Shown> {
    let lacks = |shown: &&Shown| shown.answer.errors.mesh.is_none();
    let refused = |shown: &&Shown| {
        let complaint = model.mesh.complaint.as_ref();
        complaint.is_some_and(|(asked, _)| is_alike(&asked.scenario, &shown.scenario))
    };
    let shown = model.shown.as_ref().filter(lacks);
    shown.filter(|shown| !refused(shown))
}

/// Estimates the mesh error of the answer on show while nothing is computed that somebody asked for; stops
/// where it is of another answer or not wanted any more.
pub(super) fn attend(model: &mut Model) {
    let free = model.idle && !model.is_busy();
    let wanted = lacks_mesh_error(model).filter(|_| free);
    let wanted = wanted.map(|shown| (shown.scenario.clone(), MeshQuery::of(&shown.answer)));
    let under_way = model.mesh.job.as_ref().map(|job| &job.question.scenario);
    let right = match (under_way, &wanted) {
        (Some(asked), Some((scenario, _))) => is_alike(asked, scenario),
        (asked, wanted) => asked.is_none() && wanted.is_none(),
    };
    if right {
        return;
    }
    model.mesh.stop(None, &mut model.out);
    if let Some((scenario, query)) = wanted {
        let question = EstimateMesh { scenario, query };
        model.mesh.ask(question, &mut model.out);
    }
}

/// A run that was cancelled begins by no key, but by the next edit.
fn explain_cancelling(model: &mut Model) {
    if let Some((_, why)) = &mut model.run.complaint
        && *why == Refusal::Cancelled.to_string()
    {
        why.push_str(": the next edit simulates again");
    }
}

/// In a long window half of the frames fall into the time in which most happens.
fn spacing(scenario: &Scenario, frames: f64) -> Spacing {
    let window = scenario.window_ms * 1e-3;
    let pulse = match &scenario.impact {
        Impact::ForcePulse(pulse) => pulse.duration_ms * 1e-3,
        Impact::Projectile(_) => 0.0,
    };
    let lively = LIVELY.max(2.0 * pulse);
    if window < 2.0 * lively {
        return Spacing::even(window / frames);
    }
    let early = (0.5 * frames).round();
    Spacing {
        early: early as u32,
        early_every: lively / early,
        every: (window - lively) / (frames - early),
    }
}

/// Everything that the screens show; fewer frames of a mesh too fine to keep them all.
pub fn keep(scenario: &Scenario) -> Keep {
    let side = 15.0 * f64::from(scenario.eye.level) + 1.0;
    let frames = FRAMES.min(MAX_KEPT / (side * side)).max(20.0);
    Keep {
        traces: true,
        frames: Some(spacing(scenario, frames)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::run::quantity::Quantity;
    use crate::run::watch::unwatched;

    #[test]
    fn the_mesh_error_needs_no_second_answer() {
        let scenario = Scenario::default();
        let answer = Simulate(scenario.clone()).answer(&mut unwatched).unwrap();
        let query = MeshQuery::of(&answer);
        let question = EstimateMesh { scenario, query };
        let damage = question.answer(&mut unwatched).unwrap().errors[Quantity::Damage].unwrap();
        assert!((20.0..40.0).contains(&damage), "{damage}");
    }
}
