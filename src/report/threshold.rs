//! A threshold as text of 80 columns and as one JSON object.

use std::io::{self, Write};

use serde_json::{Value, json};

use crate::injury::{A_BB, SIGNS, whole};
use crate::many::threshold::{Crossing, Threshold, ThresholdSearch};
use crate::plain_text::printable;
use crate::report::figure::{allowing, with_unit as united};
use crate::report::format::{block, capital, digits, paragraph, significant};
use crate::report::json::flags;
use crate::scenario::Scenario;

/// A text with the unit of the field that is varied.
fn with_unit(search: &ThresholdSearch, text: &str) -> String {
    united(text, search.field.unit)
}

/// Where the result passes the value, no finer than it is known.
fn at(search: &ThresholdSearch, crossing: &Crossing) -> String {
    let curves = crossing.risk.as_ref().map(|there| there.range);
    let width = curves.and_then(|(from, to)| Some(0.5 * (to? - from?)));
    let largest = [crossing.step, crossing.mesh, width];
    let largest = largest.into_iter().flatten().fold(0.0, f64::max);
    with_unit(search, &allowing(crossing.at, Some(largest)))
}

/// A crossing in one line: `50 % at 61 m/s ± 2`, by the larger error.
pub fn brief(search: &ThresholdSearch, crossing: &Crossing) -> String {
    let unit = search.quantity.row().unit;
    let target = united(&search.target.to_string(), unit);
    let at = format!("{target} at {}", at(search, crossing));
    let way = if crossing.rising { "" } else { ", falling" };
    if let (Some(there), None) = (&crossing.risk, crossing.jump) {
        let unit = |text: String| with_unit(search, &text);
        let range = range(there.range, &unit);
        let range = range.map_or(", range not known".to_owned(), |range| format!(" ({range})"));
        return format!("{at}{range}{way}");
    }
    let off = match (crossing.jump, crossing.step, crossing.mesh) {
        (Some(_), ..) => ": it jumps there".to_owned(),
        (None, Some(step), Some(mesh)) => {
            let off = step.max(mesh);
            if off > search.range.1 - search.range.0 {
                ", error beyond the range".to_owned()
            } else if off > 0.0 {
                format!(" ± {}", digits(off, 2))
            } else {
                String::new()
            }
        }
        _ => ", error not known".to_owned(),
    };
    format!("{at}{off}{way}")
}

/// The words for a target that is never reached, with the range of the result instead.
pub fn never(search: &ThresholdSearch, threshold: &Threshold) -> String {
    let (low, high) = (end(search, threshold, false), end(search, threshold, true));
    format!("Never: {low} to {high}.")
}

/// The least or the greatest result that was seen, and where.
fn end(search: &ThresholdSearch, threshold: &Threshold, highest: bool) -> String {
    let result = |(at, result): &(f64, Result<f64, String>)| Some((*at, *result.as_ref().ok()?));
    let sign = if highest { -1.0 } else { 1.0 };
    let known = threshold.seen.iter().filter_map(result);
    let (at, value) =
        known.min_by(|a, b| (sign * a.1).total_cmp(&(sign * b.1))).unwrap_or((f64::NAN, f64::NAN));
    let at = with_unit(search, &significant(at));
    let value = if search.quantity.is_risk() {
        whole(0.01 * value)
    } else {
        united(&significant(value), search.quantity.row().unit)
    };
    format!("{value} at {at}")
}

/// Prints where the result reaches the value.
pub fn text(
    scenario: &Scenario,
    search: &ThresholdSearch,
    threshold: &Threshold,
    out: &mut dyn Write,
) -> io::Result<()> {
    let row = search.quantity.row();
    let with_unit = |text: String| with_unit(search, &text);
    writeln!(out, "{}\n", printable(&scenario.name))?;
    let target = united(&search.target.to_string(), row.unit);
    let what = format!("{} {target}", capital(row.label));
    for crossing in &threshold.crossings {
        let at = at(search, crossing);
        let way = if crossing.rising { "rising" } else { "falling" };
        writeln!(out, "{what} at {at} ({}), {way}", search.field.path)?;
        let whole = search.range.1 - search.range.0;
        for line in lines(crossing, whole, row.unit, &with_unit) {
            writeln!(out, "  {line}")?;
        }
        if let Some(there) = &crossing.risk {
            let holds = match range(there.range, &with_unit) {
                Some(range) => format!("range {range}: the range of the risk holds {target} there"),
                None => "range not known".to_owned(),
            };
            block(&holds, "  ", "    ", out)?;
            let words =
                format!("there {}: {}; {A_BB}", there.risk.injury.name(), there.risk.words());
            block(&words, "  ", "    ", out)?;
        }
        for flag in &crossing.flags {
            let line = format!("FLAG {}: {}", flag.kind.name(), flag.whole());
            block(&line, "  ", "    ", out)?;
        }
    }
    match threshold.crossings.len() {
        0 => {
            let (from, to) = (significant(search.range.0), significant(search.range.1));
            writeln!(out, "{what}: not from {from} to {}", with_unit(to))?;
        }
        1 => writeln!(out)?,
        count => writeln!(out, "\n{count} crossings: it does not only rise or fall")?,
    }
    writeln!(
        out,
        "Looked at {} values from {} to {}:\n{} to {}",
        threshold.seen.len(),
        significant(search.range.0),
        with_unit(significant(search.range.1)),
        end(search, threshold, false),
        end(search, threshold, true),
    )?;
    let refused: Vec<_> = threshold.seen.iter().filter(|(_, r)| r.is_err()).collect();
    if let Some((at, Err(why))) = refused.first() {
        let at = with_unit(significant(*at));
        let text = format!("No result at {} of them, the first {at}: {why}", refused.len());
        block(&printable(&text), "", "    ", out)?;
    }
    writeln!(out)?;
    paragraph(SIGNS, out)
}

/// Over which values the range of a risk holds the target, with all that is not known.
fn range(of: (Option<f64>, Option<f64>), with_unit: &dyn Fn(String) -> String) -> Option<String> {
    Some(match of {
        (Some(from), Some(to)) => {
            let [from, to] = [from, to].map(|end| allowing(end, Some(0.5 * (to - from))));
            format!("{from} to {}", with_unit(to))
        }
        (Some(from), None) => format!("from {} on", with_unit(digits(from, 2))),
        (None, Some(to)) => format!("up to {}", with_unit(digits(to, 2))),
        (None, None) => return None,
    })
}

/// A line for the step error and one for the mesh error of a crossing, or one for its jump.
fn lines(
    crossing: &Crossing,
    whole: f64,
    unit: &str,
    with_unit: &dyn Fn(String) -> String,
) -> Vec<String> {
    if let Some((from, to)) = crossing.jump {
        let (from, to) = (significant(from), significant(to));
        let to = united(&to, unit);
        return vec![format!("jumps there, from {from} to {to}")];
    }
    if crossing.risk.is_some() {
        return Vec::new();
    }
    let off = |name: &str, error: Option<f64>| match error {
        Some(error) if error > whole => format!("{name:<5} ± more than the whole range"),
        Some(error) => format!("{name:<5} ± {}", with_unit(digits(error, 2))),
        None => format!("{name:<5} error not known"),
    };
    vec![off("step", crossing.step), off("mesh", crossing.mesh)]
}

/// A threshold as one object.
pub fn json(scenario: &Scenario, search: &ThresholdSearch, threshold: &Threshold) -> Value {
    let crossing = |c: &Crossing| {
        json!({
            "at": c.at,
            "direction": if c.rising { "rising" } else { "falling" },
            "error": { "time_step": c.step, "mesh": c.mesh },
            "jump": c.jump.map(|(from, to)| json!({ "from": from, "to": to })),
            "flags": flags(&c.flags),
            "risk": c.risk.as_ref().map(|there| json!({
                "text": there.risk.words(),
                "from": there.range.0,
                "to": there.range.1,
            })),
        })
    };
    let seen = |(at, result): &(f64, Result<f64, String>)| match result {
        Ok(value) => json!({ "at": at, "value": value }),
        Err(why) => json!({ "at": at, "refused": why }),
    };
    json!({
        "scenario": scenario,
        "vary": {
            "field": search.field.path,
            "unit": search.field.unit,
            "from": search.range.0,
            "to": search.range.1,
        },
        "until": { "result": search.quantity.key(), "value": search.target },
        "crossings": threshold.crossings.iter().map(crossing).collect::<Vec<_>>(),
        "looked_at": threshold.seen.iter().map(seen).collect::<Vec<_>>(),
    })
}
