//! The table of what is read off the axisymmetric eye, under the public names.

use crate::models::axisymmetric::recording::results::{EngineRun, Extremes};
use crate::run::model::{Detail, Run, Shown};
use crate::run::plan::Cost;
use crate::run::quantity::Quantity;
use crate::run::readings::{Reading, Readings};

/// The readings of a run. The paper's S, the growth of the shell's length, is that of the meridian;
/// its M is that of the largest diameter across the blow.
pub fn of(e: &Extremes) -> Readings {
    // Without an object there is neither contact nor a way into the eye.
    let of_object = |reading: Reading| e.rebound.map(|_| reading);
    Readings::from_fn(|of| match of {
        Quantity::ShellGrowth => Some(e.shell_growth.into()),
        Quantity::MeridianGrowth => Some(e.equator_growth.into()),
        Quantity::Energy => Some(e.energy_imparted.into()),
        Quantity::Apex => Some(e.apex.into()),
        Quantity::Pressure => Some(e.pressure.into()),
        Quantity::Contact => of_object(e.mean_force.into()),
        Quantity::BackPressure => Some(e.mean_back_pressure.into()),
        Quantity::ScleralStress => Some(e.scleral_stress.into()),
        Quantity::Shortening => Some(e.shortening.into()),
        Quantity::Intrusion => of_object(e.intrusion.into()),
        Quantity::LensWay => Some(e.lens.into()),
        Quantity::EquatorStretch => Some(e.tissue[0].into()),
        Quantity::BackStretch => Some(e.tissue[1].into()),
        Quantity::EdgeGrowth => Some(e.tissue[2].into()),
        Quantity::LensPull => Some(e.tissue[3].into()),
        Quantity::IrisPull => Some(e.tissue[4].into()),
        Quantity::CornealEnergy => Some(e.energy_over_contact().into()),
        Quantity::Rebound => e.rebound.map(Reading::from),
        _ => Some(e.node_force[Quantity::FORCES.iter().position(|force| *force == of)?].into()),
    })
}

/// Figures beside them.
pub(crate) fn details(e: &Extremes) -> Vec<Detail> {
    let angle = e.stress_angle.to_degrees();
    let words = format!("{angle:.0} deg from the front");
    let behind = Shown::Behind(Quantity::ScleralStress, words);
    let mut details = vec![Detail::new("scleral_stress_angle_deg", angle, behind)];
    details.extend(common_details(e));
    details
}

/// Those that every eye of cells has.
pub(crate) fn common_details(e: &Extremes) -> [Detail; 4] {
    let (least, most) = (e.least_volume * 1e2, e.most_volume * 1e2);
    let volume = Shown::OnLine("Globe volume", format!("to {most:.2} % of that at rest"));
    [
        Detail::new("least_globe_volume_percent", least, volume),
        Detail::data("largest_globe_volume_percent", most),
        Detail::data("peak_rim_force_n", e.rim_force.value),
        Detail::data("peak_sensor_pressure_mpa", e.back_pressure.value * 1e-6),
    ]
}

/// What every eye of cells gives of a run with this account, but for details and flags.
pub(crate) fn told<E, M>(run: EngineRun<E, M>, extremes: &Extremes) -> Run {
    Run {
        readings: of(extremes),
        fold: extremes.fold,
        missed: extremes.missed(),
        energy_residual: extremes.energy_residual,
        simulated: run.simulated,
        traces: run.traces,
        frames: run.frames,
        cost: Cost { steps: run.steps, evaluations: run.steps + 1 },
        ..Run::default()
    }
}
