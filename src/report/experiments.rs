//! Published experiments against the model, as text of 80 columns and as one JSON object.

use crate::report::format::{block, digits, significant};
use crate::scenario::Physiological;
use crate::verify::experiments::{Experiment, MeasuredBand};
use crate::verify::fit::{Fit, PATH, STEP};
use crate::verify::measured_orbit::{FATS_MPA, InOrbit, ORBITS, Row};
use crate::verify::rerun::{MESHES, OnEach, Rerun};
use serde_json::{Value, json};
use std::io::{self, Write};

/// The bulk modulus of orbital fat that the program takes, and the published one, in `MPa`.
fn fat_mpa() -> (f64, f64) {
    let taken = Physiological::default().fat_bulk_mpa;
    (taken, Physiological::PUBLISHED_FAT_BULK_MPA)
}

const REMARKS: &str = "Each row is run on mesh levels 1, 2 and 3, with the moduli as published; \
    only the bulk modulus of orbital fat is fitted, to the first two rows. In: yes on all levels, part \
    on some, NO on none. Where a source gives one value without a spread, 30 % on both sides counts \
    as inside. Pigs' eyes have a wall twice as thick and burst at their own limit.";

fn measured(experiment: &Experiment) -> String {
    let number = |value: f64| {
        let text = significant(value);
        if text.contains('.') && !text.contains('e') {
            text.trim_end_matches('0').trim_end_matches('.').to_owned()
        } else {
            text
        }
    };
    match experiment.measured {
        MeasuredBand::Spread(mean, sd) => format!("{} +- {}", number(mean), number(sd)),
        MeasuredBand::Single(value, _) => number(value),
        MeasuredBand::Between(low, high) => format!("{} to {}", number(low), number(high)),
        MeasuredBand::Below(limit) => format!("< {}", number(limit)),
        MeasuredBand::Above(limit) => format!("> {}", number(limit)),
    }
}

fn number(predicted: &Result<f64, String>) -> String {
    predicted.as_ref().map_or_else(|_| "none".to_owned(), |value| digits(*value, 3))
}

fn note(text: &str, out: &mut dyn Write) -> io::Result<()> {
    block(text, "    ", "    ", out)
}

fn line(row: &Rerun, out: &mut dyn Write) -> io::Result<()> {
    let experiment = row.experiment;
    let unit = experiment.reading.unit();
    let measured = format!("{} {unit}", measured(experiment));
    let inside = row.inside();
    let verdict = if row.is_met() {
        "yes"
    } else if inside.contains(&true) {
        "part"
    } else {
        "NO"
    };
    let [first, second, third] = row.predicted.each_ref().map(number);
    let line = format!(
        "{:<41}{measured:>13} {first:>6} {second:>6} {third:>6} {verdict}",
        experiment.what,
    );
    writeln!(out, "{line}")?;
    let standing = experiment.standing();
    note(&format!("{}; {}; {standing}", experiment.source, experiment.species), out)?;
    for refusal in row.predicted.iter().filter_map(|p| p.as_ref().err()) {
        note(&format!("not run: {refusal}"), out)?;
    }
    if let Some(published) = &row.published {
        let figures = published.each_ref().map(number).join(", ");
        let (_, fat) = fat_mpa();
        note(&format!("with fat of {fat} MPa, as published: {figures} {unit}"), out)?;
    }
    if !row.is_met() {
        note(&format!("not met, because {}", experiment.because), out)?;
    }
    if !row.flags.is_empty() {
        let names: Vec<_> = row.flags.iter().map(|kind| kind.name()).collect();
        note(&format!("FLAG {}", names.join(", ")), out)?;
    }
    Ok(())
}

fn lines(rows: &[&Rerun], out: &mut dyn Write) -> io::Result<()> {
    writeln!(out, "{:<41}{:>13} {:>6} {:>6} {:>6} in", "level:", "measured", 1, 2, 3)?;
    rows.iter().try_for_each(|row| line(row, out))
}

/// Prints the table, fitted rows apart from the others, and what the measured orbit gives.
pub fn text((rows, again): &(Vec<Rerun>, InOrbit), out: &mut dyn Write) -> io::Result<()> {
    let inside = |mesh: usize| rows.iter().filter(|row| row.inside()[mesh]).count();
    let counts: [usize; MESHES] = std::array::from_fn(inside);
    writeln!(
        out,
        "Of {} comparisons lie inside: {} on mesh level 1, {} on 2, {} on 3\n",
        rows.len(),
        counts[0],
        counts[1],
        counts[2]
    )?;
    let fitted = format!("Fitted: fat of {} MPa was chosen by these", fat_mpa().0);
    let tested = "Not fitted, moduli as published: these test the model".to_owned();
    for (heading, of) in [(fitted, true), (tested, false)] {
        let part: Vec<&Rerun> = rows.iter().filter(|r| r.experiment.fitted == of).collect();
        let inside = part.iter().filter(|row| row.is_met()).count();
        writeln!(out, "{heading} ({inside} of {} on all levels)", part.len())?;
        lines(&part, out)?;
        writeln!(out)?;
    }
    block(REMARKS, "", "", out)?;
    writeln!(out)?;
    orbit_text(again, out)?;
    writeln!(out, "Research and education, not diagnosis.")
}

/// Prints what the measured orbit gives.
fn orbit_text(again: &InOrbit, out: &mut dyn Write) -> io::Result<()> {
    writeln!(out, "In the measured orbit (numerics.geometry=Full), mesh level 1")?;
    orbit_lines("fat, MPa:", &FATS_MPA.map(|mpa| mpa.to_string()), &again.fitted, out)?;
    let misfits = again.misfits();
    write!(out, "{:<41}{:>13}", "misfit, as the fit has it", "")?;
    for misfit in misfits {
        write!(out, "{misfit:>5.2}")?;
    }
    writeln!(out)?;
    let rims = ["round", "real"].map(str::to_owned);
    orbit_lines("in an orbit:", &rims, &again.others, out)
}

fn orbit_lines<const N: usize>(
    first: &str,
    heads: &[String; N],
    rows: &[Row<N>],
    out: &mut dyn Write,
) -> io::Result<()> {
    let width = if N > MESHES { 5 } else { 7 };
    write!(out, "{first:<41}{:>13}", "measured")?;
    for head in heads {
        write!(out, "{head:>width$}")?;
    }
    writeln!(out)?;
    for (experiment, values) in rows {
        let measured = format!("{} {}", measured(experiment), experiment.reading.unit());
        write!(out, "{:<41}{measured:>13}", experiment.what)?;
        for value in values {
            write!(out, "{:>width$}", number(value))?;
        }
        writeln!(out)?;
        for refusal in values.iter().filter_map(|value| value.as_ref().err()) {
            note(&format!("not run: {refusal}"), out)?;
        }
    }
    Ok(())
}

fn orbit_json(again: &InOrbit) -> Value {
    fn row<const N: usize>((experiment, values): &Row<N>) -> Value {
        let values: Vec<_> = values.iter().map(|value| value.as_ref().ok()).collect();
        json!({ "key": experiment.key, "predicted": values })
    }
    json!({
        "fat_mpa": FATS_MPA,
        "fitted": again.fitted.iter().map(row).collect::<Vec<_>>(),
        "misfits": again.misfits(),
        "orbits": ORBITS,
        "others": again.others.iter().map(row).collect::<Vec<_>>(),
    })
}

fn row(row: &Rerun) -> Value {
    let experiment = row.experiment;
    let (low, high) = experiment.measured.limits();
    let bound = |value: f64| value.is_finite().then_some(value);
    let values = |of: &OnEach<f64>| of.each_ref().map(|p| p.as_ref().ok().copied());
    let refusal = row.predicted.iter().find_map(|p| p.as_ref().err());
    json!({
        "key": experiment.key,
        "what": experiment.what,
        "scenario": (experiment.scenario)(),
        "unit": experiment.reading.unit(),
        "measured": experiment.measured.typical(),
        "measured_band": [bound(low), bound(high)],
        "predicted": values(&row.predicted),
        "published_moduli": row.published.as_ref().map(values),
        "refusal": refusal,
        "ratio": row.ratios(),
        "inside": row.inside(),
        "met": row.is_met(),
        "because": (!row.is_met()).then_some(experiment.because),
        "fitted": experiment.fitted,
        "mark": experiment.standing(),
        "species": experiment.species,
        "source": experiment.source,
        "step_error_percent": row.step_error,
        "flags": row.flags.iter().map(|kind| kind.name()).collect::<Vec<_>>(),
    })
}

/// The rows as JSON, and those in the measured orbit.
pub fn json((rows, again): &(Vec<Rerun>, InOrbit)) -> Value {
    json!({
        "rows": rows.iter().map(row).collect::<Vec<_>>(),
        "in_measured_orbit": orbit_json(again),
    })
}

/// Prints what the fit found.
pub fn fit_text(fit: &Fit, out: &mut dyn Write) -> io::Result<()> {
    let (least, most) = fit.nearly;
    writeln!(
        out,
        "Bulk modulus of orbital fat: {} MPa; {least} to {most} fit nearly as well.",
        fit.best.mpa
    )?;
    let (taken, published) = fat_mpa();
    writeln!(out, "The program takes {taken}; published is {published}.\n")?;
    writeln!(out, "{:>6}{:>9}{:>8}", "MPa", "misfit", "inside")?;
    for tried in &fit.tried {
        let chosen = if tried.mpa == fit.best.mpa { "  taken" } else { "" };
        writeln!(out, "{:>6.2}{:>9.2}{:>8}{chosen}", tried.mpa, tried.misfit, tried.inside)?;
    }
    writeln!(out)?;
    lines(&fit.best.rows.iter().collect::<Vec<_>>(), out)
}

/// The fit as JSON.
pub fn fit_json(fit: &Fit) -> Value {
    let tried: Vec<Value> = fit
        .tried
        .iter()
        .map(|t| json!({ "mpa": t.mpa, "misfit": t.misfit, "inside": t.inside }))
        .collect();
    json!({
        "path": PATH,
        "best": fit.best.mpa,
        "published": fat_mpa().1,
        "nearly": [fit.nearly.0, fit.nearly.1],
        "step": STEP,
        "misfit": fit.best.misfit,
        "tried": tried,
        "rows": fit.best.rows.iter().map(row).collect::<Vec<_>>(),
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::format::WIDTH;
    use crate::verify::experiments::EXPERIMENTS;

    /// Every experiment with a figure on each mesh: those of every third are far off on one of
    /// them.
    fn made_up() -> Vec<Rerun> {
        let row = |(i, experiment): (usize, &'static Experiment)| {
            let inside = match experiment.measured {
                MeasuredBand::Below(limit) => 0.5 * limit,
                MeasuredBand::Above(limit) => 2.0 * limit,
                other => other.typical(),
            };
            let off = match experiment.measured {
                MeasuredBand::Above(limit) => 0.1 * limit,
                other => 10.0 * other.typical(),
            };
            let finest = if i % 3 == 0 { off } else { inside };
            Rerun {
                experiment,
                predicted: [Ok(inside), Ok(inside), Ok(finest)],
                published: experiment.fitted.then_some([Ok(1.0), Ok(2.0), Ok(3.0)]),
                step_error: Some(0.1),
                flags: Vec::new(),
            }
        };
        EXPERIMENTS.iter().enumerate().map(row).collect()
    }

    #[test]
    fn the_table_keeps_what_misses_with_its_reason_and_tells_fitted_from_not_fitted() {
        let mut page = Vec::new();
        let again = InOrbit {
            fitted: vec![(&EXPERIMENTS[0], FATS_MPA.map(|_| Ok(271.0)))],
            others: vec![(&EXPERIMENTS[12], [Ok(1.0), Err("too wide".to_owned())])],
        };
        text(&(made_up(), again), &mut page).unwrap();
        let page = String::from_utf8(page).unwrap();
        assert!(page.lines().all(|l| l.chars().count() <= WIDTH), "{page}");
        let (fitted, others) = page.split_once("Not fitted").unwrap();
        assert!(fitted.contains("with fat of 0.78 MPa, as published: 1.00, 2.00, 3.00 N"));
        for experiment in EXPERIMENTS {
            let part = if experiment.fitted { fitted } else { others };
            assert!(part.contains(experiment.what), "{}", experiment.what);
        }
        let (_, orbit) = others.split_once("In the measured orbit").unwrap();
        assert!(orbit.contains(" 0.00 0.00") && orbit.contains("not run: too wide"));
        let missed = EXPERIMENTS.len().div_ceil(3);
        assert_eq!(page.matches("not met, because").count(), missed);
        let parts = page.lines().filter(|line| line.ends_with(" part")).count();
        assert_eq!(parts, missed);
        let (all, met) = (EXPERIMENTS.len(), EXPERIMENTS.len() - missed);
        let counts = format!("inside: {all} on mesh level 1, {all} on 2, {met} on 3");
        assert!(page.lines().next().unwrap().ends_with(&counts), "{page}");
    }
}
