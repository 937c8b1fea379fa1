//! The answer to the form, and its mesh error: what is asked for, and what is done with what
//! comes.

use std::sync::Arc;

use crate::answer::mesh_error::MeshQuery;
use crate::run::refusal::Refusal;
use crate::tui::model::AppModel;
use crate::tui::request::Report;
use crate::tui::shown::ShownAnswer;
use crate::tui::simulation::{EstimateMesh, Simulate, is_alike};

/// The form holds what the answer on show, or the one on its way, is the answer to as well.
pub(crate) fn follow(model: &mut AppModel) {
    let scenario = &model.work.scenario;
    if let Some(shown) = &mut model.shown
        && is_alike(&shown.scenario, scenario)
    {
        shown.scenario.clone_from(scenario);
    }
}

/// Simulates the form.
pub(crate) fn start(model: &mut AppModel) {
    let scenario = model.work.scenario.clone();
    model.run.ask(Simulate(scenario), &mut model.out);
}

/// What the workers say of the answer and of its mesh error.
pub(crate) fn take_report(model: &mut AppModel, report: &mut Option<Report>) {
    if let Some((asked, outcome)) = model.run.take_report(report) {
        match outcome {
            Some(answer) => {
                model.shown = Some(ShownAnswer::new(asked.0.clone(), answer));
                follow(model);
            }
            None => explain_cancelling(model),
        }
    }
    if let Some((_, Some(mesh))) = model.mesh.take_report(report)
        && let Some(shown) = model.shown.as_mut()
    {
        Arc::make_mut(&mut shown.answer).add(mesh);
    }
}

/// The answer on show, if its mesh error is not known and was not refused.
pub(crate) fn lacks_mesh_error(model: &AppModel) -> Option<&ShownAnswer> {
    let lacks = |shown: &&ShownAnswer| shown.answer.errors.mesh.is_none();
    let refused = |shown: &&ShownAnswer| {
        let complaint = model.mesh.complaint.as_ref();
        complaint.is_some_and(|(asked, _)| is_alike(&asked.scenario, &shown.scenario))
    };
    let shown = model.shown.as_ref().filter(lacks);
    shown.filter(|shown| !refused(shown))
}

/// Estimates the mesh error of the answer on show while nothing is computed that somebody asked
/// for; stops where it is of another answer or not wanted any more.
pub(crate) fn refresh_requests(model: &mut AppModel, screens_busy: bool) {
    let free = model.idle && !model.is_busy() && !screens_busy;
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
fn explain_cancelling(model: &mut AppModel) {
    if let Some((_, why)) = &mut model.run.complaint
        && *why == Refusal::Cancelled.to_string()
    {
        why.push_str(": the next edit simulates again");
    }
}
