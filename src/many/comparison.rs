//! Several scenarios answered side by side, each with the errors of step and mesh.
//!
//! They run on all cores; what one of them refuses is kept beside the answers of the others.

use std::cmp::Ordering;
use std::ops::ControlFlow;
use std::sync::atomic::{AtomicBool, Ordering as Memory};

use crate::answer::derived::Derived;
use crate::answer::mesh_error::add_mesh_error;
use crate::answer::solve::{Answer, solve};
use crate::many::ordered;
use crate::run::kept::Keep;
use crate::run::quantity::Quantity;
use crate::run::refusal::Refusal;
use crate::scenario::CheckedScenario;

/// One of them.
#[derive(Debug)]
pub struct Entry {
    /// What it was asked for by.
    pub source: String,
    /// What was simulated.
    pub scenario: CheckedScenario,
    /// What came of it, with its mesh error, or why nothing did.
    pub outcome: Result<Answer, String>,
}

impl Entry {
    /// A result, where there is one.
    pub fn result(&self, of: Quantity) -> Option<f64> {
        self.outcome.as_ref().ok()?.results()[of]
    }
}

/// Answers all of them, in their order; `keep` says what each scenario's recording holds. `heard` is told
/// how many are done of how many.
///
/// # Errors
/// Where `stop` was set meanwhile.
pub fn compare(
    asked: Vec<(String, CheckedScenario)>,
    keep: impl Fn(&CheckedScenario) -> Keep + Sync,
    stop: &AtomicBool,
    mut heard: impl FnMut(usize, usize) + Send,
) -> Result<Vec<Entry>, Refusal> {
    let solved = |at: usize| {
        let scenario = &asked[at].1;
        let mut watch = |_| {
            if stop.load(Memory::Relaxed) {
                ControlFlow::Break(())
            } else {
                ControlFlow::Continue(())
            }
        };
        let mut answer = solve(scenario, keep(scenario), &mut watch)?;
        add_mesh_error(scenario, &mut answer, &mut watch)?;
        Ok(answer)
    };
    let mut outcomes: Vec<Result<Answer, String>> = Vec::new();
    let job = |at: usize| match solved(at) {
        Err(Refusal::Cancelled) => None,
        outcome => Some(outcome.map_err(|refusal| refusal.to_string())),
    };
    ordered::run((0, asked.len()), stop, job, |at, outcome| {
        heard(at + 1, asked.len());
        outcomes.push(outcome);
        ControlFlow::Continue(())
    });
    if outcomes.len() < asked.len() {
        return Err(Refusal::Cancelled);
    }
    let entry = |((source, scenario), outcome)| Entry {
        source,
        scenario,
        outcome,
    };
    Ok(asked.into_iter().zip(outcomes).map(entry).collect())
}

/// The order of two blows by their values of one result, of a risk the point by the curve that is believed
/// first: the largest first or last, and what has none last either way.
pub fn order(a: Option<f64>, b: Option<f64>, largest: bool) -> Ordering {
    match (a, b) {
        (Some(a), Some(b)) if largest => b.total_cmp(&a),
        (Some(a), Some(b)) => a.total_cmp(&b),
        (a, b) => b.is_some().cmp(&a.is_some()),
    }
}

/// Sorts by a result, the largest first.
pub fn sort(entries: &mut [Entry], by: Quantity) {
    entries.sort_by(|a, b| order(a.result(by), b.result(by), true));
}

/// The results worth a column: those that lead in one of the entries, the risks that are believed first, and the one
/// that sorts.
pub fn columns(entries: &[Entry], sorted_by: Option<Quantity>) -> Vec<Quantity> {
    let answers = || {
        entries
            .iter()
            .filter_map(|entry| entry.outcome.as_ref().ok())
    };
    let worth = |of: Quantity| {
        let is_believed = matches!(of.derived(), Some(Derived::Believed(_)));
        answers().any(|answer| {
            let results = answer.results();
            let leads = results.leading().any(|(leading, _)| leading == of);
            leads || is_believed && results[of].is_some()
        })
    };
    let all = Quantity::ALL.iter().copied();
    all.filter(|of| worth(*of) || sorted_by == Some(*of))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scenario::Scenario;
    use crate::scenario::set::set;

    fn of(force: &str) -> (String, CheckedScenario) {
        let mut scenario = Scenario {
            window_ms: 0.3,
            ..Scenario::default()
        };
        set(&mut scenario, "impact.force_n", force).unwrap();
        (force.to_owned(), scenario.check().unwrap())
    }

    #[test]
    fn entries_keep_their_order_until_they_are_sorted_and_have_both_errors() {
        let asked = vec![of("100"), of("300"), of("200")];
        let stop = AtomicBool::new(false);
        let mut entries = compare(asked, |_| Keep::default(), &stop, |_, _| {}).unwrap();
        let names = |entries: &[Entry]| -> Vec<String> {
            entries.iter().map(|entry| entry.source.clone()).collect()
        };
        assert_eq!(names(&entries), ["100", "300", "200"]);
        sort(&mut entries, Quantity::Apex);
        assert_eq!(names(&entries), ["300", "200", "100"]);
        for entry in &entries {
            assert!(entry.outcome.as_ref().unwrap().errors.mesh.is_some());
        }
        let columns = columns(&entries, Some(Quantity::StoredEnergy));
        assert!(columns.contains(&Quantity::StoredEnergy) && !columns.contains(&Quantity::Contact));
        stop.store(true, Memory::Relaxed);
        assert!(compare(vec![of("100")], |_| Keep::default(), &stop, |_, _| {}).is_err());
    }
}
