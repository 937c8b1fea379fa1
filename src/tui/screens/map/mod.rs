//! One result over two inputs: computed grid by grid while it is on show.

pub mod state;
mod view;

use super::{Mouse, Pane, Screen};
use crate::tui::form::words;
use crate::tui::keys::shared::{
    DOWN, ENTER, LEFT, RIGHT, SHIFT_DOWN, SHIFT_LEFT, SHIFT_RIGHT, SHIFT_UP, UP,
};
use crate::tui::keys::{KeyTable, TimeKeys, bind, c};
use crate::tui::model::Model;
use crate::tui::step::Step;
use crate::tui::update::change;

pub(crate) const SCREEN: Screen = Screen {
    attend,
    hear: |model, report| model.screens.map.hear(report),
    cancel: |model| model.screens.map.task.stop(Some("stopped"), &mut model.out),
    mouse: |model, mouse, _| {
        if let Mouse::Wheel(_, step) = mouse {
            model.screens.map.step(step.reversed(), true);
        }
        false
    },
    ..Screen::new(
        ("Map", "What if?"),
        "a result over two inputs",
        &[Pane {
            name: "map",
            keys: &[KEYS],
            time: TimeKeys::Absent,
        }],
        view::draw,
    )
};

#[rustfmt::skip]
const KEYS: KeyTable = KeyTable::new("Map", &[
    bind(&[LEFT, c('h')], |m| m.screens.map.step(Step::LESS, true), "cursor", "the cursor to the left"),
    bind(&[RIGHT, c('l')], |m| m.screens.map.step(Step::MORE, true), "&", "the cursor to the right"),
    bind(&[UP, c('k')], |m| m.screens.map.step(Step::MORE, false), "&", "the cursor up"),
    bind(&[DOWN, c('j')], |m| m.screens.map.step(Step::LESS, false), "&", "the cursor down"),
    bind(&[SHIFT_LEFT, c('H')], |m| m.screens.map.step(Step::MUCH_LESS, true), "", "the cursor far to the left"),
    bind(&[SHIFT_RIGHT, c('L')], |m| m.screens.map.step(Step::MUCH_MORE, true), "", "the cursor far to the right"),
    bind(&[SHIFT_UP, c('K')], |m| m.screens.map.step(Step::MUCH_MORE, false), "", "the cursor far up"),
    bind(&[SHIFT_DOWN, c('J')], |m| m.screens.map.step(Step::MUCH_LESS, false), "", "the cursor far down"),
    bind(&[ENTER], adopt, "adopt", "give the scenario the values under the cursor"),
    bind(&[c('x')], |m| m.screens.map.turn(&m.work.scenario, true), "across", "the next input across"),
    bind(&[c('X')], |m| m.screens.map.turn(&m.work.scenario, false), "up", "the next input up"),
    bind(&[c('+'), c('=')], |m| m.screens.map.zoom(&m.work.scenario, true), "range", "wider ranges"),
    bind(&[c('-')], |m| m.screens.map.zoom(&m.work.scenario, false), "&", "narrower ranges"),
    bind(&[c('v')], |m| m.screens.map.next_result(&m.work.scenario), "result", "the next result that the scene has"),
    bind(&[c('m')], |m| m.screens.map.task.complaint = None, "", "go on after Esc"),
]);

/// While the screen is on show, computes what is missing, grid by grid; stops what is not wanted.
fn attend(model: &mut Model, on_show: bool) {
    let map = &mut model.screens.map;
    let mut wanted = None;
    if on_show {
        map.settle(&model.work.scenario);
        // What Esc stopped goes on by a key alone.
        if map.task.complaint.is_none() {
            wanted = map.next(&model.work.scenario);
        }
    }
    if let Some(job) = &map.task.job {
        if wanted.as_ref() == Some(job.question.as_ref()) {
            return;
        }
        map.task.stop(None, &mut model.out);
    }
    if let Some(question) = wanted {
        map.task.ask(question, &mut model.out);
    }
}

/// Gives the scenario the values under the cursor.
fn adopt(model: &mut Model) {
    let Some(scenario) = model.screens.map.adopted(&model.work.scenario) else {
        return;
    };
    if let Err(error) = scenario.check() {
        model.notice = Some(words(&error));
        return;
    }
    if let (Some((x, y)), Some((a, b))) = (model.screens.map.spans, model.screens.map.values()) {
        let part = |label: &str, value: f64, unit: &str| format!("{label} {value} {unit}");
        model.notice = Some(format!(
            "adopted {}, {}",
            part(x.field.label, a, x.field.unit).trim_end(),
            part(y.field.label, b, y.field.unit).trim_end()
        ));
    }
    let work = model.work.with(scenario);
    change(model, work, "");
}

#[cfg(test)]
mod tests {
    use super::state::DrawMap;
    use super::*;
    use crate::study::map::{Grid, SIDES, Spot};
    use crate::study::{PerQuantity, Quantity};
    use crate::tui::simulation::Simulate;
    use crate::tui::task::Report;
    use crate::tui::update::driven::{asked, begun, key, letter};
    use crate::tui::update::{Effect, Message, update};
    use crossterm::event::KeyCode;

    fn drawn(effects: &[Effect]) -> Option<(u64, DrawMap)> {
        asked::<DrawMap>(effects).map(|(ticket, question)| (ticket, question.clone()))
    }

    fn tell(model: &mut Model, (ticket, question): (u64, DrawMap)) -> Vec<Effect> {
        let known = PerQuantity::from_fn(|q| (q != Quantity::Pressure).then_some(10.0));
        let spots = vec![Spot::Known(known); question.side * question.side];
        let grid = Grid {
            side: question.side,
            spots,
        };
        let report = Report::done::<DrawMap>(ticket, Ok(grid));
        update(model, Message::News(report))
    }

    #[test]
    fn grids_are_refined_until_the_finest() {
        let mut model = begun();
        let mut effects = letter(&mut model, '7');
        for side in SIDES {
            let asked = drawn(&effects).unwrap();
            assert_eq!(asked.1.side, side);
            effects = tell(&mut model, asked);
        }
        assert!(effects.is_empty());
        assert_eq!(
            model.screens.map.grid(&model.work.scenario).unwrap().side,
            SIDES[2]
        );
    }

    #[test]
    fn every_result_that_the_scene_has_comes_in_turn_and_nothing_is_simulated_for_it() {
        let mut model = begun();
        let asked = drawn(&letter(&mut model, '7')).unwrap();
        tell(&mut model, asked);
        for quantity in Quantity::ALL.iter().cycle().take(Quantity::ALL.len() + 1) {
            if *quantity != Quantity::Pressure {
                assert_eq!(model.screens.map.chosen, *quantity);
                assert!(letter(&mut model, 'v').is_empty());
            }
        }
    }

    #[test]
    fn escape_and_leaving_stop_it_and_a_key_goes_on() {
        let mut model = begun();
        let (ticket, question) = drawn(&letter(&mut model, '7')).unwrap();
        assert_eq!(key(&mut model, KeyCode::Esc), [Effect::Stop(ticket)]);
        assert!(tell(&mut model, (ticket, question)).is_empty(), "late news");
        let (ticket, _) = drawn(&letter(&mut model, 'm')).unwrap();
        assert_eq!(letter(&mut model, '1'), [Effect::Stop(ticket)]);
        let (ticket, _) = drawn(&letter(&mut model, '7')).unwrap();
        let effects = letter(&mut model, '-');
        assert_eq!(effects[0], Effect::Stop(ticket));
        assert!(drawn(&effects).is_some(), "other ranges");
    }

    #[test]
    fn the_cursor_moves_and_its_values_are_adopted() {
        let mut model = begun();
        letter(&mut model, '7');
        let middle = model.screens.map.cursor;
        key(&mut model, KeyCode::Up);
        letter(&mut model, 'L');
        assert_eq!(model.screens.map.cursor, (middle.0 + 4, middle.1 + 1));
        let before = model.work.scenario.clone();
        let effects = key(&mut model, KeyCode::Enter);
        assert!(asked::<Simulate>(&effects).is_some());
        assert_eq!(
            Some(&model.work.scenario),
            model.screens.map.adopted(&before).as_ref()
        );
        letter(&mut model, 'u');
        assert_eq!(model.work.scenario, before);
    }
}
