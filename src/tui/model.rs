//! Everything that the screens show. Nothing here draws and nothing here waits.

use std::sync::Arc;
use std::time::Duration;

use tui_input::Input;

use super::clock::Clock;
use super::ensemble::Spread;
use super::form::Form;
use super::keys::Context;
use super::screens::accuracy::measurement::Measurement;
use super::screens::compare::comparison::Comparison;
use super::screens::map::state::Map;
use super::screens::{SCREENS, Screen};
use super::terminal::caps::{Depth, Symbols};
use super::undo::History;
use super::worker::Ticket;
use crate::scenario::Scenario;
use crate::study::Answer;

/// The name under which the form stands in the comparison.
pub const FORM: &str = "(the form)";

/// What is being worked on.
#[derive(Debug, Clone, PartialEq)]
pub struct Work {
    /// The scenario.
    pub scenario: Scenario,
    /// The preset or file that it began as.
    pub source: String,
    /// What that holds.
    pub original: Scenario,
}

impl Work {
    /// Work on a scenario as it was found.
    pub fn fresh(source: &str, scenario: &Scenario) -> Self {
        Self {
            scenario: scenario.clone(),
            source: source.to_owned(),
            original: scenario.clone(),
        }
    }

    /// What it is called in short: of a file's path the last part.
    pub fn name(&self) -> &str {
        let parts = self.source.rsplit(['/', '\\']);
        parts
            .into_iter()
            .find(|part| !part.is_empty())
            .unwrap_or("")
    }

    /// The same work with another scenario.
    #[must_use]
    pub fn with(&self, scenario: Scenario) -> Self {
        Self {
            scenario,
            ..self.clone()
        }
    }
}

/// A preset, or a scenario that was given on the command line.
#[derive(Debug, Clone)]
pub struct Choice {
    /// Its name.
    pub name: String,
    /// What it holds, or why it cannot be used.
    pub scenario: Result<Scenario, String>,
    /// Where it comes from, in a word.
    pub origin: &'static str,
}

/// The last good result.
#[derive(Debug, Clone)]
pub struct Shown {
    /// What was asked.
    pub scenario: Scenario,
    /// What came of it.
    pub answer: Arc<Answer>,
    /// The job that it answers.
    pub ticket: Ticket,
    /// The largest force on any node in any frame, in N.
    pub hottest: f64,
}

/// How the newest edit fares.
#[derive(Debug, Clone, PartialEq)]
pub enum Run {
    /// It has its answer.
    Settled,
    /// It is being simulated; the share is known once it takes long.
    Running(Ticket, Option<f64>),
    /// It has no answer, for this reason.
    Refused(String),
}

/// Something in front of the screen.
pub enum Overlay {
    /// The keys, scrolled down so far.
    Help(u16),
    /// The presets, with a cursor.
    Picker(usize),
    /// A name is being typed to save under.
    SaveAs(Input, Option<String>),
    /// Something is asked.
    Question(Question),
}

/// What is asked.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Question {
    /// Replace the preset of this name?
    Replace(String),
    /// Save under the name of a preset that the program brings along?
    Hide(String),
    /// Quit without saving?
    Quit,
}

/// How things are drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Look {
    /// How many colours.
    pub depth: Depth,
    /// Which symbols.
    pub symbols: Symbols,
}

/// Everything that the screens show.
pub struct Model {
    /// What is being worked on.
    pub work: Work,
    /// What can be undone.
    pub history: History<Work>,
    /// The form.
    pub form: Form,
    /// The last good result, if there ever was one.
    pub shown: Option<Shown>,
    /// How the newest edit fares.
    pub run: Run,
    /// The screen.
    pub screen: Screen,
    /// The pane with the focus, for each of [`SCREENS`].
    pub panes: Vec<usize>,
    /// What is in front of the screen.
    pub overlay: Option<Overlay>,
    /// The moment shown.
    pub clock: Clock,
    /// Which curves the force screen shows.
    pub curves: usize,
    /// Which injury curve is explained.
    pub injury: usize,
    /// The comparison.
    pub compare: Comparison,
    /// Speed against error.
    pub accuracy: Measurement,
    /// What is not known of the inputs.
    pub ensemble: Spread,
    /// Damage over two inputs.
    pub map: Map,
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
    /// Whether the mouse is turning the blow.
    pub aiming: bool,
    /// Time since the start.
    pub now: Duration,
    /// The last ticket given out.
    pub ticket: Ticket,
}

impl Model {
    /// A model about to work on `work`, with everything that can be opened.
    pub fn new(work: Work, choices: Vec<Choice>, look: Look) -> Self {
        Self {
            work,
            history: History::default(),
            form: Form::default(),
            shown: None,
            run: Run::Settled,
            screen: Screen::Main,
            panes: vec![0; SCREENS.len()],
            overlay: None,
            clock: Clock::default(),
            curves: 0,
            injury: 0,
            compare: Comparison::default(),
            accuracy: Measurement::default(),
            ensemble: Spread::default(),
            map: Map::default(),
            choices,
            notice: None,
            slow_link: false,
            look,
            mouse: false,
            aiming: false,
            now: Duration::ZERO,
            ticket: 0,
        }
    }

    /// Whether the scenario differs from what was loaded or saved.
    pub fn is_edited(&self) -> bool {
        self.work.scenario != self.work.original
    }

    /// The preset's name, with a word where it no longer fits.
    pub fn title(&self) -> String {
        let edited = if self.is_edited() { " (edited)" } else { "" };
        format!("{}{edited}", self.work.name())
    }

    /// Why the result on show is not that of the form, if it is not.
    pub fn stale(&self) -> Option<&'static str> {
        let typing_fails = self
            .form
            .typing
            .as_ref()
            .is_some_and(|typing| typing.error.is_some());
        let other = |shown: &Shown| shown.scenario != self.work.scenario;
        match &self.run {
            Run::Refused(_) => Some("last good result"),
            Run::Running(_, Some(_)) => Some("previous result"),
            _ if typing_fails => Some("last good result"),
            Run::Running(_, None) => None,
            Run::Settled => self
                .shown
                .as_ref()
                .is_some_and(other)
                .then_some("last good result"),
        }
    }

    /// Whether pictures should take few bytes: while they move over a slow link.
    pub fn is_lean(&self) -> bool {
        self.slow_link && self.clock.playing
    }

    /// The index of the screen in [`SCREENS`].
    fn screen_index(&self) -> usize {
        let here = SCREENS.iter().position(|l| l.screen == self.screen);
        here.unwrap_or(0)
    }

    /// Which pane has the focus.
    pub fn pane(&self) -> usize {
        self.panes[self.screen_index()]
    }

    /// Moves the focus by so many panes.
    pub fn change_pane(&mut self, forward: bool) {
        let index = self.screen_index();
        let count = SCREENS[index].panes.len();
        let by = if forward { 1 } else { count - 1 };
        self.panes[index] = (self.panes[index] + by) % count;
    }

    /// Gives a pane of the screen the focus.
    pub fn show_pane(&mut self, pane: usize) {
        let index = self.screen_index();
        self.panes[index] = pane.min(SCREENS[index].panes.len() - 1);
    }

    /// Where a key counts now.
    pub fn context(&self) -> Context {
        match &self.overlay {
            Some(Overlay::Help(_)) => Context::Help,
            Some(Overlay::Picker(_)) => Context::Picker,
            Some(Overlay::SaveAs(..)) => Context::Typing,
            Some(Overlay::Question(_)) => Context::Question,
            None if self.form.typing.is_some() => Context::Typing,
            None => match self.screen.listed().panes[self.pane()].1 {
                Context::Form if self.form.takes_numbers() => Context::Number,
                pane => pane,
            },
        }
    }

    /// The answer whose clock runs: on the comparison, that of the first entry.
    pub fn clock_answer(&self) -> Option<&Answer> {
        let own = self.shown.as_ref().map(|shown| shown.answer.as_ref());
        if self.screen == Screen::Compare {
            let first = self.compare.entries.iter().find_map(|e| e.answer());
            first.or(own)
        } else {
            own
        }
    }

    /// The end of the clock's time, in s.
    pub fn window(&self) -> Option<f64> {
        let own = self.clock_answer()?.case.window;
        let longest = self.compare.window();
        Some(match longest {
            Some(longest) if self.screen == Screen::Compare => longest,
            _ => own,
        })
    }

    /// The time shown, in s.
    pub fn time(&self) -> f64 {
        let window = self.window().unwrap_or(0.0);
        match self.clock.moment {
            super::clock::Moment::At(time) => time.min(window),
            super::clock::Moment::Deepest => {
                self.clock_answer().map_or(0.0, |a| self.clock.time(a))
            }
        }
    }
}
