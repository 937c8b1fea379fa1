//! Total error against time as text and as JSON, for one result.

use crate::many::accuracy::{Accuracy, ROUNDS, TOLERANCES, Total, cheapest};
use crate::models::kernel_name;
use crate::plain_text::printable;
use crate::report::format::{or_dash, percent, significant};
use crate::report::json::{by_result, evaluations};
use crate::run::quantity::Quantity;
use crate::scenario::Scenario;
use serde_json::{Value, json};
use std::io::{self, Write};

pub fn text(name: &str, accuracy: &Accuracy, of: Quantity, out: &mut dyn Write) -> io::Result<()> {
    let counted = format!("M {}", accuracy.element.plural());
    writeln!(out, "{}: error of the {} against time", printable(name), of.label())?;
    writeln!(out, "kernel {}, times are medians of {ROUNDS} runs\n", kernel_name(false))?;
    writeln!(out, "level {counted:>10} {:>12}   mesh error", of.row().short)?;
    for (level, on) in (1..).zip(&accuracy.levels) {
        let error = match accuracy.mesh(level) {
            _ if on.folded.is_some() => "mesh folded".to_owned(),
            // It has no two finer ones to be compared with.
            None => "-".to_owned(),
            Some(mesh) => mesh[of].map_or_else(|| "unknown".to_owned(), percent),
        };
        let (value, work) = (or_dash(on.results[of], significant), on.elements * 1e-6);
        writeln!(out, "{level:>5} {work:>10.2} {value:>12}   {error}")?;
    }
    let fastest = accuracy.of(of);
    let name = |total: &Total| total.plan.integrator.name();
    let mut totals: Vec<&Total> = fastest.iter().collect();
    totals.sort_by(|a, b| b.step.total_cmp(&a.step));
    totals.sort_by_key(|total| (total.level, total.plan.integrator as usize));
    let heads = format!("step us {counted:>10}        ms step error      error");
    writeln!(out, "\n  level integrator           {heads}")?;
    for total in totals {
        let (front, level) = (if total.on_front { "*" } else { " " }, total.level);
        let (step, work) = (total.step * 1e6, total.elements * 1e-6);
        let (name, ms) = (name(total), total.seconds * 1e3);
        let [by_step, error] = [total.by_step, total.error()].map(percent);
        write!(out, "{front} {level:>5} {name:<19} {step:>8.4} {work:>10.3} ")?;
        writeln!(out, "{ms:>9.3} {by_step:>10} {error:>10}")?;
    }
    writeln!(out, "* nothing that is faster has an error as small\n\nThe cheapest:")?;
    for tolerance in TOLERANCES {
        let words = match cheapest(&fastest, tolerance).map(|at| &fastest[at]) {
            None => "none of these".to_owned(),
            Some(total) => {
                let (name, step, ms) = (name(total), total.step * 1e6, total.seconds * 1e3);
                format!("level {}, {name} at {step:.4} us, {ms:.3} ms", total.level)
            }
        };
        writeln!(out, "for {tolerance} %: {words}")?;
    }
    Ok(())
}

/// The report as one object: its trials from the fastest to the slowest.
pub fn json(scenario: &Scenario, accuracy: &Accuracy, of: Quantity) -> Value {
    let work = evaluations(accuracy.element);
    let totals = accuracy.of(of);
    let levels = (1..).zip(&accuracy.levels).map(|(level, on)| {
        json!({
            "level": level,
            work.as_str(): on.elements,
            "results": by_result(&on.results),
            "mesh_error_percent_by_result": accuracy.mesh(level).as_ref().map(by_result),
            "mesh_folded": on.folded.is_some(),
        })
    });
    let trials = totals.iter().map(|total| {
        json!({
            "level": total.level,
            "integrator": total.plan.integrator.name(),
            "step_us": total.step * 1e6,
            "automatic": total.is_answer,
            work.as_str(): total.elements,
            "median_ms": total.seconds * 1e3,
            "mesh_error_percent": total.mesh,
            "step_error_percent": total.by_step,
            "error_percent": total.error(),
            "on_front": total.on_front,
        })
    });
    let best = |most| json!({ "percent": most, "trial": cheapest(&totals, most) });
    json!({
        "program": crate::report::program(),
        "scenario": scenario,
        "kernel": kernel_name(false),
        "result": of.key(),
        "levels": levels.collect::<Value>(),
        "trials": trials.collect::<Value>(),
        "cheapest": TOLERANCES.map(best),
    })
}
