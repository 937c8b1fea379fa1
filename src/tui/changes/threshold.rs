//! Asking at which value of a number a result reaches what is typed, and taking the answer into
//! the form.

use crate::many::threshold::ThresholdSearch;
use crate::scenario::doubt::number;
use crate::tui::form::{FormRow, with_text};
use crate::tui::request::Report;
use crate::tui::threshold::{Asking, FindThreshold};
use crate::tui::{changes::edit::change, line::TextLine, model::AppModel, overlay::Overlay};

/// Asks about the number with the cursor: rupture of the globe first, where there are risks.
pub(crate) fn ask(model: &mut AppModel) {
    let asked = match model.form.selected {
        FormRow::Field(field) => number(field, &model.work.scenario).map(|_| field),
        _ => None,
    };
    let asking = match (asked, &model.shown) {
        (Some(field), Some(shown)) => Asking::of(field, shown),
        (None, _) => {
            model.notice = Some("choose a row with a number first".to_owned());
            return;
        }
        _ => None,
    };
    match asking {
        Some(asking) => model.overlay = Some(Overlay::Threshold(Box::new(asking))),
        None => model.notice = Some("there is no answer yet".to_owned()),
    }
}

/// What is asked now, where nothing is looked for.
fn open_question(model: &mut AppModel) -> Option<&mut Asking> {
    match &mut model.overlay {
        Some(Overlay::Threshold(asking)) if asking.task.job.is_none() => Some(asking),
        _ => None,
    }
}

/// Asks for the next result of the answer on show, or for the one before.
pub(crate) fn next_result(model: &mut AppModel, forward: bool) {
    let Some(asking) = open_question(model) else {
        return;
    };
    let count = asking.results.len();
    let here = asking.results.iter().position(|(q, _)| *q == asking.quantity);
    let by = if forward { 1 } else { count - 1 };
    let next = asking.results[(here.unwrap_or(0) + by) % count].0;
    asking.choose(next);
}

/// Goes to the next crossing.
pub(crate) fn next_crossing(model: &mut AppModel) {
    let Some(asking) = open_question(model) else {
        return;
    };
    let count = asking.found.as_ref().map_or(0, |(_, found)| found.crossings.len());
    asking.row = (asking.row + 1) % count.max(1);
}

/// Changes the value that is asked for.
pub(crate) fn retype(model: &mut AppModel, change: impl FnOnce(&mut TextLine)) {
    let Some(asking) = open_question(model) else {
        return;
    };
    let before = asking.input.value().to_owned();
    change(&mut asking.input);
    if asking.input.value() != before {
        asking.forget();
    }
}

/// Looks for the crossings, or takes the one that was found into the form.
pub(crate) fn accept(model: &mut AppModel) {
    let scenario = model.work.scenario.clone();
    let Some(asking) = open_question(model) else {
        return;
    };
    let field = asking.field;
    if let Some(text) = asking.taken() {
        model.overlay = None;
        match with_text(&scenario, field, &text) {
            Ok(scenario) => {
                let work = model.work.with(scenario);
                change(model, work, "");
            }
            Err(why) => model.form.complaint = Some(why),
        }
        return;
    }
    let target = asking.input.value().trim().parse::<f64>();
    let Some(target) = target.ok().filter(|target| target.is_finite()) else {
        asking.error = Some("a number is needed, as in 50".to_owned());
        return;
    };
    match ThresholdSearch::read(scenario, field.path, (asking.quantity, target)) {
        Ok(question) => {
            asking.forget();
            let question = FindThreshold(question);
            if let Some(Overlay::Threshold(asking)) = &mut model.overlay {
                asking.task.ask(question, &mut model.out);
            }
        }
        Err(error) => asking.error = Some(error.to_string()),
    }
}

/// Stops looking; whether anything was looked for.
pub(crate) fn stop(model: &mut AppModel) -> bool {
    match &mut model.overlay {
        Some(Overlay::Threshold(asking)) => asking.task.stop(Some("stopped"), &mut model.out),
        _ => false,
    }
}

/// Takes in what was found.
pub(crate) fn take_report(model: &mut AppModel, report: &mut Option<Report>) {
    let Some(Overlay::Threshold(asking)) = &mut model.overlay else {
        return;
    };
    if let Some((asked, Some(found))) = asking.task.take_report(report) {
        // The nearest to the present value is offered first.
        let present = asked.0.present();
        let far = |i: &usize| (found.crossings[*i].at - present).abs();
        let nearest = (0..found.crossings.len()).min_by(|a, b| far(a).total_cmp(&far(b)));
        asking.row = nearest.unwrap_or(0);
        asking.found = Some((asked, found));
    }
}
