//! The answer to the form and its mesh error: what is asked, and what is done with what comes.

use std::sync::Arc;

use crate::run::refusal::Refusal;
use crate::tui::simulation::{Complete, Simulate, is_alike};
use crate::tui::{ensemble::key, model::AppModel, request::Report, shown::ShownAnswer};

/// The form holds what the answer on show, or the one on its way, is the answer to as well.
pub(crate) fn follow(model: &mut AppModel) {
    let scenario = &model.work.scenario;
    if let Some(shown) = &mut model.shown
        && is_alike(&shown.scenario, scenario)
    {
        shown.scenario.clone_from(scenario);
        model.answered = Some(model.work.clone());
    }
}

/// Takes the form back to what the answer on show is of; without one only ends the run.
pub(crate) fn cancel(model: &mut AppModel) {
    let Some(answered) = model.answered.clone() else {
        model.run.end(&mut model.out);
        return;
    };
    if model.run.stop(None, &mut model.out) {
        let left = std::mem::replace(&mut model.work, answered);
        model.notice = Some(format!("back at {}: u goes on with the other", model.work.name()));
        model.history.record(left, "", model.now);
        model.form.settle(&model.work.scenario);
        follow(model);
    }
}

/// Simulates the form.
pub(crate) fn start(model: &mut AppModel) {
    model.run.ask(Simulate(model.work.scenario.clone()), &mut model.out);
}

/// What the workers say of the answer and of its mesh error.
pub(crate) fn take_report(model: &mut AppModel, report: &mut Option<Report>) {
    if let Some((asked, outcome)) = model.run.take_report(report) {
        if let Some(answer) = outcome {
            model.shown = Some(ShownAnswer::new(asked.0.clone(), answer));
            follow(model);
        } else {
            // A run that was cancelled begins by no key, but by the next edit.
            let complaint = model.run.complaint.as_mut().map(|(_, why)| why);
            if let Some(why) = complaint.filter(|why| **why == Refusal::Cancelled.to_string()) {
                why.push_str(": the next edit simulates again");
            }
        }
    }
    if let Some((_, Some(mesh))) = model.rest.take_report(report)
        && let Some(shown) = model.shown.as_mut()
    {
        Arc::make_mut(&mut shown.answer).add(mesh);
    }
}

/// The question for the mesh error of the answer on show, if it lacks one that was not refused.
pub(crate) fn incomplete(model: &AppModel) -> Option<Complete> {
    let shown = model.shown.as_ref()?;
    let complaint = model.rest.complaint.as_ref();
    let refused = complaint.is_some_and(|(asked, _)| key(&asked.scenario) == key(&shown.scenario));
    Complete::of(&shown.scenario, &shown.answer).filter(|_| !refused)
}

/// Completes the answer on show, and no other, while nothing is computed that somebody asked for.
pub(crate) fn refresh_requests(model: &mut AppModel, screens_busy: bool) {
    let wanted = incomplete(model).filter(|_| model.idle && !model.is_busy() && !screens_busy);
    let under_way = model.rest.job.as_ref().map(|job| &job.question.scenario);
    let right = match (under_way, &wanted) {
        (Some(asked), Some(wanted)) => key(asked) == key(&wanted.scenario),
        (asked, wanted) => asked.is_none() && wanted.is_none(),
    };
    if right {
        return;
    }
    model.rest.stop(None, &mut model.out);
    if let Some(question) = wanted {
        model.rest.ask(question, &mut model.out);
    }
}
