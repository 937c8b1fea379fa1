//! An ensemble as text of 80 columns and as one JSON object.

use crate::answer::uncertain::{Shape, UncertainInput};
use crate::injury::SIGNS;
use crate::many::{bands::Band, ensemble::Ensemble};
use crate::plain_text::printable;
use crate::report::figure::number_of;
use crate::report::format::{paragraph, percent, significant};
use crate::run::quantity::Quantity;
use crate::scenario::Scenario;
use serde_json::{Map, Value, json};
use std::io::{self, Write};

/// So many samples leave little scatter in the bands.
const MANY: usize = 1000;
/// Half the length of a bar of rank correlation, in characters.
const BAR: usize = 12;

/// A distribution in words.
pub fn distribution(input: &UncertainInput) -> String {
    let unit = input.field.unit;
    let (kind, a, between, b) = match input.shape {
        Shape::LogUniform(a, b) => ("log-uniform", a, "to", b),
        Shape::Uniform(a, b) => ("uniform", a, "to", b),
        Shape::Normal(mean, sd) => ("normal", mean, "±", sd),
    };
    let (a, b) = (significant(a), significant(b));
    format!("{kind} {a} {between} {b} {unit}").trim_end().to_owned()
}

/// Two digits, without a sign where they are zero.
pub fn hundredths(value: f64) -> String {
    let text = format!("{value:.2}");
    if text == "-0.00" { "0.00".to_owned() } else { text }
}

/// A bar from the middle, to the left for less than zero.
pub fn bar(correlation: f64, half: usize) -> String {
    let length = ((correlation.abs() * half as f64).round() as usize).min(half);
    let (space, full) = (" ".repeat(half - length), "█".repeat(length));
    if correlation < 0.0 {
        format!("{space}{full}│{}", " ".repeat(half))
    } else {
        format!("{}│{full}{space}", " ".repeat(half))
    }
}

/// Prints bands, drivers of `drives`, counts and cost.
pub fn text(
    scenario: &Scenario,
    ensemble: &Ensemble,
    drives: Quantity,
    out: &mut dyn Write,
) -> io::Result<()> {
    let done = ensemble.samples.len();
    writeln!(out, "{}", printable(&scenario.name))?;
    let stopped = if ensemble.stopped() {
        format!(", stopped: {} were asked for", ensemble.asked)
    } else {
        String::new()
    };
    writeln!(out, "{done} samples of seed {}{stopped}\n", ensemble.seed)?;
    writeln!(out, "{:<22}{:>12}{:>12}{:>12}{:>16}", "", "5 %", "median", "95 %", "as entered")?;
    let mut risks = false;
    for quantity in ensemble.results() {
        let Some(band) = ensemble.band(quantity) else {
            continue;
        };
        let Band { low, median, high } = band;
        if quantity.is_risk() && !risks {
            risks = true;
            writeln!(out, "{:<22}{:>12}{:>12}{:>12}", "", "10 %", "median", "90 %")?;
        }
        let nominal = ensemble.nominal.as_ref().and_then(|n| n[quantity]);
        let row = quantity.row();
        let said = |value| number_of(quantity, value, significant);
        writeln!(
            out,
            "{:<19}{:>3}{:>12}{:>12}{:>12}{:>16}",
            row.label,
            row.unit,
            said(low),
            said(median),
            said(high),
            nominal.map_or_else(String::new, said)
        )?;
    }
    for remark in flat(ensemble).into_iter().chain(outside(ensemble)) {
        paragraph(&remark, out)?;
    }
    if ensemble.valid().next().is_none() {
        writeln!(out, "no sample has a valid result")?;
    }
    writeln!(out, "\nWhat drives {} (rank correlation)", drives.label())?;
    for (input, correlation) in ensemble.drivers(drives) {
        writeln!(
            out,
            "{:<20} {:>5} {}",
            ensemble.inputs[input].field.label,
            hundredths(correlation),
            bar(correlation, BAR)
        )?;
    }
    if ensemble.values(drives).is_none() {
        writeln!(out, "the scene has no such result")?;
    }
    if ensemble.inputs.is_empty() {
        writeln!(out, "nothing was drawn: every input is held to be known")?;
    }
    writeln!(out, "\nDrawn from")?;
    for input in &ensemble.inputs {
        let source = input.source.unwrap_or("your doubt");
        let what = format!("{:<20} {}", input.field.label, distribution(input));
        writeln!(out, "{what}\n    {source}")?;
    }
    counts(ensemble, out)?;
    cost(ensemble, out)?;
    writeln!(out)?;
    paragraph(SIGNS, out)
}

/// In how many samples the eye was pressed flat, in words; none where in none.
fn flat(ensemble: &Ensemble) -> Option<String> {
    let samples = ensemble.valid();
    let flat = samples.filter(|(_, run)| run.pressed_flat()).count();
    let of = ensemble.valid().count();
    (flat > 0).then(|| {
        format!(
            "! in {flat} of {of} samples the eye was pressed flat: their results are at least so \
             large, and no eye was tested so hard"
        )
    })
}

/// Which results lie outside their bands as they stand, one line for each input that may be why.
fn outside(ensemble: &Ensemble) -> Vec<String> {
    let mut found: Vec<(Option<&str>, Vec<&str>)> = Vec::new();
    for of in ensemble.results() {
        let Some(input) = ensemble.outside(of) else {
            continue;
        };
        let (why, label) = (input.map(|input| input.field.label), of.label());
        match found.iter_mut().find(|(known, _)| *known == why) {
            Some((_, labels)) => labels.push(label),
            None => found.push((why, vec![label])),
        }
    }
    let said = |(why, labels): &(Option<&str>, Vec<&str>)| {
        let labels = labels.join(", ");
        let why = why.map_or_else(String::new, |input| {
            format!(", as {input} stands at an end of its spread")
        });
        format!("! as entered it lies outside its band: {labels}{why}")
    };
    found.iter().map(said).collect()
}

fn counts(ensemble: &Ensemble, out: &mut dyn Write) -> io::Result<()> {
    let (done, valid) = (ensemble.samples.len(), ensemble.valid().count());
    writeln!(out, "\nThe bands hold {valid} of {done} samples: {}", ensemble.which())?;
    for (name, count) in ensemble.counts() {
        writeln!(out, "{count:>7}  {name}")?;
    }
    let checks = ensemble.checks();
    if checks.count == 0 {
        writeln!(
            out,
            "Step error: not checked, as no sample kept its mesh whole and its eye in shape"
        )?;
    } else {
        let worst = match checks.first {
            Some(error) => format!("at the common step {}", percent(error)),
            None => percent(checks.last),
        };
        writeln!(
            out,
            "Step error: {} samples set beside twice as many steps; worst {worst}",
            checks.count,
        )?;
    }
    if checks.refined > 0 {
        writeln!(
            out,
            "  {} above {} % were refined, {} of them after the pilot; now at most {}",
            checks.refined,
            ensemble.promise,
            checks.missed,
            percent(checks.last)
        )?;
    }
    Ok(())
}

fn cost(ensemble: &Ensemble, out: &mut dyn Write) -> io::Result<()> {
    let timing = &ensemble.timing;
    let each = timing.cores / ensemble.samples.len().max(1) as f64;
    write!(
        out,
        "Took {:.2} s on {} threads: {:.2} core-ms a sample",
        timing.wall,
        timing.threads,
        each * 1e3,
    )?;
    if let Some(single) = timing.single {
        write!(out, ", {:.2} times the single case ({:.2} ms)", each / single, single * 1e3)?;
    }
    writeln!(out)?;
    let done = ensemble.samples.len();
    if done < MANY && !ensemble.stopped() {
        let wall = (timing.wall * MANY as f64 / done.max(1) as f64).max(1.0);
        writeln!(out, "More samples, steadier bands: --samples {MANY} (about {wall:.0} s)")?;
    }
    Ok(())
}

fn band(ensemble: &Ensemble, of: Quantity) -> Value {
    let nominal = ensemble.nominal.as_ref().and_then(|n| n[of]);
    let drivers: Map<String, Value> = ensemble
        .drivers(of)
        .into_iter()
        .map(|(i, r)| (ensemble.inputs[i].field.path.to_owned(), json!(r)))
        .collect();
    ensemble.band(of).map_or(Value::Null, |band| {
        json!({
            if of.is_risk() { "p10" } else { "p05" }: band.low,
            "median": band.median,
            if of.is_risk() { "p90" } else { "p95" }: band.high,
            "as_it_stands": nominal,
            "as_it_stands_is_outside": ensemble.outside(of).is_some(),
            "rank_correlation": drivers,
        })
    })
}

fn input(of: &UncertainInput) -> Value {
    let (kind, [first, second], a, b) = match of.shape {
        Shape::LogUniform(a, b) => ("log_uniform", ["low", "high"], a, b),
        Shape::Uniform(a, b) => ("uniform", ["low", "high"], a, b),
        Shape::Normal(a, b) => ("normal", ["mean", "sd"], a, b),
    };
    json!({
        "field": of.field.path,
        "unit": of.field.unit,
        "distribution": kind,
        first: a,
        second: b,
        "source": of.source.unwrap_or("doubt of the scenario"),
    })
}

/// An ensemble as one JSON object.
pub fn json(scenario: &Scenario, ensemble: &Ensemble) -> Value {
    let checks = ensemble.checks();
    let timing = &ensemble.timing;
    let done = ensemble.samples.len();
    let each = timing.cores / done.max(1) as f64;
    let results: Map<String, Value> = ensemble
        .results()
        .into_iter()
        .map(|of| (of.key().to_owned(), band(ensemble, of)))
        .collect();
    json!({
        "scenario": scenario,
        "samples": done,
        "asked": ensemble.asked,
        "stopped": ensemble.stopped(),
        "seed": ensemble.seed,
        "inputs": ensemble.inputs.iter().map(input).collect::<Vec<_>>(),
        "results": results,
        "counted": {
            "in_the_bands": ensemble.valid().count(),
            "folded": ensemble.folded(),
            "by_name": ensemble.counts().into_iter().map(|(name, n)| (name, json!(n))).collect::<Map<_, _>>(),
        },
        "step_error": {
            "promise_percent": ensemble.promise,
            "checked": checks.count,
            "refined": checks.refined,
            "above_promise_after_pilot": checks.missed,
            "worst_at_the_common_step_percent": checks.first,
            "worst_percent": (checks.count > 0).then_some(checks.last),
            "longest_step_us": ensemble.cap.map(|cap| cap * 1e6),
        },
        "timing": {
            "wall_s": timing.wall,
            "threads": timing.threads,
            "core_ms_per_sample": each * 1e3,
            "single_case_ms": timing.single.map(|single| single * 1e3),
            "ratio_to_single_case": timing.single.map(|single| each / single),
        },
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bars_grow_from_the_middle() {
        assert_eq!(bar(0.5, 4), "    │██  ");
        assert_eq!(bar(-1.0, 4), "████│    ");
        assert_eq!(bar(0.0, 2), "  │  ");
        assert_eq!([-0.004, -0.25].map(hundredths), ["0.00", "-0.25"]);
    }
}
