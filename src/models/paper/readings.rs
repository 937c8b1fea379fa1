//! The table of what is read off the section, under the public names.

use crate::models::paper::{case::PaperCase, flags::NEGLIGIBLE, recording::PaperExtremes};
use crate::run::model::{Detail, Shown};
use crate::run::{quantity::Quantity, readings::Readings};

/// The readings of a run.
pub(crate) fn of(e: &PaperExtremes) -> Readings {
    Readings::from_fn(|of| match of {
        Quantity::ShellGrowth => Some(e.shell_growth.into()),
        Quantity::MeridianGrowth => Some(e.meridian_growth.into()),
        Quantity::Energy => Some(e.work.into()),
        Quantity::Apex => Some(e.apex.into()),
        Quantity::StoredEnergy => Some(e.elastic.into()),
        _ => Some(e.force[Quantity::FORCES.iter().position(|force| *force == of)?].into()),
    })
}

/// Figures beside them.
pub(crate) fn details(case: &PaperCase, e: &PaperExtremes) -> Vec<Detail> {
    let (strain, shielded) = (e.strain.value * 1e2, case.load.shielded);
    let at = e.strain.time * 1e3;
    let behind = if shielded > NEGLIGIBLE {
        Shown::OnLine("Shielded by bone", "%  of the arc".to_owned())
    } else {
        Shown::InData
    };
    let largest = Shown::OnLine("Spring strain", format!("%  at {at:.4} ms, the largest"));
    vec![
        Detail::new("largest_spring_strain_percent", strain, largest),
        Detail::new("shielded_percent", shielded * 1e2, behind),
    ]
}
