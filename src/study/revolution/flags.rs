//! What a reader must know before trusting a result of the eye of revolution.

use super::case::RevolutionCase;
use crate::dynamics::revolution::Extremes;
use crate::scenario::TRUSTED_ANGLE_DEG;
use crate::study::compiled::Element;
use crate::study::flags::{Flag, FlagKind, Motion, Raised, TwoRuns};
use crate::study::left::Left;
use crate::study::quantity::Quantity;

/// A peak in the last share of the window may not have been the last word.
pub(in crate::study) const END: f64 = 0.999;

/// Flags of a run of `simulated` s.
pub(in crate::study) fn raise(
    case: &RevolutionCase,
    extremes: &Extremes,
    simulated: f64,
    two_runs: Option<TwoRuns>,
) -> Vec<Flag> {
    let mut raised = Raised::default();
    raised.motion(&Motion {
        fold: extremes.fold,
        element: Element::Cell,
        energy_residual: extremes.energy_residual,
        two_runs,
    });
    if case.angle_deg.abs() > TRUSTED_ANGLE_DEG {
        let angle = case.angle_deg;
        raised.raise(
            FlagKind::AngleBeyondTrust,
            format!(
                "the orbit turns with a blow at {angle} degrees: trust it to {TRUSTED_ANGLE_DEG}"
            ),
        );
    }
    if extremes.rim_force.value > 0.0 {
        let rim = extremes.rim_force;
        raised.rim_stops(case.rim, rim.time, Some(rim.value));
        if extremes.missed() {
            raised.rim_kept_it_off(case.rim);
        }
    }
    if let Some(time) = extremes.crushed_at {
        let at = time * 1e3;
        raised.raise_at(
            time,
            FlagKind::SurfaceCrushed,
            format!(
                "the object's surface was crushed through at {at:.3} ms: from there on it is as hard as its core"
            ),
        );
    }
    window(case, extremes, simulated, &mut raised);
    raised.flags()
}

/// Flags of a window that ends too early.
fn window(case: &RevolutionCase, extremes: &Extremes, simulated: f64, raised: &mut Raised) {
    if let Some(pulse) = case.pulse().filter(|pulse| case.window < *pulse) {
        raised.pulse_cut(case.window, pulse);
        return;
    }
    if extremes.rebound.is_some_and(|speed| speed <= 0.0) || extremes.touching {
        raised.contact_cut(case.window);
    }
    let late = Quantity::ALL.iter().find(|of| {
        let peak = of.peak(&Left::Revolution(*extremes));
        peak.is_some_and(|peak| peak.time > END * simulated)
    });
    if let Some(of) = late {
        let how = format!("a result still grew when the window ended: {}", of.label());
        raised.window_short(case.window, how);
    }
}
