//! What keys do to the measurement of total error against time.

use super::drawn::{model as open, open_measured, press};
use std::time::Duration;

use contrecoup::many::accuracy::Total;
use contrecoup::tui::model::{Model, Overlay, Question};
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

fn ticket_of(effects: &[Effect]) -> Option<Ticket> {
    effects.iter().find_map(|effect| match effect {
        Effect::Start(request) if request.question::<MeasureAccuracy>().is_some() => {
            Some(request.ticket)
        }
        _ => None,
    })
}

fn here(model: &Model) -> &Measurement {
    &model.screens.accuracy
}

fn chosen(model: &Model) -> (usize, Total) {
    let shown = here(model).shown(&model.work.scenario);
    let place = here(model).place(&shown);
    (place, shown[place])
}

/// A model whose screen shows a measurement.
fn measured() -> Model {
    let mut model = model();
    open_measured(&mut model);
    assert!(here(&model).task.job.is_none());
    model
}

#[test]
fn the_cursor_goes_through_time_and_along_the_front() {
    let mut model = measured();
    for _ in 0..100 {
        key(&mut model, KeyCode::Left);
    }
    let (place, fastest) = chosen(&model);
    assert!(fastest.on_front && place == 0);
    key(&mut model, KeyCode::Right);
    assert!(chosen(&model).1.seconds >= fastest.seconds);
    while {
        let before = chosen(&model).0;
        letter(&mut model, 'L');
        chosen(&model).0 > before
    } {
        assert!(chosen(&model).1.on_front);
    }
    assert!(chosen(&model).1.level > 1, "finer levels are on the front");
}

#[test]
fn a_point_is_adopted_with_its_level_and_that_can_be_undone() {
    let mut model = measured();
    let before = model.work.scenario.clone();
    while chosen(&model).1.is_answer || chosen(&model).1.level == 1 {
        key(&mut model, KeyCode::Right);
    }
    let total = chosen(&model).1;
    assert!(simulates(&key(&mut model, KeyCode::Enter)));
    let scenario = &model.work.scenario;
    assert_eq!(scenario.eye.level, total.level);
    assert_eq!(scenario.numerics.integrator, Some(total.plan.integrator));
    let step = scenario.numerics.step_us.unwrap() * 1e-6;
    assert!(step <= total.plan.step && step > total.plan.step * 0.9999);
    assert_eq!(chosen(&model).1, total, "the measurement holds for it too");
    letter(&mut model, 'u');
    assert_eq!(model.work.scenario, before);
}

#[test]
fn it_measures_while_it_is_on_show_and_goes_on_where_it_was() {
    let mut model = model();
    let ticket = ticket_of(&key(&mut model, KeyCode::F(5))).unwrap();
    let mut part = super::made_up_accuracy::made_up();
    part.done = 20;
    let report = Report::so_far::<MeasureAccuracy>(ticket, part);
    update(&mut model, Message::News(report));
    assert!(key(&mut model, KeyCode::F(2)).contains(&Effect::Stop(ticket)));
    let late = Report::progress(ticket, 0.5, Duration::ZERO);
    update(&mut model, Message::News(late));
    assert!(here(&model).task.job.is_none());
    let ticket = ticket_of(&key(&mut model, KeyCode::F(5))).unwrap();
    let known = here(&model).of(&model.work.scenario).unwrap();
    assert_eq!(known.done, 20);
    assert!(key(&mut model, KeyCode::Esc).contains(&Effect::Stop(ticket)));
    assert!(
        key(&mut model, KeyCode::F(5)).is_empty(),
        "only a key goes on"
    );
    let ticket = ticket_of(&letter(&mut model, 'm')).unwrap();
    // Another scenario is measured from the beginning.
    key(&mut model, KeyCode::F(1));
    letter(&mut model, 'l');
    let again = ticket_of(&key(&mut model, KeyCode::F(5))).unwrap();
    assert!(again > ticket && here(&model).of(&model.work.scenario).is_none());
}

#[test]
fn what_is_more_exact_says_what_it_costs_before_it_is_done() {
    let asked = |model: &Model| match &model.overlay {
        Some(Overlay::Question(Question::Adopt(words))) => words.clone(),
        _ => panic!("nothing is asked"),
    };
    let mut model = model();
    // Nothing is known yet: the screen opens, measures, and then asks.
    letter(&mut model, '>');
    assert_eq!(model.on_show().title, "Accuracy");
    let ticket = here(&model).task.job.as_ref().unwrap().ticket;
    let totals = super::made_up_accuracy::made_up();
    update(
        &mut model,
        Message::News(Report::done::<MeasureAccuracy>(ticket, Ok(totals))),
    );
    let words = asked(&model);
    assert!(
        words.contains("Error of the damage index: ") && words.contains("ms"),
        "{words}"
    );
    key(&mut model, KeyCode::Esc);
    assert_eq!(model.work.scenario.eye.level, 1);
    // Known by now: it is asked on any screen.
    key(&mut model, KeyCode::F(3));
    letter(&mut model, '>');
    asked(&model);
    assert!(simulates(&key(&mut model, KeyCode::Enter)));
    assert_eq!(model.on_show().title, "Forces");
    assert_eq!(model.work.scenario.eye.level, 2);
    letter(&mut model, '<');
    asked(&model);
    key(&mut model, KeyCode::Enter);
    assert_eq!(model.work.scenario.eye.level, 1);
}
