//! Published experiments against the model, as text of 80 columns and as one JSON object.

use super::text::{WIDTH, significant, wrapped};
use crate::study::calibrate::{FREE, Fit};
use crate::study::experiments::{Band, Experiment};
use crate::study::validate::Row;
use serde_json::{Value, json};
use std::io::{self, Write};

const REMARKS: &str = "Finer: on the next finer mesh, ! where that is not inside; the fit is one of \
    mesh level 1. Where a source gives one value without a spread, 30 % on both sides counts as \
    inside. Pig pressures stand as they are (species factor 1); bursting is compared with the species' \
    own limit. A disc in the plane is a rod in space: small balls engage more of the eye here than in \
    life, and fluid cannot make way sideways, so that their pressure is too high and the globe's change \
    of shape too small.";

fn measured(experiment: &Experiment) -> String {
    let scale = experiment.unit.1;
    let number = |value: f64| {
        let text = significant(value / scale);
        if text.contains('.') && !text.contains('e') {
            text.trim_end_matches('0').trim_end_matches('.').to_owned()
        } else {
            text
        }
    };
    match experiment.measured {
        Band::Spread(mean, sd) => format!("{} +- {}", number(mean), number(sd)),
        Band::Single(value, _) => number(value),
        Band::Between(low, high) => format!("{} to {}", number(low), number(high)),
        Band::Below(limit) => format!("< {}", number(limit)),
        Band::Above(limit) => format!("> {}", number(limit)),
    }
}

fn lines(rows: &[&Row], out: &mut dyn Write) -> io::Result<()> {
    writeln!(
        out,
        "{:<42}{:>12}{:>7}{:>6} {:<3}{:>8}",
        "", "measured", "model", "ratio", "in", "finer"
    )?;
    for row in rows {
        let experiment = row.experiment;
        let (unit, scale) = experiment.unit;
        let (model, ratio) = match (&row.predicted, row.ratio()) {
            (Ok(value), Some(ratio)) => (significant(value / scale), format!("{ratio:.2}")),
            _ => ("none".to_owned(), String::new()),
        };
        let measured = format!("{} {unit}", measured(experiment));
        let finer = row.finer.map_or_else(String::new, |value| {
            let mark = if row.finer_inside() == Some(true) {
                ' '
            } else {
                '!'
            };
            format!("{}{mark}", significant(value / scale))
        });
        let line = format!(
            "{:<42}{measured:>12}{model:>7}{ratio:>6} {:<3}{finer:>8}",
            experiment.what,
            if row.inside() { "yes" } else { "NO" }
        );

        writeln!(out, "{}", line.trim_end())?;
        writeln!(
            out,
            "    {}; {}; {}",
            experiment.source,
            experiment.species,
            experiment.mark.name()
        )?;
        if let Err(refusal) = &row.predicted {
            writeln!(out, "    not run: {refusal}")?;
        }
        if !row.flags.is_empty() {
            let names: Vec<_> = row.flags.iter().map(|kind| kind.name()).collect();
            writeln!(out, "    FLAG {}", names.join(", "))?;
        }
    }
    Ok(())
}

/// Prints the table, fitted rows apart from the others.
///
/// # Errors
/// Whatever `out` reports.
pub fn text(rows: &[Row], out: &mut dyn Write) -> io::Result<()> {
    for (heading, fitted) in [
        ("Fitted: the model was made to agree with these", true),
        ("Not fitted: these test it", false),
    ] {
        let part: Vec<&Row> = rows
            .iter()
            .filter(|r| r.experiment.fitted == fitted)
            .collect();
        let inside = part.iter().filter(|r| r.inside()).count();
        writeln!(out, "{heading} ({inside} of {} inside)", part.len())?;
        lines(&part, out)?;
        writeln!(out)?;
    }
    for line in wrapped(REMARKS, WIDTH) {
        writeln!(out, "{line}")?;
    }
    writeln!(out, "Research and education, not diagnosis.")
}

fn row(row: &Row) -> Value {
    let experiment = row.experiment;
    let (unit, scale) = experiment.unit;
    let (low, high) = experiment.measured.limits();
    let bound = |value: f64| value.is_finite().then(|| value / scale);
    json!({
        "key": experiment.key,
        "what": experiment.what,
        "scenario": (experiment.scenario)(),
        "unit": unit,
        "measured": experiment.measured.typical() / scale,
        "measured_band": [bound(low), bound(high)],
        "predicted": row.predicted.as_ref().ok().map(|value| value / scale),
        "refusal": row.predicted.as_ref().err(),
        "ratio": row.ratio(),
        "inside": row.inside(),
        "finer_mesh": row.finer.map(|value| value / scale),
        "finer_mesh_inside": row.finer_inside(),
        "fitted": experiment.fitted,
        "mark": experiment.mark.name(),
        "species": experiment.species,
        "source": experiment.source,
        "step_error_percent": row.step_error,
        "flags": row.flags.iter().map(|kind| kind.name()).collect::<Vec<_>>(),
    })
}

/// The same as JSON.
pub fn json(rows: &[Row]) -> Value {
    json!({ "species_factor_pressure": 1.0, "rows": rows.iter().map(row).collect::<Vec<_>>() })
}

/// Prints what a calibration found.
///
/// # Errors
/// Whatever `out` reports.
pub fn fit_text(fit: &Fit, out: &mut dyn Write) -> io::Result<()> {
    writeln!(
        out,
        "Best of {} points tried; sum of squared misfits {:.2}\n",
        fit.tried, fit.misfit
    )?;
    writeln!(
        out,
        "{:<36}{:>10}{:>24}{:>10}",
        "", "best", "fits nearly as well", "now"
    )?;
    let now = crate::scenario::Physiological::default();
    for (free, nearly) in FREE.iter().zip(fit.nearly) {
        writeln!(
            out,
            "{:<36}{:>10}{:>24}{:>10}",
            free.what,
            significant(free.of(&fit.model)),
            format!("{} to {}", significant(nearly.0), significant(nearly.1)),
            significant(free.of(&now)),
        )?;
        let note = format!(
            "{}: tried {} to {}; {}",
            free.path, free.range.0, free.range.1, free.source
        );
        for line in wrapped(&note, WIDTH - 4) {
            writeln!(out, "    {line}")?;
        }
    }
    writeln!(out)?;
    lines(&fit.rows.iter().collect::<Vec<_>>(), out)
}

/// The same as JSON.
pub fn fit_json(fit: &Fit) -> Value {
    let free: Vec<Value> = FREE
        .iter()
        .zip(fit.nearly)
        .map(|(free, nearly)| {
            json!({
                "path": free.path,
                "best": free.of(&fit.model),
                "nearly": [nearly.0, nearly.1],
                "tried": [free.range.0, free.range.1],
                "source": free.source,
            })
        })
        .collect();
    json!({
        "free": free,
        "model": fit.model,
        "misfit": fit.misfit,
        "points": fit.tried,
        "rows": fit.rows.iter().map(row).collect::<Vec<_>>(),
    })
}
