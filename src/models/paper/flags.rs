//! Flags of a section.

use crate::models::paper::{case::PaperCase, recording::PaperExtremes};
use crate::run::flags::{Flag, FlagKind};
use crate::run::raised::Raised;

/// Quads smaller than this share of their rest area are worth a warning.
const NEARLY_FOLDED: f64 = 0.2;
/// A shielded share below this is rounding.
pub(super) const NEGLIGIBLE: f64 = 1e-9;

/// Flags of a run.
pub(crate) fn raise(case: &PaperCase, extremes: &PaperExtremes) -> Vec<Flag> {
    let (window, pulse) = (case.window, case.system.pulse.duration());
    let mut raised = Raised::default();
    if extremes.fold.is_none() && extremes.least_quad_ratio < NEARLY_FOLDED {
        let percent = 100.0 * extremes.least_quad_ratio;
        let message = format!(
            "a quad shrank to {percent:.0} % of its area: near the end of the model's validity"
        );
        raised.raise(FlagKind::MeshNearlyFolded, message);
    }
    if extremes.lost_in_rounding {
        let message = "the blow is lost in rounding: what it does is taken as 0";
        raised.raise(FlagKind::LostInRounding, message);
    }
    if window < pulse {
        raised.pulse_cut(window, pulse);
    } else if extremes.still_rising {
        raised.window_short(window, "a result still grew when the window ended");
    } else if extremes.could_rise {
        let reason = "the energy left at the end of the window could still raise a result";
        raised.window_short(window, reason);
    }
    let ((low, high), shielded) = (case.load.arc, case.load.shielded);
    // The angle from one node of the shell to the next, in radians.
    let spacing = std::f64::consts::TAU / case.eye.landmarks.shell.len() as f64;
    if !case.load.shares.is_empty() && high - low < spacing * (1.0 - NEGLIGIBLE) {
        let message = format!(
            "the loaded arc of {:.3} degrees is narrower than the mesh's spacing of {:.3}",
            (high - low).to_degrees(),
            spacing.to_degrees()
        );
        raised.raise(FlagKind::ArcUnresolved, message);
    }
    if shielded > NEGLIGIBLE {
        let percent = 100.0 * shielded;
        let message =
            format!("bone shields {percent:.1} % of the arc: the whole force acts on the rest");
        raised.raise(FlagKind::BoneShields, message);
    }
    raised.flags()
}
