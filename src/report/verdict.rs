//! The answer first: one line an injury, in text and as JSON.

use crate::injury::{Curve, Part, Risk, Verdict, curve_of, lines};
use crate::study::Quantity;
use crate::study::quantity::Read;
use serde_json::{Value, json};
use std::io::{self, Write};

use super::text::paragraph;

/// What is said of a risk that means nothing here.
pub const VOID: &str = "not valid here";

/// The part that a curve has in the verdicts.
pub fn part_of<'a>(verdicts: &'a [Verdict], curve: &Curve) -> Option<&'a Part> {
    let mut parts = verdicts.iter().flat_map(|verdict| &verdict.parts);
    let part = parts.find(|(of, _)| of.curve == curve)?;
    Some(&part.1)
}

/// Whether a result is a risk that means nothing here.
pub fn is_void(verdicts: &[Verdict], of: Quantity) -> bool {
    let Read::Risk(injury, measure) = of.row().read else {
        return false;
    };
    let part = curve_of(injury, measure).and_then(|curve| part_of(verdicts, curve));
    matches!(part, Some(Part::NotValid(_)))
}

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
