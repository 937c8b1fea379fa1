//! What keys and news do to the map of two inputs.

pub mod state;
pub mod view;

use super::Screen;
use crate::scenario::check::check;
use crate::study::map::Grid;
use crate::tui::form::words;
use crate::tui::model::Model;
use crate::tui::screens::map::state::Job;
use crate::tui::update::{Effect, change, ticket};
use crate::tui::worker::Report;

/// While the screen is on show, computes what is missing, grid by grid; stops what is not wanted.
pub(crate) fn go_on(model: &mut Model) -> Vec<Effect> {
    let mut effects = Vec::new();
    if model.screen == Screen::Map {
        model.map.settle(&model.work.scenario);
    }
    let wanted = (model.screen == Screen::Map && !model.map.halted)
        .then(|| model.map.next(&model.work.scenario))
        .flatten();
    if let Some(job) = &model.map.job {
        if wanted.as_ref() == Some(&job.question) {
            return effects;
        }
        effects.push(Effect::StopDrawing(job.ticket));
        model.map.job = None;
    }
    if let Some(question) = wanted {
        let ticket = ticket(model);
        model.map.job = Some(Job {
            ticket,
            question: question.clone(),
            share: 0.0,
        });
        effects.push(Effect::Draw(ticket, question));
    }
    effects
}

/// Gives up what is under way, until a key asks for it.
pub(crate) fn stop(model: &mut Model) -> Option<Effect> {
    let job = model.map.job.take()?;
    model.map.halted = true;
    Some(Effect::StopDrawing(job.ticket))
}

/// What the worker says. News of anything but the job under way is dropped.
pub(crate) fn hear(model: &mut Model, report: Report<Grid>) {
    let Some(job) = &mut model.map.job else {
        return;
    };
    match report {
        Report::Progress(ticket, share) if ticket == job.ticket => job.share = share,
        Report::Done(ticket, outcome) if ticket == job.ticket => {
            let question = job.question.clone();
            model.map.job = None;
            match *outcome {
                Ok(grid) => model.map.take(question, grid),
                Err(_) => model.map.halted = true,
            }
        }
        _ => {}
    }
}

/// Gives the scenario the values under the cursor.
pub(crate) fn adopt(model: &mut Model, effects: &mut Vec<Effect>) {
    let Some(scenario) = model.map.adopted(&model.work.scenario) else {
        return;
    };
    if let Err(error) = check(&scenario) {
        model.notice = Some(words(&error));
        return;
    }
    if let (Some((x, y)), Some((a, b))) = (model.map.spans, model.map.values()) {
        let part = |label: &str, value: f64, unit: &str| format!("{label} {value} {unit}");
        model.notice = Some(format!(
            "adopted {}, {}",
            part(x.field.label, a, x.field.unit).trim_end(),
            part(y.field.label, b, y.field.unit).trim_end()
        ));
    }
    let work = model.work.with(scenario);
    change(model, work, "", effects);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::study::map::{SIDES, Spot};
    use crate::tui::screens::map::state::Drawing;
    use crate::tui::update::driven::{begun, key, letter};
    use crate::tui::update::{Message, update};
    use crossterm::event::KeyCode;

    fn drawn(effects: &[Effect]) -> Option<(u64, Drawing)> {
        effects.iter().find_map(|effect| match effect {
            Effect::Draw(ticket, question) => Some((*ticket, question.clone())),
            _ => None,
        })
    }

    fn tell(model: &mut Model, (ticket, question): (u64, Drawing)) -> Vec<Effect> {
        let spots = vec![Spot::Damage(10.0); question.side * question.side];
        let grid = Grid {
            side: question.side,
            spots,
        };
        update(
            model,
            Message::Map(Report::Done(ticket, Box::new(Ok(grid)))),
        )
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
        assert_eq!(model.map.grid(&model.work.scenario).unwrap().side, SIDES[2]);
    }

    #[test]
    fn escape_and_leaving_stop_it_and_a_key_goes_on() {
        let mut model = begun();
        let (ticket, question) = drawn(&letter(&mut model, '7')).unwrap();
        assert_eq!(key(&mut model, KeyCode::Esc), [Effect::StopDrawing(ticket)]);
        assert!(tell(&mut model, (ticket, question)).is_empty(), "late news");
        let (ticket, _) = drawn(&letter(&mut model, 'm')).unwrap();
        assert_eq!(letter(&mut model, '1'), [Effect::StopDrawing(ticket)]);
        let (ticket, _) = drawn(&letter(&mut model, '7')).unwrap();
        let effects = letter(&mut model, '-');
        assert_eq!(effects[0], Effect::StopDrawing(ticket));
        assert!(drawn(&effects).is_some(), "other ranges");
    }

    #[test]
    fn the_cursor_moves_and_its_values_are_adopted() {
        let mut model = begun();
        letter(&mut model, '7');
        let middle = model.map.cursor;
        key(&mut model, KeyCode::Up);
        letter(&mut model, 'L');
        assert_eq!(model.map.cursor, (middle.0 + 4, middle.1 + 1));
        let before = model.work.scenario.clone();
        let effects = key(&mut model, KeyCode::Enter);
        assert!(matches!(effects[0], Effect::Solve(..)));
        assert_eq!(
            Some(&model.work.scenario),
            model.map.adopted(&before).as_ref()
        );
        letter(&mut model, 'u');
        assert_eq!(model.work.scenario, before);
    }
}
