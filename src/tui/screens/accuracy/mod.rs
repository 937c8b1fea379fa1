//! Speed against error: measures every integrator when it is opened, and adopts what is chosen.

mod log_axis;
pub mod measurement;
mod view;

use super::{Mouse, Pane, Screen};
use crate::dynamics::LOCAL_TOLERANCE;
use crate::tui::form::words;
use crate::tui::keys::shared::{ENTER, LEFT, RIGHT, SHIFT_LEFT, SHIFT_RIGHT};
use crate::tui::keys::{KeyTable, TimeKeys, bind, c};
use crate::tui::model::Model;
use crate::tui::step::Step;
use crate::tui::update::change;
use measurement::{MeasureAccuracy, adopted};

pub(crate) const SCREEN: Screen = Screen {
    opened,
    attend,
    hear: |model, report| model.screens.accuracy.hear(report),
    cancel: stop,
    mouse: |model, mouse, _| {
        if let Mouse::Wheel(_, step) = mouse {
            model.screens.accuracy.step(step.reversed());
        }
        false
    },
    ..Screen::new(
        ("Accuracy", "Which integrator and step?"),
        "speed against error",
        &[Pane {
            name: "points",
            keys: &[KEYS],
            time: TimeKeys::Absent,
        }],
        view::draw,
    )
};

#[rustfmt::skip]
const KEYS: KeyTable = KeyTable::new("Accuracy", &[
    bind(&[LEFT, c('h')], |m| m.screens.accuracy.step(Step::LESS), "point", "the next faster point"),
    bind(&[RIGHT, c('l')], |m| m.screens.accuracy.step(Step::MORE), "&", "the next slower point"),
    bind(&[SHIFT_LEFT, c('H')], |m| m.screens.accuracy.step(Step::MUCH_LESS), "front", "the next faster point of the front"),
    bind(&[SHIFT_RIGHT, c('L')], |m| m.screens.accuracy.step(Step::MUCH_MORE), "&", "the next slower point of the front"),
    bind(&[ENTER], adopt, "adopt", "give the scenario its integrator and step"),
    bind(&[c('m')], start, "measure", "measure every integrator again"),
]);

/// Measures unless there is a result for this scenario.
fn opened(model: &mut Model) {
    let accuracy = &model.screens.accuracy;
    if accuracy.measured.is_none() || accuracy.is_stale(&model.work.scenario) {
        start(model);
    }
}

/// Measures, unless that is under way.
fn start(model: &mut Model) {
    let task = &mut model.screens.accuracy.task;
    if task.job.is_none() {
        task.ask(MeasureAccuracy::of(&model.work.scenario), &mut model.out);
    }
}

fn stop(model: &mut Model) -> bool {
    let task = &mut model.screens.accuracy.task;
    task.stop(Some("cancelled"), &mut model.out)
}

/// Gives it up if the screen was left or the scenario became another.
fn attend(model: &mut Model, on_show: bool) {
    if let Some(job) = &model.screens.accuracy.task.job {
        let same = *job.question == MeasureAccuracy::of(&model.work.scenario);
        if !(on_show && same) {
            stop(model);
        }
    }
}

/// Gives the scenario the integrator and the step of the point under the cursor.
fn adopt(model: &mut Model) {
    let Some(point) = model.screens.accuracy.chosen().copied() else {
        return;
    };
    if model.screens.accuracy.is_stale(&model.work.scenario) {
        model.notice = Some("measured for another scenario: m measures this one".to_owned());
        return;
    }
    let scenario = adopted(&model.work.scenario, &point);
    if let Err(error) = scenario.check() {
        model.notice = Some(words(&error));
        return;
    }
    let step = scenario.numerics.step_us.unwrap_or_default();
    let name = point.plan.integrator.name();
    let work = model.work.with(scenario);
    change(model, work, "");
    let mut notice = format!("adopted {name}, step {step} µs");
    if point.plan.integrator.method().adaptive() {
        notice = format!("{notice}; its tolerance stays {LOCAL_TOLERANCE:e}");
    }
    model.notice = Some(notice);
}
