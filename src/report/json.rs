//! Results as one JSON object. The names are a contract.
//!
//! A result stands under the key of its row in [`crate::run::quantity`], which is the same in
//! sweeps, ensembles and errors; the time of its peak stands under that key in
//! `peak_time_ms_by_result`. Figures that are no results stand beside them. `contrecoup guide json`
//! lists every key.

use crate::answer::results::{Limit, Limits, Results};
use crate::answer::solve::{Answer, Cut, Errors};
use crate::injury::SIGNS;
use crate::models::kernel_name;
use crate::run::{flags::Flag, fold::Fold, quantity::Quantity, rules::Element, sectors::Sectors};
use crate::scenario::Scenario;
use serde_json::{Value, json};

/// How the key of a direction about the eye's axis ends.
pub(super) const AZIMUTH: &str = "_azimuth_deg";

/// A number for each result that there is, by its key.
pub fn by_result(values: &Results) -> Value {
    values.present().map(|(of, value)| (of.key(), value)).collect()
}

/// Each limit that is known, in the unit of its result, by its key.
fn by_limit(limits: &Limits) -> Value {
    let known = limits.iter().filter_map(|(of, limit)| {
        let Limit { value, error } = (*limit)?;
        Some((of.key(), json!({ "value": value, "error": error })))
    });
    known.collect()
}

fn errors(errors: &Errors) -> Value {
    let unknown = errors.without_limit().map(Quantity::key);
    json!({
        "time_step_percent": errors.time_step_percent(),
        "mesh_percent": errors.mesh_percent(),
        "energy_balance_percent": errors.energy_balance,
        "time_step_percent_by_result": by_result(&errors.time_step),
        "mesh_percent_by_result": errors.mesh.as_ref().map(by_result),
        "mesh_limit_by_result": errors.limits.as_ref().map(by_limit),
        "mesh_limit_unknown": errors.mesh.map(|_| unknown.collect::<Value>()),
    })
}

/// How the mesh folded: where the first quad did, from the front, and how long it lasted.
fn folded(fold: &Fold) -> Value {
    json!({
        "since_ms": fold.since * 1e3,
        "lasted_ms": fold.lasted * 1e3,
        "stays": fold.stays,
        "quads": fold.quads,
        "of_quads": fold.of,
        "region": fold.part.name(),
        "angle_deg": fold.front_angle().to_degrees(),
        "both_sides": fold.both_sides,
        "radius_mm": fold.radius() * 1e3,
    })
}

pub(super) fn flags(flags: &[Flag]) -> Value {
    let one = |flag: &Flag| {
        let (kind, ms) = (flag.kind.name(), flag.time.map(|time| time * 1e3));
        json!({ "kind": kind, "message": flag.whole(), "time_ms": ms })
    };
    flags.iter().map(one).collect()
}

/// The key of how many springs or cells were computed.
pub(super) fn evaluations(element: Element) -> String {
    format!("{}_evaluations", element.singular())
}

/// The keys of the results that the end of the run cut off in this way.
pub(super) fn cut(answer: &Answer, how: Cut) -> Vec<&'static str> {
    let is_cut = |(of, _): &(Quantity, f64)| answer.cut(*of) == Some(how);
    answer.results().present().filter(is_cut).map(|(of, _)| of.key()).collect()
}

/// What tissues felt by clock hour and by quadrant, from 12 o'clock towards the nose.
fn sectors(of: &Sectors) -> Value {
    let scaled = |all: &[f64], by: f64| all.iter().map(|value| value * by).collect::<Value>();
    json!({
        "equator_percent": scaled(&of.equator, 1e2),
        "edge_percent": scaled(&of.edge, 1e2),
        "back_percent": scaled(&of.back, 1e2),
        "lens_mm": scaled(&of.lens, 1e3),
        "iris_mm": scaled(&of.iris, 1e3),
    })
}

/// An answer as one object; `reasons` say how its numerics were chosen.
pub fn answer(scenario: &Scenario, answer: &Answer, reasons: &[String]) -> Value {
    let element = answer.case.rules().element;
    let mut object = json!({
        "program": crate::report::program(),
        "scenario": scenario,
        "direction": scenario.direction(),
        "results": by_result(&answer.results()),
        "at_least": cut(answer, Cut::AtLeast),
        "not_final": cut(answer, Cut::NotFinal),
        "error": errors(&answer.errors),
        "numerics": {
            "level": answer.case.level(),
            "nodes": answer.case.eye.nodes(),
            element.plural(): answer.case.eye.elements(),
            "integrator": answer.plan.integrator.name(),
            "step_us": answer.step * 1e6,
            "step_limit_us": answer.step_limit * 1e6,
            "steps": answer.run.cost.steps,
            "simulated_ms": answer.run.simulated * 1e3,
            evaluations(element): answer.element_evaluations,
            "solve_ms": answer.solve_time.as_secs_f64() * 1e3,
            "total_ms": answer.total_time.as_secs_f64() * 1e3,
            "kernel": kernel_name(false),
            "choice": reasons,
        },
        "flags": flags(&answer.flags),
        "sectors": answer.run.sectors.as_ref().map(sectors),
        "mesh_fold": answer.run.fold.map(|fold| folded(&fold)),
        "risks": crate::report::risks::json(answer),
        "no_risks_because": answer.silence(),
        "signs": SIGNS,
    });
    let timed = |of: &Quantity| Some((of.key(), answer.peak(*of)?.time * 1e3));
    object["results"]["peak_time_ms_by_result"] = Quantity::ALL.iter().filter_map(timed).collect();
    let side = scenario.eye_side();
    for detail in &answer.run.details {
        object["results"][detail.key] = json!(detail.value);
        if let Some(place) = detail.key.strip_suffix(AZIMUTH) {
            let hour = side.hour(detail.value.to_radians());
            object["results"][format!("{place}_clock_h")] = json!(hour);
        }
    }
    object
}
