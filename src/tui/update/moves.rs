//! Moving: through lists, from field to field, from frame to frame, and from value to value.

use super::{Effect, change, doubt, presets};
use crate::scenario::Scenario;
use crate::scenario::fields::{self, Field};
use crate::tui::action::Step;
use crate::tui::clock::Moment;
use crate::tui::form::{Row, allowed, nudged};
use crate::tui::keys::{BINDINGS, Context};
use crate::tui::model::{Model, Overlay};
use crate::tui::screens::Screen;
use crate::tui::screens::forces;

/// Rows of a page.
pub(super) const PAGE: i16 = 10;
/// Small steps in place of a large one, at most.
const MOST_SMALL: usize = 20;

/// The next set of curves on the screen of forces.
pub(super) fn next_view(model: &mut Model) {
    let traces = model
        .shown
        .as_ref()
        .and_then(|s| s.answer.recording.traces.as_ref());
    let count = traces.map_or(1, |t| forces::views(t).len());
    model.curves = (model.curves % count + 1) % count;
}

pub(super) fn stay_at(model: &mut Model, time: f64) {
    model.clock.moment = Moment::At(time);
    model.clock.playing = false;
}

pub(super) fn go(model: &mut Model, by: i16) {
    let last = model.choices.len();
    match &mut model.overlay {
        Some(Overlay::Help(line)) => {
            // No page is so short that there is more to scroll to.
            *line = line.saturating_add_signed(by).min(BINDINGS.len() as u16);
        }
        Some(Overlay::Picker(row)) => {
            *row = row
                .saturating_add_signed(isize::from(by))
                .min(last.saturating_sub(1));
        }
        Some(_) => {}
        None if model.screen == Screen::Doubt => doubt::go(model, by > 0),
        None if model.screen == Screen::Injury => {
            let count = model.shown.as_ref().map_or(0, |s| s.answer.risks().len());
            let row = model.injury.saturating_add_signed(isize::from(by));
            model.injury = row.min(count.saturating_sub(1));
        }
        None if model.screen == Screen::Compare => {
            // The form stands above the presets.
            let row = model.compare.row.saturating_add_signed(isize::from(by));
            model.compare.row = row.min(last);
        }
        None => model.form.go(&model.work.scenario, isize::from(by)),
    }
}

/// A step to the side: of a value in the form, of a column in the table, of time elsewhere.
pub(super) fn step_here(model: &mut Model, step: Step, effects: &mut Vec<Effect>) {
    match model.context() {
        Context::Form | Context::Number => match model.form.selected {
            Row::Preset => presets::next_preset(model, step.up, effects),
            Row::Fold => model.form.fold(&model.work.scenario),
            Row::Field(field) => nudge(model, field.path, step, effects),
        },
        Context::Accuracy => model.accuracy.step(step),
        Context::Map => model.map.step(step, true),
        Context::Table => {
            let by = if step.up { 1 } else { -1 };
            let column = model.compare.column.saturating_add_signed(by);
            model.compare.column = column.min(model.compare.columns().len() - 1);
        }
        _ => step_time(model, step),
    }
}

/// A step from frame to frame.
pub(super) fn step_time(model: &mut Model, step: Step) {
    if let (Some(answer), Some(window)) = (model.clock_answer(), model.window()) {
        let mut clock = model.clock;
        clock.step(step, model.time(), &answer.recording.frames, window);
        model.clock = clock;
    }
}

pub(super) fn nudge(model: &mut Model, path: &'static str, step: Step, effects: &mut Vec<Effect>) {
    let Some(field) = fields::find(path) else {
        return;
    };
    let present = model.shown.as_ref().map(|s| s.answer.plan.step * 1e6);
    match furthest(&model.work.scenario, field, step, present) {
        Ok(scenario) if scenario == model.work.scenario => {
            model.notice = Some(format!("{}: {}", field.label, allowed(field)));
        }
        Ok(scenario) => {
            let work = model.work.with(scenario);
            change(model, work, path, effects);
        }
        Err(why) => model.form.complaint = Some(why),
    }
}

/// The scenario one step further; where a rule forbids a large step, as many small ones as it allows.
fn furthest(
    scenario: &Scenario,
    field: &Field,
    step: Step,
    present: Option<f64>,
) -> Result<Scenario, String> {
    let whole = nudged(scenario, field, step, present);
    if whole.is_ok() || !step.coarse {
        return whole;
    }
    let small = Step {
        coarse: false,
        ..step
    };
    let mut reached: Option<Scenario> = None;
    for _ in 0..MOST_SMALL {
        match nudged(reached.as_ref().unwrap_or(scenario), field, small, present) {
            Ok(next) => reached = Some(next),
            Err(_) => break,
        }
    }
    reached.map_or(whole, Ok)
}
