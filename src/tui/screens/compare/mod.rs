//! What keys and news do to the comparison.

pub mod comparison;
mod overlaid;
mod replays;
pub mod view;

use std::sync::Arc;

use crate::plain_text::quoted;
use crate::recording::Traces;
use crate::study::Answer;
use crate::tui::model::{FORM, Model};
use crate::tui::screens::compare::comparison::Found;
use crate::tui::screens::forces::CURVES;
use crate::tui::update::{Effect, ticket};
use crate::tui::view::heat::hottest;
use crate::tui::worker::Report;

/// What the worker says.
pub(crate) fn hear(model: &mut Model, report: Report<Answer>) {
    if let Report::Done(ticket, answer) = report {
        let found = match *answer {
            Ok(answer) => {
                let hottest = hottest(&answer);
                Found::Answer(Arc::new(answer), hottest)
            }
            Err(refusal) => Found::Refused(refusal.to_string()),
        };
        model.compare.take(ticket, found);
    }
}

pub(crate) fn next(model: &mut Model) -> Option<Effect> {
    let entry = model.compare.next()?;
    let (name, scenario) = (entry.name.clone(), entry.scenario.clone());
    let ticket = ticket(model);
    model.compare.job = Some((ticket, name));
    Some(Effect::Compare(ticket, scenario))
}

/// Takes the next curve that any of the answers has.
pub(crate) fn next_curve(model: &mut Model) {
    let entries = &model.compare.entries;
    let there = |curve: &usize| {
        let has = |traces: &Traces| !(CURVES[*curve].values)(traces).is_empty();
        let mut answers = entries.iter().filter_map(|entry| entry.answer());
        answers.any(|answer| answer.recording.traces.as_ref().is_some_and(has))
    };
    let (here, count) = (model.compare.curve, CURVES.len());
    let next = (1..=count).map(|by| (here + by) % count).find(there);
    model.compare.curve = next.unwrap_or(here);
}

pub(crate) fn mark(model: &mut Model, effects: &mut Vec<Effect>) {
    let row = model.compare.row;
    let outcome = if row == 0 {
        let scenario = model.work.scenario.clone();
        model.compare.mark(FORM, &scenario)
    } else if let Some(choice) = model.choices.get(row - 1) {
        match &choice.scenario {
            Ok(scenario) => model.compare.mark(&choice.name, scenario),
            Err(why) => Err(format!("{}: {why}", quoted(&choice.name))),
        }
    } else {
        Ok(())
    };
    model.notice = outcome.err();
    // Nobody wants the answer of what was just unmarked.
    let marked = |name: &str| model.compare.is_marked(name);
    let unwanted = model.compare.job.as_ref().filter(|(_, name)| !marked(name));
    if let Some((ticket, _)) = unwanted {
        effects.push(Effect::StopComparing(*ticket));
        model.compare.job = None;
    }
}
