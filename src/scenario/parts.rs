//! The parts of a scenario that only some variants have.

use crate::scenario::{ForcePulse, Geometry, Impact, Model, Physiological, Projectile};
use crate::scenario::{ProjectileStiffness, Scenario, Support, Surface};

/// Both accessors of what one variant of a part holds, which has the name of the variant.
macro_rules! variant {
    ($(#[$doc:meta])* $get:ident, $get_mut:ident, $part:ident in $kind:ident::$held:ident) => {
        $(#[$doc])*
        pub fn $get(&self) -> Option<&$held> {
            if let $kind::$held(held) = &self.$part { Some(held) } else { None }
        }

        $(#[$doc])*
        pub fn $get_mut(&mut self) -> Option<&mut $held> {
            if let $kind::$held(held) = &mut self.$part { Some(held) } else { None }
        }
    };
}

/// Both accessors of a part as long as it is of some kind.
macro_rules! only {
    ($get:ident, $get_mut:ident, $whole:ident, $whole_mut:ident -> $held:ident, $is:expr) => {
        pub(super) fn $get(&self) -> Option<&$held> {
            self.$whole().filter(|held| $is(held))
        }

        pub(super) fn $get_mut(&mut self) -> Option<&mut $held> {
            self.$whole_mut().filter(|held| $is(held))
        }
    };
}

fn in_orbit(eye: &Physiological) -> bool {
    eye.support == Support::Orbit
}

fn in_gelatin(eye: &Physiological) -> bool {
    eye.support == Support::Gelatin
}

/// By its spring or its surface: nothing else loses energy.
fn gives_way(object: &Projectile) -> bool {
    object.stiffness != ProjectileStiffness::Rigid || object.surface != Surface::Hard
}

impl Scenario {
    variant! {
        /// The force that hits the eye, if a force does.
        pulse, pulse_mut, impact in Impact::ForcePulse
    }
    variant! {
        /// The object that hits the eye, if one does.
        projectile, projectile_mut, impact in Impact::Projectile
    }
    variant! {
        /// What the eye of the Physiological model is made of.
        physiological, physiological_mut, model in Model::Physiological
    }
    only!(orbit, orbit_mut, physiological, physiological_mut -> Physiological, in_orbit);
    only!(gelatin, gelatin_mut, physiological, physiological_mut -> Physiological, in_gelatin);
    only!(lossy, lossy_mut, projectile, projectile_mut -> Projectile, gives_way);

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
