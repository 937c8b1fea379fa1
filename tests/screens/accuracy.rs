//! What keys do to the measurement of speed against error.

use super::drawn::{model as open, open_measured, press};
use contrecoup::tui::model::Model;
use contrecoup::tui::screens::SCREENS;
use contrecoup::tui::screens::accuracy::measurement::{MeasureAccuracy, Measurement};
use contrecoup::tui::simulation::Simulate;
use contrecoup::tui::task::{Report, Ticket};
use contrecoup::tui::terminal::caps::Depth;
use contrecoup::tui::update::{Effect, Message, update};
use crossterm::event::{KeyCode, KeyEvent};

fn model() -> Model {
    let mut model = open(&[], Depth::Mono);
    press(&mut model, "\x1b1");
    model
}

fn key(model: &mut Model, code: KeyCode) -> Vec<Effect> {
    update(model, Message::Key(KeyEvent::from(code)))
}

fn letter(model: &mut Model, letter: char) -> Vec<Effect> {
    key(model, KeyCode::Char(letter))
}

fn simulates(effects: &[Effect]) -> bool {
    let is_run =
        |effect: &Effect| matches!(effect, Effect::Start(r) if r.question::<Simulate>().is_some());
    effects.iter().any(is_run)
}

fn ticket_of(effects: &[Effect]) -> Ticket {
    match effects {
        [Effect::Start(request)] if request.question::<MeasureAccuracy>().is_some() => {
            request.ticket
        }
        other => panic!("{other:?}"),
    }
}

fn here(model: &Model) -> &Measurement {
    &model.screens.accuracy
}

/// A model whose screen shows a measurement.
fn measured() -> Model {
    let mut model = model();
    open_measured(&mut model);
    assert!(here(&model).task.job.is_none() && here(&model).chosen().is_some());
    model
}

#[test]
fn the_cursor_goes_through_time_and_along_the_front() {
    let mut model = measured();
    for _ in 0..100 {
        key(&mut model, KeyCode::Left);
    }
    let fastest = *here(&model).chosen().unwrap();
    assert!(fastest.on_front && here(&model).cursor == 0);
    key(&mut model, KeyCode::Right);
    assert!(here(&model).chosen().unwrap().seconds >= fastest.seconds);
    while {
        let before = here(&model).cursor;
        letter(&mut model, 'L');
        here(&model).cursor > before
    } {
        assert!(here(&model).chosen().unwrap().on_front);
    }
}

#[test]
fn a_point_is_adopted_and_that_can_be_undone() {
    let mut model = measured();
    let before = model.work.scenario.clone();
    let plan = here(&model).chosen().unwrap().plan;
    let effects = key(&mut model, KeyCode::Enter);
    assert!(simulates(&effects));
    let numerics = model.work.scenario.numerics.clone();
    assert!(numerics.integrator.is_some());
    let step = numerics.step_us.unwrap() * 1e-6;
    assert!(step <= plan.step && step > plan.step * 0.9999);
    assert!(!here(&model).is_stale(&model.work.scenario));
    letter(&mut model, 'u');
    assert_eq!(model.work.scenario, before);
}

#[test]
fn an_edit_makes_it_stale_and_only_a_key_measures_again() {
    let mut model = measured();
    assert!(letter(&mut model, '1').is_empty());
    assert!(
        key(&mut model, KeyCode::F(5)).is_empty(),
        "it is still right"
    );
    letter(&mut model, '1');
    let effects = letter(&mut model, 'l');
    assert!(simulates(&effects));
    model.work.scenario.window_ms = 0.3;
    assert!(here(&model).is_stale(&model.work.scenario));
    // Back on the screen without its key, which would measure.
    model.screen = SCREENS.iter().position(|s| s.title == "Accuracy").unwrap();
    let before = model.work.clone();
    assert!(key(&mut model, KeyCode::Enter).is_empty());
    assert!(model.work == before && model.notice.is_some());
    ticket_of(&letter(&mut model, 'm'));
    assert!(letter(&mut model, 'm').is_empty(), "one at a time");
}

#[test]
fn leaving_an_edit_and_escape_stop_it_and_late_news_is_dropped() {
    for leave in ['1', '\u{1b}', 'u'] {
        let mut model = model();
        letter(&mut model, 'l');
        let ticket = ticket_of(&key(&mut model, KeyCode::F(5)));
        let code = if leave == '\u{1b}' {
            KeyCode::Esc
        } else {
            KeyCode::Char(leave)
        };
        let effects = key(&mut model, code);
        let stops = Effect::Stop(ticket);
        assert!(effects.contains(&stops), "{leave}");
        update(&mut model, Message::News(Report::progress(ticket, 0.5)));
        assert!(here(&model).task.job.is_none());
    }
}
