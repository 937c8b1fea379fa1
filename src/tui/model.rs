//! What the screens share: what is worked on, its answer, the clock, and what is asked. Nothing
//! here draws and nothing here waits; what a screen keeps to itself is not here.

use crate::answer::solve::Answer;
use crate::scenario::Scenario;
use crate::tui::request::TaskQuestion as _;
use crate::tui::simulation::{Complete, Simulate};
use crate::tui::{clock::Clock, ensemble::Samples, form::ScenarioForm, guest, picker::Choice};
use crate::tui::{keys::chosen::Keys, look::Look, outbox::Outbox, overlay::Overlay};
use crate::tui::{page::WritePage, shown::ShownAnswer, task::Task, undo::History, work::Work};
use std::time::Duration;

/// The answer through whose time the clock goes, and the end of that time in s.
pub type Timed<'a> = (&'a Answer, f64);

/// What the screens share.
#[derive(Default)]
#[expect(clippy::struct_excessive_bools, reason = "each says one thing")]
pub struct AppModel {
    /// What is being worked on.
    pub work: Work,
    pub history: History<Work>,
    pub form: ScenarioForm,
    /// The last good result, if there ever was one.
    pub shown: Option<ShownAnswer>,
    /// What that is the answer to, with the name it had.
    pub answered: Option<Work>,
    /// The answer to the newest edit.
    pub run: Task<Simulate>,
    /// The mesh error of the answer on show.
    pub rest: Task<Complete>,
    pub page: Task<WritePage>,
    pub overlay: Option<Overlay>,
    pub clock: Clock,
    /// Samples over what is not known of the inputs.
    pub ensemble: Samples,
    /// Removed presets: how many changes could be undone then, the name, and the file's text.
    pub removed: Vec<(usize, String, String)>,
    pub choices: Vec<Choice>,
    /// Said in the footer until the next key.
    pub notice: Option<String>,
    /// Whether frames take long to arrive.
    pub slow_link: bool,
    pub look: Look,
    /// Whether the mouse is listened to.
    pub mouse: bool,
    /// Whether mesh errors and bands are computed while nothing else is wanted.
    pub idle: bool,
    /// Whether the next start goes on from here.
    pub goes_on: bool,
    /// Whether whoever works is a [guest](crate::tui::guest).
    pub guest: bool,
    pub keys: Keys,
    /// Time since the start.
    pub now: Duration,
    /// What is to be done outside.
    pub out: Outbox,
}

impl AppModel {
    /// Whether what is shown can be seen from the front; says why not where there is something.
    pub fn can_face_front(&mut self) -> bool {
        let Some(shown) = &self.shown else { return false };
        let has_front = shown.has_front();
        if !has_front {
            self.notice = Some("a section has no front: hit the eye with an object".to_owned());
        }
        has_front
    }

    /// Whether this scenario may be simulated here, or why not.
    pub fn allows(&self, scenario: &Scenario) -> Result<(), String> {
        if self.guest { guest::allowed(scenario) } else { Ok(()) }
    }

    /// Whether the scenario differs from what was loaded or saved.
    pub fn is_edited(&self) -> bool {
        self.work.original.as_ref() != Some(&self.work.scenario)
    }

    /// The preset's name, with a word where it no longer fits.
    pub fn title(&self) -> String {
        let edited = if self.is_edited() { " (edited)" } else { "" };
        format!("{}{edited}", self.work.name())
    }

    /// Why the result on show is not that of the form, if it is not.
    pub fn stale(&self) -> Option<&'static str> {
        let other = |shown: &ShownAnswer| shown.scenario != self.work.scenario;
        if self.run.complaint.is_some() {
            return Some("last good result");
        }
        match &self.run.job {
            Some(job) if job.pace.is_some() => Some("previous result"),
            Some(_) => None,
            None => self.shown.as_ref().is_some_and(other).then_some("last good result"),
        }
    }

    /// Whether something is computed that somebody asked for, the screens left aside.
    pub fn is_busy(&self) -> bool {
        let samples = self.ensemble.task.job.as_ref();
        let looks =
            |overlay: &Overlay| matches!(overlay, Overlay::Threshold(a) if a.task.job.is_some());
        self.run.job.is_some()
            || self.page.job.is_some()
            || self.overlay.as_ref().is_some_and(looks)
            || samples.is_some_and(|job| !job.question.is_idle())
    }

    /// What is computed though nobody asked for it, and how far it is.
    pub fn ahead(&self) -> Option<String> {
        let rest = || {
            let done = self.rest.job.as_ref()?.pace?.done(None);
            Some(format!("mesh error {done}"))
        };
        let samples = || {
            let job = self.ensemble.task.job.as_ref()?;
            let (pace, count) = (job.pace?, job.question.count as usize);
            let words = format!("{} samples", pace.done(Some(count)));
            job.question.is_idle().then_some(words)
        };
        rest().or_else(samples)
    }

    /// The answer to the form, and the end of its time in s.
    pub fn timed(&self) -> Option<Timed<'_>> {
        let answer = self.shown.as_ref()?.answer.as_ref();
        Some((answer, answer.window()))
    }

    /// The answer to the form, if there is one, with the name of its source.
    pub fn answer(&self) -> Vec<(String, &ShownAnswer)> {
        self.shown.iter().map(|shown| (self.work.name().to_owned(), shown)).collect()
    }

    /// The time shown of the answer to the form, in s.
    pub fn time(&self) -> f64 {
        self.clock.time_in(self.timed())
    }
}
