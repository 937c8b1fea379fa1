//! The parts of a scenario that only some variants have.

use crate::scenario::{
    ForcePulse, Geometry, Impact, Model, Physiological, Projectile, ProjectileStiffness, Scenario,
    Support, Surface,
};

/// Both accessors of what one variant of a part holds.
macro_rules! variant {
    ($part:ident, $variant:path, $held:ty, $get:ident, $get_mut:ident, $what:literal) => {
        #[doc = $what]
        pub fn $get(&self) -> Option<&$held> {
            if let $variant(held) = &self.$part { Some(held) } else { None }
        }

        #[doc = $what]
        pub fn $get_mut(&mut self) -> Option<&mut $held> {
            if let $variant(held) = &mut self.$part { Some(held) } else { None }
        }
    };
}

impl Scenario {
    variant!(
        impact,
        Impact::ForcePulse,
        ForcePulse,
        pulse,
        pulse_mut,
        "The force that hits the eye, if a force does."
    );
    variant!(
        impact,
        Impact::Projectile,
        Projectile,
        projectile,
        projectile_mut,
        "The object that hits the eye, if one does."
    );
    variant!(
        model,
        Model::Physiological,
        Physiological,
        physiological,
        physiological_mut,
        "What the eye of the Physiological model is made of."
    );

    pub(super) fn orbit(&self) -> Option<&Physiological> {
        self.physiological().filter(|parts| parts.support == Support::Orbit)
    }

    pub(super) fn orbit_mut(&mut self) -> Option<&mut Physiological> {
        self.physiological_mut().filter(|parts| parts.support == Support::Orbit)
    }

    pub(super) fn gelatin(&self) -> Option<&Physiological> {
        self.physiological().filter(|parts| parts.support == Support::Gelatin)
    }

    pub(super) fn gelatin_mut(&mut self) -> Option<&mut Physiological> {
        self.physiological_mut().filter(|parts| parts.support == Support::Gelatin)
    }

    /// An object that gives way, by its spring or its surface: nothing else loses energy.
    pub(super) fn lossy(&self) -> Option<&Projectile> {
        self.projectile().filter(|object| gives_way(object))
    }

    pub(super) fn lossy_mut(&mut self) -> Option<&mut Projectile> {
        self.projectile_mut().filter(|object| gives_way(object))
    }

    /// The scenario, if it is of the Paper model.
    pub(super) fn section(&self) -> Option<&Self> {
        self.physiological().is_none().then_some(self)
    }

    pub(super) fn section_mut(&mut self) -> Option<&mut Self> {
        self.physiological().is_none().then_some(self)
    }

    /// How much of the eye is computed, of a model that leaves the choice.
    pub(super) fn choosing(&self) -> Option<&Geometry> {
        self.physiological().map(|_| &self.numerics.geometry)
    }

    pub(super) fn choosing_mut(&mut self) -> Option<&mut Geometry> {
        self.physiological()?;
        Some(&mut self.numerics.geometry)
    }
}

fn gives_way(object: &Projectile) -> bool {
    object.stiffness != ProjectileStiffness::Rigid || object.surface != Surface::Hard
}
