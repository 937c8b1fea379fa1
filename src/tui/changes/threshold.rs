//! Asking at which value a result reaches what is typed, and taking the answer into the form.

use crate::many::threshold::ThresholdSearch;
use crate::scenario::doubt::number;
use crate::tui::threshold::{Asking, FindThreshold};
use crate::tui::{changes::edit::change, form::with_text, model::AppModel};
use crate::tui::{overlay::Overlay, request::Report};

/// Asks about the number with the cursor: rupture of the globe first, where there are risks.
pub(crate) fn ask(model: &mut AppModel) {
    let is_number = |field: &&_| number(field, &model.work.scenario).is_some();
    let Some(field) = model.form.selected.field().filter(is_number) else {
        model.notice = Some("choose a row with a number first".to_owned());
        return;
    };
    match model.shown.as_ref().and_then(|shown| Asking::of(field, shown)) {
        Some(asking) => model.overlay = Some(Overlay::Threshold(Box::new(asking))),
        None => model.notice = Some("there is no answer yet".to_owned()),
    }
}

/// Changes what is asked now, where nothing is looked for.
pub(crate) fn ask_otherwise(model: &mut AppModel, change: impl FnOnce(&mut Asking)) {
    if let Some(Overlay::Threshold(asking)) = &mut model.overlay
        && asking.task.job.is_none()
    {
        change(asking);
    }
}

/// Looks for the crossings, or takes the one that was found into the form.
pub(crate) fn accept(model: &mut AppModel) {
    let scenario = model.work.scenario.clone();
    let Some(Overlay::Threshold(asking)) = &mut model.overlay else { return };
    if asking.task.job.is_some() {
        return;
    }
    let field = asking.field;
    if let Some(text) = asking.taken() {
        model.overlay = None;
        match with_text(&scenario, field, &text) {
            Ok(scenario) => change(model, model.work.with(scenario), ""),
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
            asking.task.ask(FindThreshold(question), &mut model.out);
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

pub(crate) fn take_report(model: &mut AppModel, report: &mut Option<Report>) {
    let Some(Overlay::Threshold(asking)) = &mut model.overlay else { return };
    if let Some((asked, Some(found))) = asking.task.take_report(report) {
        // The nearest to the present value is offered first.
        let present = asked.0.present();
        let far = |i: &usize| (found.crossings[*i].at - present).abs();
        let nearest = (0..found.crossings.len()).min_by(|a, b| far(a).total_cmp(&far(b)));
        asking.row = nearest.unwrap_or(0);
        asking.found = Some((asked, found));
    }
}
