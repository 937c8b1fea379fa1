//! What every message does to the model, and what it asks of the world outside.
//!
//! This is the only place that changes a [`Model`]. It reads no clock and touches no file: time
//! comes with messages, and what must be done goes out as an [`Effect`].

use std::time::Duration;

use crossterm::event::{KeyEvent, MouseEvent};
use tui_input::Input;

use super::action::Action;
use super::clock::Moment;
use super::ensemble::{MANY, Sampling};
use super::form::Row;
use super::keys::{self, Context};
use super::model::{Choice, FORM, Model, Overlay, Question, Run, Work};
use super::save::SaveError;
use super::screens::map::state::Drawing;
use super::screens::{Screen, accuracy, compare, doubt, map};
use super::worker::{Report, Ticket};
use crate::scenario::Scenario;
use crate::study::MeshError;
use crate::study::accuracy::Accuracy;
use crate::study::ensemble::Ensemble;
use crate::study::map::Grid;

#[cfg(test)]
pub(crate) mod driven;
mod mouse;
mod moves;
mod news;
mod presets;
mod typing;

use moves::{PAGE, go, next_view, nudge, stay_at, step_here, step_time};

/// Something that happened.
pub enum Message {
    /// A key.
    Key(KeyEvent),
    /// Pasted text.
    Paste(String),
    /// The mouse, on a screen of this size.
    Mouse(MouseEvent, (u16, u16)),
    /// It is now this long after the start.
    Tick(Duration),
    /// The worker of the form says something.
    Form(Report),
    /// The worker of the comparison says something.
    Comparison(Report),
    /// The worker that measures speed against error says something.
    Accuracy(Report<Accuracy>),
    /// The worker of the mesh error.
    Mesh(Report<MeshError>),
    /// The worker of the ensembles says something.
    Ensemble(Report<Ensemble>),
    /// The worker of the map says something.
    Map(Report<Grid>),
    /// A preset was saved under this name, or not.
    Saved(String, Result<(), SaveError>),
    /// These can be opened now.
    Choices(Vec<Choice>),
}

/// Something to do outside.
#[derive(Debug, Clone, PartialEq)]
pub enum Effect {
    /// Simulate for the form.
    Solve(Ticket, Scenario),
    /// Stop that.
    Stop(Ticket),
    /// Estimate the mesh error of the answer to this job.
    EstimateMesh(Ticket, Scenario),
    /// Simulate for the comparison.
    Compare(Ticket, Scenario),
    /// Stop that.
    StopComparing(Ticket),
    /// Measure speed against error.
    Measure(Ticket, Scenario),
    /// Stop that.
    StopMeasuring(Ticket),
    /// Run samples over what is not known.
    Sample(Ticket, Sampling),
    /// Stop that; what is done will be told.
    StopSampling(Ticket),
    /// Compute a map of two inputs.
    Draw(Ticket, Drawing),
    /// Stop that.
    StopDrawing(Ticket),
    /// Save a preset: name, text, whether it may replace another.
    Save(String, String, bool),
    /// Stop the process until it is continued.
    Suspend,
    /// Have the mouse reported, or no longer.
    Mouse(bool),
    /// Draw everything afresh.
    Repaint,
    /// Leave with this exit code.
    Quit(u8),
}

/// Everything that is to be done once before the first key.
pub fn begin(model: &mut Model) -> Vec<Effect> {
    let mut effects = Vec::new();
    solve(model, &mut effects);
    effects.extend(compare::next(model));
    effects
}

/// Takes a message in.
pub fn update(model: &mut Model, message: Message) -> Vec<Effect> {
    let mut effects = Vec::new();
    match message {
        Message::Tick(now) => tick(model, now),
        Message::Key(event) => key(model, event, &mut effects),
        Message::Paste(text) => typing::paste(model, &text, &mut effects),
        Message::Mouse(event, size) => mouse::hear(model, event, size, &mut effects),
        Message::Form(report) => {
            news::hear(model, report);
            // The finer mesh is for the time when nothing else is wanted.
            if let (Run::Settled, Some(shown)) = (&model.run, &model.shown)
                && shown.answer.errors.mesh.is_none()
            {
                effects.push(Effect::EstimateMesh(shown.ticket, shown.scenario.clone()));
            }
        }
        Message::Mesh(report) => {
            let done = matches!(report, Report::Done(..));
            news::hear_mesh(model, report);
            if done {
                effects.extend(doubt::idle(model));
            }
        }
        Message::Ensemble(report) => doubt::hear(model, report),
        Message::Map(report) => map::hear(model, report),
        Message::Comparison(report) => compare::hear(model, report),
        Message::Accuracy(report) => accuracy::hear(model, report),
        Message::Saved(name, outcome) => presets::saved(model, name, outcome),
        Message::Choices(choices) => model.choices = choices,
    }
    if model.screen == Screen::Compare {
        model.compare.replace(FORM, &model.work.scenario);
    }
    effects.extend(compare::next(model));
    effects.extend(accuracy::stop_if_unwanted(model));
    effects.extend(doubt::stop_if_unwanted(model));
    effects.extend(map::go_on(model));
    effects
}

fn tick(model: &mut Model, now: Duration) {
    let passed = now.saturating_sub(model.now).as_secs_f64();
    model.now = now;
    if let Some(window) = model.window() {
        model.clock.advance(passed, model.time(), window);
    }
}

pub(super) fn ticket(model: &mut Model) -> Ticket {
    model.ticket += 1;
    model.ticket
}

fn solve(model: &mut Model, effects: &mut Vec<Effect>) {
    let ticket = ticket(model);
    model.run = Run::Running(ticket, None);
    effects.push(Effect::Solve(ticket, model.work.scenario.clone()));
}

/// Takes another scenario and simulates it at once.
pub(super) fn change(model: &mut Model, work: Work, what: &'static str, effects: &mut Vec<Effect>) {
    if work == model.work {
        return;
    }
    model.history.record(model.work.clone(), what, model.now);
    put(model, work, effects);
}

fn put(model: &mut Model, work: Work, effects: &mut Vec<Effect>) {
    let same = work.scenario == model.work.scenario;
    model.work = work;
    model.form.settle(&model.work.scenario);
    if !same {
        solve(model, effects);
    }
}

fn key(model: &mut Model, event: KeyEvent, effects: &mut Vec<Effect>) {
    model.notice = None;
    let context = model.context();
    let action = keys::action(context, event);
    if action == Some(Action::Type) {
        typing::begin(model, true);
    }
    if let Some(action) = action.filter(|action| *action != Action::Type) {
        act(model, action, effects);
    } else if model.context() == Context::Typing {
        typing::key(model, event, effects);
    }
}

fn act(model: &mut Model, action: Action, effects: &mut Vec<Effect>) {
    model.form.complaint = None;
    match action {
        Action::Interrupt => effects.push(Effect::Quit(130)),
        Action::Suspend => effects.push(Effect::Suspend),
        Action::Mouse => {
            model.mouse = !model.mouse;
            model.aiming = false;
            let word = if model.mouse { "on" } else { "off" };
            model.notice = Some(format!("mouse {word}"));
            effects.push(Effect::Mouse(model.mouse));
        }
        Action::Repaint => effects.push(Effect::Repaint),
        Action::Quit if model.is_edited() => {
            model.overlay = Some(Overlay::Question(Question::Quit));
        }
        Action::Quit => effects.push(Effect::Quit(0)),
        Action::Help => {
            model.overlay = match model.overlay {
                Some(Overlay::Help(_)) => None,
                _ => Some(Overlay::Help(0)),
            };
        }
        Action::Show(screen) => {
            model.screen = screen;
            effects.extend(accuracy::opened(model));
            effects.extend(doubt::opened(model));
        }
        Action::Measure if model.screen == Screen::Doubt => {
            effects.extend(doubt::start(model, MANY));
        }
        Action::Measure if model.screen == Screen::Map => model.map.halted = false,
        Action::Measure => effects.extend(accuracy::start(model)),
        Action::NextPane => model.change_pane(true),
        Action::PreviousPane => model.change_pane(false),
        Action::Undo | Action::Redo => travel(model, action == Action::Undo, effects),
        Action::Save => presets::ask_for_name(model),
        Action::Presets => presets::open_picker(model),
        Action::Up | Action::Down => go(model, if action == Action::Down { 1 } else { -1 }),
        Action::Page(down) => go(model, if down { PAGE } else { -PAGE }),
        Action::Step(step) => step_here(model, step, effects),
        Action::Enter if model.context() == Context::Accuracy => accuracy::adopt(model, effects),
        Action::Enter if model.context() == Context::Map => map::adopt(model, effects),
        Action::Enter => enter(model, effects),
        Action::Cancel if model.context() == Context::Accuracy && model.accuracy.job.is_some() => {
            effects.extend(accuracy::stop(model));
        }
        Action::Cancel if model.context() == Context::Doubt => {
            effects.extend(doubt::stop(model));
        }
        Action::Cancel if model.context() == Context::Map => effects.extend(map::stop(model)),
        Action::Cancel => cancel(model, effects),
        Action::Advanced => model.form.fold(&model.work.scenario),
        Action::Axis(across) => model.map.turn(&model.work.scenario, across),
        Action::Reach(wider) => model.map.zoom(&model.work.scenario, wider),
        Action::Turn(step) if model.screen == Screen::Map => model.map.step(step, false),
        Action::Turn(step) => nudge(model, "impact.angle_deg", step, effects),
        Action::Widen(step) => nudge(model, "impact.half_width_deg", step, effects),
        Action::Play => {
            // Nobody has chosen a moment yet: begin at the beginning.
            let time = match model.clock.moment {
                Moment::Deepest => 0.0,
                Moment::At(_) => model.time(),
            };
            model.clock.moment = Moment::At(time);
            model.clock.playing = !model.clock.playing;
        }
        Action::First | Action::Last if model.context().is_list() => {
            go(
                model,
                if action == Action::Last {
                    i16::MAX
                } else {
                    -i16::MAX
                },
            );
        }
        Action::First => stay_at(model, 0.0),
        Action::Last => stay_at(model, model.window().unwrap_or(0.0)),
        Action::Slower => model.clock.change_speed(false),
        Action::Faster => model.clock.change_speed(true),
        Action::NextPeak | Action::PreviousPeak => {
            let mut clock = model.clock;
            if let Some(answer) = model.clock_answer() {
                clock.jump(answer, action == Action::NextPeak);
            }
            model.clock = clock;
        }
        Action::Exaggerate => model.clock.change_zoom(),
        Action::Detail => model.clock.change_detail(),
        Action::Curves if model.screen == Screen::Compare => compare::next_curve(model),
        Action::Curves => next_view(model),
        Action::Mark => compare::mark(model, effects),
        Action::Sort => model.compare.sort_here(),
        // What is typed goes into the field, see `key`.
        Action::Type => {}
        Action::Yes | Action::No => answer_question(model, action == Action::Yes, effects),
    }
}

fn travel(model: &mut Model, back: bool, effects: &mut Vec<Effect>) {
    let present = model.work.clone();
    let other = if back {
        model.history.undo(present)
    } else {
        model.history.redo(present)
    };
    if let Ok(work) = other {
        put(model, work, effects);
    } else {
        let what = if back { "undo" } else { "redo" };
        model.notice = Some(format!("nothing to {what}"));
    }
}

fn enter(model: &mut Model, effects: &mut Vec<Effect>) {
    match &model.overlay {
        Some(Overlay::Picker(row)) => {
            let row = *row;
            model.overlay = None;
            presets::open(model, row, effects);
        }
        Some(Overlay::SaveAs(input, _)) => {
            let name = input.value().trim().to_owned();
            presets::save(model, name, false, effects);
        }
        Some(_) => {}
        None if model.form.typing.is_some() => typing::accept(model, effects),
        None => match model.form.selected {
            Row::Preset => presets::open_picker(model),
            Row::Fold => model.form.fold(&model.work.scenario),
            Row::Field(_) => typing::begin(model, false),
        },
    }
}

fn cancel(model: &mut Model, effects: &mut Vec<Effect>) {
    if model.overlay.take().is_some() {
        return;
    }
    if let Some(typing) = model.form.typing.take() {
        let work = model.work.with(typing.before);
        put(model, work, effects);
    } else if let Run::Running(ticket, _) = model.run {
        effects.push(Effect::Stop(ticket));
    }
}

fn answer_question(model: &mut Model, yes: bool, effects: &mut Vec<Effect>) {
    match model.overlay.take() {
        Some(Overlay::Question(Question::Quit)) if yes => effects.push(Effect::Quit(0)),
        Some(Overlay::Question(Question::Replace(name) | Question::Hide(name))) => {
            if yes {
                presets::save(model, name, true, effects);
            } else {
                model.overlay = Some(Overlay::SaveAs(Input::new(name), None));
            }
        }
        _ => {}
    }
}

#[cfg(test)]
mod tests;
