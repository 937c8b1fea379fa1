//! What is told of the eye in three dimensions beside the readings that every eye of cells has.

use crate::models::spatial::case::SpatialCase;
use crate::models::spatial::recording::results::Extremes;
use crate::run::model::{Detail, Shown};
use crate::run::quantity::Quantity;
use crate::run::sectors::{HOURS, Sectors};
use crate::scenario::direction::place as place_name;
use std::f64::consts::{PI, TAU};

/// Figures beside the readings.
pub(crate) fn details(case: &SpatialCase, e: &Extremes) -> Vec<Detail> {
    let percent = |share: f64| share * 1e2;
    let (least, most) = (
        percent(e.common.least_volume),
        percent(e.common.most_volume),
    );
    let up = case.blow.up;
    // Where a place lies, in degrees from the front and around from above to the nose.
    let place = |(front, azimuth): (f64, f64)| {
        let around = (azimuth + up).rem_euclid(TAU);
        (front.to_degrees(), around)
    };
    let words = |(front, around): (f64, f64)| {
        format!(
            "{front:.0} deg from the front, towards {}",
            place_name(around)
        )
    };
    let (stress, equator) = (place(e.stress_at), place(e.equator_at));
    let hour = |of: &[f64]| Sectors::strongest(of) as f64 * TAU / HOURS as f64;
    let (edge, lens, iris) = (
        hour(&e.sectors.edge),
        hour(&e.sectors.lens),
        hour(&e.sectors.iris),
    );
    let back = (Sectors::strongest(&e.sectors.back) as f64 + 0.5) * 0.5 * PI;
    let (turn, way) = (e.turn.value.to_degrees(), e.way.value * 1e3);
    let then = e.way_then * 1e3;
    let behind =
        |of, azimuth: f64| Shown::Behind(of, format!("most towards {}", place_name(azimuth)));
    let mut details = vec![
        Detail {
            key: "scleral_stress_angle_deg",
            value: stress.0,
            shown: Shown::Behind(Quantity::ScleralStress, words(stress)),
        },
        Detail::data("scleral_stress_azimuth_deg", stress.1.to_degrees()),
        Detail {
            key: "equator_stretch_angle_deg",
            value: equator.0,
            shown: Shown::Behind(Quantity::EquatorStretch, words(equator)),
        },
        Detail::data("equator_stretch_azimuth_deg", equator.1.to_degrees()),
        Detail {
            key: "edge_growth_azimuth_deg",
            value: edge.to_degrees(),
            shown: behind(Quantity::EdgeGrowth, edge),
        },
        Detail {
            key: "back_stretch_azimuth_deg",
            value: back.to_degrees(),
            shown: behind(Quantity::BackStretch, back),
        },
        Detail {
            key: "lens_pull_azimuth_deg",
            value: lens.to_degrees(),
            shown: behind(Quantity::LensPull, lens),
        },
        Detail {
            key: "iris_pull_azimuth_deg",
            value: iris.to_degrees(),
            shown: behind(Quantity::IrisPull, iris),
        },
        Detail {
            key: "globe_turn_deg",
            value: turn,
            shown: Shown::OnLine("Globe turned", "degrees at most".to_owned()),
        },
        Detail {
            key: "globe_way_mm",
            value: way,
            shown: Shown::OnLine(
                "Globe moved",
                format!(
                    "mm at most: {:.1} back, {:.1} up, {:.1} to the nose",
                    then.x, then.y, then.z
                ),
            ),
        },
        Detail {
            key: "least_globe_volume_percent",
            value: least,
            shown: Shown::OnLine("Globe volume", format!("to {most:.2} % of that at rest")),
        },
        Detail::data("largest_globe_volume_percent", most),
        Detail::data("peak_rim_force_n", e.common.rim_force.value),
        Detail::data(
            "peak_sensor_pressure_mpa",
            e.common.back_pressure.value * 1e-6,
        ),
        Detail::data("impulse_on_eye_n_s", e.impulse_on_eye.norm()),
        Detail::data("impulse_on_bone_n_s", e.impulse_on_bone.norm()),
        Detail::data("energy_at_bone_j", e.energy_at_bone),
        Detail::data("globe_on_bone_n", e.globe_on_bone.value),
    ];
    details.extend(taken_by_bone(e));
    details
}

/// The share of the impulse that bone took, if it took any.
fn taken_by_bone(e: &Extremes) -> Option<Detail> {
    let (eye, bone) = (e.impulse_on_eye.norm(), e.impulse_on_bone.norm());
    (bone > 0.0).then(|| Detail {
        key: "bone_impulse_percent",
        value: 1e2 * bone / (eye + bone),
        shown: Shown::OnLine("Taken by bone", "% of the impulse".to_owned()),
    })
}
