//! The injuries that an answer speaks of.

use crate::run::quantity::Quantity;
use strum::{EnumCount, IntoStaticStr, VariantArray};

/// An injury, the gravest first.
#[derive(
    Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, EnumCount, IntoStaticStr, VariantArray,
)]
#[strum(serialize_all = "snake_case")]
pub enum Injury {
    /// The wall of the globe torn through.
    GlobeRupture,
    /// Damage of the retina at the back of the eye.
    RetinaBack,
    /// Damage of the retina at its front edge, the ora, from which it detaches.
    RetinaFront,
    /// The lens torn off what holds it.
    LensDislocation,
    /// Blood in the anterior chamber.
    Hyphema,
    /// Loss of the cornea's outermost layer.
    CornealAbrasion,
}

impl Injury {
    /// All of them, the gravest first.
    pub const ALL: &[Self] = Self::VARIANTS;

    /// The name for people.
    pub const fn name(self) -> &'static str {
        match self {
            Self::GlobeRupture => "globe rupture",
            Self::RetinaBack => "retina at the back",
            Self::RetinaFront => "retina's front edge",
            Self::LensDislocation => "lens dislocation",
            Self::Hyphema => "hyphema",
            Self::CornealAbrasion => "corneal abrasion",
        }
    }

    /// Its name where there is room for one short word.
    pub const fn word(self) -> &'static str {
        match self {
            Self::GlobeRupture => "rupture",
            Self::RetinaBack => "retina",
            Self::RetinaFront => "edge",
            Self::LensDislocation => "lens",
            Self::Hyphema => "hyphema",
            Self::CornealAbrasion => "abrasion",
        }
    }

    /// Its name in JSON.
    pub fn key(self) -> &'static str {
        self.into()
    }

    /// What its tissue felt, which its risk is read from.
    pub const fn measure(self) -> Quantity {
        match self {
            Self::GlobeRupture => Quantity::EquatorStretch,
            Self::RetinaBack => Quantity::BackStretch,
            Self::RetinaFront => Quantity::EdgeGrowth,
            Self::LensDislocation => Quantity::LensPull,
            Self::Hyphema => Quantity::IrisPull,
            Self::CornealAbrasion => Quantity::CornealEnergy,
        }
    }

    /// Its risk as a result.
    pub const fn result(self) -> Quantity {
        match self {
            Self::GlobeRupture => Quantity::GlobeRupture,
            Self::RetinaBack => Quantity::RetinaBack,
            Self::RetinaFront => Quantity::RetinaFront,
            Self::LensDislocation => Quantity::LensDislocation,
            Self::Hyphema => Quantity::Hyphema,
            Self::CornealAbrasion => Quantity::CornealAbrasion,
        }
    }

    /// The injury whose risk a result is; none of what is no risk.
    pub fn of(result: Quantity) -> Option<Self> {
        let own = |injury: &&Self| injury.result() == result;
        Self::ALL.iter().find(own).copied()
    }
}

/// One `T` for each injury, in their order.
pub type PerInjury<T> = [T; Injury::COUNT];
