//! What every message does to the model, and what it asks of the world outside.
//!
//! Only what is called from here changes a [`Model`]. It reads no clock and touches no file: time
//! comes with messages, and what must be done goes out as an [`Effect`].

use std::time::Duration;

use crossterm::event::{KeyCode, KeyEvent, MouseEvent};

use crate::tui::ensemble;
use crate::tui::keys;
use crate::tui::keys::Act;
use crate::tui::line::Line;
use crate::tui::model::{Choice, Model, Naming, Overlay, Question};
use crate::tui::save::SaveError;
use crate::tui::screens::{SCREENS, accuracy, compare};
use crate::tui::simulation;
use crate::tui::take_away;
use crate::tui::task::{Report, Request, Ticket};
use crate::tui::threshold;
use crate::tui::view::overlay::help_rows;
use crate::tui::work::Work;

#[cfg(test)]
pub(crate) mod driven;
mod mouse;
pub(crate) mod presets;
pub(crate) mod time;
pub(crate) mod typing;

/// Rows of a page.
pub(crate) const PAGE: i16 = 10;

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
    /// A worker says something.
    News(Report),
    /// A preset was saved under this name, or not.
    Saved(String, Result<(), SaveError>),
    /// The preset of the first name has the second one, or not.
    Renamed(String, String, Result<(), SaveError>),
    /// The preset of this name was removed, or not.
    Removed(String, Result<(), SaveError>),
    /// These can be opened now.
    Choices(Vec<Choice>),
    /// What came of something that was done outside.
    Said(String),
}

/// Something to do outside.
#[derive(Debug, Clone, PartialEq)]
pub enum Effect {
    /// Work on a question, on the thread of its kind.
    Start(Request),
    /// Stop working on that.
    Stop(Ticket),
    /// Save a preset: name, text, whether it may replace another.
    Save(String, String, bool),
    /// Give the preset of the first name the second one.
    Rename(String, String),
    /// Remove the preset of this name.
    Remove(String),
    /// Write a page: the beginning of its file's name, and its text.
    Page(String, Vec<u8>),
    /// Put this on the clipboard.
    Copy(String),
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
    simulation::start(model);
    attend(model);
    std::mem::take(&mut model.out.effects)
}

/// Takes a message in.
pub fn update(model: &mut Model, message: Message) -> Vec<Effect> {
    match message {
        Message::Tick(now) => tick(model, now),
        Message::Key(event) => key(model, event),
        Message::Paste(text) => typing::paste(model, &text),
        Message::Mouse(event, size) => mouse::hear(model, event, size),
        Message::News(report) => hear(model, report),
        Message::Saved(name, outcome) => presets::saved(model, name, outcome),
        Message::Renamed(from, to, outcome) => presets::renamed(model, &from, to, outcome),
        Message::Removed(name, outcome) => presets::removed(model, &name, outcome),
        Message::Choices(choices) => presets::take(model, choices),
        Message::Said(words) => model.notice = Some(words),
    }
    attend(model);
    std::mem::take(&mut model.out.effects)
}

/// Offers what a worker says to all who may have asked. Late news is nobody's.
fn hear(model: &mut Model, report: Report) {
    let mut report = Some(report);
    simulation::hear(model, &mut report);
    ensemble::hear(model, &mut report);
    threshold::hear(model, &mut report);
    take_away::hear(model, &mut report);
    for screen in SCREENS {
        (screen.hear)(model, &mut report);
    }
}

fn attend(model: &mut Model) {
    for (place, screen) in SCREENS.iter().enumerate() {
        (screen.attend)(model, place == model.screen);
    }
    // What nobody asked for comes after what somebody did.
    ensemble::attend(model);
    simulation::attend(model);
}

fn tick(model: &mut Model, now: Duration) {
    let passed = now.saturating_sub(model.now).as_secs_f64();
    model.now = now;
    if let Some(window) = model.window() {
        model.clock.advance(passed, model.time(), window);
    }
}

/// Takes another scenario and simulates it at once. `what` names the field that changes, empty if the
/// change stands for itself.
pub(crate) fn change(model: &mut Model, work: Work, what: &'static str) {
    if work == model.work {
        return;
    }
    if let Err(why) = model.allows(&work.scenario) {
        model.notice = Some(why);
        return;
    }
    model.history.record(model.work.clone(), what, model.now);
    put(model, work);
}

fn put(model: &mut Model, work: Work) {
    let alike = simulation::is_alike(&work.scenario, &model.work.scenario);
    let same = work.scenario == model.work.scenario;
    model.work = work;
    model.form.settle(&model.work.scenario);
    if alike && model.run.complaint.is_none() {
        simulation::follow(model);
    } else if !same {
        simulation::start(model);
    }
}

fn key(model: &mut Model, event: KeyEvent) {
    model.notice = None;
    match keys::find(model, event) {
        Some(Act::Run(run)) => {
            model.form.complaint = None;
            run(model);
        }
        Some(Act::Show(place)) => show(model, place),
        Some(Act::Type) if model.form.takes_numbers() => {
            typing::begin(model, true);
            typing::key(model, event);
        }
        Some(Act::Type) => model.notice = Some(elsewhere(event)),
        None => typing::key(model, event),
    }
}

/// What to press for the screen of a digit where digits are values.
fn elsewhere(event: KeyEvent) -> String {
    let number = match event.code {
        KeyCode::Char(digit) => digit.to_digit(10).unwrap_or(0),
        _ => 0,
    };
    let screen = number
        .checked_sub(1)
        .and_then(|at| SCREENS.get(at as usize));
    screen.map_or("no number is typed here".to_owned(), |screen| {
        format!(
            "no number is typed here: F{number} or Alt-{number} shows {}",
            screen.title
        )
    })
}

/// Shows the screen of a place in the list.
pub(crate) fn show(model: &mut Model, place: usize) {
    model.form.complaint = None;
    model.screen = place;
    (SCREENS[place].opened)(model);
}

/// Leaves at once.
pub(crate) fn leave(model: &mut Model) {
    model.out.effects.push(Effect::Quit(130));
}

/// Stops until the shell goes on.
#[cfg(unix)]
pub(crate) fn suspend(model: &mut Model) {
    model.out.effects.push(Effect::Suspend);
}

/// Draws everything afresh.
pub(crate) fn repaint(model: &mut Model) {
    model.out.effects.push(Effect::Repaint);
}

/// Listens to the mouse, or no longer.
pub(crate) fn toggle_mouse(model: &mut Model) {
    model.mouse = !model.mouse;
    model.dragging = false;
    let word = if model.mouse { "on" } else { "off" };
    model.notice = Some(format!("mouse {word}"));
    model.out.effects.push(Effect::Mouse(model.mouse));
}

/// Computes ahead while nothing else is wanted, or no longer.
pub(crate) fn toggle_idle(model: &mut Model) {
    model.idle = !model.idle;
    let words = if model.idle {
        "idle work on: mesh error and bands are computed ahead"
    } else {
        "idle work off: nothing is computed ahead"
    };
    model.notice = Some(words.to_owned());
}

/// Leaves, after a question if work would be lost.
pub(crate) fn quit(model: &mut Model) {
    if model.is_edited() {
        model.overlay = Some(Overlay::Question(Question::Quit {
            kept: model.goes_on,
        }));
    } else {
        model.out.effects.push(Effect::Quit(0));
    }
}

/// Shows or hides the keys.
pub(crate) fn help(model: &mut Model) {
    model.overlay = match model.overlay {
        Some(Overlay::Help(_)) => None,
        _ => Some(Overlay::Help(0)),
    };
}

/// Moves by so many rows through the list in front of the screen.
pub(crate) fn scroll(model: &mut Model, by: i16) {
    if let Some(Overlay::Help(line)) = model.overlay {
        let line = line.saturating_add_signed(by).min(help_rows(model));
        model.overlay = Some(Overlay::Help(line));
    }
    if let Some(Overlay::Picker(picker)) = &mut model.overlay {
        picker.go(isize::from(by));
    }
}

/// Takes the last change back, or makes it again.
pub(crate) fn travel(model: &mut Model, back: bool) {
    let present = model.work.clone();
    let other = if back {
        model.history.undo(present)
    } else {
        model.history.redo(present)
    };
    if let Ok(work) = other {
        put(model, work);
    } else {
        let what = if back { "undo" } else { "redo" };
        model.notice = Some(format!("nothing to {what}"));
    }
}

/// Accepts what is chosen in front of the screen, or what is typed.
pub(crate) fn accept(model: &mut Model) {
    match &model.overlay {
        Some(Overlay::Picker(picker)) => {
            let (at, marks) = (picker.shown.get(picker.row).copied(), picker.marks);
            match at {
                Some(at) if marks => compare::mark_found(model, at),
                Some(at) => {
                    model.overlay = None;
                    presets::open(model, at);
                }
                None => {}
            }
        }
        Some(Overlay::Name(naming, input, _)) => {
            let (naming, name) = (naming.clone(), input.value().trim().to_owned());
            match naming {
                Naming::Save => presets::save(model, name, false),
                Naming::Rename(from) => presets::rename(model, from, name),
            }
        }
        Some(Overlay::Threshold(_)) => threshold::accept(model),
        Some(_) => {}
        None => typing::accept(model),
    }
}

/// Gives up what is nearest: what stands in front, what is typed, or what is being computed.
pub(crate) fn cancel(model: &mut Model) {
    if threshold::stop(model) {
        return;
    }
    match model.overlay.take() {
        // Back to the list that it came from.
        Some(Overlay::Name(Naming::Rename(from), ..)) => {
            presets::open_picker_at(model, &from);
            return;
        }
        Some(_) => return,
        None => {}
    }
    if let Some(typing) = model.form.typing.take() {
        let work = model.work.with(typing.before);
        put(model, work);
    } else if model.page.stop(None, &mut model.out) {
        model.notice = Some("no page is written".to_owned());
    } else if !(model.on_show().cancel)(model) {
        // Its worker says that it was cancelled.
        model.run.end(&mut model.out);
    }
}

/// Answers yes or no to what is asked.
pub(crate) fn reply(model: &mut Model, yes: bool) {
    match model.overlay.take() {
        Some(Overlay::Question(Question::Adopt(_))) if yes => accuracy::accept(model),
        Some(Overlay::Question(Question::Quit { .. })) if yes => {
            model.out.effects.push(Effect::Quit(0));
        }
        Some(Overlay::Question(Question::Replace(name) | Question::Hide(name))) => {
            if yes {
                presets::save(model, name, true);
            } else {
                model.overlay = Some(Overlay::Name(Naming::Save, Line::of(name), None));
            }
        }
        Some(Overlay::Question(Question::Remove(name))) => {
            if yes {
                model.out.effects.push(Effect::Remove(name));
            } else {
                presets::open_picker_at(model, &name);
            }
        }
        _ => {}
    }
}

#[cfg(test)]
mod tests;
