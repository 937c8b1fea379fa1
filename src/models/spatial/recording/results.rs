//! What a run leaves: extremes over every step, and its balance of energy.

use crate::models::axisymmetric::recording::results as axisymmetric;
use crate::run::kept::Peak;
use crate::run::sectors::Sectors;
use nalgebra::Vector3;

/// Largest values over every step.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Extremes {
    /// What every eye of cells has, measures of tissues at their largest over the azimuth.
    pub common: axisymmetric::Extremes,
    /// Measures of tissues by clock hour.
    pub sectors: Sectors,
    /// Front angle and azimuth of the largest stretch near the equator, rad.
    pub equator_at: (f64, f64),
    /// Front angle and azimuth of the largest tension of the sclera, rad.
    pub stress_at: (f64, f64),
    /// Turn of the globe, rad.
    pub turn: Peak,
    /// Way of the globe's middle, m.
    pub way: Peak,
    /// That way when it was longest, m, in the eye's axes.
    pub way_then: Vector3<f64>,
    /// Impulse of the object on the eye, N s.
    pub impulse_on_eye: Vector3<f64>,
    /// Impulse of the object on bone, N s.
    pub impulse_on_bone: Vector3<f64>,
    /// Most energy that the object spent on bone, J.
    pub energy_at_bone: f64,
    /// Force of the globe on bone, N.
    pub globe_on_bone: Peak,
    /// Most of the cornea that the object touched at once, across its way, m2.
    pub cornea_touched: f64,
}

/// That of one run, with the angular momentum about the middle of the globe at rest, kg m2/s.
pub type EngineRun = axisymmetric::EngineRun<Extremes, [Vector3<f64>; 2]>;
