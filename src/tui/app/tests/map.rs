//! What the map asks for, and what is done with what comes.

use super::*;
use crate::many::map::Spot;
use crate::run::readings::PerQuantity;
use crate::tui::screens::map::DrawMap;

fn drawn(effects: &[Effect]) -> Option<(u64, DrawMap)> {
    asked::<DrawMap>(effects).map(|(ticket, question)| (ticket, question.clone()))
}

/// So many points more than were known, so far or in the end.
fn tell(
    app: &mut App,
    (ticket, question): &(u64, DrawMap),
    count: usize,
    over: bool,
) -> Vec<Effect> {
    let known = PerQuantity::from_fn(|q| (q != Quantity::Pressure).then_some(10.0));
    let mut grid = question.known.clone();
    let before = grid.known().0;
    for at in grid.order().into_iter().skip(before).take(count) {
        grid.put(at, Spot::Known(known));
    }
    if over {
        done::<DrawMap>(app, *ticket, Ok(grid))
    } else {
        so_far::<DrawMap>(app, *ticket, grid)
    }
}

fn count(app: &App) -> usize {
    let grid = app.state::<Map>().grid(&app.model.work.scenario);
    grid.map_or(0, |grid| grid.known().0)
}

#[test]
fn a_map_is_shown_while_it_fills_in_and_goes_on_where_it_was_after_a_visit_elsewhere() {
    let mut app = begun();
    let asked = drawn(&letter(&mut app, '7')).unwrap();
    assert!(tell(&mut app, &asked, 81, false).is_empty());
    assert_eq!(count(&app), 81);
    assert_eq!(letter(&mut app, '1'), [Effect::Stop(asked.0)]);
    let again = drawn(&letter(&mut app, '7')).unwrap();
    assert_eq!(again.1.known.known().0, 81);
    assert!(tell(&mut app, &again, 2000, true).is_empty());
    assert_eq!(count(&app), 33 * 33);
    letter(&mut app, '1');
    assert!(letter(&mut app, '7').is_empty(), "nothing is left");
}

#[test]
fn every_result_that_the_scene_has_comes_in_turn_and_nothing_is_simulated_for_it() {
    let mut app = begun();
    let asked = drawn(&letter(&mut app, '7')).unwrap();
    tell(&mut app, &asked, 81, false);
    let shown = |app: &App| {
        let map = &app.state::<Map>();
        map.quantity(map.grid(&app.model.work.scenario).unwrap())
    };
    let first = shown(&app);
    assert_eq!(first, Quantity::GlobeRupture, "a risk, where there is one");
    let all = Quantity::ALL.iter().copied().filter(|q| *q != Quantity::Pressure);
    let before = all.clone().take_while(|q| *q != first);
    let order = all.clone().skip_while(|q| *q != first).chain(before);
    for quantity in order.chain([first]) {
        assert_eq!(shown(&app), quantity);
        assert!(letter(&mut app, 'v').is_empty());
    }
}

#[test]
fn escape_and_leaving_stop_it_and_a_key_goes_on() {
    let mut app = begun();
    let asked = drawn(&letter(&mut app, '7')).unwrap();
    assert_eq!(key(&mut app, KeyCode::Esc), [Effect::Stop(asked.0)]);
    assert!(tell(&mut app, &asked, 9, false).is_empty(), "late news");
    assert_eq!(count(&app), 0);
    let (ticket, _) = drawn(&letter(&mut app, 'm')).unwrap();
    assert_eq!(letter(&mut app, '1'), [Effect::Stop(ticket)]);
    let (ticket, _) = drawn(&letter(&mut app, '7')).unwrap();
    let effects = letter(&mut app, '-');
    assert_eq!(effects[0], Effect::Stop(ticket));
    assert!(drawn(&effects).is_some(), "other ranges");
}

#[test]
fn the_cursor_moves_and_its_values_are_adopted() {
    let mut app = begun();
    letter(&mut app, '7');
    let middle = app.state::<Map>().cursor;
    key(&mut app, KeyCode::Up);
    letter(&mut app, 'L');
    assert_eq!(app.state::<Map>().cursor, [middle[0] + 4, middle[1] + 1]);
    let before = app.model.work.scenario.clone();
    let effects = key(&mut app, KeyCode::Enter);
    assert!(asked::<Simulate>(&effects).is_some());
    let (_, adopted) = app.state::<Map>().adopted(&before).unwrap();
    assert_eq!(app.model.work.scenario, adopted);
    assert!(notice(&app).contains("now "));
    key(&mut app, KeyCode::Enter);
    assert!(notice(&app).contains("your values"));
    letter(&mut app, 'u');
    assert_eq!(app.model.work.scenario, before);
}
