//! A question put to a number of the form: at which value of it a result reaches what is asked.
//!
//! It stands in front of the screen while it is answered in the background, and its answer can be taken into the
//! form. Left out: a range of one's own, which `contrecoup threshold` takes.

use std::fmt;
use std::sync::Arc;

use crate::answer::derived::Derived;
use crate::injury::Injury;
use crate::many::threshold::{Crossing, Question, Threshold};
use crate::report::text::significant;
use crate::run::quantity::Quantity;
use crate::run::refusal::Refusal;
use crate::run::watch::Watch;
use crate::scenario::fields::{Field, Kind};
use crate::scenario::problem::plain;
use crate::tui::form::{Row, with_text};
use crate::tui::line::Line;
use crate::tui::model::{Model, Overlay, Shown};
use crate::tui::task;
use crate::tui::task::{Report, Task};
use crate::tui::update::change;
use crate::tui::worker::overseen;

/// What a risk or an index is asked for unless something else is typed, in %.
const HALF: f64 = 50.0;

/// Asks for every crossing.
pub struct FindThreshold(pub Question);

impl fmt::Debug for FindThreshold {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let Question { field, target, .. } = &self.0;
        write!(f, "{} until {target}", field.path)
    }
}

impl task::Question for FindThreshold {
    type Answer = Threshold;

    fn answer(&self, watch: Watch) -> Result<Threshold, Refusal> {
        overseen(watch, &mut |()| {}, |stop, desk| {
            self.0.answer(stop, |share| {
                // It hears of an end by `stop`.
                let _ = desk.lay(share, || ());
            })
        })
    }
}

/// What is asked, and what came of it.
pub struct Asking {
    /// The number that is varied.
    pub field: &'static Field,
    /// The result, and all that the answer on show has.
    pub quantity: Quantity,
    results: Vec<(Quantity, f64)>,
    /// The value that it is to reach, as typed.
    pub input: Line,
    /// What is being looked for.
    pub task: Task<FindThreshold>,
    /// What was found for what is asked.
    pub found: Option<(Arc<FindThreshold>, Threshold)>,
    /// The crossing that would be taken.
    pub row: usize,
    /// What is wrong with what is asked.
    pub error: Option<String>,
}

/// Asks about the number with the cursor: rupture of the globe by its most believed measure first.
pub(crate) fn ask(model: &mut Model) {
    let number = match model.form.selected {
        Row::Field(field) if matches!(field.kind, Kind::Number(..)) => Some(field),
        _ => None,
    };
    let asking = match (number, &model.shown) {
        (Some(field), Some(shown)) => Asking::of(field, shown),
        (None, _) => {
            model.notice = Some("choose a row with a number first".to_owned());
            return;
        }
        _ => None,
    };
    match asking {
        Some(asking) => model.overlay = Some(Overlay::Threshold(Box::new(asking))),
        None => model.notice = Some("there is no answer yet".to_owned()),
    }
}

impl Asking {
    fn of(field: &'static Field, shown: &Shown) -> Option<Self> {
        let values = shown.answer.results();
        let results: Vec<(Quantity, f64)> = Quantity::ALL
            .iter()
            .filter_map(|quantity| Some((*quantity, values[*quantity]?)))
            .collect();
        let (quantity, _) = *results.first()?;
        let mut asking = Self {
            field,
            quantity,
            results,
            input: Line::default(),
            task: Task::default(),
            found: None,
            row: 0,
            error: None,
        };
        let there = |quantity: &Quantity| asking.results.iter().any(|(other, _)| other == quantity);
        let quantity = rupture(shown).filter(there).unwrap_or(quantity);
        asking.choose(quantity);
        Some(asking)
    }

    /// Asks for another result, for half of it or for what it is now.
    fn choose(&mut self, quantity: Quantity) {
        self.quantity = quantity;
        let now = self.results.iter().find(|(other, _)| *other == quantity);
        let risk = quantity.row().whole.is_some();
        let target = match now {
            Some((_, value)) if !risk => *value,
            _ => HALF,
        };
        self.input = Line::of(brief(target));
        self.forget();
    }

    /// What was found is no answer to what is asked now.
    fn forget(&mut self) {
        (self.found, self.error, self.row) = (None, None, 0);
        self.task.complaint = None;
    }

    /// The crossing that would be taken.
    pub fn chosen(&self) -> Option<&Crossing> {
        self.found.as_ref()?.1.crossings.get(self.row)
    }

    /// What would be taken, as it is typed.
    pub fn taken(&self) -> Option<String> {
        Some(brief(self.chosen()?.at))
    }
}

/// Four digits, as a person would type them.
fn brief(value: f64) -> String {
    significant(value)
        .parse()
        .map_or_else(|_| significant(value), plain)
}

/// Rupture of the globe by the measure that is believed first.
fn rupture(shown: &Shown) -> Option<Quantity> {
    let verdicts = shown.answer.verdicts();
    let verdict = verdicts.iter().find(|v| v.injury == Injury::GlobeRupture)?;
    let (risk, _) = verdict.parts.first()?;
    let measure = risk.curve.measure;
    let by = |quantity: &&Quantity| matches!(quantity.derived(), Some(Derived::Risk(Injury::GlobeRupture, m)) if m == measure);
    Quantity::ALL.iter().find(by).copied()
}

/// What is asked now, where nothing is looked for.
fn idle(model: &mut Model) -> Option<&mut Asking> {
    match &mut model.overlay {
        Some(Overlay::Threshold(asking)) if asking.task.job.is_none() => Some(asking),
        _ => None,
    }
}

/// Asks for the next result of the answer on show, or for the one before.
pub(crate) fn next_result(model: &mut Model, forward: bool) {
    let Some(asking) = idle(model) else { return };
    let count = asking.results.len();
    let here = asking
        .results
        .iter()
        .position(|(q, _)| *q == asking.quantity);
    let by = if forward { 1 } else { count - 1 };
    let next = asking.results[(here.unwrap_or(0) + by) % count].0;
    asking.choose(next);
}

/// Goes to the next crossing.
pub(crate) fn next_crossing(model: &mut Model) {
    let Some(asking) = idle(model) else { return };
    let count = asking
        .found
        .as_ref()
        .map_or(0, |(_, found)| found.crossings.len());
    asking.row = (asking.row + 1) % count.max(1);
}

/// Changes the value that is asked for.
pub(crate) fn retype(model: &mut Model, change: impl FnOnce(&mut Line)) {
    let Some(asking) = idle(model) else { return };
    let before = asking.input.value().to_owned();
    change(&mut asking.input);
    if asking.input.value() != before {
        asking.forget();
    }
}

/// Looks for the crossings, or takes the one that was found into the form.
pub(crate) fn accept(model: &mut Model) {
    let scenario = model.work.scenario.clone();
    let Some(asking) = idle(model) else { return };
    let field = asking.field;
    if let Some(text) = asking.taken() {
        model.overlay = None;
        match with_text(&scenario, field, &text) {
            Ok(scenario) => {
                let work = model.work.with(scenario);
                change(model, work, "");
            }
            Err(why) => model.form.complaint = Some(why),
        }
        return;
    }
    let target = asking.input.value().trim().parse::<f64>();
    let Some(target) = target.ok().filter(|target| target.is_finite()) else {
        asking.error = Some("a number is needed, as in 50".to_owned());
        return;
    };
    match Question::read(scenario, field.path, (asking.quantity, target)) {
        Ok(question) => {
            asking.forget();
            let question = FindThreshold(question);
            if let Some(Overlay::Threshold(asking)) = &mut model.overlay {
                asking.task.ask(question, &mut model.out);
            }
        }
        Err(error) => asking.error = Some(error.to_string()),
    }
}

/// Stops looking; whether anything was looked for.
pub(crate) fn stop(model: &mut Model) -> bool {
    match &mut model.overlay {
        Some(Overlay::Threshold(asking)) => asking.task.stop(Some("stopped"), &mut model.out),
        _ => false,
    }
}

/// Takes in what was found.
pub(super) fn hear(model: &mut Model, report: &mut Option<Report>) {
    let Some(Overlay::Threshold(asking)) = &mut model.overlay else {
        return;
    };
    if let Some((asked, Some(found))) = asking.task.hear(report) {
        // The nearest to the present value is offered first.
        let present = asked.0.present();
        let far = |i: &usize| (found.crossings[*i].at - present).abs();
        let nearest = (0..found.crossings.len()).min_by(|a, b| far(a).total_cmp(&far(b)));
        asking.row = nearest.unwrap_or(0);
        asking.found = Some((asked, found));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::answer::solve::solve;
    use crate::run::kept::Keep;
    use crate::run::watch::unwatched;
    use crate::scenario::fields;
    use crate::scenario::library::find;
    use crate::tui::task::Question as _;
    use crate::tui::update::driven::{asked, key, letter, opened};
    use crate::tui::update::{Effect, Message, update};
    use crossterm::event::KeyCode;

    /// At the speed of a BB whose answer is on show.
    fn bb() -> Model {
        let mut model = opened();
        let scenario = find("bb-56").unwrap().scenario().unwrap();
        model.work.scenario = scenario.clone();
        let answer = solve(&scenario.check().unwrap(), Keep::default(), &mut unwatched).unwrap();
        model.shown = Some(Shown::new(scenario, answer));
        model.form.selected = Row::Field(fields::find("impact.speed_m_s").unwrap());
        model
    }

    fn asking(model: &Model) -> &Asking {
        match &model.overlay {
            Some(Overlay::Threshold(asking)) => asking,
            _ => panic!("nothing is asked"),
        }
    }

    fn risk_by_energy(model: &mut Model) {
        letter(model, 't');
        while asking(model).quantity != Quantity::RuptureByEnergy {
            key(model, KeyCode::Down);
        }
    }

    #[test]
    fn a_risk_is_looked_for_and_its_value_is_taken_into_the_form() {
        let mut model = bb();
        letter(&mut model, 't');
        assert!(matches!(
            asking(&model).quantity.derived(),
            Some(Derived::Risk(Injury::GlobeRupture, _))
        ));
        key(&mut model, KeyCode::Esc);
        risk_by_energy(&mut model);
        assert_eq!(asking(&model).input.value(), "50");
        let effects = key(&mut model, KeyCode::Enter);
        let (ticket, question) = asked::<FindThreshold>(&effects).unwrap();
        let found = question.answer(&mut unwatched);
        let report = Report::done::<FindThreshold>(ticket, found);
        update(&mut model, Message::News(report));
        let speed: f64 = asking(&model).taken().unwrap().parse().unwrap();
        assert!((40.0..80.0).contains(&speed), "{speed}");
        key(&mut model, KeyCode::Enter);
        let speed_now = fields::find("impact.speed_m_s")
            .unwrap()
            .text(&model.work.scenario);
        assert_eq!(speed_now.unwrap().parse(), Ok(speed));
        letter(&mut model, 'u');
        assert_eq!(
            model.work.scenario,
            find("bb-56").unwrap().scenario().unwrap()
        );
    }

    #[test]
    fn escape_stops_the_search_and_then_closes_and_nothing_is_taken() {
        let mut model = bb();
        let before = model.work.clone();
        risk_by_energy(&mut model);
        let effects = key(&mut model, KeyCode::Enter);
        let (ticket, _) = asked::<FindThreshold>(&effects).unwrap();
        // What is asked stays as it is meanwhile.
        key(&mut model, KeyCode::Char('7'));
        key(&mut model, KeyCode::Down);
        assert_eq!(asking(&model).input.value(), "50");
        // What is computed ahead may begin again beside it.
        assert!(key(&mut model, KeyCode::Esc).contains(&Effect::Stop(ticket)));
        assert!(asking(&model).task.job.is_none());
        key(&mut model, KeyCode::Esc);
        assert!(model.overlay.is_none() && model.work == before);
    }

    #[test]
    fn only_a_number_with_an_answer_is_asked_about_and_only_numbers_are_sought() {
        let mut model = bb();
        risk_by_energy(&mut model);
        letter(&mut model, 'x');
        key(&mut model, KeyCode::Enter);
        assert!(asking(&model).error.is_some() && asking(&model).task.job.is_none());
        key(&mut model, KeyCode::Esc);
        model.form.selected = Row::Preset;
        letter(&mut model, 't');
        assert!(model.overlay.is_none() && model.notice.is_some());
        model.form.selected = Row::Field(fields::find("impact.speed_m_s").unwrap());
        model.shown = None;
        letter(&mut model, 't');
        assert!(model.overlay.is_none());
    }
}
