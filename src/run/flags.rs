//! What a reader must know before trusting a result, each by name.
//!
//! [`crate::run::raised`] collects them and words those that every model can raise; the rest each
//! model raises itself.

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
    /// All that it says, and what to do about it.
    pub fn whole(&self) -> String {
        let detail = self.detail.iter().map(String::as_str);
        let parts: Vec<&str> = std::iter::once(self.message.as_str())
            .chain(detail)
            .chain([self.kind.next_step()])
            .collect();
        parts.join("; ")
    }
}

/// Whether one of these flags is of such a kind.
pub fn has(flags: &[Flag], kind: FlagKind) -> bool {
    flags.iter().any(|flag| flag.kind == kind)
}

/// Kinds of flags.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, strum::IntoStaticStr)]
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
        match self {
            Self::MeshFolded => "the computed tissue folded",
            Self::MeshNearlyFolded => "the computed tissue nearly folded",
            Self::FinerMeshFolds => "finer meshes fold in this blow",
            Self::EnergyImbalance => "the energies do not add up",
            Self::NotPredictable => "not predictable",
            Self::Unconverged => "the time step is too long",
            Self::LostInRounding => "lost in rounding",
            Self::WindowShort => "still rising at the end",
            Self::WindowCapped => "not watched to the end",
            Self::PulseCut => "the force outlasts the run",
            Self::ArcUnresolved => "arc finer than the mesh",
            Self::BoneShields => "bone shields a part",
            Self::SurfaceCrushed => "object crushed flat",
            Self::WentPast => "object went past the eye",
            Self::BeyondTests => "flatter than any tested eye",
            Self::EyeFlat => "eye pressed flat",
            Self::RimStops => "bone stopped the object",
            Self::BoneMayBreak => "bone may break",
            Self::EyeMissed => "the eye was missed",
            Self::AngleBeyondTrust => "too far from the side",
            Self::ContactCut => "still touching at the end",
        }
    }

    /// Name as used in JSON.
    pub fn name(self) -> &'static str {
        self.into()
    }

    /// What to do about it.
    pub fn next_step(self) -> &'static str {
        match self {
            Self::MeshFolded | Self::NotPredictable => "try a smaller blow",
            Self::MeshNearlyFolded => "a little more folds it: take no more than this",
            Self::FinerMeshFolds => "take the results for a rough guess, or try a smaller blow",
            Self::EnergyImbalance | Self::Unconverged => "try a shorter step, as --step-us sets it",
            Self::LostInRounding => "try a larger blow",
            Self::WindowShort | Self::WindowCapped | Self::PulseCut | Self::ContactCut => {
                "set a longer window_ms"
            }
            Self::ArcUnresolved => "try a finer mesh, as --level sets it",
            Self::BoneShields => "aim nearer to the front",
            Self::SurfaceCrushed | Self::EyeFlat => {
                "believe no more than `at least`, or try a smaller blow"
            }
            Self::BeyondTests => "take the figures as rough, or try a smaller blow",
            Self::WentPast => "aim nearer to the middle",
            Self::RimStops => {
                "bone takes a part of the blow: try another side, impact.from, or rim, model.rim"
            }
            Self::BoneMayBreak => "think of a fracture too: it is not in the model",
            Self::EyeMissed => "change angle or offset for a blow that meets the eye",
            Self::AngleBeyondTrust => "turn the blow nearer to the front",
        }
    }
}
