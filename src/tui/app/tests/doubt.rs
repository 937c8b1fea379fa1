//! What the screen of doubt asks for, and what it keeps.

use super::*;
use crate::scenario::Scenario;
use crate::tui::ensemble::{FEW, MANY, RunSamples};
use crate::tui::{screens::doubt::Doubt, simulation::Complete};

fn sampled(effects: &[Effect]) -> Option<(u64, RunSamples)> {
    asked::<RunSamples>(effects).map(|(ticket, question)| (ticket, question.clone()))
}

/// A model with its answer, and what it asks for when it is whole or was refused.
fn idle_model() -> (App, (u64, RunSamples)) {
    let mut app = opened();
    app.model.work.scenario.window_ms = Some(0.2);
    let effects = begin(&mut app);
    let (ticket, question) = asked::<Simulate>(&effects).unwrap();
    let answer = question.answer(&mut unwatched);
    let effects = done::<Simulate>(&mut app, ticket, answer);
    let (ticket, _) = asked::<Complete>(&effects).unwrap();
    let effects = done::<Complete>(&mut app, ticket, Err(Refusal::Cancelled));
    (app, sampled(&effects).expect("the band follows what completes the answer"))
}

/// An ensemble of so many samples, unfinished or finished.
fn sample(app: &mut App, (ticket, question): &(u64, RunSamples), count: u32, whole: bool) {
    let mut outcome = RunSamples { count, ..question.clone() }.answer(&mut unwatched).unwrap();
    outcome.asked = question.count;
    tell::<RunSamples>(app, *ticket, outcome, whole);
}

#[test]
fn the_band_comes_when_idle_and_an_edit_stops_it() {
    let (mut app, asked) = idle_model();
    assert_eq!(asked.1.count, FEW);
    let scenario = app.model.work.scenario.clone();
    assert!(app.model.ensemble.of(&scenario).is_none());
    sample(&mut app, &asked, 8, false);
    assert!(app.model.ensemble.of(&scenario).is_none(), "too few to be shown");
    sample(&mut app, &asked, 16, false);
    assert!(app.model.ensemble.of(&scenario).is_some());
    assert!(app.model.ensemble.of(&Scenario { name: "other".to_owned(), ..scenario }).is_some());

    let (mut app, asked) = idle_model();
    assert!(press(&mut app, "l").contains(&Effect::Stop(asked.0)));
    sample(&mut app, &asked, 16, false);
    assert!(app.model.ensemble.done.is_none(), "late news");
}

#[test]
fn idle_work_is_announced_and_a_key_stops_it() {
    let (mut app, asked) = idle_model();
    assert!(asked.1.is_idle());
    update(&mut app, Message::News(Report::progress(asked.0, 0.25, Duration::ZERO)));
    assert_eq!(app.model.ahead().unwrap(), "64 of 256 samples");
    assert_eq!(press(&mut app, "I"), [Effect::Stop(asked.0)]);
    assert_eq!(app.model.ahead(), None);
    let (ticket, question) = sampled(&press(&mut app, "I")).unwrap();
    assert!(question.is_idle());
    assert!(press(&mut app, "\x1b2").contains(&Effect::Stop(ticket)));
}

#[test]
fn the_screen_asks_for_more_and_goes_on_with_what_is_done() {
    let (mut app, asked) = idle_model();
    sample(&mut app, &asked, 8, false);
    let asked = sampled(&press(&mut app, "\x1b6")).unwrap();
    assert_eq!(asked.1.count, MANY);
    assert!(!asked.1.is_idle() && asked.1.known.as_ref().unwrap().samples.len() == 8);
    update(&mut app, Message::News(Report::progress(asked.0, 0.3, Duration::ZERO)));
    assert_eq!(app.model.ensemble.pace().unwrap(), "300 of 1000");
    let offered = |app: &App| footer_keys(app).iter().any(|(_, word)| *word == "go on");
    assert!(!offered(&app), "it runs");
    assert_eq!(press(&mut app, "\x1b"), [Effect::Stop(asked.0)]);
    sample(&mut app, &asked, 32, true);
    assert!(offered(&app));
    let kept = app.model.ensemble.of(&app.model.work.scenario).unwrap();
    assert!(kept.stopped() && kept.samples.len() == 32 && kept.asked == MANY);
    assert!(app.model.ensemble.task.complaint.is_some());
    assert!(press(&mut app, "\x1b6").is_empty(), "only a key goes on");
    let (_, again) = sampled(&press(&mut app, "m")).unwrap();
    assert_eq!(again.known.unwrap().samples.len(), 32);
    assert!(press(&mut app, "m").is_empty(), "one at a time");
}

#[test]
fn leaving_the_screen_stops_it_and_results_can_be_walked_through() {
    let (mut app, _) = idle_model();
    let asked = sampled(&press(&mut app, "\x1b6")).unwrap();
    assert_eq!(press(&mut app, "\x1b2"), [Effect::Stop(asked.0)]);
    let asked = sampled(&press(&mut app, "\x1b6")).unwrap();
    sample(&mut app, &asked, 16, false);
    press(&mut app, &"j".repeat(20));
    let last = app.model.ensemble.of(&app.model.work.scenario).unwrap().results().len() - 1;
    assert!(last >= 8, "all that a force pulse has");
    assert_eq!(app.state::<Doubt>().row, last);
    press(&mut app, "k");
    assert_eq!(app.state::<Doubt>().row, last - 1);
    app.model.work.scenario.window_ms = Some(0.3);
    press(&mut app, "k");
    assert_eq!(app.state::<Doubt>().row, last - 1, "nothing to walk through");
}
