//! What an answer of the eye of revolution says beside its results, as text and as JSON.

use crate::run::quantity::Quantity;
use crate::answer::solve::Answer;
use crate::models::axisymmetric::case::RevolutionCase;
use crate::models::axisymmetric::recording::results::Extremes;
use crate::report::figure::Figure;
use crate::report::text::row;
use crate::scenario::{Impact, Physiological, Scenario, Species, Support};
use serde_json::{Value, json};
use std::io::{self, Write};

/// The model in words.
pub(super) fn model(model: &Physiological) -> String {
    let species = match model.species {
        Species::Human => "human",
        Species::Pig => "pig",
    };
    let support = match model.support {
        Support::Orbit => "in its orbit",
        Support::Gelatin => "in gelatin",
        Support::Free => "free",
    };
    format!("Physiological model, {species} eye {support}")
}

/// What a reader should know of a peak beside its value.
pub(super) fn remark(of: Quantity, extremes: &Extremes) -> String {
    match of {
        Quantity::Pressure => ", mean of the globe".to_owned(),
        Quantity::ScleralStress => {
            let angle = extremes.stress_angle.to_degrees();
            format!(", {angle:.0} deg from the front")
        }
        _ => String::new(),
    }
}

/// Prints what is no result.
pub(super) fn beside(
    scenario: &Scenario,
    answer: &Answer,
    extremes: &Extremes,
    out: &mut dyn Write,
) -> io::Result<()> {
    writeln!(
        out,
        "Globe volume       {:>9} to {:.2} % of that at rest",
        format!("{:.2}", extremes.least_volume * 1e2),
        extremes.most_volume * 1e2
    )?;
    let rebound = Figure::of(answer, Quantity::Rebound);
    if let (Impact::Projectile(shot), Some(mut rebound)) = (&scenario.impact, rebound) {
        let way = match rebound.number.strip_prefix('-') {
            Some(on) => {
                rebound.number = on.to_owned();
                // What still goes on slows down.
                rebound.cut = None;
                "Goes on at"
            }
            None => "Rebound speed",
        };
        row(way, &rebound, &format!("of {} m/s", shot.speed_m_s), out)?;
        crate::report::text::unverified(shot, out)?;
    }
    Ok(())
}

/// Adds what is no result, and how large the mesh is, to an answer's object.
pub(super) fn add_json(case: &RevolutionCase, extremes: &Extremes, object: &mut Value) {
    object["numerics"]["shell_segments"] = case.eye.segments.len().into();
    let results = &mut object["results"];
    results["scleral_stress_angle_deg"] = json!(extremes.stress_angle.to_degrees());
    results["least_globe_volume_percent"] = json!(extremes.least_volume * 1e2);
    results["largest_globe_volume_percent"] = json!(extremes.most_volume * 1e2);
    results["peak_rim_force_n"] = json!(extremes.rim_force.value);
}
