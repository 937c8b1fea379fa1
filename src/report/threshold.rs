//! A threshold as text of 80 columns and as one JSON object.

use std::io::{self, Write};

use serde_json::{Value, json};

use crate::injury::{SIGNS, whole};
use crate::many::threshold::{Crossing, Threshold, ThresholdSearch};
use crate::plain_text::printable;
use crate::report::figure::{allowing, with_unit};
use crate::report::format::{block, capital, digits, paragraph, significant};
use crate::report::json::flags;
use crate::scenario::Scenario;

/// Where the result passes the value, no finer than it is known.
fn at(search: &ThresholdSearch, crossing: &Crossing) -> String {
    let curves = crossing.risk.as_ref().map(|there| there.range);
    let width = curves.and_then(|(from, to)| Some(0.5 * (to? - from?)));
    let largest = [crossing.step, crossing.mesh, width].into_iter().flatten().fold(0.0, f64::max);
    with_unit(&allowing(crossing.at, Some(largest)), search.field.unit)
}

fn target(search: &ThresholdSearch) -> String {
    with_unit(&search.target.to_string(), search.quantity.row().unit)
}

/// A crossing in one line: `50 % at 61 m/s ± 2`, by the larger error.
pub fn brief(search: &ThresholdSearch, crossing: &Crossing) -> String {
    let off = match (&crossing.risk, crossing.jump, crossing.step, crossing.mesh) {
        (Some(there), None, ..) => match range(there.range, search.field.unit) {
            Some(range) => format!(" ({range})"),
            None => ", range not known".to_owned(),
        },
        (_, Some(_), ..) => ": it jumps there".to_owned(),
        (_, None, Some(step), Some(mesh)) => match step.max(mesh) {
            off if off > search.range.1 - search.range.0 => ", error beyond the range".to_owned(),
            off if off > 0.0 => format!(" ± {}", digits(off, 2)),
            _ => String::new(),
        },
        _ => ", error not known".to_owned(),
    };
    let way = if crossing.rising { "" } else { ", falling" };
    format!("{} at {}{off}{way}", target(search), at(search, crossing))
}

/// The words for a target that is never reached, with the range of the result instead.
pub fn never(search: &ThresholdSearch, threshold: &Threshold) -> String {
    format!("Never: {}.", span(search, threshold))
}

/// The least and the greatest result that were seen, and where.
fn span(search: &ThresholdSearch, threshold: &Threshold) -> String {
    let result = |(at, result): &(f64, Result<f64, String>)| Some((*at, *result.as_ref().ok()?));
    let ends = [1.0, -1.0].map(|sign| {
        let known = threshold.seen.iter().filter_map(result);
        let least = known.min_by(|a, b| (sign * a.1).total_cmp(&(sign * b.1)));
        let (at, value) = least.unwrap_or((f64::NAN, f64::NAN));
        let value = if search.quantity.is_risk() {
            whole(0.01 * value)
        } else {
            with_unit(&significant(value), search.quantity.row().unit)
        };
        format!("{value} at {}", with_unit(&significant(at), search.field.unit))
    });
    ends.join(" to ")
}

pub fn text(
    scenario: &Scenario,
    search: &ThresholdSearch,
    threshold: &Threshold,
    out: &mut dyn Write,
) -> io::Result<()> {
    let (row, field, target) = (search.quantity.row(), search.field, target(search));
    writeln!(out, "{}\n", printable(&scenario.name))?;
    let of = if search.quantity.is_risk() { " of eyes hit so" } else { "" };
    let what = format!("{} {target}{of}", capital(row.label));
    for crossing in &threshold.crossings {
        let (at, path) = (at(search, crossing), field.path);
        writeln!(out, "{what} at {at} ({path}), {}", direction(crossing))?;
        lines(search, crossing).iter().try_for_each(|line| writeln!(out, "  {line}"))?;
        let mut more = Vec::new();
        if let Some(there) = &crossing.risk {
            more.push(match range(there.range, field.unit) {
                Some(range) => format!("range {range}: the range of the risk holds {target} there"),
                None => "range not known".to_owned(),
            });
            let name = there.risk.injury.name();
            more.push(format!("there {name}: {}", there.risk.words()));
        }
        let flags = crossing.flags.iter();
        more.extend(flags.map(|flag| format!("FLAG {}: {}", flag.kind.name(), flag.whole())));
        more.iter().try_for_each(|line| block(line, "  ", "    ", out))?;
    }
    let from = significant(search.range.0);
    let to = with_unit(&significant(search.range.1), field.unit);
    match threshold.crossings.len() {
        0 => writeln!(out, "{what}: not from {from} to {to}")?,
        1 => writeln!(out)?,
        count => writeln!(out, "\n{count} crossings: it does not only rise or fall")?,
    }
    writeln!(out, "Looked at {} values from {from} to {to}:", threshold.seen.len())?;
    writeln!(out, "{}", span(search, threshold))?;
    let refused: Vec<_> = threshold.seen.iter().filter(|(_, r)| r.is_err()).collect();
    if let Some((at, Err(why))) = refused.first() {
        let at = with_unit(&significant(*at), field.unit);
        let text = format!("No result at {} of them, the first {at}: {why}", refused.len());
        paragraph(&printable(&text), out)?;
    }
    writeln!(out)?;
    paragraph(SIGNS, out)
}

fn direction(crossing: &Crossing) -> &'static str {
    if crossing.rising { "rising" } else { "falling" }
}

/// Over which values the range of a risk holds the target, with all that is not known.
fn range(of: (Option<f64>, Option<f64>), unit: &str) -> Option<String> {
    let words = match of {
        (Some(from), Some(to)) => {
            let [from, to] = [from, to].map(|end| allowing(end, Some(0.5 * (to - from))));
            format!("{from} to {}", with_unit(&to, unit))
        }
        (Some(from), None) => format!("from {} on", with_unit(&digits(from, 2), unit)),
        (None, Some(to)) => format!("up to {}", with_unit(&digits(to, 2), unit)),
        (None, None) => return None,
    };
    Some(words)
}

/// A line for the step error and one for the mesh error of a crossing, or one for its jump.
fn lines(search: &ThresholdSearch, crossing: &Crossing) -> Vec<String> {
    if let Some((from, to)) = crossing.jump {
        let to = with_unit(&significant(to), search.quantity.row().unit);
        return vec![format!("jumps there, from {} to {to}", significant(from))];
    }
    if crossing.risk.is_some() {
        return Vec::new();
    }
    let whole = search.range.1 - search.range.0;
    let off = |(name, error): (&str, Option<f64>)| match error {
        Some(error) if error > whole => format!("{name} ± more than the whole range"),
        Some(error) => format!("{name} ± {}", with_unit(&digits(error, 2), search.field.unit)),
        None => format!("{name} error not known"),
    };
    [("step ", crossing.step), ("mesh ", crossing.mesh)].map(off).to_vec()
}

pub fn json(scenario: &Scenario, search: &ThresholdSearch, threshold: &Threshold) -> Value {
    let crossing = |c: &Crossing| {
        json!({
            "at": c.at,
            "direction": direction(c),
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
        "program": crate::report::program(),
        "scenario": scenario,
        "vary": {
            "field": search.field.path,
            "unit": search.field.unit,
            "from": search.range.0,
            "to": search.range.1,
        },
        "until": { "result": search.quantity.key(), "value": search.target },
        "crossings": threshold.crossings.iter().map(crossing).collect::<Value>(),
        "looked_at": threshold.seen.iter().map(seen).collect::<Value>(),
    })
}
