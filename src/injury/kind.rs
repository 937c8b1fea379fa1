//! The injuries that an answer speaks of.

use crate::run::quantity::Quantity;
use strum::{EnumCount, IntoStaticStr, VariantArray};

/// An injury, the gravest first.
#[derive(Debug, Clone, Copy, PartialEq, Eq, EnumCount, IntoStaticStr, VariantArray)]
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

    /// Its name and short word, what its tissue felt and its risk as a result.
    const fn row(self) -> (&'static str, &'static str, Quantity, Quantity) {
        use Quantity as Q;
        match self {
            Self::GlobeRupture => ("globe rupture", "rupture", Q::EquatorStretch, Q::GlobeRupture),
            Self::RetinaBack => ("retina at the back", "retina", Q::BackStretch, Q::RetinaBack),
            Self::RetinaFront => ("retina's front edge", "edge", Q::EdgeGrowth, Q::RetinaFront),
            Self::LensDislocation => ("lens dislocation", "lens", Q::LensPull, Q::LensDislocation),
            Self::Hyphema => ("hyphema", "hyphema", Q::IrisPull, Q::Hyphema),
            Self::CornealAbrasion => {
                ("corneal abrasion", "abrasion", Q::CornealEnergy, Q::CornealAbrasion)
            }
        }
    }

    /// The name for people.
    pub const fn name(self) -> &'static str {
        self.row().0
    }

    /// Its name where there is room for one short word.
    pub const fn word(self) -> &'static str {
        self.row().1
    }

    /// Its name in JSON.
    pub fn key(self) -> &'static str {
        self.into()
    }

    /// What its tissue felt, which its risk is read from.
    pub const fn measure(self) -> Quantity {
        self.row().2
    }

    /// Its risk as a result.
    pub const fn result(self) -> Quantity {
        self.row().3
    }

    /// The injury whose risk a result is; none of what is no risk.
    pub fn of(result: Quantity) -> Option<Self> {
        let own = |injury: &&Self| injury.result() == result;
        Self::ALL.iter().find(own).copied()
    }
}

/// One `T` for each injury, in their order.
pub type PerInjury<T> = [T; Injury::COUNT];
