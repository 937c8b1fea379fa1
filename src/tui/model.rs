//! Everything that the screens show. Nothing here draws and nothing here waits.

use std::borrow::Borrow;
use std::sync::Arc;
use std::time::Duration;

use crate::answer::solve::Answer;
use crate::run::drawing::Drawing;
use crate::scenario::Scenario;
use crate::tui::clock::{Clock, Moment};
use crate::tui::ensemble::Samples;
use crate::tui::form::Form;
use crate::tui::guest;
use crate::tui::keys::chosen::Keys;
use crate::tui::line::Line;
use crate::tui::picker::Picker;
use crate::tui::screens::{Pane, SCREENS, Screen, Screens};
use crate::tui::simulation::{EstimateMesh, Simulate};
use crate::tui::take_away::WritePage;
use crate::tui::task::{Outbox, Question as _, Task};
use crate::tui::terminal::caps::{Depth, Symbols};
use crate::tui::threshold::Asking;
use crate::tui::undo::History;
use crate::tui::view::heat::{HeatMap, highest, hottest};
use crate::tui::view::palette::Palette;
use crate::tui::work::Work;

/// A preset, or a scenario that was given on the command line.
#[derive(Debug, Clone)]
pub struct Choice {
    /// What the list shows, and what opens it.
    pub name: String,
    /// What it holds, or why it cannot be used.
    pub scenario: Result<Scenario, String>,
    /// Where it comes from, in a word.
    pub origin: &'static str,
}

/// An answer with what every picture of it needs.
#[derive(Debug, Clone)]
pub struct Shown {
    /// What was asked.
    pub scenario: Scenario,
    /// What came of it.
    pub answer: Arc<Answer>,
    /// The largest force on any node in any frame, in N.
    pub hottest: f64,
    /// The largest pressure in any cell in any frame, in Pa, if it has cells.
    pub highest: Option<f64>,
    /// What pictures are made of.
    pub drawing: Drawing,
}

impl Shown {
    /// The answer to a scenario.
    pub fn new(scenario: Scenario, answer: Answer) -> Self {
        Self {
            scenario,
            hottest: hottest(&answer),
            highest: highest(&answer),
            drawing: answer.case.eye.drawing(),
            answer: Arc::new(answer),
        }
    }
}

impl Borrow<Answer> for Box<Shown> {
    fn borrow(&self) -> &Answer {
        &self.answer
    }
}

/// Something in front of the screen.
pub enum Overlay {
    /// The keys, scrolled down so far.
    Help(u16),
    /// Everything that can be opened.
    Picker(Picker),
    /// At which value of a number does a result reach this?
    Threshold(Box<Asking>),
    /// A name is being typed, and what is wrong with it.
    Name(Naming, Line, Option<String>),
    /// Something is asked.
    Question(Question),
}

/// What a name is typed for.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Naming {
    /// To save what is worked on.
    Save,
    /// To give the preset of this name another one.
    Rename(String),
}

/// What is asked.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Question {
    /// Remove the preset of this name?
    Remove(String),
    /// Replace the preset of this name?
    Replace(String),
    /// Save under the name of a preset that the program brings along?
    Hide(String),
    /// Compute it otherwise, at these costs?
    Adopt(String),
    /// Quit without saving? The next start may bring the changes back.
    Quit {
        /// Whether it does.
        kept: bool,
    },
}

impl Question {
    /// It in a few words.
    pub fn brief(&self) -> String {
        match self {
            Self::Remove(name) => format!("Remove the preset {name}?"),
            Self::Replace(name) => format!("Replace the preset {name}?"),
            Self::Hide(name) => format!("Hide the preset {name}?"),
            Self::Adopt(_) => "Compute it so?".to_owned(),
            Self::Quit { .. } => "Quit without saving the changes?".to_owned(),
        }
    }

    /// The same with what it would do.
    pub fn text(&self) -> String {
        match self {
            Self::Remove(name) => {
                format!("This removes your preset {name} from the disk, for good. Remove it?")
            }
            Self::Replace(name) => {
                format!("There is a preset {name} already. Put this one in its place?")
            }
            Self::Hide(name) => format!(
                "{name} comes with the program. A preset of your own of that name hides it. Save it?"
            ),
            Self::Adopt(words) => words.clone(),
            Self::Quit { kept: false } => {
                "The changes are not saved. Quit and lose them?".to_owned()
            }
            Self::Quit { kept: true } => {
                "The changes are not saved as a preset. Quit? They are there again next time."
                    .to_owned()
            }
        }
    }
}

/// How things are drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Look {
    /// How many colours.
    pub depth: Depth,
    /// Which symbols.
    pub symbols: Symbols,
    /// Which colours stand for heat.
    pub heat: HeatMap,
    /// The ground, and colours of the person's own choice.
    pub palette: Palette,
}

/// Everything that the screens show.
#[expect(clippy::struct_excessive_bools, reason = "each says one thing")]
pub struct Model {
    /// What is being worked on.
    pub work: Work,
    /// What can be undone.
    pub history: History<Work>,
    /// The form.
    pub form: Form,
    /// The last good result, if there ever was one.
    pub shown: Option<Shown>,
    /// The answer to the newest edit.
    pub run: Task<Simulate>,
    /// The mesh error of the answer on show.
    pub mesh: Task<EstimateMesh>,
    /// A page to take away.
    pub page: Task<WritePage>,
    /// The place of the screen on show in [`SCREENS`].
    pub screen: usize,
    /// The pane with the focus, for each of [`SCREENS`].
    pub panes: Vec<usize>,
    /// What the screens keep to themselves.
    pub screens: Screens,
    /// What is in front of the screen.
    pub overlay: Option<Overlay>,
    /// The moment shown.
    pub clock: Clock,
    /// Samples over what is not known of the inputs.
    pub ensemble: Samples,
    /// What can be opened.
    pub choices: Vec<Choice>,
    /// Said in the footer until the next key.
    pub notice: Option<String>,
    /// Whether frames take long to arrive.
    pub slow_link: bool,
    /// How things are drawn.
    pub look: Look,
    /// Whether the mouse is listened to.
    pub mouse: bool,
    /// Whether mesh errors and bands are computed while nothing else is wanted.
    pub idle: bool,
    /// Whether the next start goes on from here.
    pub goes_on: bool,
    /// Whether whoever works is a [guest](crate::tui::guest).
    pub guest: bool,
    /// Keys of the person's own choice.
    pub keys: Keys,
    /// Whether the screen wants to be told where the mouse is dragged.
    pub dragging: bool,
    /// Time since the start.
    pub now: Duration,
    /// What is to be done outside.
    pub out: Outbox,
}

impl Model {
    /// A model about to work on `work`, with everything that can be opened.
    pub fn new(work: Work, choices: Vec<Choice>, look: Look) -> Self {
        Self {
            work,
            history: History::default(),
            form: Form::default(),
            shown: None,
            run: Task::default(),
            mesh: Task::default(),
            page: Task::default(),
            screen: 0,
            panes: vec![0; SCREENS.len()],
            screens: Screens::default(),
            overlay: None,
            clock: Clock::default(),
            ensemble: Samples::default(),
            choices,
            notice: None,
            slow_link: false,
            look,
            mouse: false,
            idle: true,
            goes_on: false,
            guest: false,
            keys: Keys::default(),
            dragging: false,
            now: Duration::ZERO,
            out: Outbox::default(),
        }
    }

    /// Whether this scenario may be simulated here.
    ///
    /// # Errors
    /// Says what is too much for a guest.
    pub fn allows(&self, scenario: &Scenario) -> Result<(), String> {
        if self.guest {
            guest::allowed(scenario)
        } else {
            Ok(())
        }
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

    /// The mechanical model of the scenario in words.
    pub fn material(&self) -> &'static str {
        self.work.scenario.model.title()
    }

    /// Why the result on show is not that of the form, if it is not.
    pub fn stale(&self) -> Option<&'static str> {
        let typing_fails = self
            .form
            .typing
            .as_ref()
            .is_some_and(|typing| typing.error.is_some());
        let other = |shown: &Shown| shown.scenario != self.work.scenario;
        if self.run.complaint.is_some() {
            return Some("last good result");
        }
        match &self.run.job {
            Some(job) if job.pace.is_some() => Some("previous result"),
            _ if typing_fails => Some("last good result"),
            Some(_) => None,
            None => self
                .shown
                .as_ref()
                .is_some_and(other)
                .then_some("last good result"),
        }
    }

    /// Whether something is computed that somebody asked for.
    pub fn is_busy(&self) -> bool {
        let screens = &self.screens;
        let samples = self.ensemble.task.job.as_ref();
        let looks =
            |overlay: &Overlay| matches!(overlay, Overlay::Threshold(a) if a.task.job.is_some());
        self.run.job.is_some()
            || self.page.job.is_some()
            || self.overlay.as_ref().is_some_and(looks)
            || screens.compare.task.job.is_some()
            || screens.compare.mesh.job.is_some()
            || screens.accuracy.task.job.is_some()
            || screens.map.task.job.is_some()
            || samples.is_some_and(|job| !job.question.is_idle())
    }

    /// What is computed though nobody asked for it, and how far it is.
    pub fn ahead(&self) -> Option<String> {
        let mesh = || {
            Some(format!(
                "mesh error {}",
                self.mesh.job.as_ref()?.pace?.done(None)
            ))
        };
        let samples = || {
            let job = self.ensemble.task.job.as_ref()?;
            let (pace, count) = (job.pace?, job.question.count as usize);
            let words = format!("{} samples", pace.done(Some(count)));
            job.question.is_idle().then_some(words)
        };
        mesh().or_else(samples)
    }

    /// Whether pictures should take few bytes: while they move over a slow link.
    pub fn is_lean(&self) -> bool {
        self.slow_link && self.clock.playing
    }

    /// What there is to know of the screen on show.
    pub fn on_show(&self) -> &'static Screen {
        &SCREENS[self.screen]
    }

    /// The place of the pane with the focus.
    pub fn pane(&self) -> usize {
        self.panes[self.screen]
    }

    /// The pane with the focus.
    pub fn focus(&self) -> &'static Pane {
        &self.on_show().panes[self.pane()]
    }

    /// Whether a pane of the screen hears the keys now.
    pub fn has_focus(&self, pane: usize) -> bool {
        self.pane() == pane && self.overlay.is_none()
    }

    /// Gives the next pane the focus, or the one before.
    pub fn change_pane(&mut self, forward: bool) {
        let count = self.on_show().panes.len();
        let by = if forward { 1 } else { count - 1 };
        self.show_pane((self.pane() + by) % count);
    }

    /// Gives a pane of the screen the focus.
    pub fn show_pane(&mut self, pane: usize) {
        self.panes[self.screen] = pane.min(self.on_show().panes.len() - 1);
    }

    /// The answer whose clock runs, and the end of its time in s.
    pub fn timed(&self) -> Option<(&Answer, f64)> {
        (self.on_show().timed)(self)
    }

    /// The end of the clock's time, in s.
    pub fn window(&self) -> Option<f64> {
        Some(self.timed()?.1)
    }

    /// The time shown, in s.
    pub fn time(&self) -> f64 {
        let Some((answer, window)) = self.timed() else {
            return 0.0;
        };
        match self.clock.moment {
            Moment::At(time) => time.min(window),
            Moment::Deepest => self.clock.time(answer),
        }
    }
}
