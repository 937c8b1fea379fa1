//! Total error against time: measures mesh levels, integrators and steps while it is on show, adopts what is
//! chosen, and proposes what is more exact or faster.

mod log_axis;
pub mod measurement;
mod view;

use crate::scenario::Scenario;
use crate::tui::form::words;
use crate::tui::keys::shared::{ENTER, LEFT, RIGHT, SHIFT_LEFT, SHIFT_RIGHT};
use crate::tui::keys::{KeyTable, TimeKeys, bind, c};
use crate::tui::model::{Model, Overlay, Question};
use crate::tui::screens::{Mouse, Pane, SCREENS, Screen};
use crate::tui::step::Step;
use crate::tui::update::{change, show};
use measurement::adopted;

const TITLE: &str = "Accuracy";

pub(crate) const SCREEN: Screen = Screen {
    attend,
    hear: |model, report| model.screens.accuracy.hear(report),
    cancel: |model| {
        model
            .screens
            .accuracy
            .task
            .stop(Some("stopped"), &mut model.out)
    },
    mouse: |model, mouse, _| {
        if let Mouse::Wheel(_, by) = mouse {
            step(model, by.reversed());
        }
        false
    },
    ..Screen::new(
        (TITLE, "How exact, at what cost?"),
        "total error against time",
        &[Pane {
            name: "points",
            keys: &[KEYS],
            time: TimeKeys::Absent,
        }],
        view::draw,
    )
};

#[rustfmt::skip]
const KEYS: KeyTable = KeyTable::new(TITLE, &[
    bind(&[LEFT, c('h')], |m| step(m, Step::LESS), "point", "the next faster point"),
    bind(&[RIGHT, c('l')], |m| step(m, Step::MORE), "&", "the next slower point"),
    bind(&[ENTER], adopt, "adopt", "give the scenario its level, integrator and step"),
    bind(&[SHIFT_LEFT, c('H')], |m| step(m, Step::MUCH_LESS), "", "the next faster point of the front"),
    bind(&[SHIFT_RIGHT, c('L')], |m| step(m, Step::MUCH_MORE), "", "the next slower point of the front"),
    bind(&[c('v')], next_result, "result", "the error of the next result"),
    bind(&[c('m')], start, "", "go on after Esc, or measure again"),
]);

fn step(model: &mut Model, step: Step) {
    model.screens.accuracy.step(&model.work.scenario, step);
}

fn next_result(model: &mut Model) {
    model.screens.accuracy.next_result(&model.work.scenario);
}

/// Goes on, or begins again where nothing is left.
fn start(model: &mut Model) {
    let accuracy = &mut model.screens.accuracy;
    if accuracy.task.complaint.take().is_none() && accuracy.task.job.is_none() {
        accuracy.known = None;
    }
}

/// Measures while the screen is on show what is not known yet; asks what was wished for once it is known.
fn attend(model: &mut Model, on_show: bool) {
    let scenario = &model.work.scenario;
    let accuracy = &mut model.screens.accuracy;
    let free = on_show && accuracy.complaint(scenario).is_none();
    let wanted = accuracy.lacking(scenario).filter(|_| free);
    if accuracy.task.job.is_some() && !(wanted.is_some() && accuracy.measures(scenario)) {
        accuracy.task.stop(None, &mut model.out);
    }
    if let (Some(question), None) = (wanted, &accuracy.task.job) {
        accuracy.task.ask(question, &mut model.out);
    }
    if !on_show {
        accuracy.wish = None;
    } else if let Some(exact) = accuracy.wish
        && model.overlay.is_none()
        && let Some(found) = accuracy.propose(scenario, exact)
    {
        accuracy.wish = None;
        answer(model, found);
    }
}

/// Proposes what is more exact, or faster, and says what it costs; what must be measured first is shown.
pub(crate) fn propose(model: &mut Model, exact: bool) {
    let found = model.screens.accuracy.propose(&model.work.scenario, exact);
    if let Some(found) = found {
        answer(model, found);
        return;
    }
    let place = SCREENS.iter().position(|screen| screen.title == TITLE);
    show(model, place.unwrap_or(model.screen));
    model.screens.accuracy.wish = Some(exact);
    let words = "measuring first what each level and step costs: the question follows";
    model.notice = Some(words.to_owned());
}

fn answer(model: &mut Model, found: Result<measurement::Proposal, String>) {
    match found {
        Ok(proposal) => {
            let words = proposal.words.clone();
            model.overlay = Some(Overlay::Question(Question::Adopt(words)));
            model.screens.accuracy.proposal = Some(proposal);
        }
        Err(why) => model.notice = Some(why),
    }
}

/// Does what was proposed.
pub(crate) fn accept(model: &mut Model) {
    if let Some(proposal) = model.screens.accuracy.proposal.take() {
        take(model, proposal.scenario);
    }
}

/// Gives the scenario level, integrator and step of the point under the cursor.
fn adopt(model: &mut Model) {
    let shown = model.screens.accuracy.shown(&model.work.scenario);
    if let Some(total) = shown.get(model.screens.accuracy.place(&shown)) {
        let scenario = adopted(&model.work.scenario, total);
        take(model, scenario);
    }
}

fn take(model: &mut Model, scenario: Scenario) {
    if let Err(error) = scenario.check() {
        model.notice = Some(words(&error));
        return;
    }
    let (level, numerics) = (scenario.eye.level, &scenario.numerics);
    let how = match (numerics.integrator, numerics.step_us) {
        (Some(integrator), Some(step)) => format!("{}, step {step} µs", integrator.name()),
        _ => "automatic integrator and step".to_owned(),
    };
    let notice = format!("adopted level {level}, {how}; u takes it back");
    let work = model.work.with(scenario);
    change(model, work, "");
    if model.notice.is_none() {
        model.notice = Some(notice);
    }
}
