//! What keys do to the measurement of total error against time.

use super::drawn::{app as open, open_measured, press};
use std::time::Duration;

use contrecoup::many::accuracy::Total;
use contrecoup::tui::app::App;
use contrecoup::tui::app::update::Message;
use contrecoup::tui::app::update::update;
use contrecoup::tui::outbox::Effect;
use contrecoup::tui::overlay::Overlay;
use contrecoup::tui::overlay::Prompt;
use contrecoup::tui::request::Report;
use contrecoup::tui::request::Ticket;
use contrecoup::tui::screens::accuracy::{MeasureAccuracy, Measurement};
use contrecoup::tui::simulation::Simulate;
use contrecoup::tui::terminal::caps::Depth;
use crossterm::event::{KeyCode, KeyEvent};

fn app() -> App {
    let mut app = open(&[], Depth::Mono);
    press(&mut app, "\x1b1");
    app
}

fn key(app: &mut App, code: KeyCode) -> Vec<Effect> {
    update(app, Message::Key(KeyEvent::from(code)))
}

fn letter(app: &mut App, letter: char) -> Vec<Effect> {
    key(app, KeyCode::Char(letter))
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

fn here(app: &App) -> &Measurement {
    app.state::<Measurement>()
}

fn chosen(app: &App) -> (usize, Total) {
    let shown = here(app).shown(&app.model.work.scenario);
    let place = here(app).place(&shown);
    (place, shown[place])
}

/// A model whose screen shows a measurement.
fn measured() -> App {
    let mut app = app();
    open_measured(&mut app);
    assert!(here(&app).task.job.is_none());
    app
}

#[test]
fn the_cursor_goes_through_time_and_along_the_front() {
    let mut app = measured();
    for _ in 0..100 {
        key(&mut app, KeyCode::Left);
    }
    let (place, fastest) = chosen(&app);
    assert!(fastest.on_front && place == 0);
    key(&mut app, KeyCode::Right);
    assert!(chosen(&app).1.seconds >= fastest.seconds);
    while {
        let before = chosen(&app).0;
        letter(&mut app, 'L');
        chosen(&app).0 > before
    } {
        assert!(chosen(&app).1.on_front);
    }
    assert!(chosen(&app).1.level > 1, "finer levels are on the front");
}

#[test]
fn a_point_is_adopted_with_its_level_and_that_can_be_undone() {
    let mut app = measured();
    let before = app.model.work.scenario.clone();
    while chosen(&app).1.is_answer || chosen(&app).1.level == 1 {
        key(&mut app, KeyCode::Right);
    }
    let total = chosen(&app).1;
    assert!(simulates(&key(&mut app, KeyCode::Enter)));
    let scenario = &app.model.work.scenario;
    assert_eq!(scenario.eye.level, total.level);
    assert_eq!(scenario.numerics.integrator, Some(total.plan.integrator));
    let step = scenario.numerics.step_us.unwrap() * 1e-6;
    assert!(step <= total.plan.step && step > total.plan.step * 0.9999);
    assert_eq!(chosen(&app).1, total, "the measurement holds for it too");
    letter(&mut app, 'u');
    assert_eq!(app.model.work.scenario, before);
}

#[test]
fn it_measures_while_it_is_on_show_and_goes_on_where_it_was() {
    let mut app = app();
    let ticket = ticket_of(&key(&mut app, KeyCode::F(5))).unwrap();
    let mut part = crate::made_up_accuracy::made_up();
    part.done = 20;
    let report = Report::so_far::<MeasureAccuracy>(ticket, part);
    update(&mut app, Message::News(report));
    assert!(key(&mut app, KeyCode::F(2)).contains(&Effect::Stop(ticket)));
    let late = Report::progress(ticket, 0.5, Duration::ZERO);
    update(&mut app, Message::News(late));
    assert!(here(&app).task.job.is_none());
    let ticket = ticket_of(&key(&mut app, KeyCode::F(5))).unwrap();
    let known = here(&app).of(&app.model.work.scenario).unwrap();
    assert_eq!(known.done, 20);
    assert!(key(&mut app, KeyCode::Esc).contains(&Effect::Stop(ticket)));
    assert!(key(&mut app, KeyCode::F(5)).is_empty(), "only a key goes on");
    let ticket = ticket_of(&letter(&mut app, 'm')).unwrap();
    // Another scenario is measured from the beginning.
    key(&mut app, KeyCode::F(1));
    letter(&mut app, 'l');
    let again = ticket_of(&key(&mut app, KeyCode::F(5))).unwrap();
    assert!(again > ticket && here(&app).of(&app.model.work.scenario).is_none());
}

#[test]
fn what_is_more_exact_says_what_it_costs_before_it_is_done() {
    let asked = |app: &App| match &app.model.overlay {
        Some(Overlay::Prompt(Prompt::Adopt(words, _))) => words.clone(),
        _ => panic!("nothing is asked"),
    };
    let mut app = app();
    // Nothing is known yet: the screen opens, measures, and then asks.
    letter(&mut app, '>');
    assert_eq!(app.about().title, "Accuracy");
    let ticket = here(&app).task.job.as_ref().unwrap().ticket;
    let totals = crate::made_up_accuracy::made_up();
    update(&mut app, Message::News(Report::done::<MeasureAccuracy>(ticket, Ok(totals))));
    let words = asked(&app);
    assert!(words.contains("Error of the damage index: ") && words.contains("ms"), "{words}");
    key(&mut app, KeyCode::Esc);
    assert_eq!(app.model.work.scenario.eye.level, 1);
    // Known by now: it is asked on any screen.
    key(&mut app, KeyCode::F(3));
    letter(&mut app, '>');
    asked(&app);
    assert!(simulates(&key(&mut app, KeyCode::Enter)));
    assert_eq!(app.about().title, "Forces");
    assert_eq!(app.model.work.scenario.eye.level, 2);
    letter(&mut app, '<');
    asked(&app);
    key(&mut app, KeyCode::Enter);
    assert_eq!(app.model.work.scenario.eye.level, 1);
}
