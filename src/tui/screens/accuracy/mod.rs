//! Total error against time: measures mesh levels, integrators and steps while it is on show,
//! adopts what is chosen, and proposes what is more exact or faster.
//!
//! It belongs to a scenario apart from the scenario's own level, integrator and step, which are
//! what it is there to choose.

mod log_axis;
mod view;

use std::sync::Arc;
use std::time::{Duration, Instant};

use crate::many::accuracy::{Accuracy, Total, cheapest, finest_tried, measure};
use crate::report::format::{percent, significant};
use crate::run::{quantity::Quantity, refusal::Refusal, watch::Watch};
use crate::scenario::Scenario;
use crate::tui::keys::press::{ENTER, LEFT, RIGHT, SHIFT_LEFT, SHIFT_RIGHT, c};
use crate::tui::overlay::{Overlay, Prompt};
use crate::tui::request::{Report, TaskQuestion};
use crate::tui::screens::screen::{Pane, PaneKeys, Panes, Screen, bind, follow, next_of};
use crate::tui::{changes::edit::adopt, ensemble, keys::TimeKeys, model::AppModel};
use crate::tui::{step::Step, task::Task, view::sheet::Sheet};

impl Panes for Measurement {
    const PANES: &'static [Pane<Self>] = &[Pane::new("points", TimeKeys::Absent, &[KEYS])];
}

#[rustfmt::skip]
const KEYS: PaneKeys<Measurement> = PaneKeys::new("Accuracy", &[
    bind(&[LEFT, c('h')], |s, m| s.step(m, Step::LESS), "point", "the next faster point"),
    bind(&[RIGHT, c('l')], |s, m| s.step(m, Step::MORE), "&", "the next slower point"),
    bind(&[ENTER], Measurement::adopt_chosen, "use it", "compute the blow with its level, integrator and step"),
    bind(&[SHIFT_LEFT, c('H')], |s, m| s.step(m, Step::MUCH_LESS), "", "the next faster that none beats"),
    bind(&[SHIFT_RIGHT, c('L')], |s, m| s.step(m, Step::MUCH_MORE), "", "the next slower that none beats"),
    bind(&[c('v')], |s, m| s.next_result(&m.work.scenario), "result", "the error of the next result"),
    bind(&[c('m')], |s, _| s.measure_again(), "", "go on after Esc, or measure again"),
]);

impl Screen for Measurement {
    fn draw(&self, model: &AppModel, sheet: &mut Sheet) {
        view::draw(self, model, sheet);
    }

    /// Measures on show what is not known yet; asks what was wished for once it is known.
    fn refresh_requests(&mut self, model: &mut AppModel, on_show: bool) {
        let scenario = &model.work.scenario;
        let free = on_show && self.complaint(scenario).is_none();
        let wanted = self.lacking(scenario).filter(|_| free);
        follow(&mut self.task, wanted, |a, b| a.scenario == b.scenario, &mut model.out);
        if !on_show {
            self.wish = None;
        } else if let Some(exact) = self.wish
            && model.overlay.is_none()
            && let Some(found) = self.proposal(scenario, exact)
        {
            self.wish = None;
            ask(model, found);
        }
    }

    fn take_report(&mut self, _: &mut AppModel, report: &mut Option<Report>) {
        if let Some((question, Some(totals))) = self.task.take_report(report) {
            self.known = Some((question.scenario.clone(), Arc::new(totals)));
        }
    }

    fn is_busy(&self) -> bool {
        self.task.job.is_some()
    }

    fn cancel(&mut self, model: &mut AppModel) -> bool {
        self.task.stop(Some("stopped"), &mut model.out)
    }

    fn propose(&mut self, model: &mut AppModel, exact: bool) -> Option<bool> {
        if let Some(found) = self.proposal(&model.work.scenario, exact) {
            ask(model, found);
            return Some(false);
        }
        self.wish = Some(exact);
        let words = "measuring first what each level and step costs: the question follows";
        model.notice = Some(words.to_owned());
        Some(true)
    }

    /// Moves the cursor to the next run, or by a large step to the next one of the front.
    fn step(&mut self, model: &mut AppModel, step: Step) {
        let shown = self.shown(&model.work.scenario);
        let here = self.place(&shown);
        let fits = |at: &usize| !step.coarse || shown[*at].on_front;
        let next =
            if step.up { (here + 1..shown.len()).find(fits) } else { (0..here).rev().find(fits) };
        if let Some(next) = next {
            self.cursor = Some(name(&shown[next]));
        }
    }
}

/// Asks whether to do what was found, or says why nothing was.
fn ask(model: &mut AppModel, found: Result<Prompt, String>) {
    match found {
        Ok(question) => model.overlay = Some(Overlay::Prompt(question)),
        Err(why) => model.notice = Some(why),
    }
}

/// What there is so far is shown this often at most.
const SHOW_EVERY: Duration = Duration::from_millis(200);
/// Where the cursor begins: the cheapest within so many percent.
const FIRST: f64 = 10.0;
/// Something is more exact or faster only below this share of what there is.
const WORTH: f64 = 0.8;

/// Asks for what a measurement lacks.
#[derive(Debug, Clone)]
pub struct MeasureAccuracy {
    scenario: Scenario,
    known: Option<Arc<Accuracy>>,
}

impl TaskQuestion for MeasureAccuracy {
    type Answer = Accuracy;

    fn answer(&self, watch: Watch) -> Result<Accuracy, Refusal> {
        self.fill_in(watch, &mut |_| {})
    }

    fn fill_in(&self, watch: Watch, show: &mut dyn FnMut(Accuracy)) -> Result<Accuracy, Refusal> {
        let known = self.known.as_deref().cloned();
        let mut shown = Instant::now();
        let finest = finest_tried(&self.scenario);
        let scenario = self.scenario.check()?;
        measure(&scenario, finest, known, watch, &mut |so_far| {
            if shown.elapsed() >= SHOW_EVERY {
                shown = Instant::now();
                show(so_far.clone());
            }
        })
    }
}

/// The scenario without what the measurement varies: level, integrator and step.
fn key(scenario: &Scenario) -> Scenario {
    let mut key = ensemble::key(scenario);
    key.numerics = scenario.numerics.automatic();
    key.eye.level = finest_tried(scenario);
    key.doubt.clear();
    key
}

#[derive(Debug, Default)]
pub struct Measurement {
    /// What is known, and of which scenario.
    known: Option<(Scenario, Arc<Accuracy>)>,
    /// What is under way, or that it was stopped.
    pub task: Task<MeasureAccuracy>,
    /// The run under the cursor, once it was moved: level, integrator's name and step in s.
    cursor: Option<(u32, &'static str, f64)>,
    chosen: Option<Quantity>,
    /// Whether something more exact, or something faster, is to be proposed once it is known.
    wish: Option<bool>,
}

impl Measurement {
    /// What is known of this scenario.
    pub fn of(&self, scenario: &Scenario) -> Option<&Arc<Accuracy>> {
        let (asked, totals) = self.known.as_ref()?;
        (*asked == key(scenario)).then_some(totals)
    }

    /// What is to be measured, if anything is left.
    fn lacking(&self, scenario: &Scenario) -> Option<MeasureAccuracy> {
        let known = self.of(scenario).cloned();
        let whole = known.as_ref().is_some_and(|known| known.done == known.all);
        (!whole).then(|| MeasureAccuracy { scenario: key(scenario), known })
    }

    /// Why nothing more is measured of this scenario.
    fn complaint(&self, scenario: &Scenario) -> Option<&str> {
        let (asked, why) = self.task.complaint.as_ref()?;
        (asked.scenario == key(scenario)).then_some(why)
    }

    /// What is known with the result on show: the chosen one, else pressure, else damage.
    fn on_show(&self, scenario: &Scenario) -> Option<(&Accuracy, Quantity)> {
        let known = self.of(scenario)?;
        Some((known, known.to_show(self.chosen)?))
    }

    fn next_result(&mut self, scenario: &Scenario) {
        if let Some((known, here)) = self.on_show(scenario) {
            self.chosen = Some(next_of(&known.results(), here, |_| true));
        }
    }

    /// The runs on show, from the fastest to the slowest.
    pub fn shown(&self, scenario: &Scenario) -> Vec<Total> {
        self.on_show(scenario).map_or(Vec::new(), |(known, of)| known.of(of))
    }

    /// The place of the cursor among them.
    pub fn place(&self, shown: &[Total]) -> usize {
        let place = shown.iter().position(|total| self.cursor == Some(name(total)));
        let place = place.or_else(|| cheapest(shown, FIRST));
        let best = || shown.iter().rposition(|total| total.on_front);
        place.or_else(best).unwrap_or(0)
    }

    /// Goes on, or begins again where nothing is left.
    fn measure_again(&mut self) {
        if self.task.complaint.take().is_none() && self.task.job.is_none() {
            self.known = None;
        }
    }

    /// Gives the scenario level, integrator and step of the point under the cursor.
    fn adopt_chosen(&mut self, model: &mut AppModel) {
        let shown = self.shown(&model.work.scenario);
        if let Some(total) = shown.get(self.place(&shown)) {
            adopt(model, adopted(&model.work.scenario, total));
        }
    }

    /// Something more exact than now, or faster, or why there is none; nothing too early.
    fn proposal(&self, scenario: &Scenario, exact: bool) -> Option<Result<Prompt, String>> {
        let (known, of) = self.on_show(scenario)?;
        let shown = known.of(of);
        let present = present(scenario, &shown)?;
        let front = || shown.iter().filter(|total| total.on_front);
        let found = if exact {
            front().find(|total| total.error() < WORTH * present.error())
        } else {
            front().rfind(|total| total.seconds < WORTH * present.seconds)
        };
        let Some(found) = found else {
            let words = if exact { "more exact" } else { "faster" };
            return (known.done == known.all)
                .then(|| Err(format!("nothing that was tried is {words}")));
        };
        let [error, new_error] = [present, found].map(|total| percent(total.error()));
        let [ms, new_ms] = [present, found].map(|total| significant(total.seconds * 1e3));
        let (level, integrator) = (found.level, found.plan.integrator.name());
        let by = format!("level {level}, {integrator}, step {} µs", significant(found.step * 1e6));
        let label = of.label();
        let words = format!(
            "Error of the {label}: {error} → {new_error}. Time: {ms} → {new_ms} ms. By {by}."
        );
        Some(Ok(Prompt::Adopt(words, Box::new(adopted(scenario, found)))))
    }
}

fn name(total: &Total) -> (u32, &'static str, f64) {
    (total.level, total.plan.integrator.name(), total.plan.step)
}

/// The run that is nearest to how the scenario is solved now.
fn present<'a>(scenario: &Scenario, shown: &'a [Total]) -> Option<&'a Total> {
    let own = scenario.numerics.integrator;
    let step = scenario.numerics.step_us.map(|step| step * 1e-6);
    let there = shown.iter().filter(|total| total.level == scenario.eye.level);
    let far = |total: &Total| {
        let other = own.is_some_and(|own| own != total.plan.integrator);
        let off = step.map_or(0.0, |step| (total.plan.step / step).ln().abs());
        // Without a wish of the person's own it is the plan of an answer.
        let asked = own.is_some() || step.is_some();
        f64::from(u8::from(if asked { other } else { !total.is_answer })) * 1e3 + off
    };
    there.min_by(|a, b| far(a).total_cmp(&far(b)))
}

/// The scenario solved as a run was. The step is rounded down to six digits.
fn adopted(scenario: &Scenario, total: &Total) -> Scenario {
    let step = total.plan.step * 1e6;
    let power = 10f64.powi(5 - step.log10().floor() as i32);
    let mut adopted = scenario.clone();
    adopted.eye.level = total.level;
    // What the program would take by itself stays free to be refined.
    let own = !total.is_answer;
    adopted.numerics.integrator = own.then_some(total.plan.integrator);
    adopted.numerics.step_us = own.then(|| (step * power).floor() / power);
    adopted
}
