//! Flags of a section.

use crate::models::compiled::Element;
use crate::models::paper::case::Case;
use crate::models::paper::forces::load::ArcLoad;
use crate::models::paper::recording::Extremes;
use crate::run::flags::{Flag, FlagKind};
use crate::run::raised::{Motion, Raised, TwoRuns};

/// Quads smaller than this share of their rest area are worth a warning.
const NEARLY_FOLDED: f64 = 0.2;
/// A shielded share below this is rounding.
const NEGLIGIBLE: f64 = 1e-9;

/// What flags are raised from.
pub(crate) struct Evidence<'a> {
    /// What was moved.
    pub case: &'a Case,
    /// What its march left.
    pub extremes: &'a Extremes,
    /// What a second run says.
    pub two_runs: Option<TwoRuns>,
}

/// Flags of a result.
pub(crate) fn raise(evidence: &Evidence) -> Vec<Flag> {
    let Evidence { case, extremes, .. } = *evidence;
    let (window, pulse) = (case.window, case.system.load().pulse.duration());
    // The angle from one node of the shell to the next, in radians.
    let spacing = std::f64::consts::TAU / case.eye.landmarks.shell.len() as f64;
    let mut raised = Raised::default();
    raised.motion(&Motion {
        fold: extremes.fold,
        element: Element::Spring,
        energy_residual: extremes.energy_residual,
        two_runs: evidence.two_runs,
    });
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::answer::quantity::Quantity;
    use crate::answer::solve::solve;
    use crate::models::paper::case::unwatched;
    use crate::models::paper::eye::mesh::Region;
    use crate::run::fold::Fold;
    use crate::run::kept::Keep;
    use crate::scenario::CheckedScenario;
    use FlagKind::{MeshFolded, NotPredictable, Unconverged};
    use nalgebra::Point2;

    #[test]
    fn nobody_is_told_to_take_a_smaller_step_where_none_would_help() {
        let answer = solve(&CheckedScenario::default(), Keep::default(), &mut unwatched).unwrap();
        let mut extremes = *answer.left.section().unwrap();
        let mut kinds = |fold, error, disagreement| -> Vec<FlagKind> {
            extremes.fold = fold;
            let flags = raise(&Evidence {
                case: answer.case.section().unwrap(),
                extremes: &extremes,
                two_runs: Some(TwoRuns {
                    worst: Some((Quantity::Damage, error)),
                    disagreement,
                }),
            });
            flags.into_iter().map(|flag| flag.kind).collect()
        };
        let folded = Some(Fold {
            since: 1e-4,
            lasted: 1e-5,
            stays: false,
            quads: 1,
            of: 193,
            at: Point2::new(-0.01, 0.0),
            part: Region::Interior,
            both_sides: false,
        });
        assert_eq!(kinds(folded, 50.0, 50.0), [MeshFolded, NotPredictable]);
        assert_eq!(
            kinds(folded, f64::NAN, f64::NAN),
            [MeshFolded, NotPredictable]
        );
        assert_eq!(kinds(folded, 50.0, 1.0), [MeshFolded, Unconverged]);
        assert_eq!(kinds(None, 50.0, 50.0), [Unconverged]);
        assert_eq!(kinds(None, f64::NAN, 0.0), [Unconverged]);
        assert_eq!(kinds(None, 1.0, 50.0), []);
    }
}
