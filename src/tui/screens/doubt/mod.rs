//! What the doubt in the inputs does to each result: runs many samples when it is opened.

mod view;

use super::{Pane, Screen};
use crate::tui::ensemble::{self, MANY};
use crate::tui::keys::shared::{DOWN, UP};
use crate::tui::keys::{KeyTable, TimeKeys, bind, c};
use crate::tui::model::Model;

pub(crate) const SCREEN: Screen = Screen {
    opened,
    attend: ensemble::attend,
    cancel: |model| model.ensemble.task.end(&mut model.out),
    ..Screen::new(
        ("Doubt", "How sure?"),
        "what the doubt in the inputs does",
        &[Pane {
            name: "outputs",
            keys: &[KEYS],
            time: TimeKeys::Absent,
        }],
        view::draw,
    )
};

#[rustfmt::skip]
const KEYS: KeyTable = KeyTable::new("Doubt", &[
    bind(&[UP, c('k')], |m| go(m, -1), "result", "the result above"),
    bind(&[DOWN, c('j')], |m| go(m, 1), "&", "the result below"),
    bind(&[c('m')], |m| ensemble::start(m, MANY), "again", "run the samples again, or the rest of them"),
]);

/// Runs many samples unless they are there.
fn opened(model: &mut Model) {
    let known = model.ensemble.of(&model.work.scenario);
    if known.is_none_or(|ensemble| ensemble.asked < MANY) {
        ensemble::start(model, MANY);
    }
}

/// Moves to another result.
fn go(model: &mut Model, by: isize) {
    let Some(ensemble) = model.ensemble.of(&model.work.scenario) else {
        return;
    };
    let last = ensemble.results().len().saturating_sub(1);
    let here = model.screens.doubt.min(last);
    model.screens.doubt = here.saturating_add_signed(by).min(last);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scenario::Scenario;
    use crate::study::{Refusal, unwatched};
    use crate::tui::ensemble::{FEW, RunSamples};
    use crate::tui::simulation::{EstimateMesh, Simulate};
    use crate::tui::task::{Question, Report};
    use crate::tui::update::driven::{asked, key, letter, opened};
    use crate::tui::update::{Effect, Message, begin, update};
    use crossterm::event::KeyCode;

    fn sampled(effects: &[Effect]) -> Option<(u64, RunSamples)> {
        asked::<RunSamples>(effects).map(|(ticket, question)| (ticket, question.clone()))
    }

    /// A model with its answer, and what it asks for when the mesh error has come.
    fn idle_model() -> (Model, u64, RunSamples) {
        let mut model = opened();
        model.work.scenario.window_ms = 0.2;
        let effects = begin(&mut model);
        let (ticket, question) = asked::<Simulate>(&effects).unwrap();
        let report = Report::done::<Simulate>(ticket, question.answer(&mut unwatched));
        let effects = update(&mut model, Message::News(report));
        let (ticket, _) = asked::<EstimateMesh>(&effects).unwrap();
        let report = Report::done::<EstimateMesh>(ticket, Err(Refusal::Cancelled));
        let effects = update(&mut model, Message::News(report));
        let (ticket, question) = sampled(&effects).expect("the band follows the mesh error");
        (model, ticket, question)
    }

    fn tell(model: &mut Model, ticket: u64, question: &RunSamples, count: u32) {
        let small = RunSamples {
            count,
            ..question.clone()
        };
        let mut outcome = small.answer(&mut unwatched).unwrap();
        outcome.asked = question.count;
        let report = Report::done::<RunSamples>(ticket, Ok(outcome));
        update(model, Message::News(report));
    }

    #[test]
    fn the_band_comes_when_idle_and_an_edit_stops_it() {
        let (mut model, ticket, question) = idle_model();
        assert_eq!(question.count, FEW);
        let scenario = model.work.scenario.clone();
        assert!(model.ensemble.of(&scenario).is_none());
        tell(&mut model, ticket, &question, 16);
        assert!(model.ensemble.of(&scenario).is_some());
        let renamed = Scenario {
            name: "other".to_owned(),
            ..scenario
        };
        assert!(model.ensemble.of(&renamed).is_some());

        let (mut model, ticket, question) = idle_model();
        let effects = letter(&mut model, 'l');
        assert!(effects.contains(&Effect::Stop(ticket)));
        tell(&mut model, ticket, &question, 8);
        assert!(model.ensemble.done.is_none(), "late news");
    }

    #[test]
    fn the_screen_asks_for_more_and_keeps_what_is_done_when_stopped() {
        let (mut model, ticket, question) = idle_model();
        tell(&mut model, ticket, &question, 8);
        let (ticket, question) = sampled(&letter(&mut model, '6')).unwrap();
        assert_eq!(question.count, MANY);
        update(&mut model, Message::News(Report::progress(ticket, 0.3)));
        assert_eq!(model.ensemble.task.percent(), Some(30.0));
        assert_eq!(key(&mut model, KeyCode::Esc), [Effect::Stop(ticket)]);
        tell(&mut model, ticket, &question, 32);
        let kept = model.ensemble.of(&model.work.scenario).unwrap();
        assert!(kept.stopped() && kept.samples.len() == 32 && kept.asked == MANY);
        assert!(model.ensemble.task.complaint.is_some());
        assert!(letter(&mut model, '6').is_empty(), "only a key goes on");
        assert!(sampled(&letter(&mut model, 'm')).is_some());
        assert!(letter(&mut model, 'm').is_empty(), "one at a time");
    }

    #[test]
    fn leaving_the_screen_stops_it_and_results_can_be_walked_through() {
        let (mut model, ..) = idle_model();
        let (ticket, question) = sampled(&letter(&mut model, '6')).unwrap();
        let effects = letter(&mut model, '1');
        assert_eq!(effects, [Effect::Stop(ticket)]);
        assert!(letter(&mut model, '2').is_empty(), "once");
        tell(&mut model, ticket, &question, 8);
        assert!(model.ensemble.of(&model.work.scenario).is_some());
        letter(&mut model, '6');
        for _ in 0..20 {
            letter(&mut model, 'j');
        }
        let ensemble = model.ensemble.of(&model.work.scenario).unwrap();
        let last = ensemble.results().len() - 1;
        assert!(last >= 8, "all that a force pulse has");
        assert_eq!(model.screens.doubt, last);
        letter(&mut model, 'k');
        assert_eq!(model.screens.doubt, last - 1);
        model.work.scenario.window_ms = 0.3;
        letter(&mut model, 'k');
        assert_eq!(model.screens.doubt, last - 1, "nothing to walk through");
    }
}
