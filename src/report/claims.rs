//! How often what is claimed holds, as text of 80 columns and as one JSON object.

use crate::answer::mesh_error::witnesses;
use crate::report::format::{block, significant};
use crate::verify::claims::{Claim, Coverage, Fault, Findings, Study, Subject};
use crate::verify::scenes::Scenes;
use serde_json::{Value, json};
use std::io::{self, Write};

/// An error in percent with two digits, however small.
fn error(percent: f64) -> String {
    if percent == 0.0 || (1e-3..1e3).contains(&percent) {
        crate::report::format::percent(percent)
    } else {
        format!("{percent:.1e} %")
    }
}

fn label(subject: Subject) -> String {
    match subject {
        Subject::Result(quantity) => quantity.label().to_owned(),
        Subject::Tolerance(percent) => error(percent),
    }
}

fn scenes(study: Study) -> &'static str {
    match study.scenes() {
        Scenes::Pulses => "random pulses",
        Scenes::Objects => "random objects",
        Scenes::Sides => "random blows from the side",
    }
}

/// What was checked, in which scenes, against what.
fn heading(found: &Findings) -> String {
    let Findings { study, seed, .. } = found;
    let folded = found.folded().len();
    let reference = study.reference_level();
    let why = match study.scenes() {
        Scenes::Pulses => "as a mesh folded",
        _ => "as a mesh folded or the object went through",
    };
    let of = |count: usize| format!("{count} {} of seed {seed}", scenes(*study));
    let promising = of(found.scenes.len() - folded);
    let passed_over = |level: u32| {
        let [coarser, finer] = witnesses(&study.scenes().scene(0, *seed), level);
        let mut levels = vec![level, coarser, finer];
        levels.dedup();
        let levels: Vec<String> = levels.iter().map(u32::to_string).collect();
        format!("{} or {reference}, {why}: {folded}", levels.join(", "))
    };
    match study {
        Study::Steps(scenes) => format!(
            "Stated step errors of {}, each against a reference that takes {} times as many steps. \
             Promised nothing, {why}: {folded}.",
            of(found.scenes.len()),
            scenes.fineness()
        ),
        Study::Meshes(_, level) => format!(
            "Stated mesh errors at level {level} of {promising}, each against level {reference}. \
             Passed over at level {}.",
            passed_over(*level)
        ),
        Study::Tolerances => format!(
            "Answers of --tolerance P in {promising}, each against level {reference}. \
             Passed over at level {}.",
            passed_over(1)
        ),
    }
}

/// How many scenes have a fault, and of how many nothing said so.
fn faults(found: &Findings) -> String {
    let count = |fault| found.count(fault);
    format!(
        "Folded and flagged: {}; a finer step folds, unflagged: {}. Went through: {}. No finite \
         motion, refused: {}. A result that is no number: {}. Energies off by more than half a \
         percent, unflagged: {}.",
        count(Fault::Folded),
        count(Fault::FoldedUnflagged),
        count(Fault::WentThrough),
        count(Fault::NotFinite),
        count(Fault::NoNumber),
        count(Fault::EnergyUnflagged),
    )
}

/// Some figure of every subject that has it, in one sentence.
fn list(what: &str, rows: &[Coverage], figure: impl Fn(&Coverage) -> Option<String>) -> String {
    let each =
        rows.iter().filter_map(|row| Some(format!("{} {}", label(row.subject), figure(row)?)));
    let each: Vec<String> = each.collect();
    let each = if each.is_empty() { "none".to_owned() } else { each.join(", ") };
    format!("{what}: {each}.")
}

/// Prints the table of what was found and every claim that did not hold.
pub fn text(found: &Findings, out: &mut dyn Write) -> io::Result<()> {
    block(&heading(found), "", "", out)?;
    if found.study == Study::Steps(Scenes::Sides) {
        block(&faults(found), "", "", out)?;
    }
    let (first, silence) = match found.study {
        Study::Tolerances => ("asked for", "Scenes in which it was refused"),
        _ => ("result", "Scenes without a limit and a claim"),
    };
    writeln!(
        out,
        "\n{:<20}{:>11}{:>16}{:>16}{:>16}\n{first:<20}{:>11}{:>16}{:>16}{:>16}",
        "",
        "within",
        "claimed/true",
        "true error",
        "true error",
        "the claim",
        "median",
        "median",
        "largest"
    )?;
    let rows = found.coverage();
    for row in &rows {
        let or_dash = |figure: Option<f64>, written: fn(f64) -> String| {
            figure.map_or_else(|| "-".to_owned(), written)
        };
        writeln!(
            out,
            "{:<20}{:>11}{:>16}{:>16}{:>16}",
            label(row.subject),
            or_dash(row.within, |within| format!("{within:.1} %")),
            or_dash(row.median_ratio, |ratio| format!("{ratio:.1}")),
            or_dash(row.median_truth, error),
            or_dash(row.largest_truth, error),
        )?;
    }
    if !matches!(found.study, Study::Steps(_)) {
        let missing =
            |row: &Coverage| (row.without_claim > 0).then(|| row.without_claim.to_string());
        writeln!(out)?;
        block(&list(silence, &rows, missing), "", "", out)?;
    }
    if found.study == Study::Tolerances {
        let what = "Springs computed, over those of one run at level 1, in the median";
        let costs = list(what, &rows, |row| row.median_cost.map(significant));
        block(&costs, "", "", out)?;
    }
    let misses = found.misses();
    if misses.is_empty() {
        return writeln!(out, "\nEvery claim held.");
    }
    writeln!(out, "\nClaims that did not hold: {}", misses.len())?;
    writeln!(out, "{:<8}{first:<20}{:>14}{:>14}", "scene", "claimed", "true")?;
    for (scene, Claim { subject, claimed, truth, .. }) in misses {
        let [claimed, truth] = [claimed, truth].map(|e| e.map_or_else(String::new, error));
        writeln!(out, "{scene:<8}{:<20}{claimed:>14}{truth:>14}", label(subject))?;
    }
    Ok(())
}

/// The table as one JSON object. A claim that did not hold comes with its scenario, to be run
/// again.
pub fn json(found: &Findings) -> Value {
    let study = found.study;
    let miss = |(scene, claim): (u32, Claim)| {
        let scenario = study.scenes().scene(scene, found.seed);
        json!({ "scene": scene, "claim": claim, "scenario": scenario })
    };
    let (fineness, level, reference) = match study {
        Study::Steps(scenes) => (Some(scenes.fineness()), None, None),
        Study::Meshes(_, level) => (None, Some(level), Some(study.reference_level())),
        Study::Tolerances => (None, None, Some(study.reference_level())),
    };
    json!({
        "drawn": scenes(study),
        "seed": found.seed,
        "scenes": found.scenes.len(),
        "mesh_level": level,
        "reference_level": reference,
        "reference_fineness": fineness,
        "folded_scenes": found.folded(),
        "coverage": found.coverage(),
        "misses": found.misses().into_iter().map(miss).collect::<Vec<_>>(),
        "by_scene": found.scenes,
    })
}
