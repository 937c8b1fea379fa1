//! Several scenarios side by side: what came of each with the errors of step and mesh, which
//! results are worth a column, and which blow is worse.
//!
//! [`compare`] answers them on all cores; what one of them refuses is kept beside the others.

use std::borrow::Borrow;
use std::cmp::Ordering;
use std::sync::atomic::AtomicBool;
use std::sync::{Mutex, PoisonError};

use crate::answer::mesh_error::{add_mesh_error, is_asked};
use crate::answer::{solve::Answer, solve::solve};
use crate::run::refusal::unstopped;
use crate::run::{kept::Keep, ordered, ordered::until, quantity::Quantity, refusal::Refusal};
use crate::scenario::{CheckedScenario, Scenario};

/// The share of the progress of an answer that stands for its first run.
const FIRST_RUN: f64 = 0.04;

/// The answer to a scenario, as far as it is known; a screen may wrap it into what it draws.
#[derive(Debug, Clone)]
pub enum Found<A = Answer> {
    /// It is still being computed.
    Awaited,
    /// Its answer.
    Answer(A),
    /// Why there is none.
    Refused(String),
}

/// One of the scenarios.
#[derive(Debug, Clone)]
pub struct Entry<A = Answer> {
    /// The preset, the file or the place in a list that it was asked for by.
    pub name: String,
    /// The scenario.
    pub scenario: Scenario,
    /// Its answer, or why there is none.
    pub found: Found<A>,
    /// Whether its mesh error was refused.
    pub without_mesh: bool,
}

impl<A: Borrow<Answer>> Entry<A> {
    /// An entry without an answer yet.
    pub fn new(name: &str, scenario: &Scenario) -> Self {
        let (name, scenario) = (name.to_owned(), scenario.clone());
        Self { name, scenario, found: Found::Awaited, without_mesh: false }
    }

    /// The answer, if there is one.
    pub fn answer(&self) -> Option<&Answer> {
        if let Found::Answer(answer) = &self.found { Some(answer.borrow()) } else { None }
    }

    /// Why there is no answer, if it was refused.
    pub fn refused(&self) -> Option<&str> {
        if let Found::Refused(why) = &self.found { Some(why) } else { None }
    }
}

/// A column of the table.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ComparisonColumn {
    /// The name of each scenario.
    Name,
    /// One result; of an injury the range of its risk stands there.
    Result(Quantity),
}

impl ComparisonColumn {
    /// The value of an answer in this column, where it has one.
    pub fn of(self, answer: &Answer) -> Option<f64> {
        if let Self::Result(quantity) = self { answer.result(quantity) } else { None }
    }

    /// Whether the column is the risk of an injury.
    pub fn is_risk(self) -> bool {
        matches!(self, Self::Result(of) if of.is_risk())
    }

    /// Place from the left: risks, what acts on the eye, the rest.
    fn rank(self) -> u8 {
        match self {
            _ if self.is_risk() => 0,
            Self::Result(Quantity::Pressure | Quantity::ScleralStress | Quantity::Contact) => 1,
            _ => 2,
        }
    }
}

/// The order of two in a column, the largest first or last; what has none is last either way.
pub fn order<A: Borrow<Answer>>(
    a: &Entry<A>,
    b: &Entry<A>,
    (column, largest): (ComparisonColumn, bool),
) -> Ordering {
    let value = |entry: &Entry<A>| column.of(entry.answer()?);
    match (column, value(a), value(b)) {
        (ComparisonColumn::Name, ..) if largest => b.name.cmp(&a.name),
        (ComparisonColumn::Name, ..) => a.name.cmp(&b.name),
        (_, Some(a), Some(b)) if largest => b.total_cmp(&a),
        (_, Some(a), Some(b)) => a.total_cmp(&b),
        (_, a, b) => b.is_some().cmp(&a.is_some()),
    }
}

/// The names, then the risks and other results that some answer has, or all before there are any.
pub fn columns<A: Borrow<Answer>>(entries: &[Entry<A>]) -> Vec<ComparisonColumn> {
    let answers = || entries.iter().filter_map(Entry::answer);
    let none = answers().next().is_none();
    let there = |column: &ComparisonColumn| none || answers().any(|a| column.of(a).is_some());
    let results = Quantity::ALL.iter().map(|of| ComparisonColumn::Result(*of));
    let mut columns: Vec<ComparisonColumn> = results.filter(there).collect();
    columns.sort_by_key(|column| column.rank());
    columns.insert(0, ComparisonColumn::Name);
    columns
}

/// The results worth printing: the risks, those that lead in an entry, and the one that sorts.
pub fn leading(entries: &[Entry], sorted_by: Option<Quantity>) -> Vec<Quantity> {
    let worth = |of: Quantity| {
        entries.iter().filter_map(Entry::answer).any(|answer| {
            let results = answer.results();
            let leads = results.leading().any(|(leading, _)| leading == of);
            leads || of.is_risk() && results[of].is_some()
        })
    };
    let all = Quantity::ALL.iter().copied();
    let mut shown: Vec<Quantity> = all.filter(|of| worth(*of) || sorted_by == Some(*of)).collect();
    shown.sort_by_key(|of| !of.is_risk());
    shown
}

/// Answers all in order; `keep` says what each recording holds, `progress` is told the share done.
///
/// # Errors
/// Where `stop` was set meanwhile.
pub fn compare(
    asked: &[(String, CheckedScenario)],
    keep: impl Fn(&CheckedScenario) -> Keep + Sync,
    stop: &AtomicBool,
    progress: impl FnMut(f64) + Send,
) -> Result<Vec<Entry>, Refusal> {
    let told = Mutex::new((vec![0.0; asked.len()], progress));
    let tell = |at: usize, share: f64| {
        let mut told = told.lock().unwrap_or_else(PoisonError::into_inner);
        let (shares, progress) = &mut *told;
        shares[at] = share;
        progress(shares.iter().sum::<f64>() / shares.len() as f64);
    };
    let solved = |at: usize, scenario: &CheckedScenario| {
        let mut watch = |share| {
            tell(at, FIRST_RUN * share);
            until(stop)(share)
        };
        let mut answer = solve(scenario, keep(scenario), &mut watch)?;
        if is_asked(scenario) {
            add_mesh_error(scenario, &mut answer, &mut |share| {
                tell(at, FIRST_RUN + (1.0 - FIRST_RUN) * share);
                until(stop)(share)
            })?;
        }
        Ok(answer)
    };
    let job = |at: usize| {
        let (name, scenario) = &asked[at];
        let solved = unstopped(solved(at, scenario))?;
        tell(at, 1.0);
        let refused = |refusal: Refusal| Found::Refused(refusal.to_string());
        let found = solved.map_or_else(refused, Found::Answer);
        Some(Entry { found, ..Entry::new(name, scenario) })
    };
    ordered::all(asked.len(), stop, job, |_| {})
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scenario::set::set;

    fn of(force: &str) -> (String, CheckedScenario) {
        let mut scenario = Scenario { window_ms: Some(0.3), ..Scenario::default() };
        set(&mut scenario, "impact.force_n", force).unwrap();
        (force.to_owned(), scenario.check().unwrap())
    }

    #[test]
    fn entries_keep_their_order_until_they_are_sorted_and_have_both_errors() {
        let asked = vec![of("100"), of("300"), of("200")];
        let stop = AtomicBool::new(false);
        let mut entries = compare(&asked, |_| Keep::default(), &stop, |_| {}).unwrap();
        let names = |entries: &[Entry]| entries.iter().map(|e| e.name.clone()).collect::<Vec<_>>();
        assert_eq!(names(&entries), ["100", "300", "200"]);
        entries.sort_by(|a, b| order(a, b, (ComparisonColumn::Result(Quantity::Apex), true)));
        assert_eq!(names(&entries), ["300", "200", "100"]);
        assert!(entries.iter().all(|entry| entry.answer().unwrap().errors.mesh.is_some()));
        let columns = leading(&entries, Some(Quantity::StoredEnergy));
        assert!(columns.contains(&Quantity::StoredEnergy) && !columns.contains(&Quantity::Contact));
        let stopped = AtomicBool::new(true);
        assert!(compare(&asked, |_| Keep::default(), &stopped, |_| {}).is_err());
    }
}
