//! Samples over the doubt in the inputs: which are run, and what is done with those that come.

use std::sync::Arc;

use crate::tui::ensemble::{FEW, MANY, RunSamples, key};
use crate::tui::shown::ShownAnswer;
use crate::tui::{changes::simulation, guest::MOST_SAMPLES, model::AppModel, request::Report};

/// Whether nothing else is wanted, and the answer is an index, of which samples tell more.
fn is_settled(model: &AppModel, screens_busy: bool) -> bool {
    let answered = |shown: &ShownAnswer| {
        shown.scenario == model.work.scenario && shown.answer.silence().is_some()
    };
    let computes = screens_busy || model.is_busy() || simulation::incomplete(model).is_some();
    !computes && model.shown.as_ref().is_some_and(answered)
}

/// Runs the samples that the screen on show has `room` for: many where they are what it is about,
/// else a few once nothing else is wanted. What a person stopped goes on by a key alone.
pub(crate) fn refresh_requests(model: &mut AppModel, room: u32, screens_busy: bool) {
    let most = if model.guest { MOST_SAMPLES } else { MANY };
    let idle = room <= FEW;
    let count = room.min(most);
    let scenario = key(&model.work.scenario);
    let samples = &model.ensemble;
    let known = samples.known(&scenario).cloned();
    let lacks = known.as_ref().map_or(0, |known| known.samples.len()) < count as usize;
    let is_free = !idle || model.idle && is_settled(model, screens_busy);
    let wanted = lacks && is_free && samples.complaint(&scenario).is_none();
    if let Some(job) = &samples.task.job {
        let asked = &job.question;
        let right = asked.scenario == scenario && (asked.count, asked.idle) == (count, idle);
        // What was asked to end is about to say what it has.
        if right && (wanted || job.ending) {
            return;
        }
        model.ensemble.task.stop(None, &mut model.out);
    }
    if wanted {
        model.ensemble.task.ask(RunSamples { scenario, count, known, idle }, &mut model.out);
    }
}

pub(crate) fn take_report(model: &mut AppModel, report: &mut Option<Report>) {
    let samples = &mut model.ensemble;
    let Some((asked, Some(ensemble))) = samples.task.take_report(report) else { return };
    if samples.task.job.is_none() && ensemble.stopped() {
        let done = ensemble.samples.len();
        let text = format!("stopped after {done} of {}", ensemble.asked);
        samples.task.complaint = Some((asked.clone(), text));
    }
    samples.done = Some((asked.scenario.clone(), Arc::new(ensemble)));
}
