//! Another scenario takes the place of the one worked on, and what that does to its answer.

use crate::scenario::Scenario;
use crate::tui::{changes::simulation, form::words, model::AppModel, outbox::Effect};
use crate::tui::{simulation::is_alike, work::Work};

/// Takes another scenario and simulates it. `what` changes, empty if it stands for itself.
pub(crate) fn change(model: &mut AppModel, work: Work, what: &'static str) {
    if work == model.work {
        return;
    }
    if let Err(why) = model.allows(&work.scenario) {
        model.notice = Some(why);
        return;
    }
    model.history.record(model.work.clone(), what, model.now);
    set_work(model, work);
}

pub(crate) fn set_work(model: &mut AppModel, work: Work) {
    let alike = is_alike(&work.scenario, &model.work.scenario);
    let same = work.scenario == model.work.scenario;
    model.work = work;
    model.form.settle(&model.work.scenario);
    if alike && model.run.complaint.is_none() {
        simulation::follow(model);
    } else if !same {
        simulation::start(model);
    }
}

/// Takes the last change back, or makes it again; a preset that was removed since comes first.
pub(crate) fn travel(model: &mut AppModel, back: bool) {
    let changes = model.history.depth().0;
    if back && let Some((_, name, text)) = model.removed.pop_if(|(then, ..)| *then >= changes) {
        model.out.effects.push(Effect::Restore(name, text));
        return;
    }
    if let Some(work) = model.history.travel(back, model.work.clone()) {
        set_work(model, work);
    } else {
        let what = if back { "undo" } else { "redo" };
        model.notice = Some(format!("nothing to {what}"));
    }
}

/// Has the scenario solved by the level, integrator and step of another one.
pub(crate) fn adopt(model: &mut AppModel, scenario: Scenario) {
    if let Err(error) = scenario.check() {
        model.notice = Some(words(&error));
        return;
    }
    let (level, numerics) = (scenario.eye.level, &scenario.numerics);
    let how = match (numerics.integrator, numerics.step_us) {
        (Some(integrator), Some(step)) => format!("{}, step {step} µs", integrator.name()),
        _ => "automatic integrator and step".to_owned(),
    };
    let notice = format!("computed with level {level}, {how} now; u takes it back");
    change(model, model.work.with(scenario), "");
    if model.notice.is_none() {
        model.notice = Some(notice);
    }
}
