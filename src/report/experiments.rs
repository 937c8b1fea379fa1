//! Published experiments against the model, as text of 80 columns and as one JSON object.

use crate::report::format::{block, digits, trimmed};
use crate::scenario::Physiological;
use crate::verify::experiments::{Experiment, MeasuredBand};
use crate::verify::fit::{Fit, PATH, STEP, Tried};
use crate::verify::measured_orbit::{FATS_MPA, InOrbit, ORBITS, Row};
use crate::verify::rerun::{OnEach, Rerun};
use serde_json::{Value, json};
use std::io::{self, Write};

const REMARKS: &str = "Each row is run on mesh levels 1, 2 and 3, with the moduli as published; \
    only the bulk modulus of orbital fat is fitted, to the first two rows. In: yes on all levels, part \
    on some, NO on none. Where a source gives one value without a spread, 30 % on both sides counts \
    as inside. Pigs' eyes have a wall twice as thick and burst at their own limit.";

fn measured(experiment: &Experiment) -> String {
    let band = match experiment.measured {
        MeasuredBand::Spread(mean, sd) => format!("{} +- {}", trimmed(mean), trimmed(sd)),
        MeasuredBand::Single(value, _) => trimmed(value),
        MeasuredBand::Between(low, high) => format!("{} to {}", trimmed(low), trimmed(high)),
        MeasuredBand::Below(limit) => format!("< {}", trimmed(limit)),
        MeasuredBand::Above(limit) => format!("> {}", trimmed(limit)),
    };
    format!("{band} {}", experiment.reading.unit())
}

fn number(predicted: &Result<f64, String>) -> String {
    predicted.as_ref().map_or_else(|_| "none".to_owned(), |value| digits(*value, 3))
}

/// A line of the tables, with figures in columns so wide.
fn columns(what: &str, measured: &str, width: usize, figures: &[String]) -> String {
    let figures = figures.iter().map(|figure| format!("{figure:>width$}"));
    format!("{what:<41}{measured:>13}{}", figures.collect::<String>())
}

fn figures(experiment: &Experiment, width: usize, values: &[Result<f64, String>]) -> String {
    let values: Vec<String> = values.iter().map(number).collect();
    columns(experiment.what, &measured(experiment), width, &values)
}

fn note(text: &str, out: &mut dyn Write) -> io::Result<()> {
    block(text, "    ", "    ", out)
}

fn refusals(values: &[Result<f64, String>], out: &mut dyn Write) -> io::Result<()> {
    let mut refusals = values.iter().filter_map(|value| value.as_ref().err());
    refusals.try_for_each(|refusal| note(&format!("not run: {refusal}"), out))
}

fn line(row: &Rerun, out: &mut dyn Write) -> io::Result<()> {
    let experiment = row.experiment;
    let verdict = match row.inside() {
        _ if row.is_met() => "yes",
        inside if inside.contains(&true) => "part",
        _ => "NO",
    };
    writeln!(out, "{} {verdict}", figures(experiment, 7, &row.predicted))?;
    let standing = experiment.standing();
    note(&format!("{}; {}; {standing}", experiment.source, experiment.species), out)?;
    refusals(&row.predicted, out)?;
    if let Some(published) = &row.published {
        let (fat, unit) = (Physiological::PUBLISHED_FAT_BULK_MPA, experiment.reading.unit());
        let figures = published.each_ref().map(number).join(", ");
        note(&format!("with fat of {fat} MPa, as published: {figures} {unit}"), out)?;
    }
    if !row.is_met() {
        note(&format!("not met, because {}", experiment.because), out)?;
    }
    if !row.flags.is_empty() {
        note(&format!("FLAG {}", flag_names(row).join(", ")), out)?;
    }
    Ok(())
}

fn flag_names(row: &Rerun) -> Vec<&'static str> {
    row.flags.iter().map(|kind| kind.name()).collect()
}

fn lines<'a>(rows: impl IntoIterator<Item = &'a Rerun>, out: &mut dyn Write) -> io::Result<()> {
    let levels = ["1", "2", "3"].map(str::to_owned);
    writeln!(out, "{} in", columns("level:", "measured", 7, &levels))?;
    rows.into_iter().try_for_each(|row| line(row, out))
}

/// Prints the table, fitted rows apart from the others, and what the measured orbit gives.
pub fn text((rows, again): &(Vec<Rerun>, InOrbit), out: &mut dyn Write) -> io::Result<()> {
    let inside = |mesh: usize| rows.iter().filter(|row| row.inside()[mesh]).count();
    let [first, second, third] = [0, 1, 2].map(inside);
    write!(out, "Of {} comparisons lie inside: {first} on mesh level 1, ", rows.len())?;
    writeln!(out, "{second} on 2, {third} on 3\n")?;
    let fitted =
        format!("Fitted: fat of {} MPa was chosen by these", Physiological::default().fat_bulk_mpa);
    let tested = "Not fitted, moduli as published: these test the model".to_owned();
    for (heading, of) in [(fitted, true), (tested, false)] {
        let part: Vec<&Rerun> = rows.iter().filter(|r| r.experiment.fitted == of).collect();
        let inside = part.iter().filter(|row| row.is_met()).count();
        writeln!(out, "{heading} ({inside} of {} on all levels)", part.len())?;
        lines(part, out)?;
        writeln!(out)?;
    }
    block(REMARKS, "", "", out)?;
    writeln!(out, "\nIn the measured orbit (numerics.geometry=Full), mesh level 1")?;
    let fats = FATS_MPA.map(|mpa| mpa.to_string());
    writeln!(out, "{}", columns("fat, MPa:", "measured", 5, &fats))?;
    orbit(5, &again.fitted, out)?;
    let misfits = again.misfits().map(|misfit| format!("{misfit:.2}"));
    writeln!(out, "{}", columns("misfit, as the fit has it", "", 5, &misfits))?;
    let rims = ["round", "real"].map(str::to_owned);
    writeln!(out, "{}", columns("in an orbit:", "measured", 7, &rims))?;
    orbit(7, &again.others, out)?;
    writeln!(out, "Research and education, not diagnosis.")
}

fn orbit<const N: usize>(width: usize, rows: &[Row<N>], out: &mut dyn Write) -> io::Result<()> {
    for (experiment, values) in rows {
        writeln!(out, "{}", figures(experiment, width, values))?;
        refusals(values, out)?;
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
        "fitted": again.fitted.iter().map(row).collect::<Value>(),
        "misfits": again.misfits(),
        "orbits": ORBITS,
        "others": again.others.iter().map(row).collect::<Value>(),
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
        "flags": flag_names(row),
    })
}

pub fn json((rows, again): &(Vec<Rerun>, InOrbit)) -> Value {
    let rows: Value = rows.iter().map(row).collect();
    json!({ "rows": rows, "in_measured_orbit": orbit_json(again) })
}

pub fn fit_text(fit: &Fit, out: &mut dyn Write) -> io::Result<()> {
    let (best, (least, most)) = (&fit.best, fit.nearly);
    write!(out, "Bulk modulus of orbital fat: {} MPa; ", best.mpa)?;
    writeln!(out, "{least} to {most} fit nearly as well.")?;
    write!(out, "The program takes {}; ", Physiological::default().fat_bulk_mpa)?;
    writeln!(out, "published is {}.\n", Physiological::PUBLISHED_FAT_BULK_MPA)?;
    writeln!(out, "{:>6}{:>9}{:>8}", "MPa", "misfit", "inside")?;
    for Tried { mpa, misfit, inside, .. } in &fit.tried {
        let chosen = if *mpa == best.mpa { "  taken" } else { "" };
        writeln!(out, "{mpa:>6.2}{misfit:>9.2}{inside:>8}{chosen}")?;
    }
    writeln!(out)?;
    lines(&best.rows, out)
}

pub fn fit_json(fit: &Fit) -> Value {
    let tried = |t: &Tried| json!({ "mpa": t.mpa, "misfit": t.misfit, "inside": t.inside });
    json!({
        "path": PATH,
        "best": fit.best.mpa,
        "published": Physiological::PUBLISHED_FAT_BULK_MPA,
        "nearly": fit.nearly,
        "step": STEP,
        "misfit": fit.best.misfit,
        "tried": fit.tried.iter().map(tried).collect::<Value>(),
        "rows": fit.best.rows.iter().map(row).collect::<Value>(),
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::format::WIDTH;
    use crate::verify::experiments::EXPERIMENTS;

    #[test]
    fn the_table_keeps_what_misses_with_its_reason_and_tells_fitted_from_not_fitted() {
        let mut page = Vec::new();
        // Every experiment with a figure on each mesh; for every third one of them is no number.
        let made_up = EXPERIMENTS.iter().enumerate().map(|(i, experiment)| {
            let (low, high) = experiment.measured.limits();
            let inside = if low.is_finite() { low } else { high };
            let finest = if i % 3 == 0 { f64::NAN } else { inside };
            let predicted = [Ok(inside), Ok(inside), Ok(finest)];
            let published = experiment.fitted.then_some([Ok(1.0), Ok(2.0), Ok(3.0)]);
            Rerun { experiment, predicted, published, step_error: Some(0.1), flags: Vec::new() }
        });
        let again = InOrbit {
            fitted: vec![(&EXPERIMENTS[0], FATS_MPA.map(|_| Ok(271.0)))],
            others: vec![(&EXPERIMENTS[12], [Ok(1.0), Err("too wide".to_owned())])],
        };
        text(&(made_up.collect(), again), &mut page).unwrap();
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
        assert_eq!(page.matches(" part\n").count(), missed);
        let (all, met) = (EXPERIMENTS.len(), EXPERIMENTS.len() - missed);
        let counts = format!("inside: {all} on mesh level 1, {all} on 2, {met} on 3");
        assert!(page.lines().next().unwrap().ends_with(&counts), "{page}");
    }
}
