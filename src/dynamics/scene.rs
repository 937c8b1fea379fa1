//! What kind of scene a scenario is, decided once.
//!
//! All that follows from the kind hangs on it: here what the eye is compiled with, in `study::rules`
//! which integrators solve it, in which steps, and how its step error is told.

use crate::scenario::{Impact, Model, Scenario};

/// What acts on the nodes of a scene.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum SceneKind {
    /// Springs, drag and a force that is known beforehand.
    Springs,
    /// A fluid or dashpots besides.
    Coupled,
    /// A projectile, with or without a fluid or dashpots.
    Contact,
}

impl SceneKind {
    /// The kind of `scenario`.
    pub fn of(scenario: &Scenario) -> Self {
        match (&scenario.impact, &scenario.model) {
            (Impact::Projectile(_), _) => Self::Contact,
            (Impact::ForcePulse(_), Model::Physiological(parts))
                if parts.pressure || parts.dashpots =>
            {
                Self::Coupled
            }
            (Impact::ForcePulse(_), _) => Self::Springs,
        }
    }

    /// Whether the whole eye is moved even where the load is symmetric: a projectile, a fluid and
    /// dashpots are compiled for no half.
    pub fn needs_whole_eye(self) -> bool {
        match self {
            Self::Springs => false,
            Self::Coupled | Self::Contact => true,
        }
    }

    /// Whether the energy in springs and motion bounds all that can still happen after the load.
    pub fn bounded_by_energy(self) -> bool {
        match self {
            Self::Springs => true,
            Self::Coupled | Self::Contact => false,
        }
    }
}
