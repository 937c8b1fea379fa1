//! What a reader must know before trusting a result of the eye in three dimensions.

use crate::models::axisymmetric::case::ORBITS_RIM;
use crate::models::axisymmetric::flags::{Asked, of_blow};
use crate::models::spatial::{case::SpatialCase, recording::results::Extremes};
use crate::run::flags::{Flag, FlagKind};
use crate::run::{raised::Raised, readings::Readings};

/// Energy of flight that breaks bone in half of all cases, in J: of a baseball at 13.9 m/s on the
/// cheekbone, part of which squeezes the ball. Walls of orbits were computed to break at 16 to 41
/// J.
const BONE_BREAKS: f64 = 14.0;

/// Flags of a run of `simulated` s.
pub(crate) fn raise(
    case: &SpatialCase,
    extremes: &Extremes,
    readings: &Readings,
    simulated: f64,
) -> Vec<Flag> {
    let mut raised = Raised::default();
    // What holds gelatin stops nothing here.
    let asked = Asked { window: case.window, pulse: None, rim: ORBITS_RIM };
    of_blow(&asked, &extremes.common, (readings, simulated), &mut raised);
    let spent = extremes.energy_at_bone;
    if spent > BONE_BREAKS {
        let said = format!(
            "the object spent {spent:.0} J at the rim, its own squeezing included; a baseball of \
             {BONE_BREAKS:.0} J breaks a cheekbone in half of all cases; here bone does not break"
        );
        raised.raise(FlagKind::BoneMayBreak, said);
    }
    raised.flags()
}
