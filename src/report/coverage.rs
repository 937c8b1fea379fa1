//! How often the stated step or mesh errors hold, as text of 80 columns and as one JSON object.

use crate::answer::mesh_error::witnesses;
use crate::report::json::by_result;
use crate::report::text::block;
use crate::run::quantity::Quantity;
use crate::verify::coverage::{Checked, Coverage, Drawn, Miss, coverage, misses};
use crate::verify::mesh_coverage::reference;
use serde_json::{Map, Value, json};
use std::io::{self, Write};

/// An error in percent with two digits, however small.
fn error(percent: f64) -> String {
    if percent == 0.0 || (1e-3..1e3).contains(&percent) {
        crate::report::text::percent(percent)
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

/// What was checked.
#[derive(Debug, Clone, Copy)]
pub struct Asked {
    /// What the scenes are.
    pub drawn: Drawn,
    /// Which of them.
    pub seed: u32,
    /// The level whose mesh errors are the claims; none if they are step errors.
    pub mesh: Option<u32>,
}

impl Asked {
    fn scenes(self) -> &'static str {
        match self.drawn {
            Drawn::Pulses => "random pulses",
            Drawn::Objects => "random objects",
        }
    }

    fn promised_nothing(self) -> &'static str {
        match self.drawn {
            Drawn::Pulses => "as a mesh folded",
            Drawn::Objects => "as a mesh folded or the object went through",
        }
    }
}

/// Prints the table of `checked` and every claim that did not hold.
///
/// # Errors
/// Whatever `out` reports.
pub fn text(checked: &[Checked], asked: Asked, out: &mut dyn Write) -> io::Result<()> {
    let Asked { drawn, seed, mesh } = asked;
    let (scenes, why) = (asked.scenes(), asked.promised_nothing());
    let folded = folded(checked).len();
    let count = checked.len();
    let head = match mesh {
        None => format!(
            "Stated step errors of {count} {scenes} of seed {seed}, each against a reference \
             that takes {} times as many steps. Promised nothing, {why}: {folded}.",
            drawn.fineness()
        ),
        Some(level) => {
            let [coarser, finer] = witnesses(&drawn.scene(0, seed).model, level);
            let reference = reference(drawn);
            format!(
                "Stated mesh errors at level {level} of {} {scenes} of seed {seed}, each against \
                 level {reference}. Passed over at level {level}, {coarser}, {finer} or \
                 {reference}, {why}: {folded}.",
                count - folded
            )
        }
    };
    block(&head, "", "", out)?;
    writeln!(out)?;
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
        block(&text, "", "", out)?;
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

fn miss(of: &Miss, asked: Asked) -> Value {
    json!({
        "scene": of.index,
        "result": of.quantity.key(),
        "claimed_percent": of.claimed,
        "true_percent": of.truth,
        "scenario": asked.drawn.scene(of.index, asked.seed),
    })
}

/// The same as one object. A miss comes with its scenario, to be run again.
pub fn json(checked: &[Checked], asked: Asked) -> Value {
    let Asked { drawn, seed, mesh } = asked;
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
        "drawn": asked.scenes(),
        "seed": seed,
        "mesh_level": mesh,
        "reference_level": mesh.map(|_| reference(drawn)),
        "reference_fineness": mesh.is_none().then_some(drawn.fineness()),
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
        "misses": misses.iter().map(|m| miss(m, asked)).collect::<Vec<_>>(),
    })
}
