//! How often what is claimed holds, as text of 80 columns and as one JSON object.

use crate::answer::mesh_error::witnesses;
use crate::report::format::{block, or_dash, percent, significant};
use crate::verify::claims::{Claim, Coverage, Fault, Findings, Study, Subject};
use crate::verify::scenes::Scenes;
use serde_json::{Value, json};
use std::io::{self, Write};

/// An error in percent with two digits, however small.
fn error(value: f64) -> String {
    let plain = value == 0.0 || (1e-3..1e3).contains(&value);
    if plain { percent(value) } else { format!("{value:.1e} %") }
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
    let (study, folded) = (found.study, found.folded().len());
    let (all, kind, seed) = (found.scenes.len(), scenes(study), found.seed);
    let reference = study.reference_level();
    let why = match study.scenes() {
        Scenes::Pulses => "as a mesh folded",
        _ => "as a mesh folded or the object went through",
    };
    let (what, level) = match study {
        Study::Steps(scenes) => {
            let fineness = scenes.fineness();
            return format!(
                "Stated step errors of {all} {kind} of seed {seed}, each against a reference that \
                 takes {fineness} times as many steps. Promised nothing, {why}: {folded}."
            );
        }
        Study::Meshes(_, level) => (format!("Stated mesh errors at level {level} of"), level),
        Study::Tolerances => ("Answers of --tolerance P in".to_owned(), 1),
    };
    let [coarser, finer] = witnesses(&study.scenes().scene(0, seed), level);
    let mut levels = vec![level, coarser, finer];
    levels.dedup();
    let levels: Vec<String> = levels.iter().map(u32::to_string).collect();
    format!(
        "{what} {} {kind} of seed {seed}, each against level {reference}. Passed over at level {} \
         or {reference}, {why}: {folded}.",
        all - folded,
        levels.join(", ")
    )
}

/// How many scenes have a fault, and of how many nothing said so.
fn faults(found: &Findings) -> String {
    let counted = [
        ("Folded and flagged", Fault::Folded, "; "),
        ("a finer step folds, unflagged", Fault::FoldedUnflagged, ". "),
        ("Went through", Fault::WentThrough, ". "),
        ("No finite motion, refused", Fault::NotFinite, ". "),
        ("A result that is no number", Fault::NoNumber, ". "),
        ("Energies off by more than half a percent, unflagged", Fault::EnergyUnflagged, "."),
    ];
    let each = counted.map(|(what, fault, end)| format!("{what}: {}{end}", found.count(fault)));
    each.concat()
}

/// Some figure of every subject that has it, in one sentence.
fn list(what: &str, rows: &[Coverage], figure: impl Fn(&Coverage) -> Option<String>) -> String {
    let of = |row: &Coverage| Some(format!("{} {}", label(row.subject), figure(row)?));
    let each: Vec<String> = rows.iter().filter_map(of).collect();
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
    let line = |name: &str, [within, ratio, median, largest]: [&str; 4]| {
        format!("{name:<20}{within:>11}{ratio:>16}{median:>16}{largest:>16}")
    };
    writeln!(out, "\n{}", line("", ["within", "claimed/true", "true error", "true error"]))?;
    writeln!(out, "{}", line(first, ["the claim", "median", "median", "largest"]))?;
    let rows = found.coverage();
    for row in &rows {
        let within = or_dash(row.within, |within| format!("{within:.1} %"));
        let ratio = or_dash(row.median_ratio, |ratio| format!("{ratio:.1}"));
        let [median, largest] = [row.median_truth, row.largest_truth].map(|e| or_dash(e, error));
        writeln!(out, "{}", line(&label(row.subject), [&within, &ratio, &median, &largest]))?;
    }
    if !matches!(found.study, Study::Steps(_)) {
        let count = |count: usize| (count > 0).then(|| count.to_string());
        writeln!(out)?;
        block(&list(silence, &rows, |row| count(row.without_claim)), "", "", out)?;
    }
    if found.study == Study::Tolerances {
        let what = "Springs computed, over those of one run at level 1, in the median";
        block(&list(what, &rows, |row| row.median_cost.map(significant)), "", "", out)?;
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

/// The table as one JSON object; a claim that did not hold comes with its scenario.
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
