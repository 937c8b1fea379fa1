//! Flags of a section.

use crate::models::paper::{case::PaperCase, forces::load::ArcLoad, recording::PaperExtremes};
use crate::run::flags::{Flag, FlagKind};
use crate::run::raised::Raised;

/// Quads smaller than this share of their rest area are worth a warning.
const NEARLY_FOLDED: f64 = 0.2;
/// A shielded share below this is rounding.
pub(super) const NEGLIGIBLE: f64 = 1e-9;

/// Flags of a run.
pub(crate) fn raise(case: &PaperCase, extremes: &PaperExtremes) -> Vec<Flag> {
    let (window, pulse) = (case.window, case.system.pulse.duration());
    // The angle from one node of the shell to the next, in radians.
    let spacing = std::f64::consts::TAU / case.eye.landmarks.shell.len() as f64;
    let mut raised = Raised::default();
    if extremes.fold.is_none() && extremes.least_quad_ratio < NEARLY_FOLDED {
        let percent = 100.0 * extremes.least_quad_ratio;
        raised.raise(
            FlagKind::MeshNearlyFolded,
            format!(
                "a quad shrank to {percent:.0} % of its area: near the end of the model's validity"
            ),
        );
    }
    if extremes.lost_in_rounding {
        raised.raise(
            FlagKind::LostInRounding,
            "the blow is lost in rounding: what it does is taken as 0",
        );
    }
    if window < pulse {
        raised.pulse_cut(window, pulse);
    } else if extremes.still_rising {
        raised.window_short(window, "a result still grew when the window ended");
    } else if extremes.could_rise {
        raised.window_short(
            window,
            "the energy left at the end of the window could still raise a result",
        );
    }
    of_load(&case.load, spacing, &mut raised);
    raised.flags()
}

/// Flags of where a force acts.
fn of_load(load: &ArcLoad, spacing: f64, raised: &mut Raised) {
    let (arc, shielded) = (load.arc.1 - load.arc.0, load.shielded);
    if !load.shares.is_empty() && arc < spacing * (1.0 - NEGLIGIBLE) {
        raised.raise(
            FlagKind::ArcUnresolved,
            format!(
                "the loaded arc of {:.3} degrees is narrower than the mesh's spacing of {:.3}",
                arc.to_degrees(),
                spacing.to_degrees()
            ),
        );
    }
    if shielded > NEGLIGIBLE {
        let percent = 100.0 * shielded;
        raised.raise(
            FlagKind::BoneShields,
            format!("bone shields {percent:.1} % of the arc: the whole force acts on the rest"),
        );
    }
}
