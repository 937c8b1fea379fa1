//! What the flags of a run say of the pressure and the stress that it computed.

use super::flags::{Flag, FlagKind};
use crate::injury::Validity;

/// A pulse brings no energy of an object, and springs hold no pressure.
const NOTHING: &str = "no measure is usable: a force pulse is no object with an energy, and the Paper model \
                       has no pressure or stress; take the model Physiological, or an object";
const MISSED: &str = "none: the object never touches the eye";

/// Of a run with these flags. `late` says whether pressure or stress were largest as it ended; none if
/// the model has neither.
pub(super) fn validity(flags: &[Flag], late: Option<bool>, pig: bool) -> Validity {
    let has = |kind| flags.iter().any(|flag| flag.kind == kind);
    let spoiled = flags.iter().find(|flag| spoils(flag.kind));
    Validity {
        computes: late.is_some(),
        spoiled: spoiled.map(|flag| {
            let name = flag.kind.name().replace('_', " ");
            let time = flag.time.map(|time| format!(" at {:.3} ms", time * 1e3));
            name + &time.unwrap_or_default()
        }),
        cut: late == Some(true) || has(FlagKind::PulseCut) || has(FlagKind::ContactCut),
        pig,
        silence: if has(FlagKind::EyeMissed) {
            MISSED
        } else {
            NOTHING
        },
    }
}

/// Whether a flag of this kind says that the motion itself cannot be believed. One that tells how far a
/// figure is off does not: the error is part of the range.
fn spoils(kind: FlagKind) -> bool {
    matches!(
        kind,
        FlagKind::MeshFolded
            | FlagKind::EnergyImbalance
            | FlagKind::NotPredictable
            | FlagKind::ThroughBone
            | FlagKind::AngleBeyondTrust
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    fn flag(kind: FlagKind) -> Flag {
        Flag {
            kind,
            message: String::new(),
            time: Some(0.48e-3),
        }
    }

    #[test]
    fn a_folded_mesh_spoils_and_a_window_that_cuts_the_contact_only_bounds() {
        let folded = validity(&[flag(FlagKind::MeshFolded)], Some(false), false);
        assert_eq!(folded.spoiled.as_deref(), Some("mesh folded at 0.480 ms"));
        assert!(!folded.cut);
        let cut = validity(&[flag(FlagKind::ContactCut)], Some(false), false);
        assert!(cut.cut && cut.spoiled.is_none());
        assert!(validity(&[], Some(true), false).cut);
        assert_eq!(
            validity(&[flag(FlagKind::WindowShort)], Some(false), false).spoiled,
            None
        );
    }
}
