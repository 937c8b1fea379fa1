//! What a reader must know before trusting a result, each by name.

use super::case::Case;
use crate::dynamics::ArcLoad;
use crate::eye::GLOBE_RADIUS_M;
use crate::recording::{Extremes, ShotExtremes};

/// Something that limits a result.
#[derive(Debug, Clone, PartialEq)]
pub struct Flag {
    /// What kind.
    pub kind: FlagKind,
    /// A sentence for a person.
    pub message: String,
    /// When it happened, in s.
    pub time: Option<f64>,
}

/// Kinds of flags.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum FlagKind {
    /// A quad of the mesh turned inside out.
    MeshFolded,
    /// A quad came close to that.
    MeshNearlyFolded,
    /// The next finer mesh turns inside out where this one does not.
    FinerMeshFolds,
    /// The energies do not add up.
    EnergyImbalance,
    /// The mesh folded and a slightly different step gives another answer.
    NotPredictable,
    /// The step error is large.
    Unconverged,
    /// The window ended while a result still grew.
    WindowShort,
    /// The window ended before the pulse.
    PulseCut,
    /// The loaded arc is narrower than the distance between two nodes.
    ArcUnresolved,
    /// Part of the arc lies behind bone.
    BoneShields,
    /// The projectile went deeper into the shell or the rim than a rigid one should.
    DeepPenetration,
    /// A soft projectile was squeezed further than its spring is linear.
    ObjectFlattened,
    /// The projectile went through the wall of the orbit.
    ThroughBone,
    /// The projectile is narrower than the distance between two nodes of the shell.
    ObjectUnresolved,
    /// The projectile is lighter than a node that it hits.
    ObjectLight,
    /// The orbit's rim met the projectile.
    RimStops,
    /// The projectile never touched the eye.
    EyeMissed,
    /// The blow comes at an angle at which a turned axis is no good picture of an orbit.
    AngleBeyondTrust,
    /// The projectile touched the eye, or still flew at it, when the window ended.
    ContactCut,
}

impl FlagKind {
    /// Name as used in JSON.
    pub fn name(self) -> &'static str {
        match self {
            Self::MeshFolded => "mesh_folded",
            Self::MeshNearlyFolded => "mesh_nearly_folded",
            Self::FinerMeshFolds => "finer_mesh_folds",
            Self::EnergyImbalance => "energy_imbalance",
            Self::NotPredictable => "not_predictable",
            Self::Unconverged => "unconverged",
            Self::WindowShort => "window_short",
            Self::PulseCut => "pulse_cut",
            Self::ArcUnresolved => "arc_unresolved",
            Self::BoneShields => "bone_shields",
            Self::DeepPenetration => "deep_penetration",
            Self::ObjectFlattened => "object_flattened",
            Self::ThroughBone => "through_bone",
            Self::ObjectLight => "object_light",
            Self::ObjectUnresolved => "object_unresolved",
            Self::RimStops => "rim_stops",
            Self::EyeMissed => "eye_missed",
            Self::AngleBeyondTrust => "angle_beyond_trust",
            Self::ContactCut => "contact_cut",
        }
    }
}

/// Quads smaller than this share of their rest area are worth a warning.
const NEARLY_FOLDED: f64 = 0.2;
/// An energy residual above this share of the work in is an alarm.
pub(super) const ENERGY_ALARM: f64 = 0.01;
/// A step error above this many percent is called unconverged.
const UNCONVERGED_PERCENT: f64 = 10.0;
/// Two runs of a folded mesh that differ by more than this many percent predict nothing.
const UNPREDICTABLE_PERCENT: f64 = 5.0;

/// A penetration above this share of the diameter is an alarm.
const DEEP: f64 = 0.02;

/// A soft object squeezed by more than this share of the diameter is no linear spring.
const FLATTENED: f64 = 0.5;

/// A shielded share below this is rounding.
const NEGLIGIBLE: f64 = 1e-9;

/// What flags are raised from.
pub(super) struct Evidence<'a> {
    /// What was moved.
    pub case: &'a Case,
    /// What its march left.
    pub extremes: &'a Extremes,
    /// Where there was a second run: the largest step error of a leading result, and the largest
    /// difference of one between the two runs, both in %.
    pub step_error: Option<(f64, f64)>,
}

/// Flags of a result.
pub(super) fn raise(evidence: &Evidence) -> Vec<Flag> {
    let Evidence { case, extremes, .. } = *evidence;
    let (window, pulse) = (case.window, case.system.load().pulse.duration());
    // The angle from one node of the shell to the next, in radians.
    let spacing = std::f64::consts::TAU / case.eye.landmarks.shell.len() as f64;
    let mut flags = Vec::new();
    let split = |disagreement: f64| disagreement > UNPREDICTABLE_PERCENT || disagreement.is_nan();
    let unpredictable = evidence
        .step_error
        .filter(|(_, disagreement)| extremes.folded_at.is_some() && split(*disagreement));
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
                "mesh folded at {:.3} ms: beyond the model's validity",
                time * 1e3
            ),
            Some(time),
        );
        if let Some((_, disagreement)) = unpredictable {
            raise(
                FlagKind::NotPredictable,
                format!("two solutions disagree by {disagreement:.0} %: not predictable"),
                Some(time),
            );
        }
    } else if extremes.least_quad_ratio < NEARLY_FOLDED {
        raise(
            FlagKind::MeshNearlyFolded,
            format!(
                "a quad shrank to {:.0} % of its area: near the end of the model's validity",
                100.0 * extremes.least_quad_ratio
            ),
            None,
        );
    }
    if extremes.energy_residual > ENERGY_ALARM {
        raise(
            FlagKind::EnergyImbalance,
            format!(
                "the energies miss the work in by {:.2} %",
                100.0 * extremes.energy_residual
            ),
            None,
        );
    }
    // Where two solutions part for good, no step is small enough.
    if let Some((error, _)) = evidence.step_error.filter(|_| unpredictable.is_none()) {
        unconverged(error, &mut raise);
    }
    if window < pulse {
        pulse_cut(window, pulse, &mut raise);
    } else if extremes.still_rising {
        raise(
            FlagKind::WindowShort,
            "a result still grew when the window ended".to_owned(),
            Some(window),
        );
    } else if extremes.could_rise {
        raise(
            FlagKind::WindowShort,
            "the energy left at the end of the window could still raise a result".to_owned(),
            Some(window),
        );
    }
    of_load(&case.load, spacing, &mut raise);
    if let Some(shot) = &extremes.shot {
        of_shot(shot, window, spacing, &mut raise);
    }
    flags
}

/// Where a step error, in %, is so large that the result has not converged.
pub(super) fn unconverged(step_error: f64, raise: &mut impl FnMut(FlagKind, String, Option<f64>)) {
    if step_error > UNCONVERGED_PERCENT || step_error.is_nan() {
        raise(
            FlagKind::Unconverged,
            format!("the largest step error of any result is {step_error:.1} %"),
            None,
        );
    }
}

/// A window that ends before the pulse; both in s.
pub(super) fn pulse_cut(
    window: f64,
    pulse: f64,
    raise: &mut impl FnMut(FlagKind, String, Option<f64>),
) {
    raise(
        FlagKind::PulseCut,
        format!(
            "the window ends before the pulse, which lasts {} ms",
            pulse * 1e3
        ),
        Some(window),
    );
}

/// A window, in s, that ends while the projectile touches the eye or flies at it.
pub(super) fn contact_cut(window: f64, raise: &mut impl FnMut(FlagKind, String, Option<f64>)) {
    raise(
        FlagKind::ContactCut,
        "the window ended before the projectile had left the eye".to_owned(),
        Some(window),
    );
}

/// Flags of where a force acts.
fn of_load(load: &ArcLoad, spacing: f64, raise: &mut impl FnMut(FlagKind, String, Option<f64>)) {
    let (arc, shielded) = (load.arc.1 - load.arc.0, load.shielded);
    if !load.shares.is_empty() && arc < spacing * (1.0 - NEGLIGIBLE) {
        raise(
            FlagKind::ArcUnresolved,
            format!(
                "the loaded arc of {:.3} degrees is narrower than the mesh's spacing of {:.3}",
                arc.to_degrees(),
                spacing.to_degrees()
            ),
            None,
        );
    }
    if shielded > NEGLIGIBLE {
        raise(
            FlagKind::BoneShields,
            format!(
                "bone shields {:.1} % of the arc: the whole force acts on the rest",
                100.0 * shielded
            ),
            None,
        );
    }
}

/// Flags of a projectile.
fn of_shot(
    shot: &ShotExtremes,
    window: f64,
    spacing: f64,
    raise: &mut impl FnMut(FlagKind, String, Option<f64>),
) {
    if shot.penetration_share > DEEP {
        raise(
            FlagKind::DeepPenetration,
            format!(
                "the projectile went {:.1} % of its diameter into what it hit",
                100.0 * shot.penetration_share
            ),
            None,
        );
    }
    if shot.squeezed_share > FLATTENED {
        raise(
            FlagKind::ObjectFlattened,
            format!(
                "the projectile was squeezed by {:.0} % of its diameter: beyond a linear spring",
                100.0 * shot.squeezed_share
            ),
            None,
        );
    }
    if let Some(time) = shot.through_bone_at {
        raise(
            FlagKind::ThroughBone,
            format!(
                "the projectile passed the wall of the orbit at {:.3} ms: bone is left out there",
                time * 1e3
            ),
            Some(time),
        );
    }
    let between_nodes = spacing * GLOBE_RADIUS_M;
    if shot.diameter < between_nodes && shot.contact.is_some() {
        raise(
            FlagKind::ObjectUnresolved,
            format!(
                "the projectile is narrower than the {:.2} mm between two nodes of the shell",
                between_nodes * 1e3
            ),
            None,
        );
    }
    if shot.light && shot.contact.is_some() {
        raise(
            FlagKind::ObjectLight,
            "the projectile is lighter than a node: rebound and contact depend on the mesh"
                .to_owned(),
            None,
        );
    }
    if let Some(time) = shot.rim_at {
        raise(
            FlagKind::RimStops,
            format!("the orbit's rim met the projectile at {:.3} ms", time * 1e3),
            Some(time),
        );
    }
    match (shot.contact, shot.rim_at) {
        (None, Some(_)) => raise(
            FlagKind::EyeMissed,
            "the rim of the orbit kept the projectile off the eye".to_owned(),
            None,
        ),
        (None, None) => raise(
            FlagKind::EyeMissed,
            "the projectile never touched the eye".to_owned(),
            None,
        ),
        (Some(_), _) if shot.touching || shot.going_on => contact_cut(window, raise),
        _ => {}
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::recording::Keep;
    use crate::scenario::CheckedScenario;
    use crate::study::{solve, unwatched};
    use FlagKind::{MeshFolded, NotPredictable, Unconverged};

    #[test]
    fn nobody_is_told_to_take_a_smaller_step_where_none_would_help() {
        let answer = solve(&CheckedScenario::default(), Keep::default(), &mut unwatched).unwrap();
        let mut extremes = *answer.left.section().unwrap();
        let mut kinds = |folded_at, error, disagreement| -> Vec<FlagKind> {
            extremes.folded_at = folded_at;
            let flags = raise(&Evidence {
                case: answer.case.section().unwrap(),
                extremes: &extremes,
                step_error: Some((error, disagreement)),
            });
            flags.into_iter().map(|flag| flag.kind).collect()
        };
        let folded = Some(1e-4);
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
