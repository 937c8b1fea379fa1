//! Asking at which value a result reaches another one.

use super::*;
use crate::injury::Injury;
use crate::many::threshold::Threshold;
use crate::tui::shown::ShownAnswer;
use crate::tui::threshold::{Asking, FindThreshold};
use ratatui::buffer::Cell;

/// At the speed of a BB whose answer is on show.
fn bb() -> App {
    let mut app = opened();
    let scenario = find("bb-56").unwrap().scenario().unwrap();
    app.model.work.scenario = scenario.clone();
    app.model.shown = Some(ShownAnswer::new(scenario, simulated(&app).unwrap()));
    app.model.form.selected = row("impact.speed_m_s");
    app
}

fn drawn(app: &App) -> String {
    let mut buffer = Buffer::empty(Rect::new(0, 0, 80, 24));
    draw(app, &mut buffer);
    buffer.content.iter().map(Cell::symbol).collect()
}

fn asking(app: &App) -> &Asking {
    match &app.model.overlay {
        Some(Overlay::Threshold(asking)) => asking,
        _ => panic!("nothing is asked"),
    }
}

#[test]
fn a_risk_is_looked_for_and_its_value_is_taken_into_the_form() {
    let mut app = bb();
    press(&mut app, "t");
    assert_eq!(asking(&app).quantity, Quantity::GlobeRupture);
    assert_eq!(asking(&app).input.value(), "50");
    let effects = press(&mut app, "\r");
    let (ticket, question) = asked::<FindThreshold>(&effects).unwrap();
    done::<FindThreshold>(&mut app, ticket, question.answer(&mut unwatched));
    let crossing = asking(&app).chosen().unwrap();
    let (from, to) = crossing.risk.as_ref().unwrap().range;
    assert!(from.unwrap() < crossing.at && crossing.at < to.unwrap());
    let text = drawn(&app);
    assert!(text.contains("50 % at ") && text.contains(" to "), "{text}");
    let speed: f64 = asking(&app).taken().unwrap().parse().unwrap();
    assert!((40.0..80.0).contains(&speed), "{speed}");
    press(&mut app, "\r");
    let speed_now = fields::find("impact.speed_m_s").unwrap().text(&app.model.work.scenario);
    assert_eq!(speed_now.unwrap().parse(), Ok(speed));
    press(&mut app, "u");
    assert_eq!(app.model.work.scenario, find("bb-56").unwrap().scenario().unwrap());
}

#[test]
fn escape_stops_the_search_and_then_closes_and_nothing_is_taken() {
    let mut app = bb();
    let before = app.model.work.clone();
    let (ticket, _) = asked::<FindThreshold>(&press(&mut app, "t\r")).unwrap();
    // What is asked stays as it is meanwhile.
    press(&mut app, "\x1b7\x1b[B");
    assert_eq!(asking(&app).input.value(), "50");
    // What is computed ahead may begin again beside it.
    assert!(press(&mut app, "\x1b").contains(&Effect::Stop(ticket)));
    assert!(asking(&app).task.job.is_none());
    press(&mut app, "\x1b");
    assert!(app.model.overlay.is_none() && app.model.work == before);
}

#[test]
fn only_a_number_with_an_answer_is_asked_about_and_only_numbers_are_sought() {
    let mut app = bb();
    press(&mut app, "tx\r");
    assert!(asking(&app).error.is_some() && asking(&app).task.job.is_none());
    press(&mut app, "\x1b");
    app.model.form.selected = FormRow::Preset;
    press(&mut app, "t");
    assert!(app.model.overlay.is_none() && app.model.notice.is_some());
    app.model.form.selected = row("impact.speed_m_s");
    app.model.shown = None;
    press(&mut app, "t");
    assert!(app.model.overlay.is_none());
}

#[test]
fn any_of_the_six_risks_is_asked_for_and_one_that_no_value_reaches_says_so() {
    let mut app = bb();
    press(&mut app, "t");
    for injury in Injury::ALL {
        assert_eq!(asking(&app).quantity, injury.result());
        press(&mut app, "\x1b[B");
    }
    let (ticket, _) = asked::<FindThreshold>(&press(&mut app, "\r")).unwrap();
    let never = Threshold { seen: vec![(1.0, Ok(0.0)), (200.0, Ok(31.0))], crossings: Vec::new() };
    done::<FindThreshold>(&mut app, ticket, Ok(never));
    assert!(drawn(&app).contains("Never: "), "{}", drawn(&app));
}
