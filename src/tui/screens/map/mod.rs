//! One result over two inputs: filled in from coarse to fine while it is on show.

pub mod state;
mod view;

use crate::many::map::Span;
use crate::tui::form::words;
use crate::tui::keys::shared::{
    DOWN, ENTER, LEFT, RIGHT, SHIFT_DOWN, SHIFT_LEFT, SHIFT_RIGHT, SHIFT_UP, UP,
};
use crate::tui::keys::{KeyTable, TimeKeys, bind, c};
use crate::tui::model::Model;
use crate::tui::screens::{Mouse, Pane, Screen};
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
            keys: &[KEYS, STOPPED_KEYS],
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
]);

/// Once Esc has stopped it.
const STOPPED_KEYS: KeyTable = KeyTable {
    title: "Map: stopped",
    bindings: &[bind(
        &[c('m')],
        |m| m.screens.map.task.complaint = None,
        "go on",
        "go on where Esc stopped it",
    )],
    counts: |model| model.screens.map.task.complaint.is_some(),
};

/// While the screen is on show, computes what is missing; stops what is not wanted.
fn attend(model: &mut Model, on_show: bool) {
    let map = &mut model.screens.map;
    let mut wanted = None;
    if on_show {
        map.settle(&model.work.scenario);
        // What Esc stopped goes on by a key alone.
        if map.task.complaint.is_none() {
            wanted = map.lacking(&model.work.scenario);
        }
    }
    if let Some(job) = &map.task.job {
        if wanted
            .as_ref()
            .is_some_and(|wanted| wanted.is_of(&job.question))
        {
            return;
        }
        map.task.stop(None, &mut model.out);
    }
    if let Some(question) = wanted {
        map.task.ask(question, &mut model.out);
    }
}

/// Gives the scenario the values under the cursor, of the inputs over which it was moved.
fn adopt(model: &mut Model) {
    let Some((moved, scenario)) = model.screens.map.adopted(&model.work.scenario) else {
        return;
    };
    if moved.is_empty() {
        let words = "the cursor stands on your values: the arrows move it";
        model.notice = Some(words.to_owned());
        return;
    }
    if let Err(error) = scenario.check() {
        model.notice = Some(words(&error));
        return;
    }
    let part = |(span, value): &(Span, f64)| {
        let text = format!("{} {value} {}", span.field.label, span.field.unit);
        text.trim_end().to_owned()
    };
    let parts: Vec<String> = moved.iter().map(part).collect();
    let work = model.work.with(scenario);
    change(model, work, "");
    if model.notice.is_none() {
        model.notice = Some(format!("adopted {}; u takes it back", parts.join(", ")));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::many::map::Spot;
    use crate::run::quantity::Quantity;
    use crate::run::readings::PerQuantity;
    use crate::scenario::library::find;
    use crate::tui::screens::map::state::DrawMap;
    use crate::tui::simulation::Simulate;
    use crate::tui::task::Report;
    use crate::tui::update::driven::{asked, begun, key, letter};
    use crate::tui::update::{Effect, Message, update};
    use crossterm::event::KeyCode;

    fn drawn(effects: &[Effect]) -> Option<(u64, DrawMap)> {
        asked::<DrawMap>(effects).map(|(ticket, question)| (ticket, question.clone()))
    }

    /// So many points more than were known, so far or in the end.
    fn tell(
        model: &mut Model,
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
        let report = if over {
            Report::done::<DrawMap>(*ticket, Ok(grid))
        } else {
            Report::so_far::<DrawMap>(*ticket, grid)
        };
        update(model, Message::News(report))
    }

    fn count(model: &Model) -> usize {
        let grid = model.screens.map.grid(&model.work.scenario);
        grid.map_or(0, |grid| grid.known().0)
    }

    #[test]
    fn a_map_is_shown_while_it_fills_in_and_goes_on_where_it_was_after_a_visit_elsewhere() {
        let mut model = begun();
        let asked = drawn(&letter(&mut model, '7')).unwrap();
        assert!(tell(&mut model, &asked, 81, false).is_empty());
        assert_eq!(count(&model), 81);
        assert_eq!(letter(&mut model, '1'), [Effect::Stop(asked.0)]);
        let again = drawn(&letter(&mut model, '7')).unwrap();
        assert_eq!(again.1.known.known().0, 81);
        assert!(tell(&mut model, &again, 2000, true).is_empty());
        assert_eq!(count(&model), 33 * 33);
        letter(&mut model, '1');
        assert!(letter(&mut model, '7').is_empty(), "nothing is left");
    }

    #[test]
    fn every_result_that_the_scene_has_comes_in_turn_and_nothing_is_simulated_for_it() {
        let mut model = begun();
        let asked = drawn(&letter(&mut model, '7')).unwrap();
        tell(&mut model, &asked, 81, false);
        let shown = |model: &Model| {
            let map = &model.screens.map;
            map.quantity(map.grid(&model.work.scenario).unwrap())
        };
        let first = shown(&model);
        assert_eq!(
            first,
            Quantity::RuptureByStress,
            "a risk, where there is one"
        );
        let all = Quantity::ALL
            .iter()
            .copied()
            .filter(|q| *q != Quantity::Pressure);
        let before = all.clone().take_while(|q| *q != first);
        let order = all.clone().skip_while(|q| *q != first).chain(before);
        for quantity in order.chain([first]) {
            assert_eq!(shown(&model), quantity);
            assert!(letter(&mut model, 'v').is_empty());
        }
    }

    #[test]
    fn escape_and_leaving_stop_it_and_a_key_goes_on() {
        let mut model = begun();
        let asked = drawn(&letter(&mut model, '7')).unwrap();
        assert_eq!(key(&mut model, KeyCode::Esc), [Effect::Stop(asked.0)]);
        assert!(tell(&mut model, &asked, 9, false).is_empty(), "late news");
        assert_eq!(count(&model), 0);
        let (ticket, _) = drawn(&letter(&mut model, 'm')).unwrap();
        assert_eq!(letter(&mut model, '1'), [Effect::Stop(ticket)]);
        let (ticket, _) = drawn(&letter(&mut model, '7')).unwrap();
        let effects = letter(&mut model, '-');
        assert_eq!(effects[0], Effect::Stop(ticket));
        assert!(drawn(&effects).is_some(), "other ranges");
    }

    #[test]
    fn a_risk_by_energy_means_nothing_where_the_object_is_too_large_for_its_curve() {
        let mut model = begun();
        model.work.scenario = find("squash-ball").unwrap().scenario().unwrap();
        letter(&mut model, '7');
        let void = |model: &Model, of| view::is_void_there(model, of);
        assert!(void(&model, Quantity::RuptureByEnergy));
        assert!(!void(&model, Quantity::RuptureByStress));
        // Where the diameter is varied it is that under the cursor.
        let spans = |model: &Model| model.screens.map.spans.unwrap();
        for _ in 0..60 {
            if spans(&model).0.field.path == "impact.diameter_mm" {
                break;
            }
            letter(&mut model, 'x');
        }
        assert_eq!(spans(&model).0.field.path, "impact.diameter_mm");
        for _ in 0..40 {
            key(&mut model, KeyCode::Left);
        }
        assert!(model.screens.map.values().unwrap().0 < 30.0);
        assert!(!void(&model, Quantity::RuptureByEnergy));
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
        let (_, adopted) = model.screens.map.adopted(&before).unwrap();
        assert_eq!(model.work.scenario, adopted);
        assert!(model.notice.as_ref().unwrap().contains("adopted"));
        key(&mut model, KeyCode::Enter);
        assert!(model.notice.as_ref().unwrap().contains("your values"));
        letter(&mut model, 'u');
        assert_eq!(model.work.scenario, before);
    }
}
