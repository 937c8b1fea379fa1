//! What is told of the eye in three dimensions beside the readings that every eye of cells has.

use crate::models::axisymmetric::readings::common_details;
use crate::models::spatial::{case::SpatialCase, recording::results::Extremes};
use crate::run::kept::Peak;
use crate::run::model::{Detail, Shown};
use crate::run::quantity::Quantity;
use crate::run::readings::Readings;
use crate::run::sectors::{HOURS, Sectors};
use crate::scenario::direction::place as place_name;
use std::f64::consts::{PI, TAU};

/// The readings of a run, measures of tissues as the mean over the clock of the most at each hour.
/// Straight on that is what the axisymmetric eye reads, where the largest over the clock jumps to
/// 1.3 to 2 times as much as soon as the blow leaves the axis. Its time is that of the largest.
pub(crate) fn over_the_clock(readings: &mut Readings, e: &Extremes) {
    let sectors = &e.sectors;
    let hours: [(Quantity, &[f64]); 5] = [
        (Quantity::EquatorStretch, &sectors.equator),
        (Quantity::BackStretch, &sectors.back),
        (Quantity::EdgeGrowth, &sectors.edge),
        (Quantity::LensPull, &sectors.lens),
        (Quantity::IrisPull, &sectors.iris),
    ];
    for ((of, hours), peak) in hours.into_iter().zip(e.common.tissue) {
        let value = hours.iter().sum::<f64>() / hours.len() as f64;
        readings[of] = Some(Peak { value, ..peak }.into());
    }
}

/// What peaks in this last share of a run may not have come to its peak.
const LAST: f64 = 0.02;

/// Figures beside the readings of a run of `simulated` s.
pub(crate) fn details(case: &SpatialCase, e: &Extremes, simulated: f64) -> Vec<Detail> {
    let up = case.blow.up;
    // Where a place lies, in degrees from the front and around from above to the nose.
    let place = |(front, azimuth): (f64, f64)| (front.to_degrees(), (azimuth + up).rem_euclid(TAU));
    let words = |(front, around): (f64, f64)| {
        format!("{front:.0} deg from the front, towards {}", place_name(around))
    };
    let (stress, equator) = (place(e.stress_at), place(e.equator_at));
    let hour = |of: &[f64]| Sectors::strongest(of) as f64 * TAU / HOURS as f64;
    let back = (Sectors::strongest(&e.sectors.back) as f64 + 0.5) * 0.5 * PI;
    let most_towards = |key, of, azimuth: f64| {
        let words = format!("most towards {}", place_name(azimuth));
        Detail::new(key, azimuth.to_degrees(), Shown::Behind(of, words))
    };
    // A run ends when the readings have come to rest, which the globe as a whole need not have.
    let until = |time: f64, moving| {
        if time > (1.0 - LAST) * simulated { moving } else { "at most" }
    };
    let then = e.way_then * 1e3;
    let moved = format!(
        "mm {}: {:.1} back, {:.1} up, {:.1} to the nose",
        until(e.way.time, "and still moving as the run ended"),
        then.x,
        then.y,
        then.z
    );
    let stress_words = Shown::Behind(Quantity::ScleralStress, words(stress));
    let equator_words = Shown::Behind(Quantity::EquatorStretch, words(equator));
    let turned = until(e.turn.time, "and still turning as the run ended");
    let turned = Shown::About("Globe turned", format!("degrees {turned}"));
    let (edge, lens, iris) = (hour(&e.sectors.edge), hour(&e.sectors.lens), hour(&e.sectors.iris));
    let mut details = vec![
        Detail::new("scleral_stress_angle_deg", stress.0, stress_words),
        Detail::data("scleral_stress_azimuth_deg", stress.1.to_degrees()),
        Detail::new("equator_stretch_angle_deg", equator.0, equator_words),
        Detail::data("equator_stretch_azimuth_deg", equator.1.to_degrees()),
        most_towards("edge_growth_azimuth_deg", Quantity::EdgeGrowth, edge),
        most_towards("back_stretch_azimuth_deg", Quantity::BackStretch, back),
        most_towards("lens_pull_azimuth_deg", Quantity::LensPull, lens),
        most_towards("iris_pull_azimuth_deg", Quantity::IrisPull, iris),
        Detail::new("globe_turn_deg", e.turn.value.to_degrees(), turned),
        Detail::new("globe_way_mm", e.way.value * 1e3, Shown::About("Globe moved", moved)),
    ];
    details.extend(common_details(&e.common));
    details.extend([
        Detail::data("impulse_on_eye_n_s", e.impulse_on_eye.norm()),
        Detail::data("impulse_on_bone_n_s", e.impulse_on_bone.norm()),
        Detail::data("energy_at_bone_j", e.energy_at_bone),
        Detail::data("globe_on_bone_n", e.globe_on_bone.value),
    ]);
    let (eye, bone) = (e.impulse_on_eye.norm(), e.impulse_on_bone.norm());
    if bone > 0.0 {
        let shown = Shown::About("Taken by bone", "% of the impulse".to_owned());
        details.push(Detail::new("bone_impulse_percent", 1e2 * bone / (eye + bone), shown));
    }
    details
}
