//! What a reader must know before trusting a result, each by name.

use strum::VariantArray;

/// A peak later than this share of the simulated time may still be growing.
pub(crate) const LATE_PEAK_SHARE: f64 = 0.999;

/// An eye shortened by this share has its front on its back, and a run ends.
pub const PRESSED_FLAT: f64 = 0.85;

/// Something that limits a result.
#[derive(Debug, Clone, PartialEq)]
pub struct Flag {
    /// What kind.
    pub kind: FlagKind,
    /// A sentence for a person.
    pub message: String,
    /// More of it, where there is room.
    pub detail: Option<String>,
    /// When it happened, in s.
    pub time: Option<f64>,
}

impl Flag {
    /// A flag without more to tell.
    pub(crate) fn new(kind: FlagKind, message: impl Into<String>, time: Option<f64>) -> Self {
        Self { kind, message: message.into(), detail: None, time }
    }

    /// All that it says, and what to do about it.
    pub fn whole(&self) -> String {
        let detail = self.detail.as_ref().map_or(String::new(), |detail| format!("; {detail}"));
        format!("{}{detail}; {}", self.message, self.kind.next_step())
    }
}

/// Whether one of these flags is of such a kind.
pub fn has(flags: &[Flag], kind: FlagKind) -> bool {
    flags.iter().any(|flag| flag.kind == kind)
}

/// Which kinds of flags were raised, without their words.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct FlagKinds(u32);

impl FlagKinds {
    /// Whether one of them was.
    pub fn contains(self, kind: FlagKind) -> bool {
        self.0 & 1 << kind as u32 != 0
    }

    /// Each of them, in the order below.
    pub fn iter(self) -> impl Iterator<Item = FlagKind> {
        FlagKind::VARIANTS.iter().copied().filter(move |kind| self.contains(*kind))
    }
}

impl FromIterator<FlagKind> for FlagKinds {
    fn from_iter<I: IntoIterator<Item = FlagKind>>(kinds: I) -> Self {
        Self(kinds.into_iter().fold(0, |all, kind| all | 1 << kind as u32))
    }
}

/// Kinds of flags.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, strum::IntoStaticStr, strum::VariantArray)]
#[strum(serialize_all = "snake_case")]
pub enum FlagKind {
    /// A quad of the mesh turned inside out.
    MeshFolded,
    /// A quad came close to that.
    MeshNearlyFolded,
    /// A finer mesh, run to estimate the mesh error, folds where this one does not.
    FinerMeshFolds,
    /// The energies do not add up.
    EnergyImbalance,
    /// The mesh folded and a slightly different step gives another answer.
    NotPredictable,
    /// The step error is large.
    Unconverged,
    /// The blow is so small that all it does is lost in rounding.
    LostInRounding,
    /// The window ended while a result still grew.
    WindowShort,
    /// A run without a set window met its cap before it was known that nothing can grow.
    WindowCapped,
    /// The window ended before the pulse.
    PulseCut,
    /// The loaded arc is narrower than the distance between two nodes.
    ArcUnresolved,
    /// Part of the arc lies behind bone.
    BoneShields,
    /// All that gives way of a projectile's surface was used up.
    SurfaceCrushed,
    /// The object went past the globe.
    WentPast,
    /// The object lay at the eye when nothing could grow any more.
    Stays,
    /// The eye was shortened by more than in any test.
    BeyondTests,
    /// The eye was pressed flat, which ends a run.
    EyeFlat,
    /// The orbit's rim met the projectile.
    RimStops,
    /// The projectile spent more on bone than bone has been seen to bear.
    BoneMayBreak,
    /// The projectile never touched the eye.
    EyeMissed,
    /// The blow comes at an angle at which a turned axis is no good picture of an orbit.
    AngleBeyondTrust,
    /// The projectile touched the eye, or still flew at it, when the window ended.
    ContactCut,
}

impl FlagKind {
    /// What happened, in a few words for people.
    pub fn words(self) -> &'static str {
        self.said().0
    }

    /// Name as used in JSON.
    pub fn name(self) -> &'static str {
        self.into()
    }

    /// What to do about it.
    pub fn next_step(self) -> &'static str {
        self.said().1
    }

    /// What happened, and what to do about it.
    fn said(self) -> (&'static str, &'static str) {
        const SMALLER: &str = "try a smaller blow";
        const LONGER: &str = "set a longer window_ms";
        const SHORTER: &str = "try a shorter step, as --step-us sets it";
        const AT_LEAST: &str = "believe no more than `at least`, or try a smaller blow";
        match self {
            Self::MeshFolded => ("the computed tissue folded", SMALLER),
            Self::MeshNearlyFolded => (
                "the computed tissue nearly folded",
                "a little more folds it: take no more than this",
            ),
            Self::FinerMeshFolds => (
                "finer meshes fold in this blow",
                "take the results for a rough guess, or try a smaller blow",
            ),
            Self::EnergyImbalance => ("the energies do not add up", SHORTER),
            Self::NotPredictable => ("not predictable", SMALLER),
            Self::Unconverged => ("the time step is too long", SHORTER),
            Self::LostInRounding => ("lost in rounding", "try a larger blow"),
            Self::WindowShort => ("still rising at the end", LONGER),
            Self::WindowCapped => ("not watched to the end", LONGER),
            Self::PulseCut => ("the force outlasts the run", LONGER),
            Self::ArcUnresolved => {
                ("arc finer than the mesh", "try a finer mesh, as --level sets it")
            }
            Self::BoneShields => ("bone shields a part", "aim nearer to the front"),
            Self::SurfaceCrushed => ("object crushed flat", AT_LEAST),
            Self::WentPast => ("object went past the eye", "aim nearer to the middle"),
            Self::Stays => (
                "object lay at the eye at the end",
                "only how it leaves, and what it takes back, is not known",
            ),
            Self::BeyondTests => {
                ("flatter than any tested eye", "take the figures as rough, or try a smaller blow")
            }
            Self::EyeFlat => ("eye pressed flat", AT_LEAST),
            Self::RimStops => (
                "bone stopped the object",
                "bone takes a part of the blow, and here it does not break",
            ),
            Self::BoneMayBreak => {
                ("bone may break", "think of a fracture too: it is not in the model")
            }
            Self::EyeMissed => {
                ("the eye was missed", "change angle or offset for a blow that meets the eye")
            }
            Self::AngleBeyondTrust => {
                ("too far from the side", "turn the blow nearer to the front")
            }
            Self::ContactCut => ("still touching at the end", LONGER),
        }
    }
}
