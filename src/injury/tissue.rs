//! Risk of an injury by what its own tissue felt: curves carried over by simulation.
//!
//! The objects behind the published energy curves were run at the energy of 50 % (`contrecoup
//! verify fit` does it again), and what the tissue felt there is `half`. With m the measure, the
//! risk is Phi(log10(m/half)/hypot(eyes, known)):
//!
//! * `eyes` says how much eyes differ: the spread of the published curve in log10 of energy, times
//!   the slope of log10 m over it.
//! * `known` says how far the curve itself is known: how much the kinds of object disagree at equal
//!   energy, and how far published figures do.
//!
//! What a single blow does not tell apart, eyes, gives a probability; what is not known, the curve,
//! the errors and the inputs, gives its range.

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
    /// The same of the published energy of 50 %, where that curve counts: in its log10.
    pub energy_known: f64,
    /// Where the data end: the largest of the kinds at 100 kJ/m2, SI.
    pub end: f64,
    /// Share by which the measure may be off where finer meshes tell no limit: what two may differ.
    pub mesh_unknown: f64,
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
    [half, eyes, known, energy_known, end, mesh_unknown]: [f64; 6],
    matched: &'static str,
) -> TissueCurve {
    TissueCurve { half, eyes, known, energy_known, end, mesh_unknown, matched }
}

static CURVES: PerInjury<TissueCurve> = [
    curve([0.0568, 0.141, 0.107, 0.05, 0.153, 0.30], "34.2 to 35.8 kJ/m2, human eyes in gelatin"),
    curve([0.0358, 0.080, 0.082, 0.10, 0.131, 0.30], "30.4 kJ/m2, human and pig eyes; thin data"),
    curve(
        [0.130, 0.042, 0.150, 0.10, 0.143, 0.30],
        "10 % at 1.2 J with blunt metal of 2.6 to 45.5 g, 16 pig eyes; very thin data",
    ),
    curve([1.66e-3, 0.068, 0.134, 0.05, 5.62e-3, 0.60], "19.2 and 21.7 kJ/m2, human and pig eyes"),
    curve([2.15e-3, 0.103, 0.173, 0.10, 9.10e-3, 0.50], "12.7 and 20.2 kJ/m2, human and pig eyes"),
    curve([2180.0, 0.135, 0.272, 0.10, 1.02e5, 0.30], "1.50 kJ/m2, foam beside metal"),
];
