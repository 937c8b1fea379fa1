//! How much of the eye a scene needs, and so which eye computes it.
//!
//! Straight on, a half section turned about its axis is the whole. A blow from the side on a round
//! support has one mirror plane, so half of the eye in three dimensions is the whole; a measured
//! orbit has none. An object wide enough to meet bone meets the measured one from every side.

use crate::scenario::direction::{STEEPEST_OBJECT_DEG, upper};
use crate::scenario::{FINEST_LEVEL, FINEST_PHYSIOLOGICAL_LEVEL, Impact, Model, Projectile};
use crate::scenario::{Scenario, Support, TRUSTED_ANGLE_DEG};
use serde::{Deserialize, Serialize};
use strum::IntoStaticStr;

/// How much of the eye is computed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, IntoStaticStr)]
pub enum Geometry {
    /// As much as the scene needs.
    #[default]
    Auto,
    /// A half section about the line of the blow.
    Axisymmetric,
    /// The half of the eye beside the plane of the blow, in three dimensions.
    Half,
    /// All of it, in three dimensions.
    Full,
}

impl Geometry {
    /// Whether it is one in three dimensions.
    pub fn is_spatial(self) -> bool {
        matches!(self, Self::Half | Self::Full)
    }
}

/// Diameter up to which an object straight on meets no bone in any orbit that was measured, in mm.
const CLEARS_BONE_MM: f64 = 32.0;

/// The finest level of the eye in three dimensions.
pub const FINEST_SPATIAL_LEVEL: u32 = 3;

impl Projectile {
    /// Whether its path and what it aims at lie in one plane with the eye's axis.
    fn has_mirror_plane(&self) -> bool {
        let apart = (self.angle_clock - self.offset_clock).rem_euclid(6.0);
        self.angle_deg == 0.0 || self.offset_mm == 0.0 || apart == 0.0
    }
}

impl Scenario {
    /// Whether the eye is one in three dimensions.
    pub fn is_spatial(&self) -> bool {
        self.geometry().is_some_and(Geometry::is_spatial)
    }

    /// How much of the eye the scene needs, or is told to compute; none of the Paper model.
    pub fn geometry(&self) -> Option<Geometry> {
        let model = self.physiological()?;
        if self.numerics.geometry != Geometry::Auto {
            return Some(self.numerics.geometry);
        }
        let Some(projectile) = self.projectile() else { return Some(Geometry::Axisymmetric) };
        let meets_bone = model.support == Support::Orbit && projectile.diameter_mm > CLEARS_BONE_MM;
        Some(if projectile.is_straight_on() && !meets_bone {
            Geometry::Axisymmetric
        } else if model.support != Support::Orbit && projectile.has_mirror_plane() {
            Geometry::Half
        } else {
            Geometry::Full
        })
    }

    /// The greatest angle of a blow, in degrees: bone shields the paper's eye beyond its opening.
    pub fn steepest_deg(&self) -> f64 {
        match (&self.model, &self.impact) {
            (Model::Paper, _) => self.eye.opening_deg,
            (_, Impact::ForcePulse(_)) => 90.0,
            (_, Impact::Projectile(_)) => STEEPEST_OBJECT_DEG,
        }
    }

    /// The angle of a blow up to which the eye that is computed can be trusted, in degrees.
    pub fn trusted_angle_deg(&self) -> Option<f64> {
        let turned = self.numerics.geometry == Geometry::Axisymmetric || self.pulse().is_some();
        self.geometry().map(|_| if turned { TRUSTED_ANGLE_DEG } else { STEEPEST_OBJECT_DEG })
    }

    /// Whether an object comes from what lies at the top of a section along its path, where it is
    /// drawn above the eye's axis; its angle is shown below 0 where not.
    pub fn comes_from_top(&self) -> bool {
        let Some(object) = self.projectile() else { return true };
        let azimuth = self.eye_side().azimuth(object.angle_clock);
        self.numerics.geometry == Geometry::Axisymmetric || upper(azimuth) == azimuth
    }

    /// The eye in words, where the blow comes from, and how much of it is computed.
    pub fn description(&self) -> String {
        let mut words = self.model.description();
        if let Some(object) = self.projectile()
            && let Some(direction) = object.direction(self.eye_side())
        {
            words.extend(["; ", &direction]);
        }
        let much = match self.geometry() {
            Some(Geometry::Half) => "half",
            Some(Geometry::Full) => "all",
            _ => return words,
        };
        let (side, ..) = self.eye_side().seen();
        words + &format!("; a {side} eye, {much} of it in three dimensions")
    }

    /// The finest level of the mesh that it may be computed with.
    pub fn finest_level(&self) -> u32 {
        match self.geometry() {
            None => FINEST_LEVEL,
            Some(Geometry::Half | Geometry::Full) => FINEST_SPATIAL_LEVEL,
            Some(_) => FINEST_PHYSIOLOGICAL_LEVEL,
        }
    }

    /// Why the geometry that is asked for cannot be had, and what could.
    pub(super) fn geometry_unfit(&self) -> Option<(&'static str, &'static str)> {
        let (Some(model), Some(projectile)) = (self.physiological(), self.projectile()) else {
            let spatial = self.numerics.geometry.is_spatial();
            return spatial.then_some(("takes objects only", "Auto, Axisymmetric"));
        };
        match self.numerics.geometry {
            Geometry::Half if model.support == Support::Orbit => {
                Some(("has a mirror plane, which an orbit has not", "Auto, Axisymmetric, Full"))
            }
            Geometry::Half if !projectile.has_mirror_plane() => Some((
                "has a mirror plane, which angle_clock and offset_clock here have not",
                "Auto, Full",
            )),
            Geometry::Axisymmetric if projectile.offset_mm != 0.0 => {
                Some(("takes no blow beside the centre", "Auto, Half, Full"))
            }
            _ => None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scenario::library::tests::preset;

    fn of(name: &str, changes: &[(&str, &str)]) -> Option<Geometry> {
        preset(name, changes).geometry()
    }

    #[test]
    fn a_scene_gets_as_much_of_the_eye_as_it_needs() {
        let angle = ("impact.angle_deg", "30");
        let gelatin = ("model.support", "Gelatin");
        let aside = [("impact.offset_mm", "4"), ("impact.offset_clock", "3")];
        assert_eq!(of("paper-300n", &[]), None);
        assert_eq!(of("bb-62", &[]), Some(Geometry::Axisymmetric));
        assert_eq!(of("bb-62", &[angle]), Some(Geometry::Full));
        assert_eq!(of("bb-62", &[angle, gelatin]), Some(Geometry::Half));
        let both = [angle, gelatin, aside[0], aside[1]];
        assert_eq!(of("bb-62", &both), Some(Geometry::Full));
        assert_eq!(of("bb-62", &both[1..]), Some(Geometry::Half));
        assert_eq!(of("squash-ball", &[]), Some(Geometry::Full));
        assert_eq!(of("squash-ball", &[gelatin]), Some(Geometry::Axisymmetric));
        assert_eq!(of("champagne-cork", &[]), Some(Geometry::Axisymmetric));
        let round = ("numerics.geometry", "Axisymmetric");
        assert_eq!(of("squash-ball", &[round]), Some(Geometry::Axisymmetric));
    }

    #[test]
    fn what_has_no_mirror_plane_is_not_halved() {
        let half = ("numerics.geometry", "Half");
        let told = preset("bb-62", &[half]).check().unwrap_err().to_string();
        assert!(told.contains("numerics.geometry") && told.contains("Full"), "{told}");
        let free = preset("bb-62", &[half, ("model.support", "Free")]);
        assert!(free.check().is_ok());
    }
}
