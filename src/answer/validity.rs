//! Whether the flags of a run leave its results usable, and what to do where they do not.

use crate::run::flags::{Flag, FlagKind, has};
use crate::run::rules::Rules;

/// Why the motion of a run cannot be believed, and what to do about it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Spoiled {
    /// What happened, in a few words, and when.
    pub why: String,
    /// The next step to take.
    pub next: &'static str,
}

/// Why the motion cannot be believed, from the flags of a run and the rules of its model.
pub(crate) fn spoiled(flags: &[Flag], rules: &Rules) -> Option<Spoiled> {
    // An eye that nothing touched rests, whatever becomes of the object.
    if has(flags, FlagKind::EyeMissed) {
        return None;
    }
    flags.iter().find_map(|flag| {
        let time = flag.time.map(|time| format!(" at {:.3} ms", time * 1e3)).unwrap_or_default();
        let why = flag.kind.name().replace('_', " ") + &time;
        Some(Spoiled { why, next: (rules.advice)(flag.kind)? })
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::models::rules;
    use crate::scenario::{Impact, Projectile, Scenario};

    fn of_cells() -> &'static Rules {
        rules(&Scenario::of(Impact::Projectile(Projectile::default())))
    }

    fn flag(kind: FlagKind) -> Flag {
        Flag { kind, message: String::new(), detail: None, time: Some(0.48e-3) }
    }

    #[test]
    fn a_folded_mesh_spoils_and_a_window_that_cuts_the_contact_only_bounds() {
        let folded = spoiled(&[flag(FlagKind::MeshFolded)], of_cells()).unwrap();
        assert_eq!(folded.why, "mesh folded at 0.480 ms");
        assert_eq!(folded.next, "try a smaller blow");
        let both = [FlagKind::WindowShort, FlagKind::MeshFolded].map(flag);
        let of_paper = spoiled(&both, rules(&Scenario::default()));
        assert!(of_paper.is_some_and(|spoiled| spoiled.next.contains("Physiological")));
        for bounds in [FlagKind::ContactCut, FlagKind::WindowShort] {
            assert_eq!(spoiled(&[flag(bounds)], of_cells()), None);
        }
    }
}
