//! What a run left behind, whichever eye it moved, and what may be asked of it without knowing which.

use crate::injury::DamageIndex;
use crate::models::axisymmetric as revolution;
use crate::models::paper::recording::Extremes;
use crate::run::fold::Fold;

/// The largest values of a run, and how it ended.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Left {
    /// Of springs in a section.
    Section(Extremes),
    /// Of a body of revolution.
    Revolution(revolution::Extremes),
}

impl Left {
    /// That of a section.
    pub fn section(&self) -> Option<&Extremes> {
        match self {
            Self::Section(extremes) => Some(extremes),
            Self::Revolution(_) => None,
        }
    }

    /// That of a body of revolution.
    pub fn revolution(&self) -> Option<&revolution::Extremes> {
        match self {
            Self::Section(_) => None,
            Self::Revolution(extremes) => Some(extremes),
        }
    }

    /// The paper's index and its parts, by the eye's own S, M and E.
    pub fn index(&self) -> DamageIndex {
        match self {
            Self::Section(extremes) => DamageIndex::of(extremes),
            Self::Revolution(extremes) => DamageIndex::of_revolution(extremes),
        }
    }

    /// How the mesh folded.
    pub fn fold(&self) -> Option<Fold> {
        match self {
            Self::Section(extremes) => extremes.fold,
            Self::Revolution(extremes) => extremes.fold,
        }
    }

    /// When the mesh folded, in s.
    pub fn folded_at(&self) -> Option<f64> {
        Some(self.fold()?.since)
    }

    /// Whether a projectile never touched the eye.
    pub fn missed(&self) -> bool {
        match self {
            Self::Section(_) => false,
            Self::Revolution(extremes) => extremes.missed(),
        }
    }

    /// By how much the energies miss, as a share of what came in.
    pub fn energy_residual(&self) -> f64 {
        match self {
            Self::Section(extremes) => extremes.energy_residual,
            Self::Revolution(extremes) => extremes.energy_residual,
        }
    }

    /// Peak pressure in the globe, Pa, where it has cells.
    pub fn pressure(&self) -> Option<f64> {
        Some(self.revolution()?.pressure.value)
    }

    /// Peak stress of the sclera, Pa, where the eye has a shell of its own.
    pub fn stress(&self) -> Option<f64> {
        Some(self.revolution()?.scleral_stress.value)
    }
}
