//! The work-precision report as text and as JSON.

use crate::answer::accuracy::{Accuracy, Level, Point, TARGETS};
use crate::models::paper::forces::kernel::name as kernel_name;
use crate::plain_text::printable;
use crate::report::errors::{leading, of_damage};
use crate::report::json::{by_result, evaluations};
use crate::report::text::{percent, significant};
use crate::run::plan::Plan;
use crate::run::quantity::Quantity;
use crate::run::rules::Element;
use crate::scenario::Scenario;
use serde_json::{Value, json};
use std::io::{self, Write};

fn method(plan: &Plan) -> String {
    if plan.integrator.method().adaptive() {
        format!("{} {:.0e}", plan.integrator.name(), plan.local_tolerance)
    } else {
        plan.integrator.name().to_owned()
    }
}

/// Prints the report.
///
/// # Errors
/// Whatever `out` reports.
pub fn text(scenario: &Scenario, report: &Accuracy, out: &mut dyn Write) -> io::Result<()> {
    writeln!(
        out,
        "{}, mesh level {}: speed against step error",
        printable(&scenario.name),
        scenario.eye.level
    )?;
    writeln!(
        out,
        "kernel {}{}{}",
        kernel_name(false),
        // Scenes with a projectile are not solved by springs alone.
        report.ns_per_spring.map_or_else(String::new, |ns| format!(
            "\n{ns:.2} ns a spring in one thread"
        )),
        report.omega_bound.map_or_else(String::new, |omega| {
            let lead = if report.ns_per_spring.is_some() {
                "; "
            } else {
                "\n"
            };
            format!("{lead}omega at most {omega:.3e} rad/s")
        })
    )?;
    writeln!(
        out,
        "reference: {} at {:.4} us\nerror: the largest of {}",
        report.reference.integrator.name(),
        report.reference.step * 1e6,
        leading(&report.reference_results)
    )?;
    if report.folded {
        writeln!(
            out,
            "FLAG mesh_folded: beyond the model's validity, errors are no promise"
        )?;
    }
    let counted = format!("M {}", report.element.plural());
    writeln!(
        out,
        "\n  {:<20} {:>8} {:>10} {:>9} {:>11} {:>11}",
        "integrator", "step us", counted, "ms", "error", "damage"
    )?;
    for point in &report.points {
        writeln!(
            out,
            "{} {:<20} {:>8.4} {:>10.3} {:>9.3} {:>11} {:>11}",
            if point.on_front { "*" } else { " " },
            method(&point.plan),
            point.step * 1e6,
            point.element_evaluations as f64 * 1e-6,
            point.seconds * 1e3,
            percent(point.error()),
            of_damage(&point.errors),
        )?;
    }
    writeln!(out, "* no other point is both faster and more accurate\n")?;
    for (target, best) in TARGETS.iter().zip(report.best) {
        match best.map(|i| &report.points[i]) {
            Some(point) => writeln!(
                out,
                "for {target} %: {} at {:.4} us, {:.3} ms",
                method(&point.plan),
                point.step * 1e6,
                point.seconds * 1e3
            )?,
            None => writeln!(out, "for {target} %: none of these")?,
        }
    }
    if let Some(finest) = report.levels.last() {
        writeln!(
            out,
            "\nlevel     ms {counted:>11} {:>11}      index   from level {}",
            format!("ns/{}", report.element.singular()),
            finest.level
        )?;
    }
    for level in &report.levels {
        writeln!(
            out,
            "{:>5} {:>8.2} {:>9.2} {:>11.2} {:>10}   {}{}",
            level.level,
            level.seconds * 1e3,
            level.element_evaluations as f64 * 1e-6,
            level.seconds * 1e9 / level.element_evaluations as f64,
            level.results[Quantity::Damage].map_or_else(String::new, significant),
            of_damage(&level.errors),
            if level.folded { "  mesh folded" } else { "" },
        )?;
    }
    Ok(())
}

fn point_json(point: &Point, element: Element) -> Value {
    json!({
        "integrator": point.plan.integrator.name(),
        "step_us": point.step * 1e6,
        "local_tolerance": point.plan.integrator.method().adaptive().then_some(point.plan.local_tolerance),
        "evaluations": point.evaluations,
        evaluations(element): point.element_evaluations,
        "median_ms": point.seconds * 1e3,
        "error_percent": point.error(),
        "error_percent_by_result": by_result(&point.errors),
        "on_front": point.on_front,
    })
}

fn level_json(level: &Level, element: Element) -> Value {
    json!({
        "level": level.level,
        "median_ms": level.seconds * 1e3,
        evaluations(element): level.element_evaluations,
        format!("ns_per_{}", element.singular()): level.seconds * 1e9 / level.element_evaluations as f64,
        "results": by_result(&level.results),
        "difference_percent_by_result": by_result(&level.errors),
        "mesh_folded": level.folded,
    })
}

/// The report as one object.
pub fn json(scenario: &Scenario, report: &Accuracy) -> Value {
    let best: Vec<Value> = TARGETS
        .iter()
        .zip(report.best)
        .map(|(target, best)| {
            json!({
                "percent": target,
                "point": best.map(|i| point_json(&report.points[i], report.element)),
            })
        })
        .collect();
    json!({
        "scenario": scenario,
        "kernel": kernel_name(false),
        "ns_per_spring": report.ns_per_spring,
        "omega_bound_rad_s": report.omega_bound,
        "reference": {
            "integrator": report.reference.integrator.name(),
            "step_us": report.reference.step * 1e6,
            "results": by_result(&report.reference_results),
        },
        "mesh_folded": report.folded,
        "points": report.points.iter().map(|p| point_json(p, report.element)).collect::<Vec<_>>(),
        "best": best,
        "levels": report.levels.iter().map(|l| level_json(l, report.element)).collect::<Vec<_>>(),
    })
}
