//! The fit of the injury curves as text of 80 columns and as JSON.

use crate::injury::Injury;
use crate::report::format::{paragraph, significant};
use crate::verify::tissue_fit::{TissueFit, TissueFits};
use serde_json::{Map, Value, json};
use std::io::{self, Write};

/// Prints each curve as it was found beside the one that is shipped, then what each kind felt.
pub fn text(fits: &TissueFits, out: &mut dyn Write) -> io::Result<()> {
    paragraph(
        "Curves of injury against what the tissue felt, matched by running the objects behind the \
         published curves: found (shipped)",
        out,
    )?;
    writeln!(
        out,
        "\n{:<19}{:>6} {:>17} {:>16} {:>16}",
        "", "unit", "50 % at", "eyes differ", "curve known to"
    )?;
    for fit in &fits.injuries {
        let (row, shipped) = (fit.injury.measure().row(), fit.injury.curve());
        let half = |half: f64| significant(half * row.factor);
        let pair = |found: String, shipped: String| format!("{found} ({shipped})");
        writeln!(
            out,
            "{:<19}{:>6} {:>17} {:>16} {:>16}",
            fit.injury.name(),
            row.unit,
            pair(half(fit.half), half(shipped.half)),
            pair(format!("{:.3}", fit.eyes), format!("{:.3}", shipped.eyes)),
            pair(format!("{:.3}", fit.known), format!("{:.3}", shipped.known)),
        )?;
    }
    writeln!(out)?;
    paragraph(
        "The last two are standard deviations of log10 of the measure. Each kind at the published \
         energy of 50 %, and the risk that the curve without that kind tells of it:",
        out,
    )?;
    for fit in &fits.injuries {
        let row = fit.injury.measure().row();
        writeln!(out, "\n{}, {} in {}", fit.injury.name(), row.label, row.unit)?;
        for kind in &fit.kinds {
            writeln!(
                out,
                "  {:<14}{:>9}{:>6.0} %",
                kind.kind,
                significant(kind.felt * row.factor),
                100.0 * kind.told_by_others
            )?;
        }
    }
    Ok(())
}

fn one(fit: &TissueFit) -> Value {
    let (row, shipped) = (fit.injury.measure().row(), fit.injury.curve());
    let kinds = fit.kinds.iter().map(|kind| {
        json!({
            "kind": kind.kind,
            "felt": kind.felt * row.factor,
            "told_by_others_percent": 100.0 * kind.told_by_others,
        })
    });
    json!({
        "measure": row.key,
        "half": fit.half * row.factor,
        "eyes_differ": fit.eyes,
        "known_to": fit.known,
        "slope": fit.slope,
        "kinds_disagree": fit.disagreement,
        "data_end": fit.end * row.factor,
        "shipped": {
            "half": shipped.half * row.factor,
            "eyes_differ": shipped.eyes,
            "known_to": shipped.known,
            "data_end": shipped.end * row.factor,
        },
        "kinds": kinds.collect::<Vec<_>>(),
    })
}

/// The fit as JSON.
pub fn json(fits: &TissueFits) -> Value {
    let curves: Map<String, Value> =
        fits.injuries.iter().map(|fit| (fit.injury.key().to_owned(), one(fit))).collect();
    let powers = fits.with_inputs.iter().map(|input| {
        let of = |side: usize| -> Map<String, Value> {
            let each = Injury::ALL.iter();
            each.map(|injury| {
                (injury.key().to_owned(), json!(input.powers[side][*injury as usize]))
            })
            .collect()
        };
        json!({ "input": input.path, "below": of(0), "above": of(1) })
    });
    json!({ "curves": curves, "with_inputs": powers.collect::<Vec<_>>() })
}
