//! Total error against time as text and as JSON, for one result.

use crate::many::accuracy::{Accuracy, ROUNDS, TOLERANCES, Total, cheapest};
use crate::models::kernel_name;
use crate::plain_text::printable;
use crate::report::format::{percent, significant};
use crate::report::json::{by_result, evaluations};
use crate::run::quantity::Quantity;
use crate::scenario::Scenario;
use serde_json::{Value, json};
use std::io::{self, Write};

/// Prints the report on the error of `of`.
pub fn text(
    scenario: &Scenario,
    accuracy: &Accuracy,
    of: Quantity,
    out: &mut dyn Write,
) -> io::Result<()> {
    let counted = format!("M {}", accuracy.element.plural());
    writeln!(
        out,
        "{}: error of the {} against time\nkernel {}, times are medians of {ROUNDS} runs\n",
        printable(&scenario.name),
        of.label(),
        kernel_name(false),
    )?;
    writeln!(out, "level {counted:>10} {:>12}   mesh error", of.row().short)?;
    for (level, on) in (1..).zip(&accuracy.levels) {
        let error = match (on.folded, accuracy.mesh(level)) {
            (Some(_), _) => "mesh folded".to_owned(),
            // It has no two finer ones to be compared with.
            (None, None) => "-".to_owned(),
            (None, Some(mesh)) => mesh[of].map_or_else(|| "unknown".to_owned(), percent),
        };
        let value = on.results[of].map_or_else(|| "-".to_owned(), significant);
        let work = on.elements * 1e-6;
        writeln!(out, "{level:>5} {work:>10.2} {value:>12}   {error}")?;
    }
    let fastest = accuracy.of(of);
    let mut totals: Vec<&Total> = fastest.iter().collect();
    let name = |total: &Total| total.plan.integrator.name();
    totals.sort_by(|a, b| {
        let place = |total: &Total| (total.level, total.plan.integrator as usize);
        place(a).cmp(&place(b)).then(b.step.total_cmp(&a.step))
    });
    writeln!(
        out,
        "\n  level integrator           step us {counted:>10}        ms step error      error"
    )?;
    for total in totals {
        writeln!(
            out,
            "{} {:>5} {:<19} {:>8.4} {:>10.3} {:>9.3} {:>10} {:>10}",
            if total.on_front { "*" } else { " " },
            total.level,
            name(total),
            total.step * 1e6,
            total.elements * 1e-6,
            total.seconds * 1e3,
            percent(total.by_step),
            percent(total.error()),
        )?;
    }
    writeln!(out, "* nothing that is faster has an error as small\n\nThe cheapest:")?;
    for tolerance in TOLERANCES {
        match cheapest(&fastest, tolerance).map(|at| &fastest[at]) {
            Some(total) => writeln!(
                out,
                "for {tolerance} %: level {}, {} at {:.4} us, {:.3} ms",
                total.level,
                name(total),
                total.step * 1e6,
                total.seconds * 1e3
            )?,
            None => writeln!(out, "for {tolerance} %: none of these")?,
        }
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
    let best = TOLERANCES
        .map(|tolerance| json!({ "percent": tolerance, "trial": cheapest(&totals, tolerance) }));
    json!({
        "scenario": scenario,
        "kernel": kernel_name(false),
        "result": of.key(),
        "levels": levels.collect::<Vec<_>>(),
        "trials": trials.collect::<Vec<_>>(),
        "cheapest": best,
    })
}
