//! What keys and news do to the measurement of speed against error.

mod log_axis;
pub mod measurement;
pub mod view;

use super::Screen;
use crate::dynamics::LOCAL_TOLERANCE;
use crate::study::Refusal;
use crate::study::accuracy::Accuracy;
use crate::tui::model::Model;
use crate::tui::screens::accuracy::measurement::{Job, adopted, question};
use crate::tui::update::{Effect, change, ticket};
use crate::tui::worker::Report;

/// The screen was opened: measures unless there is a result for this scenario.
pub(crate) fn opened(model: &mut Model) -> Option<Effect> {
    let fresh = model.accuracy.measured.is_some() && !model.accuracy.is_stale(&model.work.scenario);
    (model.screen == Screen::Accuracy && !fresh)
        .then(|| start(model))
        .flatten()
}

/// Measures, unless that is under way.
pub(crate) fn start(model: &mut Model) -> Option<Effect> {
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
pub(crate) fn stop(model: &mut Model) -> Option<Effect> {
    let job = model.accuracy.job.take()?;
    model.accuracy.complaint = Some("cancelled".to_owned());
    Some(Effect::StopMeasuring(job.ticket))
}

/// Gives it up if the screen was left or the scenario became another.
pub(crate) fn stop_if_unwanted(model: &mut Model) -> Option<Effect> {
    let job = model.accuracy.job.as_ref()?;
    let wanted = model.screen == Screen::Accuracy && job.question == question(&model.work.scenario);
    if wanted { None } else { stop(model) }
}

/// What the worker says. News of anything but the job under way is dropped.
pub(crate) fn hear(model: &mut Model, report: Report<Accuracy>) {
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
pub(crate) fn adopt(model: &mut Model, effects: &mut Vec<Effect>) {
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
    if point.plan.integrator.method().adaptive() {
        notice = format!("{notice}; its tolerance stays {LOCAL_TOLERANCE:e}");
    }
    model.notice = Some(notice);
}

#[cfg(test)]
#[path = "../../../../tests/support/accuracy.rs"]
mod made_up;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tui::update::driven::{key, letter, opened};
    use crate::tui::update::{Message, begin, update};
    use crossterm::event::KeyCode;

    fn model() -> Model {
        let mut model = opened();
        model.work.scenario.window_ms = 0.2;
        begin(&mut model);
        model
    }

    fn ticket_of(effects: &[Effect]) -> u64 {
        match effects {
            [Effect::Measure(ticket, _)] => *ticket,
            other => panic!("{other:?}"),
        }
    }

    /// A model whose screen shows a measurement.
    fn measured() -> Model {
        let mut model = model();
        let effects = key(&mut model, KeyCode::F(5));
        let outcome = Ok(made_up::made_up());
        let report = Report::Done(ticket_of(&effects), Box::new(outcome));
        update(&mut model, Message::Accuracy(report));
        assert!(model.accuracy.job.is_none() && model.accuracy.chosen().is_some());
        model
    }

    #[test]
    fn the_cursor_goes_through_time_and_along_the_front() {
        let mut model = measured();
        for _ in 0..100 {
            key(&mut model, KeyCode::Left);
        }
        let fastest = *model.accuracy.chosen().unwrap();
        assert!(fastest.on_front && model.accuracy.cursor == 0);
        key(&mut model, KeyCode::Right);
        assert!(model.accuracy.chosen().unwrap().seconds >= fastest.seconds);
        while {
            let before = model.accuracy.cursor;
            letter(&mut model, 'L');
            model.accuracy.cursor > before
        } {
            assert!(model.accuracy.chosen().unwrap().on_front);
        }
    }

    #[test]
    fn a_point_is_adopted_and_that_can_be_undone() {
        let mut model = measured();
        let before = model.work.scenario.clone();
        let plan = model.accuracy.chosen().unwrap().plan;
        let effects = key(&mut model, KeyCode::Enter);
        assert!(matches!(effects[..], [Effect::Solve(..)]));
        let numerics = model.work.scenario.numerics.clone();
        assert!(numerics.integrator.is_some());
        let step = numerics.step_us.unwrap() * 1e-6;
        assert!(step <= plan.step && step > plan.step * 0.9999);
        assert!(!model.accuracy.is_stale(&model.work.scenario));
        letter(&mut model, 'u');
        assert_eq!(model.work.scenario, before);
    }

    #[test]
    fn an_edit_makes_it_stale_and_only_a_key_measures_again() {
        let mut model = measured();
        assert!(letter(&mut model, '1').is_empty());
        assert!(
            key(&mut model, KeyCode::F(5)).is_empty(),
            "it is still right"
        );
        letter(&mut model, '1');
        let effects = letter(&mut model, 'l');
        assert!(matches!(effects[..], [Effect::Solve(..)]));
        model.work.scenario.window_ms = 0.3;
        assert!(model.accuracy.is_stale(&model.work.scenario));
        model.screen = Screen::Accuracy;
        let before = model.work.clone();
        assert!(key(&mut model, KeyCode::Enter).is_empty());
        assert!(model.work == before && model.notice.is_some());
        ticket_of(&letter(&mut model, 'm'));
        assert!(letter(&mut model, 'm').is_empty(), "one at a time");
    }

    #[test]
    fn leaving_an_edit_and_escape_stop_it_and_late_news_is_dropped() {
        for leave in ['1', '\u{1b}', 'u'] {
            let mut model = model();
            letter(&mut model, 'l');
            let ticket = ticket_of(&key(&mut model, KeyCode::F(5)));
            let code = if leave == '\u{1b}' {
                KeyCode::Esc
            } else {
                KeyCode::Char(leave)
            };
            let effects = key(&mut model, code);
            let stops = Effect::StopMeasuring(ticket);
            assert!(effects.contains(&stops), "{leave}");
            update(&mut model, Message::Accuracy(Report::Progress(ticket, 0.5)));
            assert!(model.accuracy.job.is_none());
        }
    }
}
