//! The answer of the axisymmetric eye, as text of 80 columns and as one JSON object under the names of
//! [`super::json`].

use super::json::{by_result, flags};
use super::text::{balance, capital, damage, flagged, numerical, significant};
use crate::dynamics::revolution::Extremes;
use crate::plain_text::printable;
use crate::scenario::{Axisymmetric, Impact, Model, Scenario, Species, Support};
use crate::study::{Quantity, RevolutionAnswer};
use serde_json::{Map, Value, json};
use std::io::{self, Write};

fn whose(model: &Axisymmetric) -> String {
    let species = match model.species {
        Species::Human => "human",
        Species::Pig => "pig",
    };
    let support = match model.support {
        Support::Orbit => "in its orbit",
        Support::Gelatin => "in gelatin",
        Support::Free => "free",
    };
    format!("{species} eye {support}")
}

/// Prints the results of an answer.
///
/// # Errors
/// Whatever `out` reports.
pub fn results(
    scenario: &Scenario,
    answer: &RevolutionAnswer,
    out: &mut dyn Write,
) -> io::Result<()> {
    let (eye, extremes) = (&answer.case.eye, &answer.run.extremes);
    writeln!(out, "{}", printable(&scenario.name))?;
    if let Model::Axisymmetric(model) = &scenario.model {
        writeln!(
            out,
            "Axisymmetric model, {}; mesh level {}: {} nodes, {} cells\n",
            whose(model),
            eye.level,
            eye.mass.len(),
            eye.cells.len()
        )?;
    }
    let mesh = answer.errors.mesh.is_some();
    super::verdict::text(&answer.verdicts(), mesh, out)?;
    writeln!(out)?;
    damage(&answer.index, out)?;
    let above = [Quantity::ShellGrowth, Quantity::MeridianGrowth];
    for &of in Quantity::ALL.iter().filter(|of| !above.contains(of)) {
        if let Some(peak) = of.peak_of_revolution(extremes) {
            let row = of.row();
            writeln!(
                out,
                "{:<18} {:>9} {:<3} at {:.4} ms{}",
                capital(row.label),
                significant(peak.value * row.factor),
                row.unit,
                peak.time * 1e3,
                remark(of, extremes)
            )?;
        }
    }
    writeln!(
        out,
        "Globe volume       {:>9} to {:.2} % of that at rest",
        format!("{:.2}", extremes.least_volume * 1e2),
        extremes.most_volume * 1e2
    )?;
    if let (Impact::Projectile(shot), Some(rebound)) = (&scenario.impact, extremes.rebound) {
        let (way, speed) = if rebound < 0.0 {
            ("Goes on at", -rebound)
        } else {
            ("Rebound speed", rebound)
        };
        writeln!(
            out,
            "{way:<18} {:>9} m/s of {} m/s",
            significant(speed),
            shot.speed_m_s
        )?;
        if !shot.unverified.is_empty() {
            writeln!(out, "Unverified figures: {}", shot.unverified.join(", "))?;
        }
    }
    super::injury::text(&answer.risks(), out)
}

/// What a reader should know of a peak beside its value.
fn remark(of: Quantity, extremes: &Extremes) -> String {
    match of {
        Quantity::Pressure => ", mean of the globe".to_owned(),
        Quantity::ScleralStress => {
            let angle = extremes.stress_angle.to_degrees();
            format!(", {angle:.0} deg from the front")
        }
        _ => String::new(),
    }
}

/// Prints how far the results may be trusted, and how they were computed.
///
/// # Errors
/// Whatever `out` reports.
pub fn trust(answer: &RevolutionAnswer, out: &mut dyn Write) -> io::Result<()> {
    numerical(&answer.errors, out)?;
    balance(&answer.errors, out)?;
    let run = &answer.run;
    writeln!(
        out,
        "Solved in {:.2} ms by a leapfrog: {} steps to {:.3} ms",
        answer.solve_time.as_secs_f64() * 1e3,
        run.steps,
        run.simulated * 1e3
    )?;
    if run.settled {
        writeln!(
            out,
            "Stopped there: the object is gone or the pulse over, and nothing grows"
        )?;
    }
    flagged(&answer.flags, out)
}

/// An answer as one object.
pub fn json(scenario: &Scenario, answer: &RevolutionAnswer) -> Value {
    let (eye, run) = (&answer.case.eye, &answer.run);
    let extremes = &run.extremes;
    let mut object = json!({
        "scenario": scenario,
        "results": by_result(&answer.results()),
        "error": super::json::errors(&answer.errors),
        "numerics": {
            "level": eye.level,
            "nodes": eye.mass.len(),
            "cells": eye.cells.len(),
            "shell_segments": eye.segments.len(),
            "integrator": "leapfrog",
            "steps": run.steps,
            "simulated_ms": run.simulated * 1e3,
            "cell_evaluations": run.cell_evaluations,
            "solve_ms": answer.solve_time.as_secs_f64() * 1e3,
            "total_ms": answer.total_time.as_secs_f64() * 1e3,
        },
        "flags": flags(&answer.flags),
        "verdicts": super::verdict::json(&answer.verdicts()),
    });
    let times = Quantity::ALL.iter().filter_map(|of| {
        let peak = of.peak_of_revolution(extremes)?;
        Some((of.key().to_owned(), json!(peak.time * 1e3)))
    });
    let results = &mut object["results"];
    results["peak_time_ms_by_result"] = times.collect::<Map<String, Value>>().into();
    results["scleral_stress_angle_deg"] = json!(extremes.stress_angle.to_degrees());
    results["least_globe_volume_percent"] = json!(extremes.least_volume * 1e2);
    results["largest_globe_volume_percent"] = json!(extremes.most_volume * 1e2);
    results["peak_rim_force_n"] = json!(extremes.rim_force.value);
    let risks = answer.risks();
    if !risks.is_empty() {
        object["injury"] = super::injury::json(&risks);
    }
    object
}
