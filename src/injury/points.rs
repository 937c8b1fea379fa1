//! How the points of 50 % of kinds of object hang together, and the way in of small hard objects.
//!
//! How far a kind's point lies from that of all, b_j, has the covariance kappa_j^2 (s exp(-d^2/2) +
//! (1 - s) exp(-d^2/(2 n^2))) over kinds that are d apart: a share s that neighbours have in common,
//! the rest a kind's own, which two objects share only where they are nearly the same (n). So a
//! squash ball tells of a racquetball and little of a BB, and nothing jumps.

use crate::injury::object_kind::{Features, KINDS, apart_squared};
use crate::scenario::{Projectile, Scenario, Surface, direction::GLOBE_MM};
use libm::{asin, cos, exp, log10};
use nalgebra::DMatrix;
use std::f64::consts::FRAC_PI_4;

/// How kinds hang together.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Covariance {
    /// What neighbours have in common.
    pub shared: f64,
    /// How far apart two objects may be to be the same kind.
    pub near: f64,
}

impl Covariance {
    /// Of two objects, over kappa squared.
    pub fn of(&self, a: &Features, b: &Features) -> f64 {
        let d2 = apart_squared(a, b);
        let own = exp(-0.5 * d2 / (self.near * self.near));
        self.shared * exp(-0.5 * d2) + (1.0 - self.shared) * own
    }

    /// Of all kinds.
    pub fn over_kinds(&self) -> DMatrix<f64> {
        let features: Vec<Features> = KINDS.iter().map(|kind| kind.features()).collect();
        DMatrix::from_fn(KINDS.len(), KINDS.len(), |a, b| self.of(&features[a], &features[b]))
    }
}

/// Energy over area along the normal of its surface at which half of all eyes let a small hard
/// object in, J/m2, and the spread of log10 of it (Marshall 2011, pigs: 43 to 48 kJ/m2).
const ENTERS: f64 = 45e3;
pub const ENTERS_SPREAD: f64 = 0.12;
/// Widest of the objects that went in, in mm.
const ENTERS_MM: f64 = 11.2;

/// log10 of the energy over area of a hard object so small that it may go in, at 1 m/s, J/m2.
pub fn enters_at_1_m_s(scenario: &Scenario) -> Option<f64> {
    let object = scenario.projectile()?;
    let hard = object.surface == Surface::Hard && object.diameter_mm <= ENTERS_MM;
    hard.then(|| log10(0.5 * object.mass_kg() / area(object)))
}

fn area(object: &Projectile) -> f64 {
    FRAC_PI_4 * object.diameter_m() * object.diameter_m()
}

/// How many spreads log10 of its energy over area, of an object that comes so, lies beyond where
/// half go in; a direction is its angle in degrees, an hour, its offset in mm and an hour.
pub fn enters_z(log_energy: f64, [angle_deg, _, offset_mm, _]: [f64; 4]) -> f64 {
    let beside = asin((offset_mm / GLOBE_MM).min(1.0));
    let along = cos(angle_deg.to_radians() + beside).max(0.01);
    (log_energy + 2.0 * log10(along) - log10(ENTERS)) / ENTERS_SPREAD
}
