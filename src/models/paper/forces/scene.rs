//! What kind of scene a scenario is, decided once.
//!
//! All that follows from the kind hangs on it: here what the eye is compiled with, in [`crate::run::rules`]
//! which integrators solve it, in which steps, and how its step error is told.

use crate::scenario::{Impact, Scenario};

/// What acts on the nodes of a scene.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum SceneKind {
    /// Springs, drag and a force that is known beforehand.
    Springs,
    /// A projectile.
    Contact,
}

impl SceneKind {
    /// The kind of `scenario`.
    pub fn of(scenario: &Scenario) -> Self {
        match scenario.impact {
            Impact::Projectile(_) => Self::Contact,
            Impact::ForcePulse(_) => Self::Springs,
        }
    }

    /// Whether the whole eye is moved even where the load is symmetric: a projectile is compiled for no
    /// half.
    pub fn needs_whole_eye(self) -> bool {
        self == Self::Contact
    }

    /// Whether the energy in springs and motion bounds all that can still happen after the load.
    pub fn bounded_by_energy(self) -> bool {
        self == Self::Springs
    }
}
