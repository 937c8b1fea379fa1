//! The hard cases as a table of 80 columns and as JSON. The names are a contract.

use crate::report::format::{block, or_dash, percent};
use crate::verify::hard_cases::{CaseOutcome, CaseVerdict};
use serde_json::{Value, json};
use std::io::{self, Write};

fn flags(outcome: &CaseOutcome) -> Vec<&'static str> {
    outcome.flags.iter().map(|kind| kind.name()).collect()
}

pub fn text(outcomes: &[CaseOutcome], out: &mut dyn Write) -> io::Result<()> {
    let line = |[name, verdict, truth, claimed, energy]: [&str; 5]| {
        format!("{name:<29}{verdict:<16}{truth:>11}{claimed:>12}{energy:>12}")
    };
    writeln!(out, "{}", line(["case", "verdict", "true error", "claimed", "energy"]))?;
    for outcome in outcomes {
        let errors = [outcome.true_error, outcome.claimed_error, outcome.energy_balance];
        let [truth, claimed, energy] = errors.map(|error| or_dash(error, percent));
        let verdict = outcome.verdict.name();
        writeln!(out, "{}", line([outcome.name, verdict, &truth, &claimed, &energy]))?;
        let mut notes = vec![flags(outcome).join(", "), outcome.note.clone()];
        notes.retain(|note| !note.is_empty());
        block(&notes.join("; "), "    ", "    ", out)?;
    }
    let count = |verdict| outcomes.iter().filter(|outcome| outcome.verdict == verdict).count();
    let [accurate, flagged] = [CaseVerdict::Accurate, CaseVerdict::Flagged].map(count);
    let [unpredictable, refused] = [CaseVerdict::NotPredictable, CaseVerdict::Refused].map(count);
    let (cases, wrong) = (outcomes.len(), count(CaseVerdict::Wrong));
    write!(out, "\n{cases} cases: {accurate} accurate, {flagged} flagged, ")?;
    writeln!(out, "{unpredictable} not predictable, {refused} refused, {wrong} wrong")?;
    writeln!(out, "True error: the largest of damage, apex displacement and four peak forces,")?;
    let against = "against references of much shorter steps on the same mesh";
    writeln!(out, "{against}. Claimed: step error.\nEnergy: what the energies miss of the work in.")
}

pub fn json(outcomes: &[CaseOutcome]) -> Value {
    let case = |outcome: &CaseOutcome| {
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
    };
    json!({ "cases": outcomes.iter().map(case).collect::<Value>() })
}
