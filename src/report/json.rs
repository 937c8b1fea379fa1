//! Results as one JSON object. The names are a contract.

use crate::dynamics::{PA_PER_MMHG, kernel_name};
use crate::eye::Monitor;
use crate::recording::{FluidExtremes, MEAN_S, ShotExtremes};
use crate::scenario::Scenario;
use crate::study::{Answer, PerQuantity, Quantity};
use serde_json::{Map, Value, json};

/// A number for each monitored node, by name.
fn by_monitor(value: impl Fn(usize) -> f64) -> Value {
    Monitor::ALL
        .iter()
        .enumerate()
        .map(|(i, m)| (m.name().to_owned(), json!(value(i))))
        .collect::<Map<String, Value>>()
        .into()
}

/// A number for each result, by name; pressure and force of contact only where they are not 0.
pub fn by_quantity(values: &PerQuantity) -> Value {
    Quantity::ALL
        .iter()
        .zip(values)
        .enumerate()
        .filter(|(i, (_, value))| *i < Quantity::COMMON || **value != 0.0)
        .map(|(_, pair)| pair)
        .map(|(q, v)| (q.key().to_owned(), json!(v)))
        .collect::<Map<String, Value>>()
        .into()
}

/// An answer as one object; `reasons` say how its numerics were chosen.
pub fn answer(scenario: &Scenario, answer: &Answer, reasons: &[String]) -> Value {
    let extremes = &answer.recording.extremes;
    let flags: Vec<Value> = answer
        .flags
        .iter()
        .map(|flag| {
            json!({
                "kind": flag.kind.name(),
                "message": flag.message,
                "time_ms": flag.time.map(|t| t * 1e3),
            })
        })
        .collect();
    let mut object = json!({
        "scenario": scenario,
        "results": {
            "damage_percent": answer.index.damage(),
            "scleral_growth_percent": answer.index.shell_growth,
            "meridian_growth_percent": answer.index.meridian_growth,
            "energy_imparted_j": answer.index.energy,
            "apex_displacement_mm": extremes.apex.value * 1e3,
            "apex_time_ms": extremes.apex.time * 1e3,
            "peak_force_n": by_monitor(|i| extremes.force[i].value),
            "peak_time_ms": by_monitor(|i| extremes.force[i].time * 1e3),
            "largest_spring_strain_percent": extremes.strain.value * 1e2,
            "shielded_percent": answer.case.load.shielded * 1e2,
        },
        "error": {
            "time_step_percent": answer.errors.time_step_percent(),
            "mesh_percent": answer.errors.mesh_percent(),
            "energy_balance_percent": answer.errors.energy_balance,
            "time_step_percent_by_result": by_quantity(&answer.errors.time_step),
            "mesh_percent_by_result": answer.errors.mesh.as_ref().map(by_quantity),
        },
        "numerics": {
            "level": answer.case.eye.level,
            "nodes": answer.case.eye.nodes.len(),
            "springs": answer.case.eye.springs.len(),
            "integrator": answer.plan.integrator.name(),
            "step_us": answer.step * 1e6,
            "step_limit_us": answer.step_limit * 1e6,
            "steps": answer.cost.steps,
            "simulated_ms": answer.simulated * 1e3,
            "spring_evaluations": answer.spring_evaluations,
            "solve_ms": answer.solve_time.as_secs_f64() * 1e3,
            "total_ms": answer.total_time.as_secs_f64() * 1e3,
            "mirrored": answer.case.system.mirrored(),
            "kernel": kernel_name(false),
            "choice": reasons,
        },
        "flags": flags,
    });
    let risks = answer.risks();
    if !risks.is_empty() {
        object["injury"] = super::injury::json(&risks);
    }
    if answer.case.system.coupled().is_some() {
        let cost = &answer.cost;
        object["numerics"]["contact_tests"] = cost.contact_tests.into();
        object["numerics"]["pressure_evaluations"] = cost.pressure_evaluations.into();
        object["numerics"]["dashpot_evaluations"] = cost.dashpot_evaluations.into();
    }
    if let Some(fluid) = &extremes.fluid {
        object["results"]["pressure"] = pressure(fluid);
    }
    if let Some(shot) = &extremes.shot {
        object["results"]["projectile"] = projectile(shot);
    }
    object
}

fn pressure(fluid: &FluidExtremes) -> Value {
    json!({
        "peak_mpa": fluid.pressure.value * 1e-6,
        "peak_mmhg": fluid.pressure.value / PA_PER_MMHG,
        "peak_time_ms": fluid.pressure.time * 1e3,
        "rest_mmhg": fluid.rest_pressure / PA_PER_MMHG,
        "least_vitreous_area_percent": fluid.area_ratio.0 * 1e2,
        "largest_vitreous_area_percent": fluid.area_ratio.1 * 1e2,
    })
}

fn projectile(shot: &ShotExtremes) -> Value {
    json!({
        "peak_contact_force_n": shot.force.value,
        "peak_contact_time_ms": shot.force.time * 1e3,
        "contact_force_mean_over_us": MEAN_S * 1e6,
        "first_contact_ms": shot.contact.map(|(first, _)| first * 1e3),
        "last_contact_ms": shot.contact.map(|(_, last)| last * 1e3),
        "contact_time_ms": shot.contact.map(|(first, last)| (last - first) * 1e3),
        "rebound_speed_m_s": shot.velocity.norm(),
        "rebound_speed_back_along_path_m_s": shot.rebound_speed,
        "energy_given_up_j": shot.energy,
        "energy_before_j": shot.energy_before,
        "travel_mm": shot.travel.value * 1e3,
        "penetration_percent": shot.penetration_share * 1e2,
        "squeezed_percent": shot.squeezed_share * 1e2,
        "rim_met_ms": shot.rim_at.map(|t| t * 1e3),
    })
}
