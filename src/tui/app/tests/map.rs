//! What the map asks for, and what is done with what comes.

use super::*;
use crate::many::map::{PointResults, Spot};
use crate::run::readings::PerQuantity;
use crate::tui::screens::map::DrawMap;

fn drawn(effects: &[Effect]) -> Option<(u64, DrawMap)> {
    asked::<DrawMap>(effects).map(|(ticket, question)| (ticket, question.clone()))
}

/// So many points more than were known, so far or in the end.
fn fill(
    app: &mut App,
    (ticket, question): &(u64, DrawMap),
    count: usize,
    whole: bool,
) -> Vec<Effect> {
    let known = PerQuantity::from_fn(|q| (q != Quantity::Pressure).then_some(10.0));
    let mut grid = question.known.clone();
    for at in grid.order().into_iter().skip(grid.known().0).take(count) {
        grid.put(at, Spot::Known(PointResults { values: known, ranges: None }));
    }
    tell::<DrawMap>(app, *ticket, grid, whole)
}

fn count(app: &App) -> usize {
    let grid = app.state::<Map>().grid(&app.model.work.scenario);
    grid.map_or(0, |grid| grid.known().0)
}

#[test]
fn a_map_is_shown_while_it_fills_in_and_goes_on_where_it_was_after_a_visit_elsewhere() {
    let mut app = begun();
    let asked = drawn(&press(&mut app, "\x1b7")).unwrap();
    assert!(fill(&mut app, &asked, 81, false).is_empty());
    assert_eq!(count(&app), 81);
    assert_eq!(press(&mut app, "\x1b1"), [Effect::Stop(asked.0)]);
    let again = drawn(&press(&mut app, "\x1b7")).unwrap();
    assert_eq!(again.1.known.known().0, 81);
    assert!(fill(&mut app, &again, 2000, true).is_empty());
    assert_eq!(count(&app), 33 * 33);
    press(&mut app, "\x1b1");
    assert!(press(&mut app, "\x1b7").is_empty(), "nothing is left");
}

#[test]
fn every_result_that_the_scene_has_comes_in_turn_and_nothing_is_simulated_for_it() {
    let mut app = begun();
    let asked = drawn(&press(&mut app, "\x1b7")).unwrap();
    fill(&mut app, &asked, 81, false);
    let shown = |app: &App| {
        let map = &app.state::<Map>();
        map.quantity(map.grid(&app.model.work.scenario).unwrap())
    };
    let first = shown(&app);
    assert_eq!(first, Quantity::GlobeRupture, "a risk, where there is one");
    let all = Quantity::ALL.iter().copied().filter(|q| *q != Quantity::Pressure);
    let before = all.clone().take_while(|q| *q != first);
    for quantity in all.clone().skip_while(|q| *q != first).chain(before).chain([first]) {
        assert_eq!(shown(&app), quantity);
        assert!(press(&mut app, "v").is_empty());
    }
}

#[test]
fn escape_and_leaving_stop_it_and_a_key_goes_on() {
    let mut app = begun();
    let asked = drawn(&press(&mut app, "\x1b7")).unwrap();
    assert_eq!(press(&mut app, "\x1b"), [Effect::Stop(asked.0)]);
    assert!(fill(&mut app, &asked, 9, false).is_empty(), "late news");
    assert_eq!(count(&app), 0);
    let (ticket, _) = drawn(&press(&mut app, "m")).unwrap();
    assert_eq!(press(&mut app, "\x1b1"), [Effect::Stop(ticket)]);
    let (ticket, _) = drawn(&press(&mut app, "\x1b7")).unwrap();
    let effects = press(&mut app, "-");
    assert_eq!(effects[0], Effect::Stop(ticket));
    assert!(drawn(&effects).is_some(), "other ranges");
}

#[test]
fn the_cursor_moves_and_its_values_are_adopted() {
    let mut app = begun();
    press(&mut app, "\x1b7");
    let middle = app.state::<Map>().cursor;
    press(&mut app, "\x1b[AL");
    assert_eq!(app.state::<Map>().cursor, [middle[0] + 4, middle[1] + 1]);
    let before = app.model.work.scenario.clone();
    assert!(asked::<Simulate>(&press(&mut app, "\r")).is_some());
    let (_, adopted) = app.state::<Map>().adopted(&before).unwrap();
    assert_eq!(app.model.work.scenario, adopted);
    assert!(notice(&app).contains("now "));
    press(&mut app, "\r");
    assert!(notice(&app).contains("your values"));
    press(&mut app, "u");
    assert_eq!(app.model.work.scenario, before);
}
