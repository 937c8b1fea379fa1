//! The answer to the form and what completes it: what is asked, and what is done with what comes.

use std::sync::Arc;

use crate::run::refusal::Refusal;
use crate::tui::model::{AppModel, FIRST_ESTIMATE};
use crate::tui::simulation::{Complete, Simulate, first_estimate, is_alike};
use crate::tui::{ensemble::key, request::Report, shown::ShownAnswer};

/// The form holds what the answer on show, or the one on its way, is the answer to as well.
pub(crate) fn follow(model: &mut AppModel) {
    let scenario = &model.work.scenario;
    if let Some(shown) = &mut model.shown
        && is_alike(&shown.scenario, scenario)
    {
        if shown.scenario.doubt != scenario.doubt && shown.answer.inputs.is_some() {
            Arc::make_mut(&mut shown.answer).inputs = None;
        }
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
        show_finished(model);
        let left = std::mem::replace(&mut model.work, answered);
        model.notice = Some(format!("back at {}: u goes on with the other", model.work.name()));
        model.history.record(left, "", model.now);
        model.form.settle(&model.work.scenario);
        follow(model);
    }
}

/// What was on show before a first estimate, whose blow is not followed to its end.
fn show_finished(model: &mut AppModel) {
    if let Some(finished) = model.finished.take() {
        model.shown = Some(finished);
    }
}

/// Simulates the form.
pub(crate) fn start(model: &mut AppModel) {
    model.run.ask(Simulate(model.work.scenario.clone()), &mut model.out);
}

/// What the workers say of the answer and of what completes it.
pub(crate) fn take_report(model: &mut AppModel, report: &mut Option<Report>) {
    if let Some((asked, outcome)) = model.run.take_report(report) {
        match outcome {
            Some(answer) if model.run.job.is_some() => {
                // Before the first answer there are estimates only.
                let before = model.shown.take().filter(|_| model.answered.is_some());
                model.finished = model.finished.take().or(before);
                let first = first_estimate(&asked.0);
                model.shown = first.map(|first| ShownAnswer::new(first, answer));
            }
            Some(answer) => {
                model.finished = None;
                model.shown = Some(ShownAnswer::new(asked.0.clone(), answer));
                follow(model);
            }
            None => {
                show_finished(model);
                // A run that was cancelled begins by no key, but by the next edit.
                let complaint = model.run.complaint.as_mut().map(|(_, why)| why);
                if let Some(why) = complaint.filter(|why| **why == Refusal::Cancelled.to_string()) {
                    why.push_str(": the next edit simulates again");
                }
            }
        }
    }
    if let Some((_, Some(part))) = model.rest.take_report(report)
        && let Some(shown) = model.shown.as_mut()
    {
        part.put(Arc::make_mut(&mut shown.answer));
    }
}

/// The answer on show, if something is still to be counted in its ranges and was not refused.
pub(crate) fn incomplete(model: &AppModel) -> Option<&ShownAnswer> {
    let refused = |shown: &ShownAnswer| {
        let complaint = model.rest.complaint.as_ref();
        complaint.is_some_and(|(asked, _)| key(&asked.scenario) == key(&shown.scenario))
    };
    let shown = model.shown.as_ref().filter(|_| model.stale() != Some(FIRST_ESTIMATE))?;
    (shown.answer.inputs.is_none() && !refused(shown)).then_some(shown)
}

/// Completes the answer on show, and no other, while nothing is computed that somebody asked for.
pub(crate) fn refresh_requests(model: &mut AppModel, screens_busy: bool) {
    let wanted = incomplete(model).filter(|_| model.idle && !model.is_busy() && !screens_busy);
    let under_way = model.rest.job.as_ref().map(|job| &job.question.scenario);
    let right = match (under_way, wanted) {
        (Some(asked), Some(shown)) => key(asked) == key(&shown.scenario),
        (asked, wanted) => asked.is_none() && wanted.is_none(),
    };
    if right {
        return;
    }
    let question = wanted.map(|shown| Complete::of(&shown.scenario, &shown.answer));
    model.rest.stop(None, &mut model.out);
    if let Some(question) = question {
        model.rest.ask(question, &mut model.out);
    }
}
