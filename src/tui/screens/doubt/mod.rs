//! What the doubt in the inputs does to each result: runs many samples while it is on show.

mod view;

use crate::answer::derived::Derived;
use crate::injury::Verdict;
use crate::many::ensemble::Ensemble;
use crate::report::verdict::is_void;
use crate::run::quantity::Quantity;
use crate::tui::ensemble::MANY;
use crate::tui::keys::shared::{DOWN, UP};
use crate::tui::keys::{KeyTable, TimeKeys, bind, c};
use crate::tui::model::Model;
use crate::tui::screens::{Pane, Screen};

pub(crate) const SCREEN: Screen = Screen {
    samples: MANY,
    cancel: |model| model.ensemble.task.end(&mut model.out),
    ..Screen::new(
        ("Doubt", "How sure?"),
        "what the doubt in the inputs does",
        &[Pane {
            name: "outputs",
            keys: &[KEYS, STOPPED_KEYS],
            time: TimeKeys::Absent,
        }],
        view::draw,
    )
};

#[rustfmt::skip]
const KEYS: KeyTable = KeyTable::new("Doubt", &[
    bind(&[UP, c('k')], |m| go(m, -1), "result", "the result above"),
    bind(&[DOWN, c('j')], |m| go(m, 1), "&", "the result below"),
]);

/// Once Esc has stopped it.
const STOPPED_KEYS: KeyTable = KeyTable {
    title: "Doubt: stopped",
    bindings: &[bind(
        &[c('m')],
        |m| m.ensemble.task.complaint = None,
        "go on",
        "go on where Esc stopped it",
    )],
    counts: |model| model.ensemble.complaint(&model.work.scenario).is_some(),
};

/// The results that have bands: first the risks that are believed, the gravest first, which are the answer, then
/// other risks, and last what means nothing here.
fn listed(ensemble: &Ensemble, verdicts: &[Verdict]) -> Vec<Quantity> {
    let mut results = ensemble.results();
    let believed = |of: Quantity| matches!(of.derived(), Some(Derived::Believed(_)));
    results.sort_by_key(|of| (is_void(verdicts, *of), !believed(*of), !of.is_risk()));
    results
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
    use crate::run::refusal::Refusal;
    use crate::run::watch::unwatched;
    use crate::scenario::Scenario;
    use crate::tui::ensemble::{FEW, RunSamples};
    use crate::tui::keys::live;
    use crate::tui::simulation::{EstimateMesh, Simulate};
    use crate::tui::task::{Question, Report};
    use crate::tui::update::driven::{asked, key, letter, opened};
    use crate::tui::update::{Effect, Message, begin, update};
    use crossterm::event::KeyCode;
    use std::time::Duration;

    fn sampled(effects: &[Effect]) -> Option<(u64, RunSamples)> {
        asked::<RunSamples>(effects).map(|(ticket, question)| (ticket, question.clone()))
    }

    /// A model with its answer, and what it asks for when the mesh error has come.
    fn idle_model() -> (Model, (u64, RunSamples)) {
        let mut model = opened();
        model.work.scenario.window_ms = 0.2;
        let effects = begin(&mut model);
        let (ticket, question) = asked::<Simulate>(&effects).unwrap();
        let report = Report::done::<Simulate>(ticket, question.answer(&mut unwatched));
        let effects = update(&mut model, Message::News(report));
        let (ticket, _) = asked::<EstimateMesh>(&effects).unwrap();
        let report = Report::done::<EstimateMesh>(ticket, Err(Refusal::Cancelled));
        let effects = update(&mut model, Message::News(report));
        let asked = sampled(&effects).expect("the band follows the mesh error");
        (model, asked)
    }

    /// So many samples, so far or in the end.
    fn tell(
        model: &mut Model,
        (ticket, question): &(u64, RunSamples),
        count: u32,
        over: bool,
    ) -> Vec<Effect> {
        let small = RunSamples {
            count,
            ..question.clone()
        };
        let mut outcome = small.answer(&mut unwatched).unwrap();
        outcome.asked = question.count;
        let report = if over {
            Report::done::<RunSamples>(*ticket, Ok(outcome))
        } else {
            Report::so_far::<RunSamples>(*ticket, outcome)
        };
        update(model, Message::News(report))
    }

    #[test]
    fn the_band_comes_when_idle_and_an_edit_stops_it() {
        let (mut model, asked) = idle_model();
        assert_eq!(asked.1.count, FEW);
        let scenario = model.work.scenario.clone();
        assert!(model.ensemble.of(&scenario).is_none());
        tell(&mut model, &asked, 8, false);
        assert!(
            model.ensemble.of(&scenario).is_none(),
            "too few to be shown"
        );
        tell(&mut model, &asked, 16, false);
        assert!(model.ensemble.of(&scenario).is_some());
        let renamed = Scenario {
            name: "other".to_owned(),
            ..scenario
        };
        assert!(model.ensemble.of(&renamed).is_some());

        let (mut model, asked) = idle_model();
        let effects = letter(&mut model, 'l');
        assert!(effects.contains(&Effect::Stop(asked.0)));
        tell(&mut model, &asked, 16, false);
        assert!(model.ensemble.done.is_none(), "late news");
    }

    #[test]
    fn idle_work_is_announced_and_a_key_stops_it() {
        let (mut model, asked) = idle_model();
        assert!(asked.1.is_idle());
        let report = Report::progress(asked.0, 0.25, Duration::ZERO);
        update(&mut model, Message::News(report));
        assert_eq!(model.ahead().unwrap(), "64 of 256 samples");
        assert_eq!(letter(&mut model, 'I'), [Effect::Stop(asked.0)]);
        assert_eq!(model.ahead(), None);
        let (ticket, question) = sampled(&letter(&mut model, 'I')).unwrap();
        assert!(question.is_idle());
        assert!(letter(&mut model, '2').contains(&Effect::Stop(ticket)));
    }

    #[test]
    fn the_screen_asks_for_more_and_goes_on_with_what_is_done() {
        let (mut model, asked) = idle_model();
        tell(&mut model, &asked, 8, false);
        let asked = sampled(&letter(&mut model, '6')).unwrap();
        assert_eq!(asked.1.count, MANY);
        assert!(!asked.1.is_idle() && asked.1.known.as_ref().unwrap().samples.len() == 8);
        let report = Report::progress(asked.0, 0.3, Duration::ZERO);
        update(&mut model, Message::News(report));
        assert_eq!(model.ensemble.pace().unwrap(), "300 of 1000");
        let offered = |model: &Model| live(model).iter().any(|(_, word)| *word == "go on");
        assert!(!offered(&model), "it runs");
        assert_eq!(key(&mut model, KeyCode::Esc), [Effect::Stop(asked.0)]);
        tell(&mut model, &asked, 32, true);
        assert!(offered(&model));
        let kept = model.ensemble.of(&model.work.scenario).unwrap();
        assert!(kept.stopped() && kept.samples.len() == 32 && kept.asked == MANY);
        assert!(model.ensemble.task.complaint.is_some());
        assert!(letter(&mut model, '6').is_empty(), "only a key goes on");
        let (_, again) = sampled(&letter(&mut model, 'm')).unwrap();
        assert_eq!(again.known.unwrap().samples.len(), 32);
        assert!(letter(&mut model, 'm').is_empty(), "one at a time");
    }

    #[test]
    fn leaving_the_screen_stops_it_and_results_can_be_walked_through() {
        let (mut model, _) = idle_model();
        let asked = sampled(&letter(&mut model, '6')).unwrap();
        assert_eq!(letter(&mut model, '2'), [Effect::Stop(asked.0)]);
        let asked = sampled(&letter(&mut model, '6')).unwrap();
        tell(&mut model, &asked, 16, false);
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
