//! Several presets: which are marked, their answers one after another, and the clock they share.

pub mod comparison;
mod view;

use ratatui::layout::Rect;

use crate::many::comparison::Found;
use crate::run::{kept::Traces, trace::Trace};
use crate::scenario::Scenario;
use crate::tui::changing::{Changing, began_as, called};
use crate::tui::keys::press::{DOWN, END, ENTER, HOME, LEFT, PAGE_DOWN, PAGE_UP, RIGHT, UP, c};
use crate::tui::keys::{Binding, TimeKeys};
use crate::tui::model::{AppModel, Timed};
use crate::tui::picker::{Choice, PAGE, Picker};
use crate::tui::screens::screen::{Act, Mouse, Pane, PaneKeys, Panes, Screen, bind, next_of};
use crate::tui::simulation::Simulate;
use crate::tui::{overlay::Overlay, request::Report, screens::forces::drawn};
use crate::tui::{screens::replay::FrameKeys, shown::ShownAnswer, step::Step};
use crate::tui::{view::sheet::Sheet, work::Work};
use comparison::{Comparison, FORM, LIST, MAX_MARKED, Marked, OfMarked, REPLAYS, TABLE, shown};

impl Panes for Comparison {
    const PANES: &'static [Pane<Self>] = &[
        Pane::new(view::PANES[LIST], TimeKeys::Absent, &[LIST_KEYS]),
        Pane::new(view::PANES[TABLE], TimeKeys::Early, &[TABLE_KEYS]),
        Pane::new(view::PANES[REPLAYS], TimeKeys::Early, &[FRAMES, ALIGN_KEYS]),
    ];
}

#[rustfmt::skip]
const LIST_KEYS: PaneKeys<Comparison> = PaneKeys::new("Compare: presets", &[
    bind(&[UP, c('k')], |s, m| s.move_row(m, -1), "preset", "the preset above"),
    bind(&[DOWN, c('j')], |s, m| s.move_row(m, 1), "&", "the preset below"),
    bind(&[PAGE_UP], |s, m| s.move_row(m, -PAGE), "", "ten presets up"),
    bind(&[PAGE_DOWN], |s, m| s.move_row(m, PAGE), "", "ten presets down"),
    bind(&[HOME], |s, m| s.move_row(m, -i16::MAX), "", "the first preset"),
    bind(&[END], |s, m| s.move_row(m, i16::MAX), "", "the last preset"),
    bind(&[c(' '), ENTER], Comparison::mark_row, "mark", "mark or unmark, two to six in all"),
    bind(&[c('e')], Comparison::edit, "edit", "change its speed or another field, here only"),
    bind(&[c('/')], |s, m| s.open_list(m, ""), "find", "find presets by letters, and mark them"),
]);

#[rustfmt::skip]
const TABLE_KEYS: PaneKeys<Comparison> = PaneKeys::new("Compare: table", &[
    bind(&[LEFT, c('h')], |s, _| s.change_column(-1), "column", "the column to the left"),
    bind(&[RIGHT, c('l')], |s, _| s.change_column(1), "&", "the column to the right"),
    bind(&[UP, c('k')], |s, m| s.move_row(m, -1), "", "the row above"),
    bind(&[DOWN, c('j')], |s, m| s.move_row(m, 1), "", "the row below"),
    bind(&[c('e')], Comparison::edit, "edit", "change its speed or another field, here only"),
    bind(&[ENTER, c('o')], |s, _| s.sort_here(), "sort", "sort by the column; again: the other way"),
    bind(&[c('v')], |s, _| s.next_curve(), "curves", "the next curve below the table"),
    ALIGN,
]);

const FRAMES: PaneKeys<Comparison> = PaneKeys::new("Compare: replays", Comparison::FRAME_KEYS);
const ALIGN_KEYS: PaneKeys<Comparison> = PaneKeys::new("Compare: time", &[ALIGN]);

const ALIGN: Binding<Act<Comparison>> = bind(
    &[c('a')],
    |s, _| s.alignment = s.alignment.next(),
    "align",
    "at the same time: the beginning, first contact, or where deepest",
);

impl Screen for Comparison {
    fn draw(&self, model: &AppModel, sheet: &mut Sheet) {
        view::draw(self, model, sheet);
    }

    fn pane(&self) -> usize {
        self.pane
    }

    fn show_pane(&mut self, pane: usize) {
        self.pane = pane;
    }

    /// Marks what the app was opened on if that is several, and puts the table in front.
    fn opened_on(&mut self, model: &mut AppModel, works: &[Work]) {
        if works.len() < 2 {
            return;
        }
        self.pane = TABLE;
        let mut left_out = 0;
        for Work { source, scenario, original } in works {
            let name = original.as_ref().map(|original| called(source, original, scenario));
            let name = name.as_ref().unwrap_or(source);
            let marked = self.entries.iter().any(|entry| entry.name == *name);
            if !marked && self.add(name, scenario).is_err() {
                left_out += 1;
            }
        }
        if left_out > 0 {
            let only = format!("only the first {MAX_MARKED} are marked for comparison");
            model.notice = Some(format!("{only}, {left_out} are not"));
        }
    }

    /// Simulates, then completes what is marked while on show; stops what nobody waits for.
    fn refresh_requests(&mut self, model: &mut AppModel, on_show: bool) {
        if on_show {
            self.follow_form(&model.work.scenario);
        }
        let runs_on = on_show && self.awaits(&self.task);
        let rest_goes_on = on_show && self.awaits(&self.rest);
        if !runs_on {
            self.task.stop(None, &mut model.out);
        }
        if !rest_goes_on {
            self.rest.stop(None, &mut model.out);
        }
        if !on_show || runs_on || rest_goes_on {
            return;
        }
        if let Some(entry) = self.next() {
            let question = OfMarked::new(entry, Simulate(entry.scenario.clone()));
            self.task.ask(question, &mut model.out);
            return;
        }
        let incomplete = self.incomplete().next();
        if let Some((entry, mesh)) = incomplete {
            let question = OfMarked::new(entry, mesh);
            self.rest.ask(question, &mut model.out);
        }
    }

    fn take_report(&mut self, _: &mut AppModel, report: &mut Option<Report>) {
        if let Some((asked, mesh)) = self.rest.take_report(report) {
            self.complete(&asked, mesh);
        }
        let Some((asked, outcome)) = self.task.take_report(report) else { return };
        let why = self.task.complaint.take().map(|(_, why)| why);
        let found = match outcome {
            Some(answer) => Found::Answer(ShownAnswer::new(asked.scenario.clone(), answer).into()),
            None => Found::Refused(why.unwrap_or_default()),
        };
        self.set_found(&asked.name, found);
    }

    fn is_busy(&self) -> bool {
        self.task.job.is_some() || self.rest.job.is_some()
    }

    /// Gives up what is under way; the rest is not begun either.
    fn cancel(&mut self, model: &mut AppModel) -> bool {
        if let Some(job) = &self.rest.job {
            let asked = job.question.clone();
            self.rest.stop(None, &mut model.out);
            self.complete(&asked, None);
            return true;
        }
        let Some(job) = &self.task.job else { return false };
        let name = job.question.name.clone();
        self.task.stop(None, &mut model.out);
        let words = "stopped: unmark and mark it again".to_owned();
        self.set_found(&name, Found::Refused(words));
        true
    }

    /// Marks the choice of this place, or unmarks it, and makes room for the next name.
    fn mark_choice(&mut self, model: &mut AppModel, place: usize) {
        let Some(choice) = model.choices.get(place) else { return };
        model.notice = self.mark(&choice.name, choice.scenario.as_ref()).err();
        self.row = 1 + place;
        let name = choice.name.clone();
        self.open_list(model, &name);
    }

    /// Marks all that are not marked yet, and says by which names.
    fn mark_several(&mut self, model: &mut AppModel, chosen: Vec<(usize, Scenario)>) {
        let mut names = Vec::new();
        for (place, scenario) in chosen {
            let Some(Choice { name, scenario: Ok(original), .. }) = model.choices.get(place) else {
                continue;
            };
            let called = called(name, original, &scenario);
            let is_there = self.entries.iter().any(|entry| entry.name == called);
            if !is_there && let Err(why) = self.add(&called, &scenario) {
                return model.notice = Some(why);
            }
            self.row = 1 + place;
            names.push(called);
        }
        model.notice = Some(format!("marked: {}", names.join(", ")));
    }

    /// Compares it as it is now; what was not marked is marked.
    fn take_changed(&mut self, model: &mut AppModel, name: &str, scenario: &Scenario) {
        let mut choices = model.choices.iter();
        let Some(Choice { name: source, scenario: Ok(original), .. }) =
            choices.find(|choice| began_as(name, &choice.name))
        else {
            return;
        };
        let called = called(source, original, scenario);
        self.fix_order();
        match self.entries.iter().position(|entry| entry.name == name) {
            Some(at) if self.entries[at].scenario == *scenario => {}
            Some(at) => self.keeping_row(|comparison| {
                comparison.entries[at] = Marked::new(&called, scenario);
            }),
            None => model.notice = self.add(&called, scenario).err(),
        }
    }

    /// Points at the names of the panes and at rows of the list.
    fn mouse(&mut self, model: &mut AppModel, mouse: Mouse, area: Rect) -> bool {
        match mouse {
            Mouse::Press(at) => {
                if let Some(pane) = view::heading_at(area, at) {
                    self.pane = pane;
                } else if let Some(row) = view::listed_at(self, model, area, at) {
                    let again = self.row == row;
                    self.row = row;
                    if again {
                        self.mark_row(model);
                    }
                }
            }
            Mouse::Drag(_) => {}
            Mouse::Wheel(_, Step { up, .. }) if self.pane == LIST => {
                self.move_row(model, if up { -1 } else { 1 });
            }
            Mouse::Wheel(_, Step { up, .. }) if self.pane == TABLE => {
                self.change_column(if up { -1 } else { 1 });
            }
            Mouse::Wheel(_, step) => self.step(model, step.reversed()),
        }
        false
    }

    /// Through the time of the first entry, as far as the longest of them goes.
    fn timed<'a>(&'a self, model: &'a AppModel) -> Option<Timed<'a>> {
        let first = self.entries.iter().find_map(|e| e.answer());
        first.zip(self.window()).or_else(|| model.timed())
    }

    fn courses(&self, _: &AppModel) -> Vec<Trace> {
        if self.pane == REPLAYS { Vec::new() } else { vec![self.curve()] }
    }

    /// Those of the table, else of the form; none while some are being simulated.
    fn answers<'a>(&'a self, model: &'a AppModel) -> Vec<(String, &'a ShownAnswer)> {
        if self.next().is_some() {
            return Vec::new();
        }
        let named = |at: usize| {
            let entry = &self.entries[at];
            let name = if entry.name == FORM { model.work.name() } else { &entry.name };
            Some((name.to_owned(), shown(entry)?))
        };
        let marked: Vec<_> = self.sorted().into_iter().filter_map(named).collect();
        if marked.is_empty() { model.answer() } else { marked }
    }
}

impl Comparison {
    /// The time shown of the first entry, in s.
    pub(super) fn time(&self, model: &AppModel) -> f64 {
        model.clock.time_in(self.timed(model))
    }

    /// Moves the cursor of the list, or of the table.
    fn move_row(&mut self, model: &AppModel, by: i16) {
        let (row, last) = match self.pane {
            // The form stands above the presets.
            LIST => (&mut self.row, model.choices.len()),
            _ => (&mut self.entry, self.entries.len().saturating_sub(1)),
        };
        *row = row.saturating_add_signed(by.into()).min(last);
    }

    /// The choice with the cursor; none where that is on the form.
    fn listed<'a>(&self, model: &'a AppModel) -> Option<&'a Choice> {
        model.choices.get(self.row.checked_sub(1)?)
    }

    /// Asks for another value of a field of what the cursor is on.
    fn edit(&mut self, model: &mut AppModel) {
        let listed = self.listed(model);
        let place = match self.pane {
            LIST => self.place_of(listed.map_or(FORM, |choice| &choice.name)),
            _ => self.sorted().get(self.entry).copied(),
        };
        let marked = place.map(|at| &self.entries[at]);
        let named = marked.map(|entry| (&entry.name, &entry.scenario));
        let preset = || listed.and_then(|of| Some((&of.name, of.scenario.as_ref().ok()?)));
        let what = named.or_else(preset);
        let Some((name, scenario)) = what.filter(|(name, _)| *name != FORM) else {
            return model.notice = Some("F1 edits the form".to_owned());
        };
        if let Some(what) = Changing::of(name, scenario) {
            model.overlay = Some(Overlay::Change(Box::new(what)));
        }
    }

    fn change_column(&mut self, by: isize) {
        let last = self.columns().len() - 1;
        self.column = self.column.saturating_add_signed(by).min(last);
    }

    /// Takes the next curve that any of the answers has.
    fn next_curve(&mut self) {
        let there = |course: &Trace| {
            let has = |traces: &Traces| !course.values(traces).is_empty();
            let mut answers = self.entries.iter().filter_map(|entry| entry.answer());
            answers.any(|answer| answer.run.traces.as_ref().is_some_and(has))
        };
        let all: Vec<Trace> = drawn().collect();
        self.curve = Some(next_of(&all, self.curve(), there));
    }

    /// Marks what the cursor is on, or unmarks it.
    fn mark_row(&mut self, model: &mut AppModel) {
        let outcome = match self.listed(model) {
            Some(choice) => self.mark(&choice.name, choice.scenario.as_ref()),
            None if self.row == 0 => self.mark(FORM, Ok(&model.work.scenario)),
            None => Ok(()),
        };
        model.notice = outcome.err();
    }

    /// Opens the list that is searched by letters, at a name.
    fn open_list(&self, model: &mut AppModel, at: &str) {
        let names = model.choices.iter().map(|choice| &choice.name);
        let marked = names.filter(|name| self.place_of(name).is_some());
        let mut picker = Picker::at(&model.choices, at);
        picker.marked = Some(marked.cloned().collect());
        model.overlay = Some(Overlay::Picker(picker));
    }
}
