//! What a screen is made of. Whatever it leaves out does nothing.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;

use crate::answer::solve::Answer;
use crate::run::course::Course;
use crate::tui::keys::{KeyTable, TimeKeys};
use crate::tui::model::{Model, Shown};
use crate::tui::step::Step;
use crate::tui::task::Report;
use crate::tui::update::time;
use crate::tui::work::Work;

/// A part of a screen that can have the focus.
#[derive(Clone, Copy)]
pub struct Pane {
    /// What it is called on the screen.
    pub name: &'static str,
    /// Its keys; the first table that counts and knows a key wins.
    pub keys: &'static [KeyTable],
    /// Whether the keys of time count too.
    pub time: TimeKeys,
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

/// A screen.
#[derive(Clone, Copy)]
pub struct Screen {
    /// Its name in the title bar.
    pub title: &'static str,
    /// The question that it answers.
    pub question: &'static str,
    /// What it is for, in the words of the help.
    pub purpose: &'static str,
    /// What Tab moves between, at least one.
    pub panes: &'static [Pane],
    /// Draws it into the space between title and footer.
    pub draw: fn(&Model, Rect, &mut Buffer),
    /// The app was opened on these; the place of the screen in the list.
    pub given: fn(&mut Model, usize, &[Work]),
    /// How many samples over what is not known of the inputs it has room for; a few at most are run though
    /// nobody asked.
    pub samples: u32,
    /// It was asked for by its key.
    pub opened: fn(&mut Model),
    /// Something has happened: asks for what it now wants and stops what it no longer does. Whether
    /// it is on show.
    pub attend: fn(&mut Model, bool),
    /// Takes the report of a worker if the screen asked for it.
    pub hear: fn(&mut Model, &mut Option<Report>),
    /// Gives up what is under way for this screen; whether anything was.
    pub cancel: fn(&mut Model) -> bool,
    /// Takes in what the mouse does in the space that it is drawn into; whether it wants to be told
    /// of drags from there.
    pub mouse: fn(&mut Model, Mouse, Rect) -> bool,
    /// The answer through whose time its clock goes, and the end of that time in s.
    pub timed: fn(&Model) -> Option<(&Answer, f64)>,
    /// The courses on show, whose peaks are visited; none where all are.
    pub courses: fn(&Model) -> Vec<Course>,
    /// The answers on show, each by its name: what is taken away from here.
    pub answers: fn(&Model) -> Vec<(String, &Shown)>,
}

impl Screen {
    /// A screen that only shows the answer: the wheel goes through its time.
    pub const fn new(
        (title, question): (&'static str, &'static str),
        purpose: &'static str,
        panes: &'static [Pane],
        draw: fn(&Model, Rect, &mut Buffer),
    ) -> Self {
        Self {
            title,
            question,
            purpose,
            panes,
            draw,
            given: |_, _, _| {},
            samples: 0,
            opened: |_| {},
            attend: |_, _| {},
            hear: |_, _| {},
            cancel: |_| false,
            mouse: |model, mouse, _| {
                if let Mouse::Wheel(_, step) = mouse {
                    time::step(model, step.reversed());
                }
                false
            },
            timed: own_time,
            courses: |_| Vec::new(),
            answers: own_answer,
        }
    }
}

/// That of the form.
pub(super) fn own_answer(model: &Model) -> Vec<(String, &Shown)> {
    let named = |shown| (model.work.name().to_owned(), shown);
    model.shown.iter().map(named).collect()
}

/// That of the form.
pub(super) fn own_time(model: &Model) -> Option<(&Answer, f64)> {
    let answer = model.shown.as_ref()?.answer.as_ref();
    Some((answer, answer.window()))
}
