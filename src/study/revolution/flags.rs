//! What a reader must know before trusting a result of the eye of revolution.

use super::case::RevolutionCase;
use crate::dynamics::revolution::Extremes;
use crate::scenario::TRUSTED_ANGLE_DEG;
use crate::study::flags::{ENERGY_ALARM, Flag, FlagKind, contact_cut, pulse_cut, unconverged};
use crate::study::left::Left;
use crate::study::quantity::Quantity;

/// A peak in the last share of the window may not have been the last word.
pub(in crate::study) const END: f64 = 0.999;

/// Flags of a run of `simulated` s; `step_error` holds the largest step error of a leading result and the
/// largest difference of one between two runs, both in %, where there were two.
pub(in crate::study) fn raise(
    case: &RevolutionCase,
    extremes: &Extremes,
    simulated: f64,
    step_error: Option<(f64, f64)>,
) -> Vec<Flag> {
    let mut flags = Vec::new();
    let mut raise = |kind, message: String, time| {
        flags.push(Flag {
            kind,
            message,
            time,
        });
    };
    if let Some(time) = extremes.folded_at {
        raise(
            FlagKind::MeshFolded,
            format!(
                "a cell folded at {:.3} ms: beyond the model's validity",
                time * 1e3
            ),
            Some(time),
        );
    }
    if extremes.energy_residual > ENERGY_ALARM {
        raise(
            FlagKind::EnergyImbalance,
            format!(
                "the energies miss what came in by {:.2} %",
                100.0 * extremes.energy_residual
            ),
            None,
        );
    }
    if let Some((error, _)) = step_error {
        unconverged(error, &mut raise);
    }
    if case.angle_deg.abs() > TRUSTED_ANGLE_DEG {
        raise(
            FlagKind::AngleBeyondTrust,
            format!(
                "the orbit turns with a blow at {} degrees: trust it to {TRUSTED_ANGLE_DEG}",
                case.angle_deg
            ),
            None,
        );
    }
    if extremes.rim_force.value > 0.0 {
        let time = extremes.rim_force.time;
        raise(
            FlagKind::RimStops,
            format!(
                "the rim met the projectile, with {:.3e} N at {:.3} ms",
                extremes.rim_force.value,
                time * 1e3
            ),
            Some(time),
        );
    }
    window(case, extremes, simulated, &mut raise);
    flags
}

/// Flags of a window that ends too early.
fn window(
    case: &RevolutionCase,
    extremes: &Extremes,
    simulated: f64,
    raise: &mut impl FnMut(FlagKind, String, Option<f64>),
) {
    if let Some(pulse) = case.pulse().filter(|pulse| case.window < *pulse) {
        pulse_cut(case.window, pulse, raise);
        return;
    }
    if extremes.rebound.is_some_and(|speed| speed <= 0.0) || extremes.touching {
        contact_cut(case.window, raise);
    }
    let late = Quantity::ALL.iter().find(|of| {
        let peak = of.peak(&Left::Revolution(*extremes));
        peak.is_some_and(|peak| peak.time > END * simulated)
    });
    if let Some(of) = late {
        raise(
            FlagKind::WindowShort,
            format!("a result still grew when the window ended: {}", of.label()),
            Some(case.window),
        );
    }
}
