//! What every message does to the model, and what it asks of the world outside.
//!
//! This is the only place that changes a [`Model`]. It reads no clock and touches no file: time
//! comes with messages, and what must be done goes out as an [`Effect`].

use std::sync::Arc;
use std::time::Duration;

use crossterm::event::{Event, KeyEvent};
use tui_input::backend::crossterm::EventHandler;
use tui_input::{Input, InputRequest};

use super::action::{Action, Step};
use super::clock::Moment;
use super::comparison::{COLUMNS, Found};
use super::ensemble::{MANY, Sampling};
use super::form::{Row, Typing, nudged, with_text};
use super::keys::{self, Context};
use super::model::{Choice, FORM, Model, Overlay, Question, Run, Shown, Work};
use super::save::{SaveError, check_name};
use super::screens::Screen;
use super::sweep::Drawing;
use super::view::eye::hottest;
use super::view::profiles;
use super::worker::{Report, Ticket};
use crate::scenario::Scenario;
use crate::scenario::fields;
use crate::scenario::load::to_ron;
use crate::scenario::problem::quoted;
use crate::study::accuracy::Accuracy;
use crate::study::ensemble::Ensemble;
use crate::study::map::Grid;
use crate::study::{MeshError, Refusal};

mod accuracy;
mod ensemble;
mod sweep;

/// Something that happened.
pub enum Message {
    /// A key.
    Key(KeyEvent),
    /// Pasted text.
    Paste(String),
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
    /// Draw everything afresh.
    Repaint,
    /// Leave with this exit code.
    Quit(u8),
}

/// Everything that is to be done once before the first key.
pub fn begin(model: &mut Model) -> Vec<Effect> {
    let mut effects = Vec::new();
    solve(model, &mut effects);
    effects.extend(next_comparison(model));
    effects
}

/// Takes a message in.
pub fn update(model: &mut Model, message: Message) -> Vec<Effect> {
    let mut effects = Vec::new();
    match message {
        Message::Tick(now) => tick(model, now),
        Message::Key(event) => key(model, event, &mut effects),
        Message::Paste(text) => paste(model, &text, &mut effects),
        Message::Form(report) => {
            hear(model, report);
            // The finer mesh is for the time when nothing else is wanted.
            if let (Run::Settled, Some(shown)) = (&model.run, &model.shown)
                && shown.answer.errors.mesh.is_none()
            {
                effects.push(Effect::EstimateMesh(shown.ticket, shown.scenario.clone()));
            }
        }
        Message::Mesh(report) => {
            let done = matches!(report, Report::Done(..));
            hear_mesh(model, report);
            if done {
                effects.extend(ensemble::idle(model));
            }
        }
        Message::Ensemble(report) => ensemble::hear(model, report),
        Message::Map(report) => sweep::hear(model, report),
        Message::Comparison(report) => {
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
        Message::Accuracy(report) => accuracy::hear(model, report),
        Message::Saved(name, outcome) => saved(model, name, outcome),
        Message::Choices(choices) => model.choices = choices,
    }
    if model.screen == Screen::Compare {
        model.compare.replace(FORM, &model.work.scenario);
    }
    effects.extend(next_comparison(model));
    effects.extend(accuracy::stop_if_unwanted(model));
    effects.extend(ensemble::stop_if_unwanted(model));
    effects.extend(sweep::go_on(model));
    effects
}

fn tick(model: &mut Model, now: Duration) {
    let passed = now.saturating_sub(model.now).as_secs_f64();
    model.now = now;
    if let Some(window) = model.window() {
        model.clock.advance(passed, model.time(), window);
    }
}

fn ticket(model: &mut Model) -> Ticket {
    model.ticket += 1;
    model.ticket
}

fn solve(model: &mut Model, effects: &mut Vec<Effect>) {
    let ticket = ticket(model);
    model.run = Run::Running(ticket, None);
    effects.push(Effect::Solve(ticket, model.work.scenario.clone()));
}

fn next_comparison(model: &mut Model) -> Option<Effect> {
    let entry = model.compare.next()?;
    let (name, scenario) = (entry.name.clone(), entry.scenario.clone());
    let ticket = ticket(model);
    model.compare.job = Some((ticket, name));
    Some(Effect::Compare(ticket, scenario))
}

/// Adds a mesh error to the answer on show, if it is that answer's.
fn hear_mesh(model: &mut Model, report: Report<MeshError>) {
    let Report::Done(ticket, mesh) = report else {
        return;
    };
    if let (Ok(mesh), Some(shown)) = (*mesh, model.shown.as_mut())
        && shown.ticket == ticket
    {
        Arc::make_mut(&mut shown.answer).add(mesh);
    }
}

/// What the worker of the form says. Late news of superseded jobs is dropped.
fn hear(model: &mut Model, report: Report) {
    let Run::Running(awaited, _) = model.run else {
        return;
    };
    match report {
        Report::Progress(ticket, share) if ticket == awaited => {
            model.run = Run::Running(ticket, Some(share));
        }
        Report::Done(ticket, answer) if ticket == awaited => match *answer {
            Ok(answer) => {
                model.run = Run::Settled;
                model.shown = Some(Shown {
                    ticket,
                    scenario: model.work.scenario.clone(),
                    hottest: hottest(&answer),
                    answer: Arc::new(answer),
                });
            }
            Err(Refusal::Cancelled) => {
                let text = "cancelled: the next edit simulates again";
                model.run = Run::Refused(text.to_owned());
            }
            Err(refusal) => model.run = Run::Refused(refusal.to_string()),
        },
        _ => {}
    }
}

/// Takes another scenario and simulates it at once.
fn change(model: &mut Model, work: Work, what: &'static str, effects: &mut Vec<Effect>) {
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
    if let Some(action) = keys::action(context, event) {
        act(model, action, effects);
    } else if context == Context::Typing {
        type_into(model, effects, |input| {
            input.handle_event(&Event::Key(event));
        });
    }
}

fn paste(model: &mut Model, text: &str, effects: &mut Vec<Effect>) {
    if model.context() == Context::Typing {
        type_into(model, effects, |input| {
            for c in text.chars().filter(|c| !c.is_control()).take(200) {
                input.handle(InputRequest::InsertChar(c));
            }
        });
    }
}

/// Changes the text that is being typed. A value that makes sense is simulated while it is typed.
fn type_into(model: &mut Model, effects: &mut Vec<Effect>, change: impl FnOnce(&mut Input)) {
    if let Some(Overlay::SaveAs(input, error)) = &mut model.overlay {
        change(input);
        *error = check_name(input.value()).err().map(|e| e.to_string());
        return;
    }
    let Some(typing) = &mut model.form.typing else {
        return;
    };
    change(&mut typing.input);
    let outcome = with_text(&typing.before, typing.field, typing.input.value());
    typing.error = outcome.as_ref().err().cloned();
    if let Ok(scenario) = outcome {
        let work = model.work.with(scenario);
        put(model, work, effects);
    }
}

fn act(model: &mut Model, action: Action, effects: &mut Vec<Effect>) {
    model.form.complaint = None;
    match action {
        Action::Interrupt => effects.push(Effect::Quit(130)),
        Action::Suspend => effects.push(Effect::Suspend),
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
            effects.extend(ensemble::opened(model));
        }
        Action::Measure if model.screen == Screen::Uncertainty => {
            effects.extend(ensemble::start(model, MANY));
        }
        Action::Measure if model.screen == Screen::Sweep => model.map.halted = false,
        Action::Measure => effects.extend(accuracy::start(model)),
        Action::NextPane => model.change_pane(true),
        Action::PreviousPane => model.change_pane(false),
        Action::Undo | Action::Redo => travel(model, action == Action::Undo, effects),
        Action::Save => ask_for_name(model),
        Action::Presets => open_picker(model),
        Action::Up | Action::Down => go(model, action == Action::Down),
        Action::Step(step) => step_here(model, step, effects),
        Action::Enter if model.context() == Context::Accuracy => accuracy::adopt(model, effects),
        Action::Enter if model.context() == Context::Sweep => sweep::adopt(model, effects),
        Action::Enter => enter(model, effects),
        Action::Cancel if model.context() == Context::Accuracy && model.accuracy.job.is_some() => {
            effects.extend(accuracy::stop(model));
        }
        Action::Cancel if model.context() == Context::Uncertainty => {
            effects.extend(ensemble::stop(model));
        }
        Action::Cancel if model.context() == Context::Sweep => effects.extend(sweep::stop(model)),
        Action::Cancel => cancel(model, effects),
        Action::Advanced => model.form.fold(&model.work.scenario),
        Action::Axis(across) => model.map.turn(&model.work.scenario, across),
        Action::Reach(wider) => model.map.zoom(&model.work.scenario, wider),
        Action::Turn(step) if model.screen == Screen::Sweep => model.map.step(step, false),
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
        Action::Curves if model.screen == Screen::Compare => {
            model.compare.curve = (model.compare.curve + 1) % profiles::CURVES.len();
        }
        Action::Curves => model.curves = (model.curves + 1) % profiles::VIEWS.len(),
        Action::Mark => mark(model, effects),
        Action::Sort => model.compare.sort_here(),
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

fn stay_at(model: &mut Model, time: f64) {
    model.clock.moment = Moment::At(time);
    model.clock.playing = false;
}

fn go(model: &mut Model, down: bool) {
    let by = if down { 1 } else { -1 };
    let last = model.choices.len();
    match &mut model.overlay {
        Some(Overlay::Help(line)) => *line = line.saturating_add_signed(by),
        Some(Overlay::Picker(row)) => {
            *row = row
                .saturating_add_signed(isize::from(by))
                .min(last.saturating_sub(1));
        }
        Some(_) => {}
        None if model.screen == Screen::Uncertainty => ensemble::go(model, down),
        None if model.screen == Screen::Compare => {
            // The form stands above the presets.
            let row = model.compare.row.saturating_add_signed(isize::from(by));
            model.compare.row = row.min(last);
        }
        None => model.form.go(&model.work.scenario, isize::from(by)),
    }
}

/// A step to the side: of a value in the form, of a column in the table, of time elsewhere.
fn step_here(model: &mut Model, step: Step, effects: &mut Vec<Effect>) {
    match model.context() {
        Context::Form => match model.form.selected {
            Row::Preset => next_preset(model, step.up, effects),
            Row::Fold => model.form.fold(&model.work.scenario),
            Row::Field(field) => nudge(model, field.path, step, effects),
        },
        Context::Accuracy => model.accuracy.step(step),
        Context::Sweep => model.map.step(step, true),
        Context::Table => {
            let by = if step.up { 1 } else { -1 };
            let column = model.compare.column.saturating_add_signed(by);
            model.compare.column = column.min(COLUMNS.len() - 1);
        }
        _ => {
            if let (Some(answer), Some(window)) = (model.clock_answer(), model.window()) {
                let frames = answer.recording.frames.len().max(2) - 1;
                let frame = answer.case.window / frames as f64;
                let time = model.time();
                model.clock.step(step, time, frame, window);
            }
        }
    }
}

fn nudge(model: &mut Model, path: &'static str, step: Step, effects: &mut Vec<Effect>) {
    let Some(field) = fields::find(path) else {
        return;
    };
    let present = model.shown.as_ref().map(|s| s.answer.plan.step * 1e6);
    match nudged(&model.work.scenario, field, step, present) {
        Ok(scenario) if scenario == model.work.scenario => {
            model.notice = Some(format!("{}: {}", field.label, field.allowed()));
        }
        Ok(scenario) => {
            let work = model.work.with(scenario);
            change(model, work, path, effects);
        }
        Err(why) => model.form.complaint = Some(why),
    }
}

fn next_preset(model: &mut Model, forward: bool, effects: &mut Vec<Effect>) {
    let count = model.choices.len();
    if count == 0 {
        return;
    }
    let here = model
        .choices
        .iter()
        .position(|choice| choice.name == model.work.source);
    let next = match here {
        Some(here) if forward => (here + 1) % count,
        Some(here) => (here + count - 1) % count,
        None => 0,
    };
    open(model, next, effects);
}

fn open(model: &mut Model, index: usize, effects: &mut Vec<Effect>) {
    let Some(choice) = model.choices.get(index) else {
        return;
    };
    match &choice.scenario {
        Ok(scenario) => {
            let work = Work::fresh(&choice.name, scenario);
            change(model, work, "", effects);
        }
        Err(why) => model.form.complaint = Some(format!("{}: {why}", choice.name)),
    }
}

fn open_picker(model: &mut Model) {
    let here = model
        .choices
        .iter()
        .position(|choice| choice.name == model.work.source);
    model.overlay = Some(Overlay::Picker(here.unwrap_or(0)));
}

fn enter(model: &mut Model, effects: &mut Vec<Effect>) {
    match &model.overlay {
        Some(Overlay::Picker(row)) => {
            let row = *row;
            model.overlay = None;
            open(model, row, effects);
        }
        Some(Overlay::SaveAs(input, _)) => {
            let name = input.value().trim().to_owned();
            save(model, name, false, effects);
        }
        Some(_) => {}
        None if model.form.typing.is_some() => accept(model, effects),
        None => match model.form.selected {
            Row::Preset => open_picker(model),
            Row::Fold => model.form.fold(&model.work.scenario),
            Row::Field(field) => {
                let text = field.text(&model.work.scenario).unwrap_or_default();
                model.form.typing = Some(Typing {
                    field,
                    input: Input::new(text),
                    before: model.work.scenario.clone(),
                    error: None,
                });
            }
        },
    }
}

/// Ends typing with what was typed, unless it makes no sense.
fn accept(model: &mut Model, effects: &mut Vec<Effect>) {
    let Some(typing) = model.form.typing.take() else {
        return;
    };
    match with_text(&typing.before, typing.field, typing.input.value()) {
        Ok(scenario) => {
            let before = model.work.with(typing.before);
            if scenario != before.scenario {
                model.history.record(before, "", model.now);
            }
            let work = model.work.with(scenario);
            put(model, work, effects);
        }
        Err(why) => {
            model.form.typing = Some(Typing {
                error: Some(why),
                ..typing
            });
        }
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

fn ask_for_name(model: &mut Model) {
    let own = |choice: &&Choice| choice.name == model.work.source;
    let is_own = model
        .choices
        .iter()
        .find(own)
        .is_some_and(|choice| choice.origin == "own");
    let name = if is_own {
        model.work.source.clone()
    } else {
        let stem = model.work.source.rsplit(['/', '\\']).next().unwrap_or("");
        format!("my-{}", stem.trim_end_matches(".ron"))
    };
    model.overlay = Some(Overlay::SaveAs(Input::new(name), None));
}

fn save(model: &mut Model, name: String, replace: bool, effects: &mut Vec<Effect>) {
    if let Err(error) = check_name(&name) {
        if let Some(Overlay::SaveAs(_, shown)) = &mut model.overlay {
            *shown = Some(error.to_string());
        }
        return;
    }
    if !replace && model.choices.iter().any(|choice| choice.name == name) {
        model.overlay = Some(Overlay::Question(Question::Replace(name)));
        return;
    }
    let mut scenario = model.work.scenario.clone();
    // A title that a preset brought along says what the preset was.
    if scenario.name == model.work.original.name && model.is_edited() {
        scenario.name.clone_from(&name);
    }
    effects.push(Effect::Save(name, to_ron(&scenario), replace));
}

fn saved(model: &mut Model, name: String, outcome: Result<(), SaveError>) {
    match outcome {
        Ok(()) => {
            model.overlay = None;
            model.notice = Some(format!("saved as {name}"));
            if model.work.scenario.name == model.work.original.name && model.is_edited() {
                model.work.scenario.name.clone_from(&name);
                if let Some(shown) = &mut model.shown {
                    shown.scenario.name.clone_from(&name);
                }
            }
            model.work = Work::fresh(&name, &model.work.scenario);
        }
        Err(SaveError::Exists(name)) => {
            model.overlay = Some(Overlay::Question(Question::Replace(name)));
        }
        Err(error) => {
            let input = Input::new(name);
            model.overlay = Some(Overlay::SaveAs(input, Some(error.to_string())));
        }
    }
}

fn mark(model: &mut Model, effects: &mut Vec<Effect>) {
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

fn answer_question(model: &mut Model, yes: bool, effects: &mut Vec<Effect>) {
    match model.overlay.take() {
        Some(Overlay::Question(Question::Quit)) if yes => effects.push(Effect::Quit(0)),
        Some(Overlay::Question(Question::Replace(name))) => {
            if yes {
                save(model, name, true, effects);
            } else {
                model.overlay = Some(Overlay::SaveAs(Input::new(name), None));
            }
        }
        _ => {}
    }
}

#[cfg(test)]
mod tests;
