//! A cell of the table: a value with as many digits as its error allows, and that error below it.

use crate::answer::solve::Answer;
use crate::injury::Injury;
use crate::many::comparison::ComparisonColumn;
use crate::report::figure::{Figure, Off};
use crate::report::risks::range;

/// What an answer has in a column, and how far that may be off; of a risk its range and its word.
/// Whether a mesh error is still to come.
pub fn cell(answer: &Answer, column: ComparisonColumn, mesh_comes: bool) -> (String, String) {
    let nothing = || ("-".to_owned(), String::new());
    let ComparisonColumn::Result(quantity) = column else {
        return nothing();
    };
    let risk = Injury::of(quantity).and_then(|injury| answer.risk(injury));
    if let (Some(risk), Some(range)) = (risk, range(answer, quantity)) {
        let word = risk.word();
        // One of several words says no more than the range.
        return (range, if word.contains(' ') { String::new() } else { word });
    }
    let Some(figure) = Figure::of(answer, quantity) else {
        return nothing();
    };
    let error = match figure.off {
        Off::Known(_) if mesh_comes && answer.errors.mesh.is_none() => "mesh …".to_owned(),
        off => off.to_string().replace(' ', ""),
    };
    (figure.number, error)
}
