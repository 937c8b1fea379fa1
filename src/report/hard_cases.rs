//! The hard cases as a table of 80 columns and as JSON. The names are a contract.

use crate::report::format::{WIDTH, percent, wrapped};
use crate::verify::hard_cases::{CaseOutcome, CaseVerdict};
use serde_json::{Value, json};
use std::io::{self, Write};

/// Columns that a note is moved in.
const INDENT: usize = 4;

fn flags(outcome: &CaseOutcome) -> Vec<&'static str> {
    outcome.flags.iter().map(|kind| kind.name()).collect()
}

/// Prints the table.
pub fn text(outcomes: &[CaseOutcome], out: &mut dyn Write) -> io::Result<()> {
    writeln!(
        out,
        "{:<29}{:<16}{:>11}{:>12}{:>12}",
        "case", "verdict", "true error", "claimed", "energy"
    )?;
    let shown = |value: Option<f64>| value.map_or_else(|| "-".to_owned(), percent);
    for outcome in outcomes {
        writeln!(
            out,
            "{:<29}{:<16}{:>11}{:>12}{:>12}",
            outcome.name,
            outcome.verdict.name(),
            shown(outcome.true_error),
            shown(outcome.claimed_error),
            shown(outcome.energy_balance),
        )?;
        let mut parts = flags(outcome).join(", ");
        if !outcome.note.is_empty() {
            if !parts.is_empty() {
                parts.push_str("; ");
            }
            parts.push_str(&outcome.note);
        }
        for line in wrapped(&parts, WIDTH - INDENT) {
            writeln!(out, "{:INDENT$}{line}", "")?;
        }
    }
    let count = |verdict| outcomes.iter().filter(|o| o.verdict == verdict).count();
    writeln!(
        out,
        "\n{} cases: {} accurate, {} flagged, {} not predictable, {} refused, {} wrong",
        outcomes.len(),
        count(CaseVerdict::Accurate),
        count(CaseVerdict::Flagged),
        count(CaseVerdict::NotPredictable),
        count(CaseVerdict::Refused),
        count(CaseVerdict::Wrong),
    )?;
    writeln!(
        out,
        "True error: the largest of damage, apex displacement and four peak forces,\n\
         against references of much shorter steps on the same mesh. Claimed: step error.\n\
         Energy: what the energies miss of the work in."
    )
}

/// The table as one JSON object.
pub fn json(outcomes: &[CaseOutcome]) -> Value {
    let cases: Vec<Value> = outcomes
        .iter()
        .map(|outcome| {
            json!({
                "name": outcome.name,
                "stresses": outcome.stresses,
                "verdict": outcome.verdict.name(),
                "true_error_percent": outcome.true_error,
                "claimed_error_percent": outcome.claimed_error,
                "energy_balance_percent": outcome.energy_balance,
                "flags": flags(outcome),
                "note": outcome.note,
            })
        })
        .collect();
    json!({ "cases": cases })
}
