//! The presets marked for comparison, and how they are shown.

use std::sync::Arc;

use crate::answer::mesh_error::MeshError;
use crate::answer::solve::Answer;
use crate::many::comparison::{ComparisonColumn, Entry, Found, columns, order};
use crate::plain_text::quoted;
use crate::run::trace::{OtherTrace, Trace};
use crate::run::{kept::Traces, quantity::Quantity, refusal::Refusal, watch::Watch};
use crate::scenario::Scenario;
use crate::tui::simulation::{Complete, Simulate};
use crate::tui::{changing::began_as, request::TaskQuestion, shown::ShownAnswer, task::Task};

/// The name under which the form stands in the list.
pub const FORM: &str = "(the form)";
/// As many as fit side by side.
pub const MAX_MARKED: usize = 6;

/// The places of the panes.
pub const LIST: usize = 0;
pub const TABLE: usize = 1;
pub const REPLAYS: usize = 2;

/// A question about a marked scenario.
pub struct OfMarked<Q> {
    pub name: String,
    /// What is simulated for its column.
    pub scenario: Scenario,
    question: Q,
}

/// Asks for its answer.
pub type SimulateMarked = OfMarked<Simulate>;
/// Asks for the mesh error of its answer.
pub type CompleteMarked = OfMarked<Complete>;

impl<Q> OfMarked<Q> {
    pub fn new(entry: &Marked, question: Q) -> Self {
        Self { name: entry.name.clone(), scenario: entry.scenario.clone(), question }
    }

    fn is_of(&self, entry: &Marked) -> bool {
        (&self.name, &self.scenario) == (&entry.name, &entry.scenario)
    }
}

impl<Q: TaskQuestion> TaskQuestion for OfMarked<Q> {
    type Answer = Q::Answer;

    fn answer(&self, watch: Watch) -> Result<Q::Answer, Refusal> {
        self.question.answer(watch)
    }
}

/// What stands at the same time in all replays and curves.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Alignment {
    /// The beginning.
    #[default]
    Clock,
    /// The first contact, of a pulse the beginning of its load.
    Contact,
    /// The moment at which the cornea stands deepest.
    Deepest,
}

impl Alignment {
    #[must_use]
    pub fn next(self) -> Self {
        [Self::Contact, Self::Deepest, Self::Clock][self as usize]
    }

    pub fn words(self) -> &'static str {
        match self {
            Self::Clock => "same time from the start",
            Self::Contact => "same time from first contact",
            Self::Deepest => "same time from where deepest",
        }
    }

    /// When that is in an answer, in s.
    fn moment(self, answer: &Answer) -> f64 {
        match self {
            Self::Clock => 0.0,
            Self::Contact => answer.run.traces.as_ref().map_or(0.0, first_contact),
            Self::Deepest => answer.peak(Quantity::Apex).map_or(0.0, |apex| apex.time),
        }
    }
}

/// The last time before anything acts on the eye, in s.
fn first_contact(traces: &Traces) -> f64 {
    let drive = Trace::Other(OtherTrace::Drive).values(traces);
    let first = drive.iter().position(|force| *force > 0.0);
    let before = first.unwrap_or(0).saturating_sub(1);
    traces.time.get(before).copied().unwrap_or(0.0)
}

/// A marked scenario, with what pictures are made of.
pub type Marked = Entry<Box<ShownAnswer>>;

/// What pictures of an entry are made of, once it has its answer.
pub fn shown(entry: &Marked) -> Option<&ShownAnswer> {
    if let Found::Answer(shown) = &entry.found { Some(shown) } else { None }
}

/// The question for the mesh error of an entry, where that is still to come.
pub fn mesh_question(entry: &Marked) -> Option<Complete> {
    Complete::of(&entry.scenario, entry.answer()?).filter(|_| !entry.without_mesh)
}

#[derive(Default)]
pub struct Comparison {
    pub pane: usize,
    /// What is marked, in the order of marking; differences are against the first.
    pub entries: Vec<Marked>,
    /// The row with the cursor in the list of presets.
    pub row: usize,
    /// The row with the cursor in the table.
    pub entry: usize,
    pub column: usize,
    /// The column that sorts the table, and whether the largest comes first.
    pub sort: Option<(ComparisonColumn, bool)>,
    /// Whether the rows stay where they are until somebody sorts them.
    pub fixed: bool,
    /// The curve below the table, once one was chosen.
    pub curve: Option<Trace>,
    pub alignment: Alignment,
    /// The entry that is being simulated.
    pub task: Task<SimulateMarked>,
    /// The entry whose answer is being completed.
    pub rest: Task<CompleteMarked>,
}

impl Comparison {
    /// Marks one more; an error says that six are marked already.
    pub(super) fn add(&mut self, name: &str, scenario: &Scenario) -> Result<(), String> {
        if self.entries.len() == MAX_MARKED {
            return Err(format!("{MAX_MARKED} are marked already: unmark one first"));
        }
        self.entries.push(Entry::new(name, scenario));
        Ok(())
    }

    /// Marks a preset, or unmarks what began as it; an error says why it cannot be marked.
    pub(super) fn mark(
        &mut self,
        name: &str,
        scenario: Result<&Scenario, &String>,
    ) -> Result<(), String> {
        if let Some(at) = self.place_of(name) {
            self.entries.remove(at);
            return Ok(());
        }
        let scenario = scenario.map_err(|why| format!("{}: {why}", quoted(name)))?;
        self.add(name, scenario)
    }

    /// The place of what began as that preset among the entries.
    pub(super) fn place_of(&self, name: &str) -> Option<usize> {
        self.entries.iter().position(|entry| began_as(&entry.name, name))
    }

    /// Whether what a task is at is about an entry still.
    pub(super) fn awaits<Q>(&self, task: &Task<OfMarked<Q>>) -> bool {
        let asked = task.job.as_ref().map(|job| &job.question);
        asked.is_some_and(|asked| self.entries.iter().any(|entry| asked.is_of(entry)))
    }

    /// Where the form is marked, its entry takes the scenario of the form.
    pub(super) fn follow_form(&mut self, scenario: &Scenario) {
        let mut entries = self.entries.iter_mut();
        if let Some(entry) = entries.find(|e| e.name == FORM && e.scenario != *scenario) {
            *entry = Entry::new(FORM, scenario);
        }
    }

    /// The next entry to simulate.
    pub(super) fn next(&self) -> Option<&Marked> {
        let awaited = |entry: &&Marked| matches!(entry.found, Found::Awaited);
        self.entries.iter().find(awaited)
    }

    /// The entries whose mesh error is still to come, each with its question.
    pub(super) fn incomplete(&self) -> impl Iterator<Item = (&Marked, Complete)> {
        self.entries.iter().filter_map(|entry| Some((entry, mesh_question(entry)?)))
    }

    /// Changes an entry; the cursor of the table stays with its own, wherever that is sorted to.
    pub(super) fn keeping_row(&mut self, change: impl FnOnce(&mut Self)) {
        let chosen = self.sorted().get(self.entry).copied();
        change(self);
        let row = self.sorted().into_iter().position(|place| Some(place) == chosen);
        self.entry = row.unwrap_or(self.entry);
    }

    /// Takes in the mesh error of an entry, or that there is none.
    pub(super) fn complete(&mut self, asked: &CompleteMarked, mesh: Option<MeshError>) {
        self.keeping_row(|comparison| {
            let mut entries = comparison.entries.iter_mut();
            if let Some(entry) = entries.find(|entry| asked.is_of(entry))
                && let Found::Answer(shown) = &mut entry.found
            {
                let answer = Arc::make_mut(&mut shown.answer);
                if let Some(mesh) = mesh {
                    answer.add(mesh);
                }
                entry.without_mesh = answer.errors.mesh.is_none();
            }
        });
    }

    /// By how much the time shown of an answer is later than that of the first, in s.
    pub(super) fn shift(&self, answer: &Answer) -> f64 {
        let first = self.entries.iter().find_map(Entry::answer);
        let moment = |answer| self.alignment.moment(answer);
        moment(answer) - first.map_or(0.0, moment)
    }

    /// Takes in what came of an entry.
    pub(super) fn set_found(&mut self, name: &str, found: Found<Box<ShownAnswer>>) {
        self.keeping_row(|comparison| {
            let mut entries = comparison.entries.iter_mut();
            if let Some(entry) = entries.find(|entry| entry.name == name) {
                entry.found = found;
            }
        });
    }

    pub(super) fn columns(&self) -> Vec<ComparisonColumn> {
        columns(&self.entries)
    }

    /// The column with the cursor.
    pub(super) fn here(&self) -> ComparisonColumn {
        let columns = self.columns();
        columns[self.column.min(columns.len() - 1)]
    }

    /// Sorts by the column with the cursor; a second time, the other way round.
    pub(super) fn sort_here(&mut self) {
        let here = self.here();
        self.sort = match self.sorting() {
            Some((column, largest)) if column == here => Some((column, !largest)),
            _ => Some((here, here != ComparisonColumn::Name)),
        };
    }

    /// The column that sorts the table: by itself the risk of the gravest injury, if there is one.
    pub(super) fn sorting(&self) -> Option<(ComparisonColumn, bool)> {
        let first = self.columns().into_iter().nth(1);
        let risk = first.filter(|column| column.is_risk());
        let own = risk.filter(|_| !self.fixed).map(|column| (column, true));
        self.sort.or(own)
    }

    /// Keeps the rows in the order that they have now: who edits one goes on to the next.
    pub(super) fn fix_order(&mut self) {
        if let Some(by) = self.sorting() {
            self.entries.sort_by(|a, b| order(a, b, by));
        }
        (self.sort, self.fixed) = (None, true);
    }

    /// The places of the entries, in the order of the table.
    pub(super) fn sorted(&self) -> Vec<usize> {
        let mut places: Vec<usize> = (0..self.entries.len()).collect();
        if let Some(by) = self.sorting() {
            places.sort_by(|a, b| order(&self.entries[*a], &self.entries[*b], by));
        }
        places
    }

    /// The curve below the table: by itself the pressure, where there is one.
    pub(super) fn curve(&self) -> Trace {
        let mut answers = self.entries.iter().filter_map(Entry::answer);
        let pressed = answers.any(|answer| answer.result(Quantity::Pressure).is_some());
        let own = if pressed { Trace::Of(Quantity::Pressure) } else { Trace::default() };
        self.curve.unwrap_or(own)
    }

    /// The longest window of the answers, in s.
    pub(super) fn window(&self) -> Option<f64> {
        let windows = self.entries.iter().filter_map(|e| Some(e.answer()?.window()));
        windows.max_by(f64::total_cmp)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::answer::solve::solve;
    use crate::injury::Injury;
    use crate::report::compare::which_is_worse;
    use crate::run::{kept::Keep, watch::unwatched};
    use crate::scenario::library;

    /// These presets with their answers, of so many ms where they are told.
    fn answered(names: &[&str], keep: Keep, window_ms: Option<f64>) -> Comparison {
        let mut comparison = Comparison::default();
        for name in names {
            let mut scenario = library::find(name).unwrap().scenario().unwrap();
            scenario.window_ms = window_ms.or(scenario.window_ms);
            comparison.add(name, &scenario).unwrap();
            let answer = solve(&scenario.check().unwrap(), keep, &mut unwatched).unwrap();
            let shown = ShownAnswer::new(scenario, answer);
            comparison.set_found(name, Found::Answer(shown.into()));
        }
        comparison
    }

    fn order(comparison: &Comparison) -> Vec<String> {
        comparison.sorted().iter().map(|at| comparison.entries[*at].name.clone()).collect()
    }

    #[test]
    fn the_table_sorts_by_every_column_both_ways_and_the_cursor_stays_with_its_row() {
        let names = ["paper-300n", "paper-100n", "paper-600n"];
        let mut comparison = answered(&names, Keep::default(), None);
        assert_eq!(order(&comparison), names);
        comparison.sort_here();
        assert_eq!(order(&comparison), ["paper-100n", "paper-300n", "paper-600n"]);
        let columns = comparison.columns();
        let pressure = ComparisonColumn::Result(Quantity::Pressure);
        assert!(!columns.contains(&pressure), "what no scene has takes no column");
        for (index, column) in columns.iter().enumerate().skip(1) {
            comparison.column = index;
            let mut values = || -> Vec<f64> {
                comparison.sort_here();
                let entries = comparison.sorted().into_iter().map(|at| &comparison.entries[at]);
                entries.map(|e| column.of(e.answer().unwrap()).unwrap()).collect()
            };
            assert!(values().is_sorted_by(|a, b| a >= b));
            assert!(values().is_sorted());
        }
        for name in names {
            comparison.entry = order(&comparison).iter().position(|of| of == name).unwrap();
            comparison.set_found(name, Found::Awaited);
            assert_eq!(order(&comparison)[comparison.entry], name);
        }
    }

    #[test]
    fn objects_are_compared_by_the_gravest_risk_and_stand_at_the_same_moment() {
        let keep = Keep { traces: true, frames: None };
        let mut comparison = answered(&["bb-56", "bb-62"], keep, Some(0.5));
        let rupture = ComparisonColumn::Result(Quantity::GlobeRupture);
        let first = comparison.columns()[1];
        assert_eq!((first, comparison.sorting()), (rupture, Some((rupture, true))));
        assert_eq!(order(&comparison), ["bb-62", "bb-56"]);
        let (first, _) = comparison.incomplete().next().unwrap();
        assert_eq!(first.name, "bb-56", "in the order of marking");
        for injury in Injury::ALL {
            let columns = comparison.columns();
            let column = ComparisonColumn::Result(injury.result());
            comparison.column = columns.iter().position(|c| *c == column).unwrap();
            comparison.sort = None;
            comparison.sort_here();
            let largest = comparison.sort.is_some_and(|(_, largest)| largest);
            let values = comparison.sorted().into_iter().map(|at| {
                let answer = comparison.entries[at].answer().unwrap();
                answer.result(injury.result()).unwrap()
            });
            let right = |a: &f64, b: &f64| if largest { a >= b } else { a <= b };
            assert!(values.is_sorted_by(right), "{injury:?}");
        }
        comparison.sort = None;
        let said = which_is_worse(&comparison.entries).unwrap();
        assert!(said.starts_with("bb-62 is ") && said.ends_with('.'), "{said}");
        comparison.alignment = Alignment::Deepest;
        let deepest = |entry: &Marked| {
            let answer = entry.answer().unwrap();
            let own = answer.peak(Quantity::Apex).unwrap().time;
            own - comparison.shift(answer)
        };
        let times: Vec<f64> = comparison.entries.iter().map(deepest).collect();
        assert!(times[0] > 0.0 && (times[1] - times[0]).abs() < 1e-12);
        comparison.alignment = Alignment::Contact;
        let contact =
            |entry: &Marked| first_contact(entry.answer().unwrap().run.traces.as_ref().unwrap());
        assert!(comparison.entries.iter().all(|entry| contact(entry) < 1e-4));
    }
}
