//! What is on show while the eye in three dimensions is computed.

use super::*;
use crate::scenario::{Geometry, set::set};

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
