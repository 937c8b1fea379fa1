//! What is on show while the eye in three dimensions is computed.

use super::*;
use crate::scenario::{Geometry, set::set};

#[test]
fn a_blow_that_is_cancelled_leaves_what_was_on_show_before_its_first_estimate() {
    let mut app = opened();
    let effects = begin(&mut app);
    let (ticket, question) = asked::<Simulate>(&effects).unwrap();
    let whole = question.answer(&mut unwatched);
    done::<Simulate>(&mut app, ticket, whole);
    let straight = find("bb-62").unwrap().scenario().unwrap();
    let mut turned = straight.clone();
    set(&mut turned, "impact.angle_deg", "40").unwrap();
    let first = Simulate(straight).answer(&mut unwatched).unwrap();
    let work = app.model.work.clone();
    for leave in ["\x1b", ""] {
        let other = work.with(turned.clone());
        change(&mut app.model, other, "");
        let effects = std::mem::take(&mut app.model.out.effects);
        let (ticket, _) = asked::<Simulate>(&effects).unwrap();
        tell::<Simulate>(&mut app, ticket, first.clone(), false);
        assert_eq!(app.model.stale(), Some("first estimate"));
        if leave.is_empty() {
            done::<Simulate>(&mut app, ticket, Err(Refusal::Cancelled));
        } else {
            press(&mut app, leave);
            assert_eq!((&app.model.work, app.model.stale()), (&work, None));
        }
        assert_eq!(app.model.shown.as_ref().unwrap().scenario, work.scenario);
    }
    assert_eq!(app.model.stale(), Some("last good result"));
}

#[test]
fn an_estimate_of_another_blow_is_never_what_was_on_show_before() {
    let mut app = opened();
    let mut work = app.model.work.clone();
    let straight = find("bb-62").unwrap().scenario().unwrap();
    let first = Simulate(straight.clone()).answer(&mut unwatched).unwrap();
    for angle in ["30", "40"] {
        work = work.with(straight.clone());
        set(&mut work.scenario, "impact.angle_deg", angle).unwrap();
        change(&mut app.model, work.clone(), "");
        let effects = std::mem::take(&mut app.model.out.effects);
        let (ticket, _) = asked::<Simulate>(&effects).unwrap();
        tell::<Simulate>(&mut app, ticket, first.clone(), false);
        assert_eq!(app.model.stale(), Some("first estimate"));
        assert!(app.model.finished.is_none());
    }
}

#[test]
fn a_blow_from_the_side_shows_a_first_estimate_that_is_named_until_the_answer_comes() {
    let mut app = opened();
    let mut scenario = find("bb-62").unwrap().scenario().unwrap();
    let changes = [("impact.angle_deg", "40"), ("impact.offset_mm", "2"), ("window_ms", "0.05")];
    for (field, value) in changes {
        set(&mut scenario, field, value).unwrap();
    }
    app.model.work.scenario = scenario;
    let effects = begin(&mut app);
    let (ticket, question) = asked::<Simulate>(&effects).unwrap();
    let mut parts = Vec::new();
    let whole = question.fill_in(&mut unwatched, &mut |part| parts.push(part));
    let first = parts.pop().unwrap();
    assert!(parts.is_empty());
    tell::<Simulate>(&mut app, ticket, first, false);
    let geometry = |app: &App| app.model.shown.as_ref().unwrap().scenario.geometry().unwrap();
    assert_eq!(geometry(&app), Geometry::Axisymmetric);
    assert_eq!(app.model.stale(), Some("first estimate"));
    done::<Simulate>(&mut app, ticket, whole);
    assert_eq!(geometry(&app), Geometry::Full);
    assert_eq!(app.model.stale(), None);
}
