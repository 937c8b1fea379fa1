//! The presets marked for comparison, their answers, and the order of the table.

use std::cmp::Ordering;

use super::SimulateMarked;
use crate::scenario::Scenario;
use crate::study::course::Course;
use crate::study::{Answer, Quantity};
use crate::tui::model::Shown;
use crate::tui::task::Task;

/// The name under which the form stands in the list.
pub const FORM: &str = "(the form)";
/// As many as fit side by side.
pub const MAX_MARKED: usize = 6;

/// A column of the table.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Column {
    /// The preset's name.
    Name,
    /// One result.
    Result(Quantity),
    /// The step error.
    Error,
}

impl Column {
    /// The value of an answer in this column, where it has one.
    pub fn of(self, answer: &Answer) -> Option<f64> {
        match self {
            Self::Name => None,
            Self::Result(quantity) => answer.result(quantity),
            Self::Error => Some(answer.errors.time_step_percent()),
        }
    }
}

/// What is known of an entry.
#[derive(Debug, Clone)]
pub enum Found {
    /// Nothing yet.
    Awaited,
    /// Its answer.
    Answer(Box<Shown>),
    /// Why there is none.
    Refused(String),
}

/// A marked scenario.
#[derive(Debug, Clone)]
pub struct Entry {
    /// Its name in the list.
    pub name: String,
    /// What is simulated.
    pub scenario: Scenario,
    /// What came of it.
    pub found: Found,
}

impl Entry {
    /// The answer, if there is one.
    pub fn answer(&self) -> Option<&Answer> {
        match &self.found {
            Found::Answer(shown) => Some(&shown.answer),
            _ => None,
        }
    }
}

/// The comparison.
#[derive(Debug, Default)]
pub struct Comparison {
    /// What is marked, in the order of marking; differences are against the first.
    pub entries: Vec<Entry>,
    /// The row with the cursor in the list of presets.
    pub row: usize,
    /// The column with the cursor.
    pub column: usize,
    /// The column that sorts the table, and whether the largest comes first.
    pub sort: Option<(Column, bool)>,
    /// The curve below the table.
    pub curve: Course,
    /// The entry that is being simulated.
    pub task: Task<SimulateMarked>,
}

impl Comparison {
    /// Marks or unmarks; says so if there is no room.
    ///
    /// # Errors
    /// Where six are marked already.
    pub fn mark(&mut self, name: &str, scenario: &Scenario) -> Result<(), String> {
        if let Some(at) = self.entries.iter().position(|entry| entry.name == name) {
            self.entries.remove(at);
            return Ok(());
        }
        if self.entries.len() == MAX_MARKED {
            return Err(format!("{MAX_MARKED} are marked already: unmark one first"));
        }
        self.entries.push(Entry {
            name: name.to_owned(),
            scenario: scenario.clone(),
            found: Found::Awaited,
        });
        Ok(())
    }

    /// Whether a name is marked.
    pub fn is_marked(&self, name: &str) -> bool {
        self.entries.iter().any(|entry| entry.name == name)
    }

    /// The entry of that name takes another scenario, if it is marked and differs.
    pub fn replace(&mut self, name: &str, scenario: &Scenario) {
        let entry = self.entries.iter_mut().find(|entry| entry.name == name);
        if let Some(entry) = entry
            && entry.scenario != *scenario
        {
            entry.scenario = scenario.clone();
            entry.found = Found::Awaited;
        }
    }

    /// The next entry to simulate.
    pub fn next(&self) -> Option<&Entry> {
        let awaited = |entry: &&Entry| matches!(entry.found, Found::Awaited);
        self.entries.iter().find(awaited)
    }

    /// Takes in what came of an entry.
    pub fn take(&mut self, name: &str, found: Found) {
        if let Some(entry) = self.entries.iter_mut().find(|entry| entry.name == name) {
            entry.found = found;
        }
    }

    /// The columns, from the left: the results that some answer has, each in every scene that has it.
    pub fn columns(&self) -> Vec<Column> {
        let answers = || self.entries.iter().filter_map(Entry::answer);
        let none = answers().next().is_none();
        let there = |column: &Column| none || answers().any(|a| column.of(a).is_some());
        let results = Quantity::ALL.iter().map(|of| Column::Result(*of));
        let results = results.filter(there);
        std::iter::once(Column::Name)
            .chain(results)
            .chain([Column::Error])
            .collect()
    }

    /// The column with the cursor.
    pub fn here(&self) -> Column {
        let columns = self.columns();
        columns[self.column.min(columns.len() - 1)]
    }

    /// Sorts by the column with the cursor; a second time, the other way round.
    pub fn sort_here(&mut self) {
        let here = self.here();
        self.sort = match self.sort {
            Some((column, largest)) if column == here => Some((column, !largest)),
            _ => Some((here, here != Column::Name)),
        };
    }

    /// The entries in the order of the table.
    pub fn sorted(&self) -> Vec<&Entry> {
        let mut entries: Vec<&Entry> = self.entries.iter().collect();
        let Some((column, largest)) = self.sort else {
            return entries;
        };
        entries.sort_by(|a, b| {
            let value = |entry: &Entry| column.of(entry.answer()?);
            let order = match (column, value(a), value(b)) {
                (Column::Name, ..) => a.name.cmp(&b.name),
                (_, Some(a), Some(b)) => a.total_cmp(&b),
                // What has no value comes last either way.
                (_, a, b) => return b.is_some().cmp(&a.is_some()),
            };
            if largest { order.reverse() } else { order }
        });
        entries
    }

    /// The longest window of the answers, in s.
    pub fn window(&self) -> Option<f64> {
        let windows = self
            .entries
            .iter()
            .filter_map(|e| Some(e.answer()?.window()));
        windows.max_by(|a, b| a.partial_cmp(b).unwrap_or(Ordering::Equal))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::recording::Keep;
    use crate::scenario::library;
    use crate::study::{solve, unwatched};

    fn filled() -> Comparison {
        let mut comparison = Comparison::default();
        for name in ["paper-300n", "paper-100n", "paper-600n"] {
            let scenario = library::find(name).unwrap().scenario().unwrap();
            comparison.mark(name, &scenario).unwrap();
            let checked = scenario.check().unwrap();
            let answer = solve(&checked, Keep::default(), &mut unwatched).unwrap();
            comparison.take(name, Found::Answer(Shown::new(scenario, answer).into()));
        }
        comparison
    }

    fn order(comparison: &Comparison) -> Vec<&str> {
        let sorted = comparison.sorted();
        sorted.iter().map(|entry| entry.name.as_str()).collect()
    }

    #[test]
    fn the_table_sorts_by_every_column_both_ways() {
        let mut comparison = filled();
        assert_eq!(
            order(&comparison),
            ["paper-300n", "paper-100n", "paper-600n"]
        );
        comparison.sort_here();
        assert_eq!(
            order(&comparison),
            ["paper-100n", "paper-300n", "paper-600n"]
        );
        let columns = comparison.columns();
        let pressure = Column::Result(Quantity::Pressure);
        assert!(
            !columns.contains(&pressure),
            "what no scene has takes no column"
        );
        for (index, column) in columns.iter().enumerate().skip(1) {
            comparison.column = index;
            comparison.sort_here();
            let values = |c: &Comparison| -> Vec<f64> {
                let sorted = c.sorted();
                let value = |e: &&Entry| column.of(e.answer().unwrap()).unwrap();
                sorted.iter().map(value).collect()
            };
            assert!(values(&comparison).is_sorted_by(|a, b| a >= b));
            comparison.sort_here();
            assert!(values(&comparison).is_sorted());
        }
    }

    #[test]
    fn six_may_be_marked_and_marking_again_unmarks() {
        let mut comparison = Comparison::default();
        for name in ["a", "b", "c", "d", "e", "f"] {
            comparison.mark(name, &Scenario::default()).unwrap();
        }
        assert!(comparison.mark("g", &Scenario::default()).is_err());
        comparison.mark("a", &Scenario::default()).unwrap();
        assert!(!comparison.is_marked("a") && comparison.entries.len() == 5);
    }
}
