//! The answer first: one line an injury, in text and as JSON.

use crate::injury::{Part, Risk, Verdict, lines};
use serde_json::{Value, json};
use std::io::{self, Write};

use super::text::paragraph;

/// Prints a line for each injury. Before the mesh error is known, `mesh` is false and a line says that it
/// is not in the ranges, if what was computed is believed at all.
///
/// # Errors
/// Whatever `out` reports.
pub fn text(verdicts: &[Verdict], mesh: bool, out: &mut dyn Write) -> io::Result<()> {
    for (name, words) in lines(verdicts) {
        paragraph(&format!("{name}: {words}"), out)?;
    }
    if !mesh && verdicts.iter().any(Verdict::rests_on_the_run) {
        writeln!(out, "    (without the mesh error, which --mesh-error adds)")?;
    }
    Ok(())
}

/// One object an injury, with the part of every curve in the verdict.
pub fn json(verdicts: &[Verdict]) -> Value {
    let part = |(risk, part): &(Risk, Part)| {
        let (part, reason) = match part {
            Part::Believed => ("believed", None),
            Part::Agrees => ("agrees", None),
            Part::Disagrees(why) => ("disagrees", Some(*why)),
            Part::NotValid(why) => ("not_valid", Some(why.as_str())),
        };
        json!({
            "measure": risk.curve.measure.key(),
            "source": risk.curve.source,
            "risk_percent": 100.0 * risk.risk,
            "part": part,
            "reason": reason,
        })
    };
    let one = |verdict: &Verdict| {
        let range = verdict.range.map(|(low, high)| [100.0 * low, 100.0 * high]);
        json!({
            "injury": verdict.injury.key(),
            "word": verdict.word(),
            "risk_percent": range,
            "at_least": verdict.at_least,
            "energy_alone": verdict.alone,
            "text": verdict.words(),
            "measures": verdict.parts.iter().map(part).collect::<Vec<_>>(),
        })
    };
    verdicts.iter().map(one).collect()
}
