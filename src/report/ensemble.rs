//! An ensemble as text of 80 columns and as one JSON object.

use crate::answer::uncertain::{Shape, UncertainInput};
use crate::injury::SIGNS;
use crate::many::bands::{Band, Checks};
use crate::many::ensemble::{Ensemble, Timing};
use crate::plain_text::printable;
use crate::report::figure::{number_of, with_unit};
use crate::report::format::{grouped, paragraph, percent, significant};
use crate::run::quantity::Quantity;
use crate::scenario::Scenario;
use serde_json::{Value, json};
use std::io::{self, Write};

/// So many samples leave little scatter in the bands.
const MANY: usize = 1000;
/// Half the length of a bar of rank correlation, in characters.
const BAR: usize = 12;

pub fn distribution(input: &UncertainInput) -> String {
    let (kind, a, between, b) = match input.shape {
        Shape::LogUniform(a, b) => ("log-uniform", a, "to", b),
        Shape::Uniform(a, b) => ("uniform", a, "to", b),
        Shape::Normal(mean, sd) => ("normal", mean, "±", sd),
    };
    let [a, b] = [a, b].map(significant);
    with_unit(&format!("{kind} {a} {between} {b}"), input.field.unit)
}

/// Two digits, without a sign where they are zero.
pub fn hundredths(value: f64) -> String {
    let text = format!("{value:.2}");
    if text == "-0.00" { "0.00".to_owned() } else { text }
}

/// A bar from the middle, to the left for less than zero.
pub fn bar(correlation: f64, half: usize) -> String {
    let length = ((correlation.abs() * half as f64).round() as usize).min(half);
    let full = "█".repeat(length);
    let [left, right] = if correlation < 0.0 { [&*full, ""] } else { ["", &*full] };
    format!("{left:>half$}│{right:<half$}")
}

pub fn text(name: &str, ensemble: &Ensemble, of: Quantity, out: &mut dyn Write) -> io::Result<()> {
    writeln!(out, "{}", printable(name))?;
    write!(out, "{} samples of seed {}", ensemble.samples.len(), ensemble.seed)?;
    if ensemble.stopped() {
        write!(out, ", stopped: {} were asked for", ensemble.asked)?;
    }
    writeln!(out, "\n\n{:<22}{:>12}{:>12}{:>12}{:>16}", "", "5 %", "median", "95 %", "as entered")?;
    let mut risks = false;
    for quantity in ensemble.results() {
        let Some(Band { low, median, high }) = ensemble.band(quantity) else { continue };
        if quantity.is_risk() && !risks {
            risks = true;
            writeln!(out, "{:<22}{:>12}{:>12}{:>12}", "", "10 %", "median", "90 %")?;
        }
        let row = quantity.row();
        let said = |value| number_of(quantity, value, significant);
        let [low, median, high] = [low, median, high].map(said);
        let nominal = nominal(ensemble, quantity).map_or_else(String::new, said);
        write!(out, "{:<19}{:>3}{low:>12}{median:>12}", row.label, row.unit)?;
        writeln!(out, "{high:>12}{nominal:>16}")?;
    }
    for remark in flat(ensemble).into_iter().chain(outside(ensemble)) {
        paragraph(&remark, out)?;
    }
    if ensemble.valid().next().is_none() {
        writeln!(out, "no sample has a valid result")?;
    }
    writeln!(out, "\nWhat drives {} (rank correlation)", of.label())?;
    for (input, correlation) in ensemble.drivers(of) {
        let (label, value) = (ensemble.inputs[input].field.label, hundredths(correlation));
        writeln!(out, "{label:<20} {value:>5} {}", bar(correlation, BAR))?;
    }
    if ensemble.values(of).is_none() {
        writeln!(out, "the scene has no such result")?;
    }
    if ensemble.inputs.is_empty() {
        writeln!(out, "nothing was drawn: every input is held to be known")?;
    }
    writeln!(out, "\nDrawn from")?;
    for input in &ensemble.inputs {
        writeln!(out, "{:<20} {}", input.field.label, distribution(input))?;
        writeln!(out, "    {}", input.source.unwrap_or("your doubt"))?;
    }
    counts(ensemble, out)?;
    cost(ensemble, out)?;
    writeln!(out)?;
    paragraph(SIGNS, out)
}

/// A result of the scenario as it stands.
fn nominal(ensemble: &Ensemble, of: Quantity) -> Option<f64> {
    ensemble.nominal.as_ref()?[of]
}

/// In how many samples the eye was pressed flat, in words; none where in none.
fn flat(ensemble: &Ensemble) -> Option<String> {
    let flat = ensemble.valid().filter(|(_, run)| run.pressed_flat()).count();
    let of = ensemble.valid().count();
    let why = "their results are at least so large, and no eye was tested so hard";
    (flat > 0).then(|| format!("! in {flat} of {of} samples the eye was pressed flat: {why}"))
}

/// Which results lie outside their bands as they stand, one line for each input that may be why.
fn outside(ensemble: &Ensemble) -> Vec<String> {
    let found = ensemble.results().into_iter().filter_map(|of| {
        let why = ensemble.outside(of)?.map(|input| input.field.label);
        Some((why, of.label()))
    });
    let said = |(why, labels): &(Option<&str>, Vec<&str>)| {
        let why = why.map(|input| format!(", as {input} stands at an end of its spread"));
        let why = why.unwrap_or_default();
        format!("! as entered it lies outside its band: {}{why}", labels.join(", "))
    };
    grouped(found).iter().map(said).collect()
}

fn counts(ensemble: &Ensemble, out: &mut dyn Write) -> io::Result<()> {
    let (done, valid) = (ensemble.samples.len(), ensemble.valid().count());
    writeln!(out, "\nThe bands hold {valid} of {done} samples: {}", ensemble.which())?;
    let counts = ensemble.counts();
    counts.iter().try_for_each(|(name, count)| writeln!(out, "{count:>7}  {name}"))?;
    let Checks { count, refined, missed, first, last, leading } = ensemble.checks();
    let (last, promise) = (percent(last), ensemble.promise);
    if count == 0 {
        let why = "no sample kept its mesh whole and its eye in shape";
        writeln!(out, "Step error: not checked, as {why}")?;
    } else {
        let worst = first.map(|error| format!("at the common step {}", percent(error)));
        let worst = worst.as_ref().unwrap_or(&last);
        writeln!(out, "Step error: {count} samples set beside twice as many steps; worst {worst}")?;
    }
    if refined > 0 {
        write!(out, "  {refined} above {promise} % were refined, ")?;
        let now = format!("now at most {}, of results that lead", percent(leading));
        writeln!(out, "{missed} of them after the pilot;\n  {now}")?;
    }
    Ok(())
}

fn cost(ensemble: &Ensemble, out: &mut dyn Write) -> io::Result<()> {
    let Timing { wall, threads, single, .. } = ensemble.timing;
    let (done, each) = (ensemble.samples.len(), core_seconds(ensemble));
    write!(out, "Took {wall:.2} s on {threads} threads: {:.2} core-ms a sample", each * 1e3)?;
    if let Some(single) = single {
        write!(out, ", {:.2} times the single case ({:.2} ms)", each / single, single * 1e3)?;
    }
    writeln!(out)?;
    if done < MANY && !ensemble.stopped() {
        let wall = (wall * MANY as f64 / done.max(1) as f64).max(1.0);
        writeln!(out, "More samples, steadier bands: --samples {MANY} (about {wall:.0} s)")?;
    }
    Ok(())
}

/// What a sample took, in s on one core.
fn core_seconds(ensemble: &Ensemble) -> f64 {
    ensemble.timing.cores / ensemble.samples.len().max(1) as f64
}

fn band(ensemble: &Ensemble, of: Quantity) -> Option<Value> {
    let band = ensemble.band(of)?;
    let drivers = ensemble.drivers(of).into_iter();
    let drivers = drivers.map(|(input, by)| (ensemble.inputs[input].field.path, by));
    Some(json!({
        if of.is_risk() { "p10" } else { "p05" }: band.low,
        "median": band.median,
        if of.is_risk() { "p90" } else { "p95" }: band.high,
        "as_it_stands": nominal(ensemble, of),
        "as_it_stands_is_outside": ensemble.outside(of).is_some(),
        "rank_correlation": drivers.collect::<Value>(),
    }))
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

pub fn json(scenario: &Scenario, ensemble: &Ensemble) -> Value {
    let checks = ensemble.checks();
    let (timing, each) = (&ensemble.timing, core_seconds(ensemble));
    let results = ensemble.results().into_iter().map(|of| (of.key(), band(ensemble, of)));
    json!({
        "program": crate::report::program(),
        "scenario": scenario,
        "samples": ensemble.samples.len(),
        "asked": ensemble.asked,
        "stopped": ensemble.stopped(),
        "seed": ensemble.seed,
        "inputs": ensemble.inputs.iter().map(input).collect::<Value>(),
        "results": results.collect::<Value>(),
        "counted": {
            "in_the_bands": ensemble.valid().count(),
            "folded": ensemble.folded(),
            "by_name": ensemble.counts().into_iter().collect::<Value>(),
        },
        "step_error": {
            "promise_percent": ensemble.promise,
            "checked": checks.count,
            "refined": checks.refined,
            "above_promise_after_pilot": checks.missed,
            "worst_at_the_common_step_percent": checks.first,
            "worst_percent": (checks.count > 0).then_some(checks.last),
            "worst_leading_percent": (checks.count > 0).then_some(checks.leading),
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
