//! Whether tolerances are kept, as text of 80 columns and as one JSON object. The names are a contract.

use crate::report::text::{block, percent, significant};
use crate::verify::coverage::Drawn;
use crate::verify::mesh_coverage::reference;
use crate::verify::tolerance_coverage::{Kept, TOLERANCES, rows};
use serde_json::{Value, json};
use std::io::{self, Write};

/// Prints the table of `kept`, scenes of `seed`, and every answer that is not within what was asked for.
///
/// # Errors
/// Whatever `out` reports.
pub fn text(kept: &[Kept], seed: u32, out: &mut dyn Write) -> io::Result<()> {
    let folded = kept.iter().filter(|kept| kept.answers.is_none()).count();
    let (count, level) = (kept.len() - folded, reference(Drawn::Pulses));
    let head = format!(
        "Answers of --tolerance P in {count} random pulses of seed {seed}, each against level {level}. \
         Passed over at level 1, 2, 3 or {level}, as a mesh folded: {folded}."
    );
    block(&head, "", "", out)?;
    writeln!(
        out,
        "\n{:<12}{:>12}{:>12}{:>12}{:>16}{:>16}",
        "asked for", "answered", "within", "refused", "true error", "cost"
    )?;
    writeln!(
        out,
        "{:<12}{:>12}{:>12}{:>12}{:>16}{:>16}",
        "P", "", "P", "", "median", "median"
    )?;
    for row in rows(kept) {
        let within = 100.0 * row.true_ones as f64 / row.answered as f64;
        let dash = || "-".to_owned();
        writeln!(
            out,
            "{:<12}{:>12}{:>12}{:>12}{:>16}{:>16}",
            percent(row.percent),
            row.answered,
            if row.answered > 0 {
                format!("{within:.1} %")
            } else {
                dash()
            },
            row.refused,
            row.median_truth.map_or_else(dash, percent),
            row.median_cost.map_or_else(dash, significant),
        )?;
    }
    writeln!(
        out,
        "Cost: springs computed, over those of one run at level 1."
    )?;
    let misses = misses(kept);
    if misses.is_empty() {
        return writeln!(out, "\nEvery answer is within what was asked for.");
    }
    writeln!(out, "\nAnswers beyond what was asked for: {}", misses.len())?;
    for (index, asked, level, truth) in misses {
        writeln!(
            out,
            "scene {index:<6} asked {:<8} at level {level}: true error {}",
            percent(asked),
            percent(truth)
        )?;
    }
    Ok(())
}

/// Scene, tolerance, level and true error of every answer that is not within what was asked for.
fn misses(kept: &[Kept]) -> Vec<(u32, f64, u32, f64)> {
    let of = |kept: &Kept| {
        let index = kept.index;
        let answers = kept.answers.into_iter().flatten().zip(TOLERANCES);
        answers.filter_map(move |(met, asked)| {
            let met = met?;
            (met.truth > asked).then_some((index, asked, met.level, met.truth))
        })
    };
    kept.iter().flat_map(of).collect()
}

/// The same as one object, with every answer.
pub fn json(kept: &[Kept], seed: u32) -> Value {
    let folded = kept.iter().filter(|kept| kept.answers.is_none());
    let answers = kept.iter().filter_map(|kept| {
        let answers = kept.answers?.into_iter().zip(TOLERANCES);
        let answers = answers.map(|(met, asked)| {
            met.map_or_else(
                || json!({ "tolerance_percent": asked, "refused": true }),
                |met| {
                    json!({
                        "tolerance_percent": asked,
                        "level": met.level,
                        "stated_percent": met.stated,
                        "true_percent": met.truth,
                        "cost_over_level_1": met.cost,
                    })
                },
            )
        });
        Some(json!({ "scene": kept.index, "answers": answers.collect::<Vec<_>>() }))
    });
    json!({
        "seed": seed,
        "reference_level": reference(Drawn::Pulses),
        "folded_scenes": folded.map(|kept| kept.index).collect::<Vec<_>>(),
        "tolerances": rows(kept).iter().map(|row| json!({
            "tolerance_percent": row.percent,
            "answered": row.answered,
            "true": row.true_ones,
            "refused": row.refused,
            "median_true_percent": row.median_truth,
            "median_cost_over_level_1": row.median_cost,
        })).collect::<Vec<_>>(),
        "by_scene": answers.collect::<Vec<_>>(),
    })
}
