//! Total error against time: measures mesh levels, integrators and steps while it is on show,
//! adopts what is chosen, and proposes what is more exact or faster.

mod log_axis;
pub mod measurement;
mod view;

use ratatui::layout::Rect;

use crate::tui::keys::press::{ENTER, LEFT, RIGHT, SHIFT_LEFT, SHIFT_RIGHT, c};
use crate::tui::overlay::{Overlay, Prompt};
use crate::tui::screens::screen::{About, Mouse, Pane, PaneKeys, Panes, Screen, bind};
use crate::tui::{changes::edit::adopt, keys::TimeKeys, model::AppModel, request::Report};
use crate::tui::{step::Step, view::sheet::Sheet};
use measurement::{Measurement, Proposal, adopted};

pub(super) const ABOUT: About = About {
    title: "Accuracy",
    question: "How exact, at what cost?",
    purpose: "how much less error costs how much time",
    new: || Box::new(Measurement::default()),
};

impl Panes for Measurement {
    const PANES: &'static [Pane<Self>] = &[Pane::new("points", TimeKeys::Absent, &[KEYS])];
}

#[rustfmt::skip]
const KEYS: PaneKeys<Measurement> = PaneKeys::new(ABOUT.title, &[
    bind(&[LEFT, c('h')], |s, m| s.step(&m.work.scenario, Step::LESS), "point", "the next faster point"),
    bind(&[RIGHT, c('l')], |s, m| s.step(&m.work.scenario, Step::MORE), "&", "the next slower point"),
    bind(&[ENTER], Measurement::adopt_chosen, "use it", "compute the blow with its level, integrator and step"),
    bind(&[SHIFT_LEFT, c('H')], |s, m| s.step(&m.work.scenario, Step::MUCH_LESS), "", "the next faster that none beats"),
    bind(&[SHIFT_RIGHT, c('L')], |s, m| s.step(&m.work.scenario, Step::MUCH_MORE), "", "the next slower that none beats"),
    bind(&[c('v')], |s, m| s.next_result(&m.work.scenario), "result", "the error of the next result"),
    bind(&[c('m')], |s, _| s.measure_again(), "", "go on after Esc, or measure again"),
]);

impl Screen for Measurement {
    fn draw(&self, model: &AppModel, sheet: &mut Sheet) {
        view::draw(self, model, sheet);
    }

    /// Measures while the screen is on show what is not known yet; asks what was wished for once
    /// it is known.
    fn refresh_requests(&mut self, model: &mut AppModel, on_show: bool) {
        let scenario = &model.work.scenario;
        let free = on_show && self.complaint(scenario).is_none();
        let wanted = self.lacking(scenario).filter(|_| free);
        if self.task.job.is_some() && !(wanted.is_some() && self.measures(scenario)) {
            self.task.stop(None, &mut model.out);
        }
        if let (Some(question), None) = (wanted, &self.task.job) {
            self.task.ask(question, &mut model.out);
        }
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
        self.take_measured(report);
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

    fn mouse(&mut self, model: &mut AppModel, mouse: Mouse, _: Rect) -> bool {
        if let Mouse::Wheel(_, by) = mouse {
            self.step(&model.work.scenario, by.reversed());
        }
        false
    }
}

impl Measurement {
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
}

/// Asks whether to do what was found, or says why nothing was.
fn ask(model: &mut AppModel, found: Result<Proposal, String>) {
    match found {
        Ok(Proposal { words, scenario }) => {
            let question = Prompt::Adopt(words, Box::new(scenario));
            model.overlay = Some(Overlay::Prompt(question));
        }
        Err(why) => model.notice = Some(why),
    }
}
