//! How often the stated step or mesh errors hold, as text of 80 columns and as one JSON object.

use super::json::by_result;
use super::text::{WIDTH, wrapped};
use crate::study::coverage::{
    Checked, Coverage, Miss, REFERENCE_FINENESS, coverage, misses, scene,
};
use crate::study::{FINEST_LEVEL, Quantity, witnesses};
use serde_json::{Map, Value, json};
use std::io::{self, Write};

/// An error in percent with two digits, however small.
fn error(percent: f64) -> String {
    if percent == 0.0 || (1e-3..1e3).contains(&percent) {
        super::text::percent(percent)
    } else {
        format!("{percent:.1e} %")
    }
}

fn row(of: &Coverage, out: &mut dyn Write) -> io::Result<()> {
    writeln!(
        out,
        "{:<20}{:>9.1} %{:>16.1}{:>16}{:>16}",
        of.quantity.label(),
        of.within,
        of.median_ratio,
        error(of.median_truth),
        error(of.largest_truth)
    )
}

fn folded(checked: &[Checked]) -> Vec<u32> {
    let folded = checked.iter().filter(|c| c.folded);
    folded.map(|c| c.index).collect()
}

/// The results that some scenes claim nothing about though no mesh folded, and in how many.
fn without_claim(checked: &[Checked]) -> impl Iterator<Item = (Quantity, usize)> {
    let silent = |of: Quantity| {
        let here = |c: &&Checked| c.truth[of].is_some() && c.claimed[of].is_none();
        checked.iter().filter(here).count()
    };
    let counted = Quantity::ALL.iter().map(move |&of| (of, silent(of)));
    counted.filter(|(_, count)| *count > 0)
}

/// Prints the table of `checked`, scenes of `seed`, and every claim that did not hold. The claims are
/// mesh errors of answers at the level `mesh`, or step errors.
///
/// # Errors
/// Whatever `out` reports.
pub fn text(
    checked: &[Checked],
    seed: u32,
    mesh: Option<u32>,
    out: &mut dyn Write,
) -> io::Result<()> {
    let folded = folded(checked).len();
    let count = checked.len();
    match mesh {
        None => writeln!(
            out,
            "Stated step errors of {count} random scenes of seed {seed}, each against a reference\n\
             that takes {REFERENCE_FINENESS} times as many steps. Promised nothing, as the mesh folded: {folded}.\n"
        )?,
        Some(level) => {
            let [coarser, finer] = witnesses(level);
            writeln!(
                out,
                "Stated mesh errors at level {level} of {} random scenes of seed {seed}, each against\n\
                 level {FINEST_LEVEL}. Passed over, as a mesh of level {level}, {coarser}, {finer} or {FINEST_LEVEL} folds: {folded}.\n",
                count - folded
            )?;
        }
    }
    writeln!(
        out,
        "{:<20}{:>11}{:>16}{:>16}{:>16}",
        "", "within", "claimed/true", "true error", "true error"
    )?;
    writeln!(
        out,
        "{:<20}{:>11}{:>16}{:>16}{:>16}",
        "result", "the claim", "median", "median", "largest"
    )?;
    for of in coverage(checked) {
        row(&of, out)?;
    }
    if mesh.is_some() {
        let silent = without_claim(checked).map(|(of, count)| format!("{} {count}", of.label()));
        let list: Vec<String> = silent.collect();
        let text = format!("Scenes without a limit and a claim: {}.", list.join(", "));
        writeln!(out)?;
        for line in wrapped(&text, WIDTH) {
            writeln!(out, "{line}")?;
        }
    }
    let misses = misses(checked);
    if misses.is_empty() {
        return writeln!(out, "\nEvery claim held.");
    }
    writeln!(out, "\nClaims that did not hold: {}", misses.len())?;
    writeln!(
        out,
        "{:<8}{:<20}{:>14}{:>14}",
        "scene", "result", "claimed", "true"
    )?;
    for miss in misses {
        writeln!(
            out,
            "{:<8}{:<20}{:>14}{:>14}",
            miss.index,
            miss.quantity.label(),
            error(miss.claimed),
            error(miss.truth)
        )?;
    }
    Ok(())
}

fn miss(of: &Miss, seed: u32) -> Value {
    json!({
        "scene": of.index,
        "result": of.quantity.key(),
        "claimed_percent": of.claimed,
        "true_percent": of.truth,
        "scenario": scene(of.index, seed),
    })
}

/// The same as one object. A miss comes with its scenario, to be run again.
pub fn json(checked: &[Checked], seed: u32, mesh: Option<u32>) -> Value {
    let misses = misses(checked);
    let missed = |quantity: Quantity| misses.iter().filter(|m| m.quantity == quantity).count();
    let results: Vec<Value> = coverage(checked)
        .iter()
        .map(|of| {
            json!({
                "result": of.quantity.key(),
                "within_percent": of.within,
                "misses": missed(of.quantity),
                "median_claimed_over_true": of.median_ratio,
                "median_true_percent": of.median_truth,
                "largest_true_percent": of.largest_truth,
            })
        })
        .collect();
    json!({
        "scenes": checked.len(),
        "seed": seed,
        "mesh_level": mesh,
        "reference_level": mesh.map(|_| FINEST_LEVEL),
        "reference_fineness": mesh.is_none().then_some(REFERENCE_FINENESS),
        "without_claim": without_claim(checked)
            .map(|(of, count)| (of.key().to_owned(), count.into()))
            .collect::<Map<String, Value>>(),
        "folded_scenes": folded(checked),
        "results": results,
        "by_scene": checked.iter().map(|c| json!({
            "scene": c.index,
            "folded": c.folded,
            "claimed_percent": by_result(&c.claimed),
            "true_percent": by_result(&c.truth),
        })).collect::<Vec<_>>(),
        "misses": misses.iter().map(|m| miss(m, seed)).collect::<Vec<_>>(),
    })
}
