//! What the flags of a run say of the results that it computed, and what to do where they are not usable.

use crate::injury::Validity;
use crate::run::flags::{Flag, FlagKind};

/// A pulse brings no energy of an object, and springs hold no pressure.
const NOTHING: &str = "no measure is usable: a force pulse is no object with an energy, and the Paper model \
                       has no pressure or stress; take the model Physiological, or an object";
const MISSED: &str = "none: the object never touches the eye";
const OTHER_MODEL: &str = "take the model Physiological";

/// Why the motion of a run cannot be believed, and what to do about it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Spoiled {
    /// What happened, in a few words, and when.
    pub why: String,
    /// The next step to take.
    pub next: &'static str,
}

/// Of a run with these flags; `paper` says whether it is of the Paper model.
pub(crate) fn spoiled(flags: &[Flag], paper: bool) -> Option<Spoiled> {
    // An eye that nothing touched rests, whatever becomes of the object.
    if flags.iter().any(|flag| flag.kind == FlagKind::EyeMissed) {
        return None;
    }
    flags.iter().find_map(|flag| {
        let name = flag.kind.name().replace('_', " ");
        let time = flag.time.map(|time| format!(" at {:.3} ms", time * 1e3));
        Some(Spoiled {
            why: name + &time.unwrap_or_default(),
            next: next(flag.kind, paper)?,
        })
    })
}

/// What helps where a flag says that the motion itself cannot be believed; none of the others. One that
/// tells how far a figure is off does not: the error is part of the range. A finer mesh folds earlier.
fn next(kind: FlagKind, paper: bool) -> Option<&'static str> {
    match kind {
        FlagKind::MeshFolded | FlagKind::NotPredictable if paper => {
            Some("take the model Physiological, or a smaller blow")
        }
        FlagKind::MeshFolded | FlagKind::NotPredictable => Some("try a smaller blow"),
        FlagKind::EnergyImbalance if paper => Some("try a shorter step"),
        // A soft face that is pressed in deeper than its edge is round has no normal to push along.
        FlagKind::EnergyImbalance => Some("try a rounder edge, a harder surface or a shorter step"),
        FlagKind::AngleBeyondTrust => Some("turn the blow nearer to the front"),
        _ => None,
    }
}

/// Of a run with these flags. `cut` says whether it ended while pressure or stress may still grow; none if
/// the model has neither, as the Paper model.
pub(crate) fn validity(flags: &[Flag], cut: Option<bool>, pig: bool) -> Validity {
    let has = |kind| flags.iter().any(|flag| flag.kind == kind);
    let paper = cut.is_none();
    let (why, next) = match spoiled(flags, paper) {
        Some(Spoiled { why, next }) => (Some(why), if paper { OTHER_MODEL } else { next }),
        None if paper => (None, OTHER_MODEL),
        None => (None, ""),
    };
    Validity {
        spoiled: why,
        next,
        cut: cut == Some(true),
        aslant: has(FlagKind::AngleBeyondTrust),
        pig,
        silence: if has(FlagKind::EyeMissed) {
            MISSED
        } else {
            NOTHING
        },
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn flag(kind: FlagKind) -> Flag {
        Flag {
            kind,
            message: String::new(),
            detail: None,
            time: Some(0.48e-3),
        }
    }

    #[test]
    fn a_folded_mesh_spoils_and_a_window_that_cuts_the_contact_only_bounds() {
        let folded = validity(&[flag(FlagKind::MeshFolded)], Some(false), false);
        assert_eq!(folded.spoiled.as_deref(), Some("mesh folded at 0.480 ms"));
        assert_eq!(folded.next, "try a smaller blow");
        let of_paper = spoiled(
            &[flag(FlagKind::WindowShort), flag(FlagKind::MeshFolded)],
            true,
        );
        assert!(of_paper.is_some_and(|spoiled| spoiled.next.contains("Physiological")));
        assert!(!folded.cut && !folded.aslant);
        assert!(validity(&[flag(FlagKind::AngleBeyondTrust)], Some(false), false).aslant);
        let cut = validity(&[flag(FlagKind::ContactCut)], Some(true), false);
        assert!(cut.cut && cut.spoiled.is_none());
        assert_eq!(
            validity(&[flag(FlagKind::WindowShort)], Some(false), false).spoiled,
            None
        );
    }
}
