//! What keys and news do to the measurement of speed against error.

use super::{Effect, Screen, change, ticket};
use crate::dynamics::LOCAL_TOLERANCE;
use crate::study::Refusal;
use crate::study::accuracy::Accuracy;
use crate::tui::accuracy::{Job, adopted, question};
use crate::tui::model::Model;
use crate::tui::worker::Report;

/// The screen was opened: measures unless there is a result for this scenario.
pub(super) fn opened(model: &mut Model) -> Option<Effect> {
    let fresh = model.accuracy.measured.is_some() && !model.accuracy.is_stale(&model.work.scenario);
    (model.screen == Screen::Accuracy && !fresh)
        .then(|| start(model))
        .flatten()
}

/// Measures, unless that is under way.
pub(super) fn start(model: &mut Model) -> Option<Effect> {
    if model.accuracy.job.is_some() {
        return None;
    }
    let ticket = ticket(model);
    let question = question(&model.work.scenario);
    model.accuracy.complaint = None;
    model.accuracy.job = Some(Job {
        ticket,
        question: question.clone(),
        share: 0.0,
    });
    Some(Effect::Measure(ticket, question))
}

/// Gives up what is under way.
pub(super) fn stop(model: &mut Model) -> Option<Effect> {
    let job = model.accuracy.job.take()?;
    model.accuracy.complaint = Some("cancelled".to_owned());
    Some(Effect::StopMeasuring(job.ticket))
}

/// Gives it up if the screen was left or the scenario became another.
pub(super) fn stop_if_unwanted(model: &mut Model) -> Option<Effect> {
    let job = model.accuracy.job.as_ref()?;
    let wanted = model.screen == Screen::Accuracy && job.question == question(&model.work.scenario);
    if wanted { None } else { stop(model) }
}

/// What the worker says. News of anything but the job under way is dropped.
pub(super) fn hear(model: &mut Model, report: Report<Accuracy>) {
    let Some(job) = &mut model.accuracy.job else {
        return;
    };
    match report {
        Report::Progress(ticket, share) if ticket == job.ticket => job.share = share,
        Report::Done(ticket, outcome) if ticket == job.ticket => {
            let question = job.question.clone();
            model.accuracy.job = None;
            match *outcome {
                Ok(report) => model.accuracy.take(question, report),
                Err(Refusal::Cancelled) => {
                    model.accuracy.complaint = Some("cancelled".to_owned());
                }
                Err(refusal) => model.accuracy.complaint = Some(refusal.to_string()),
            }
        }
        _ => {}
    }
}

/// Gives the scenario the integrator and the step of the point under the cursor.
pub(super) fn adopt(model: &mut Model, effects: &mut Vec<Effect>) {
    let Some(point) = model.accuracy.chosen().copied() else {
        return;
    };
    if model.accuracy.is_stale(&model.work.scenario) {
        model.notice = Some("measured for another scenario: m measures this one".to_owned());
        return;
    }
    let scenario = adopted(&model.work.scenario, &point);
    let step = scenario.numerics.step_us.unwrap_or_default();
    let name = point.plan.integrator.name();
    let work = model.work.with(scenario);
    change(model, work, "", effects);
    let mut notice = format!("adopted {name}, step {step} µs");
    if point.plan.integrator.adaptive() {
        notice.push_str(&format!("; its tolerance stays {LOCAL_TOLERANCE:e}"));
    }
    model.notice = Some(notice);
}
