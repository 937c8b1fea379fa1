//! The fit of the injury curves as text of 80 columns and as JSON.

use crate::report::format::{paragraph, significant};
use crate::verify::tissue_fit::TissueFit;
use serde_json::{Value, json};
use std::io::{self, Write};

/// Prints each curve as it was found beside the one that is shipped, then what each kind felt.
pub fn text(fits: &[TissueFit], out: &mut dyn Write) -> io::Result<()> {
    let what = "Curves of injury against what the tissue felt, matched by running the objects behind \
                the published curves: found (shipped)";
    paragraph(what, out)?;
    let line = |[name, unit, half, eyes, known]: [&str; 5]| {
        format!("{name:<19}{unit:>6} {half:>17} {eyes:>16} {known:>16}")
    };
    writeln!(out, "\n{}", line(["", "unit", "50 % at", "eyes differ", "curve known to"]))?;
    for fit in fits {
        let (row, shipped) = (fit.injury.measure().row(), fit.injury.curve());
        let half = |half: f64| significant(half * row.factor);
        let half = format!("{} ({})", half(fit.half), half(shipped.half));
        let eyes = format!("{:.3} ({:.3})", fit.eyes, shipped.eyes);
        let known = format!("{:.3} ({:.3})", fit.known, shipped.known);
        writeln!(out, "{}", line([fit.injury.name(), row.unit, &half, &eyes, &known]))?;
    }
    writeln!(out)?;
    let what = "The last two are standard deviations of log10 of the measure. Each kind at the \
                published energy of 50 %, and the risk that the curve without that kind tells of it:";
    paragraph(what, out)?;
    for fit in fits {
        let row = fit.injury.measure().row();
        writeln!(out, "\n{}, {} in {}", fit.injury.name(), row.label, row.unit)?;
        for kind in &fit.kinds {
            let (felt, told) = (significant(kind.felt * row.factor), 100.0 * kind.told_by_others);
            writeln!(out, "  {:<14}{felt:>9}{told:>6.0} %", kind.kind)?;
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
        "shipped": {
            "half": shipped.half * row.factor,
            "eyes_differ": shipped.eyes,
            "known_to": shipped.known,
        },
        "kinds": kinds.collect::<Value>(),
    })
}

pub fn json(fits: &[TissueFit]) -> Value {
    fits.iter().map(|fit| (fit.injury.key(), one(fit))).collect()
}
