//! What tissues felt of the objects that donors' and animals' eyes were hit with, at the published
//! energies of 50 %: the laboratory's points, which the fit to clinics begins from.
//!
//! `contrecoup verify fit laboratory` finds them again: `half` is the mean of the measure over
//! kinds of object and published energies, `known` how much kinds and published figures disagree in
//! log10, `eyes` the spread of the published curve times the slope of log10 of the measure over
//! that of energy.

use crate::injury::kind::{Injury, PerInjury};

/// The curve of one injury against its measure.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TissueCurve {
    /// Value of the measure where the risk is 50 %, SI.
    pub half: f64,
    /// How much eyes differ: a standard deviation in log10 of the measure.
    pub eyes: f64,
    /// How far the curve is known: a standard deviation in log10 of the measure.
    pub known: f64,
    /// Share by which the measure may differ on another mesh than that of the fit.
    pub mesh_unknown: f64,
    /// Share by which a small object straight on makes it differ from one at 5 degrees, which is
    /// computed in three dimensions: a mean over eleven presets.
    pub section_unknown: f64,
    /// What the curve was matched to.
    pub matched: &'static str,
}

impl Injury {
    /// Its curve.
    pub fn curve(self) -> &'static TissueCurve {
        &CURVES[self as usize]
    }
}

/// A curve by its numbers, in the order of their fields.
const fn curve(
    [half, eyes, known, mesh_unknown, section_unknown]: [f64; 5],
    matched: &'static str,
) -> TissueCurve {
    TissueCurve { half, eyes, known, mesh_unknown, section_unknown, matched }
}

static CURVES: PerInjury<TissueCurve> = [
    curve([0.0568, 0.141, 0.107, 0.30, 0.11], "34.2 to 35.8 kJ/m2, human eyes in gelatin"),
    curve([0.0358, 0.080, 0.082, 0.30, 0.14], "30.4 kJ/m2, human and pig eyes; thin data"),
    curve(
        [0.130, 0.042, 0.150, 0.30, 0.05],
        "10 % at 1.2 J with blunt metal of 2.6 to 45.5 g, 16 pig eyes; very thin data",
    ),
    curve([1.66e-3, 0.068, 0.134, 0.60, 0.31], "19.2 and 21.7 kJ/m2, human and pig eyes"),
    curve([2.15e-3, 0.103, 0.173, 0.50, 0.38], "12.7 and 20.2 kJ/m2, human and pig eyes"),
    curve([2180.0, 0.135, 0.272, 0.30, 0.13], "1.50 kJ/m2, foam beside metal"),
];
