//! What keys and news do to the ensemble: run for the main screen when idle, and for its own.

pub mod view;

use std::sync::Arc;

use super::Screen;
use crate::study::ensemble::Ensemble;
use crate::tui::ensemble::{FEW, Job, MANY, Sampling, key};
use crate::tui::model::{Model, Run};
use crate::tui::update::{Effect, ticket};
use crate::tui::worker::Report;

/// Nothing else is wanted now: runs a few samples of what is on show, for the band beside the score.
pub(crate) fn idle(model: &mut Model) -> Option<Effect> {
    let scenario = &model.work.scenario;
    let shown = model.shown.as_ref();
    let settled = model.run == Run::Settled && shown.is_some_and(|s| s.scenario == *scenario);
    let known = model.ensemble.of(scenario).is_some();
    (settled && !known && model.ensemble.job.is_none())
        .then(|| start(model, FEW))
        .flatten()
}

/// The screen was opened: runs many samples unless they are there.
pub(crate) fn opened(model: &mut Model) -> Option<Effect> {
    let known = model.ensemble.of(&model.work.scenario);
    let enough = known.is_some_and(|ensemble| ensemble.asked >= MANY);
    (model.screen == Screen::Doubt && !enough)
        .then(|| start(model, MANY))
        .flatten()
}

/// Runs so many samples, unless that is under way. A smaller run gives way to a larger one.
pub(crate) fn start(model: &mut Model, count: u32) -> Option<Effect> {
    let question = Sampling {
        scenario: key(&model.work.scenario),
        count,
    };
    let busy = |job: &Job| !job.stopping && job.question.count >= count;
    if model.ensemble.job.as_ref().is_some_and(busy) {
        return None;
    }
    let ticket = ticket(model);
    model.ensemble.complaint = None;
    model.ensemble.job = Some(Job {
        ticket,
        question: question.clone(),
        share: 0.0,
        stopping: false,
    });
    Some(Effect::Sample(ticket, question))
}

/// Asks for what is done so far.
pub(crate) fn stop(model: &mut Model) -> Option<Effect> {
    let job = model.ensemble.job.as_mut()?;
    job.stopping = true;
    Some(Effect::StopSampling(job.ticket))
}

/// Gives it up if the scenario became another, or if its screen was left before many were done.
pub(crate) fn stop_if_unwanted(model: &mut Model) -> Option<Effect> {
    let job = model.ensemble.job.as_ref()?;
    let same = job.question.scenario == key(&model.work.scenario);
    let wanted = same && (job.question.count <= FEW || model.screen == Screen::Doubt);
    if wanted || (same && job.stopping) {
        return None;
    }
    let ticket = job.ticket;
    if same {
        // What is done still serves the main screen.
        model.ensemble.job.as_mut()?.stopping = true;
    } else {
        model.ensemble.job = None;
    }
    Some(Effect::StopSampling(ticket))
}

/// Moves to another result.
pub(crate) fn go(model: &mut Model, down: bool) {
    let Some(ensemble) = model.ensemble.of(&model.work.scenario) else {
        return;
    };
    let count = ensemble.results().len();
    let at = &mut model.ensemble.output;
    *at = if down {
        (*at + 1).min(count.saturating_sub(1))
    } else {
        at.saturating_sub(1)
    };
}

/// What the worker says. News of anything but the job under way is dropped.
pub(crate) fn hear(model: &mut Model, report: Report<Ensemble>) {
    let Some(job) = &mut model.ensemble.job else {
        return;
    };
    match report {
        Report::Progress(ticket, share) if ticket == job.ticket => job.share = share,
        Report::Done(ticket, outcome) if ticket == job.ticket => {
            let asked = job.question.scenario.clone();
            model.ensemble.job = None;
            match *outcome {
                Ok(ensemble) => take(model, asked, ensemble),
                Err(refusal) => model.ensemble.complaint = Some((asked, refusal.to_string())),
            }
        }
        _ => {}
    }
}

/// Keeps the larger one of what was known and what has come.
fn take(model: &mut Model, asked: crate::scenario::Scenario, ensemble: Ensemble) {
    let known = model.ensemble.of(&asked).map_or(0, |e| e.samples.len());
    if ensemble.stopped() {
        let done = ensemble.samples.len();
        let text = format!("stopped after {done} of {}", ensemble.asked);
        model.ensemble.complaint = Some((asked.clone(), text));
    }
    if ensemble.samples.len() > known {
        let last = ensemble.results().len().saturating_sub(1);
        model.ensemble.output = model.ensemble.output.min(last);
        model.ensemble.done = Some((asked, Arc::new(ensemble)));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scenario::Scenario;
    use crate::study::{Refusal, unwatched};
    use crate::tui::ensemble::ensemble;
    use crate::tui::update::driven::{key, letter, opened};
    use crate::tui::update::{Message, begin, update};
    use crate::tui::worker::keep;
    use crossterm::event::KeyCode;

    fn sampled(effects: &[Effect]) -> Option<(u64, Sampling)> {
        effects.iter().find_map(|effect| match effect {
            Effect::Sample(ticket, question) => Some((*ticket, question.clone())),
            _ => None,
        })
    }

    /// A model with its answer, and what it asks for when the mesh error has come.
    fn idle_model() -> (Model, u64, Sampling) {
        let mut model = opened();
        model.work.scenario.window_ms = 0.2;
        let effects = begin(&mut model);
        let Effect::Solve(ticket, scenario) = &effects[0] else {
            panic!()
        };
        let answer = crate::study::solve(scenario, keep(scenario), &mut unwatched);
        update(
            &mut model,
            Message::Form(Report::Done(*ticket, Box::new(answer))),
        );
        let mesh = Report::Done(*ticket, Box::new(Err(Refusal::Cancelled)));
        let effects = update(&mut model, Message::Mesh(mesh));
        let (ticket, question) = sampled(&effects).expect("the band follows the mesh error");
        (model, ticket, question)
    }

    fn tell(model: &mut Model, ticket: u64, question: &Sampling, count: u32) {
        let small = Sampling {
            count,
            ..question.clone()
        };
        let mut outcome = ensemble(&small, &mut unwatched).unwrap();
        outcome.asked = question.count;
        let report = Report::Done(ticket, Box::new(Ok(outcome)));
        update(model, Message::Ensemble(report));
    }

    #[test]
    fn the_band_comes_when_idle_and_an_edit_stops_it() {
        let (mut model, ticket, question) = idle_model();
        assert_eq!(question.count, FEW);
        let scenario = model.work.scenario.clone();
        assert!(model.ensemble.of(&scenario).is_none());
        tell(&mut model, ticket, &question, 16);
        assert!(model.ensemble.of(&scenario).is_some());
        let renamed = Scenario {
            name: "other".to_owned(),
            ..scenario
        };
        assert!(model.ensemble.of(&renamed).is_some());

        let (mut model, ticket, question) = idle_model();
        let effects = letter(&mut model, 'l');
        assert!(effects.contains(&Effect::StopSampling(ticket)));
        tell(&mut model, ticket, &question, 8);
        assert!(model.ensemble.done.is_none(), "late news");
    }

    #[test]
    fn the_screen_asks_for_more_and_keeps_what_is_done_when_stopped() {
        let (mut model, ticket, question) = idle_model();
        tell(&mut model, ticket, &question, 8);
        let (ticket, question) = sampled(&letter(&mut model, '6')).unwrap();
        assert_eq!(question.count, MANY);
        update(&mut model, Message::Ensemble(Report::Progress(ticket, 0.3)));
        assert_eq!(model.ensemble.job.as_ref().unwrap().share, 0.3);
        assert_eq!(
            key(&mut model, KeyCode::Esc),
            [Effect::StopSampling(ticket)]
        );
        tell(&mut model, ticket, &question, 32);
        let kept = model.ensemble.of(&model.work.scenario).unwrap();
        assert!(kept.stopped() && kept.samples.len() == 32 && kept.asked == MANY);
        assert!(model.ensemble.complaint.is_some());
        assert!(letter(&mut model, '6').is_empty(), "only a key goes on");
        assert!(sampled(&letter(&mut model, 'm')).is_some());
        assert!(letter(&mut model, 'm').is_empty(), "one at a time");
    }

    #[test]
    fn leaving_the_screen_stops_it_and_results_can_be_walked_through() {
        let (mut model, ..) = idle_model();
        let (ticket, question) = sampled(&letter(&mut model, '6')).unwrap();
        let effects = letter(&mut model, '1');
        assert_eq!(effects, [Effect::StopSampling(ticket)]);
        assert!(letter(&mut model, '2').is_empty(), "once");
        tell(&mut model, ticket, &question, 8);
        assert!(model.ensemble.of(&model.work.scenario).is_some());
        model.screen = Screen::Doubt;
        for _ in 0..20 {
            letter(&mut model, 'j');
        }
        assert_eq!(model.ensemble.output, 8);
        letter(&mut model, 'k');
        assert_eq!(model.ensemble.output, 7);
        model.work.scenario.window_ms = 0.3;
        letter(&mut model, 'k');
        assert_eq!(model.ensemble.output, 7, "nothing to walk through");
    }
}
