//! A cell of the table: a value with as many digits as its error allows, and that error below it.

use crate::answer::derived::Derived;
use crate::answer::solve::Answer;
use crate::many::comparison::ComparisonColumn;
use crate::report::figure::{Figure, Off};
use crate::report::verdict::{range, verdict};
use crate::run::quantity::Quantity;

/// What an answer has in a column, and how far that may be off. Whether a mesh error is still to
/// come.
pub fn cell(answer: &Answer, column: ComparisonColumn, mesh_comes: bool) -> (String, String) {
    let nothing = || ("-".to_owned(), String::new());
    match column {
        ComparisonColumn::Name => nothing(),
        ComparisonColumn::Result(quantity) => {
            if let Some(Derived::Believed(injury)) = quantity.derived()
                && let Some(range) = range(answer, quantity)
            {
                let word = verdict(answer, injury).and_then(|verdict| verdict.word());
                // A word of two says no more than the range.
                let word = word.filter(|word| word.len() < 10);
                return (range, word.unwrap_or_default());
            }
            let Some(figure) = Figure::of(answer, quantity) else {
                return nothing();
            };
            let error = match (quantity.derived(), figure.off) {
                (Some(Derived::Risk(..)), _) => return risk(answer, quantity, figure.number),
                (_, Off::Step(_)) if mesh_comes => "mesh …".to_owned(),
                (_, off) => off.to_string().replace(' ', ""),
            };
            (figure.number, error)
        }
    }
}

/// A risk with the letters of what to know before believing it, and its range.
fn risk(answer: &Answer, quantity: Quantity, value: String) -> (String, String) {
    let risks = answer.risks();
    let own = |risk: &&crate::injury::Risk| {
        let curve = risk.curve;
        matches!(quantity.derived(), Some(Derived::Risk(injury, measure)) if (injury, measure) == (curve.injury, curve.measure))
    };
    let Some(risk) = risks.iter().find(own) else {
        return (value, String::new());
    };
    let (low, high) = risk.band;
    let range = format!("{:.0}-{:.0}", 100.0 * low, 100.0 * high);
    (value + &risk.marks(), range)
}
