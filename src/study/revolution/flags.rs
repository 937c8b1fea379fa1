//! What a reader must know before trusting a result of the axisymmetric eye.

use super::case::RevolutionCase;
use crate::dynamics::revolution::Run;
use crate::scenario::TRUSTED_ANGLE_DEG;
use crate::study::flags::{ENERGY_ALARM, Flag, FlagKind, contact_cut, pulse_cut, unconverged};
use crate::study::quantity::Quantity;

/// A peak in the last share of the window may not have been the last word.
pub(super) const END: f64 = 0.999;

/// Flags of a run whose largest step error of a leading result is `step_error` %.
pub(super) fn raise(case: &RevolutionCase, run: &Run, step_error: f64) -> Vec<Flag> {
    let extremes = &run.extremes;
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
    unconverged(step_error, &mut raise);
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
    window(case, run, &mut raise);
    flags
}

/// Flags of a window that ends too early.
fn window(case: &RevolutionCase, run: &Run, raise: &mut impl FnMut(FlagKind, String, Option<f64>)) {
    let extremes = &run.extremes;
    if let Some(pulse) = case.pulse().filter(|pulse| case.window < *pulse) {
        pulse_cut(case.window, pulse, raise);
        return;
    }
    if extremes.rebound.is_some_and(|speed| speed <= 0.0) || run.energy.contact > 0.0 {
        contact_cut(case.window, raise);
    }
    let late = Quantity::ALL.iter().find(|of| {
        let peak = of.peak_of_revolution(extremes);
        peak.is_some_and(|peak| peak.time > END * run.simulated)
    });
    if let Some(of) = late {
        raise(
            FlagKind::WindowShort,
            format!("a result still grew when the window ended: {}", of.label()),
            Some(case.window),
        );
    }
}
