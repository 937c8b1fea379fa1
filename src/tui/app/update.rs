//! What every message does to the app. It reads no clock and touches no file: time comes with
//! messages, and what must be done goes out as an [`Effect`].

use std::time::Duration;

use crossterm::event::{KeyEvent, MouseEvent};

use crate::plain_text::quoted;
use crate::tui::app::tables::{self, shown_while_typing};
use crate::tui::app::{App, help, mouse};
use crate::tui::changes::{presets, samples, simulation, take_away, threshold, typing};
use crate::tui::screens::screen::KeyOutcome;
use crate::tui::{keys::begins_value, outbox::Effect, overlay::Overlay, picker::Choice};
use crate::tui::{request::Report, save::SaveError, screens::SCREENS, screens::screen::About};

/// Something that happened.
pub enum Message {
    /// A key.
    Key(KeyEvent),
    /// Pasted text.
    Paste(String),
    /// The mouse, on a screen of this size.
    Mouse(MouseEvent, (u16, u16)),
    /// Time passed: this long since the start.
    Tick(Duration),
    /// A worker says something.
    News(Report),
    /// A preset was saved under this name, or not.
    Saved(String, Result<(), SaveError>),
    /// The preset of the first name has the second one, or not.
    Renamed(String, String, Result<(), SaveError>),
    /// The preset of this name was removed, and its text, or not.
    Removed(String, Result<String, SaveError>),
    /// These can be opened now.
    Choices(Vec<Choice>),
    /// What came of something that was done outside.
    Said(String),
}

/// Everything that is to be done once before the first key.
pub fn begin(app: &mut App) -> Vec<Effect> {
    simulation::start(&mut app.model);
    app.refresh_requests();
    std::mem::take(&mut app.model.out.effects)
}

/// Takes a message in.
pub fn update(app: &mut App, message: Message) -> Vec<Effect> {
    let model = &mut app.model;
    match message {
        Message::Tick(now) => tick(app, now),
        Message::Key(event) => key(app, event),
        Message::Paste(text) => {
            let begins = begins_value(&tables::stack(app));
            typing::paste(&mut app.model, &text, begins);
        }
        Message::Mouse(event, size) => mouse::handle(app, event, size),
        Message::News(report) => take_report(app, report),
        Message::Saved(name, outcome) => presets::saved(model, name, outcome),
        Message::Renamed(from, to, outcome) => presets::renamed(model, &from, to, outcome),
        Message::Removed(name, outcome) => presets::removed(model, name, outcome),
        Message::Choices(choices) => presets::replace_choices(model, choices),
        Message::Said(words) => model.notice = Some(words),
    }
    if let Some(Overlay::Help(line)) = app.model.overlay {
        app.model.overlay = Some(Overlay::Help(line.min(help::rows(app))));
    }
    app.refresh_requests();
    std::mem::take(&mut app.model.out.effects)
}

/// Offers what a worker says to all who may have asked. Late news is nobody's.
fn take_report(app: &mut App, report: Report) {
    let (model, mut report) = (&mut app.model, Some(report));
    simulation::take_report(model, &mut report);
    samples::take_report(model, &mut report);
    threshold::take_report(model, &mut report);
    take_away::take_report(model, &mut report);
    for screen in &mut app.screens {
        screen.take_report(model, &mut report);
    }
}

fn tick(app: &mut App, now: Duration) {
    let passed = now.saturating_sub(app.model.now).as_secs_f64();
    app.model.now = now;
    if let Some((_, window)) = app.timed() {
        app.model.clock.advance(passed, app.time(), window);
    }
}

/// Looks a key up in what stands in front, else in the screen. What nobody has may be typed.
fn key(app: &mut App, event: KeyEvent) {
    app.model.notice = None;
    if let Some(tables) = tables::in_front(&app.model) {
        match tables.iter().find_map(|table| table.find(&app.model.keys, event)) {
            Some(binding) => run(app, binding.act),
            None => match shown_while_typing(&app.model, event) {
                Some(place) if typing::accept(&mut app.model) => {
                    app.model.overlay = None;
                    app.show(place);
                }
                Some(_) => {}
                None => typing::key(&mut app.model, event),
            },
        }
        return;
    }
    match app.screens[app.screen].press(&mut app.model, event) {
        KeyOutcome::Done => {}
        KeyOutcome::BeginsValue if app.model.form.takes_numbers() => {
            typing::begin(&mut app.model, true);
            typing::key(&mut app.model, event);
        }
        KeyOutcome::BeginsValue => app.model.notice = Some(elsewhere(event)),
        KeyOutcome::Unknown => key_of_all(app, event),
    }
}

/// Looks a key up among those that count on every screen.
fn key_of_all(app: &mut App, event: KeyEvent) {
    let keys = &app.model.keys;
    let mut shared = tables::shared(app).into_iter();
    if let Some(binding) = shared.find_map(|table| table.find(keys, event)) {
        run(app, binding.act);
    } else if let Some(binding) = tables::SHOW.find(keys, event) {
        app.show(binding.act);
    } else if let Some(sign) = event.code.as_char() {
        let sign = quoted(&sign.to_string());
        app.model.notice = Some(format!("{sign} does nothing here: ? lists the keys"));
    }
}

fn run(app: &mut App, act: tables::AppAct) {
    app.model.form.complaint = None;
    act(app);
}

/// What to press for the screen of a digit where digits are values.
fn elsewhere(event: KeyEvent) -> String {
    let digit = event.code.as_char().and_then(|c| c.to_digit(10)).unwrap_or(0);
    let screen = SCREENS.get((digit as usize).wrapping_sub(1));
    let shows = |screen: &About| format!(": F{digit} or Alt-{digit} shows {}", screen.title);
    format!("no number is typed here{}", screen.map_or_else(String::new, shows))
}
