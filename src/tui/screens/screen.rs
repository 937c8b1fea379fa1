//! What a screen is made of: its own state, its keys, what it asks for, and its picture. Whatever
//! it leaves out does nothing.

use std::any::Any;

use crossterm::event::KeyEvent;
use ratatui::layout::Rect;
use ratatui::style::Style;

use crate::run::trace::Trace;
use crate::scenario::Scenario;
use crate::tui::keys::press::{Press, c};
use crate::tui::keys::{Binding, Key, KeyList, KeyTable, TimeKeys};
use crate::tui::model::{AppModel, Timed};
use crate::tui::request::{Report, TaskQuestion};
use crate::tui::{outbox::Outbox, shown::ShownAnswer, step::Step, task::Task};
use crate::tui::{view::sheet::Sheet, view::theme::Theme, work::Work};

/// What there is to know of a screen before it is opened.
pub struct About {
    /// Its name in the title bar.
    pub title: &'static str,
    pub question: &'static str,
    /// What it is for, in the words of the help.
    pub purpose: &'static str,
    pub new: fn() -> Box<dyn Screen>,
}

impl About {
    pub const fn new<S: Screen + Default>(
        title: &'static str,
        question: &'static str,
        purpose: &'static str,
    ) -> Self {
        Self { title, question, purpose, new: || Box::new(S::default()) }
    }
}

/// What the mouse does on a screen.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Mouse {
    /// The left button went down at this cell.
    Press((u16, u16)),
    /// It was moved here, after a press that the screen held on to.
    Drag((u16, u16)),
    /// The wheel was turned over this cell; up is a step up.
    Wheel((u16, u16), Step),
}

/// A screen: a component with its own state.
pub trait Screen: Keyed + Any {
    /// Draws it into the space between title and footer.
    fn draw(&self, model: &AppModel, sheet: &mut Sheet);

    /// The place of the pane with the focus.
    fn pane(&self) -> usize {
        0
    }

    /// Gives the pane of this place the focus.
    fn show_pane(&mut self, _pane: usize) {}

    /// The app was opened on these.
    fn opened_on(&mut self, _model: &mut AppModel, _works: &[Work]) {}

    /// How many samples of the inputs it has room for; a few at most are run though nobody asked.
    fn samples(&self) -> u32 {
        0
    }

    /// Something has happened: asks for what it now wants and stops what it no longer does.
    fn refresh_requests(&mut self, _model: &mut AppModel, _on_show: bool) {}

    /// Takes the report of a worker if the screen asked for it.
    fn take_report(&mut self, _model: &mut AppModel, _report: &mut Option<Report>) {}

    /// Whether something is computed that it asked for.
    fn is_busy(&self) -> bool {
        false
    }

    /// Gives up what is under way for this screen; whether anything was.
    fn cancel(&mut self, _model: &mut AppModel) -> bool {
        false
    }

    /// Takes the choice of this place in the list that it opened to mark some.
    fn mark_choice(&mut self, _model: &mut AppModel, _place: usize) {}

    /// Takes several choices by their places in that list, each with its scenario.
    fn mark_several(&mut self, _model: &mut AppModel, _chosen: Vec<(usize, Scenario)>) {}

    /// Takes another scenario for what is called so, after a field of it was changed.
    fn take_changed(&mut self, _model: &mut AppModel, _name: &str, _scenario: &Scenario) {}

    /// Proposes what is more exact than the answer on show, or faster, or shall be shown to find
    /// that out first; whether this is its business, and whether it is to be shown.
    fn propose(&mut self, _model: &mut AppModel, _exact: bool) -> Option<bool> {
        None
    }

    /// Takes in what the mouse does on it; whether it wants to be told of drags from there.
    fn mouse(&mut self, model: &mut AppModel, mouse: Mouse, _area: Rect) -> bool {
        if let Mouse::Wheel(_, step) = mouse {
            self.step(model, step.reversed());
        }
        false
    }

    /// The answer through whose time its clock goes, and the end of that time in s.
    fn timed<'a>(&'a self, model: &'a AppModel) -> Option<Timed<'a>> {
        model.timed()
    }

    /// Goes a step through what it shows: by itself from frame to frame of that time.
    fn step(&mut self, model: &mut AppModel, step: Step) {
        let mut clock = model.clock;
        if let Some((answer, window)) = self.timed(model) {
            let time = clock.time_in(Some((answer, window)));
            clock.step(step, time, &answer.run.frames, window);
        }
        model.clock = clock;
    }

    /// The courses on show, whose peaks are visited; none where all are.
    fn courses(&self, _model: &AppModel) -> Vec<Trace> {
        Vec::new()
    }

    /// The answers on show, each by its name: what is taken away from here.
    fn answers<'a>(&'a self, model: &'a AppModel) -> Vec<(String, &'a ShownAnswer)> {
        model.answer()
    }
}

/// Has a task do what is wanted and nothing else; `same` tells whether it is at it already.
pub fn follow<Q: TaskQuestion>(
    task: &mut Task<Q>,
    wanted: Option<Q>,
    same: fn(&Q, &Q) -> bool,
    out: &mut Outbox,
) {
    let both = task.job.as_ref().zip(wanted.as_ref());
    if both.is_some_and(|(job, wanted)| same(&job.question, wanted)) {
        return;
    }
    task.stop(None, out);
    if let Some(question) = wanted {
        task.ask(question, out);
    }
}

/// The next of `all` that fits after this one, which may be the same.
pub fn next_of<T: Copy + PartialEq>(all: &[T], here: T, fits: impl FnMut(&T) -> bool) -> T {
    let after = all.iter().position(|one| *one == here).map_or(0, |at| at + 1);
    let (before, after) = all.split_at(after);
    after.iter().chain(before).copied().find(fits).unwrap_or(here)
}

/// How far a screen's work is, or why it stopped, or else what is `known`, for its first row.
pub fn state_of_work(
    pace: Option<String>,
    stopped: Option<&str>,
    known: String,
    theme: Theme,
) -> (String, Style) {
    match (pace, stopped) {
        (Some(pace), _) => (format!("{pace}  Esc stops"), theme.warning()),
        (None, Some(why)) => (format!("{why}: m goes on"), theme.warning()),
        (None, None) => (known, theme.quiet()),
    }
}

/// What a key of a screen does to it and to what the screens share.
pub type Act<S> = fn(&mut S, &mut AppModel);

pub const fn bind<S>(
    presses: &'static [Press],
    act: Act<S>,
    short: &'static str,
    help: &'static str,
) -> Binding<Act<S>> {
    Binding { key: Key::new(presses, short, help), act }
}

const GO_ON: &[Press] = &[c('m')];

/// The key that goes on with what Esc has stopped.
pub const fn go_on<S>(act: Act<S>) -> Binding<Act<S>> {
    bind(GO_ON, act, "go on", "go on where Esc stopped it")
}

/// Keys of a pane, and when they count there.
pub struct PaneKeys<S: 'static> {
    table: KeyTable<Act<S>>,
    counts: fn(&S, &AppModel) -> bool,
}

impl<S> PaneKeys<S> {
    /// Keys that always count where their pane has the focus.
    pub const fn new(title: &'static str, bindings: &'static [Binding<Act<S>>]) -> Self {
        Self { table: KeyTable::new(title, bindings), counts: |_, _| true }
    }

    /// These keys where they count at times.
    #[must_use]
    pub const fn when(mut self, counts: fn(&S, &AppModel) -> bool) -> Self {
        self.counts = counts;
        self
    }
}

/// A part of a screen that can have the focus.
pub struct Pane<S: 'static> {
    pub name: &'static str,
    /// Its keys; the first table that counts and knows a key wins.
    pub keys: &'static [PaneKeys<S>],
    pub time: TimeKeys,
}

impl<S> Pane<S> {
    pub const fn new(name: &'static str, time: TimeKeys, keys: &'static [PaneKeys<S>]) -> Self {
        Self { name, keys, time }
    }

    fn now(&self, screen: &S, model: &AppModel) -> impl Iterator<Item = &'static KeyTable<Act<S>>> {
        let now = self.keys.iter().filter(|keys| (keys.counts)(screen, model));
        now.map(|keys| &keys.table)
    }
}

/// A screen that says what its panes are.
pub trait Panes: Sized + 'static {
    /// What Tab moves between, at least one.
    const PANES: &'static [Pane<Self>];
}

/// What is known of a pane whatever its screen.
pub struct PaneFacts {
    pub name: &'static str,
    pub keys: Vec<KeyList>,
    pub time: TimeKeys,
}

/// What became of a key.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum KeyOutcome {
    /// The screen has none like it.
    Unknown,
    /// The screen did what the key stands for.
    Done,
    /// A value is typed that begins with it.
    BeginsValue,
}

/// A screen by its keys. Every screen is one by its [`Panes`].
pub trait Keyed {
    fn panes(&self) -> Vec<PaneFacts>;

    fn keys_now(&self, model: &AppModel) -> Vec<KeyList>;

    /// Does what a key stands for.
    fn press(&mut self, model: &mut AppModel, event: KeyEvent) -> KeyOutcome;
}

impl<S: Screen + Panes> Keyed for S {
    fn panes(&self) -> Vec<PaneFacts> {
        let facts = |pane: &Pane<S>| PaneFacts {
            name: pane.name,
            keys: pane.keys.iter().map(|keys| keys.table.list()).collect(),
            time: pane.time,
        };
        S::PANES.iter().map(facts).collect()
    }

    fn keys_now(&self, model: &AppModel) -> Vec<KeyList> {
        S::PANES[self.pane()].now(self, model).map(KeyTable::list).collect()
    }

    fn press(&mut self, model: &mut AppModel, event: KeyEvent) -> KeyOutcome {
        let find = |table: &KeyTable<Act<S>>| table.find(&model.keys, event);
        let Some(binding) = S::PANES[self.pane()].now(self, model).find_map(find) else {
            return KeyOutcome::Unknown;
        };
        if binding.key.begins_value {
            return KeyOutcome::BeginsValue;
        }
        model.form.complaint = None;
        (binding.act)(self, model);
        KeyOutcome::Done
    }
}
