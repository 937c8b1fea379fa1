//! Published curves of risk in laboratories against normalized energy: kinetic energy over the area
//! pi d^2/4.
//!
//! Weibull, R = 1 - exp(-ln 2 (x/x50)^k): no energy, no risk. The abstract 2394472 gives the risks
//! at two energies, which fix x50 and k (a logistic through the same points has its 50 % at 34.2,
//! 21.2 and 12.7 kJ/m2, but a risk of 1 to 6 % of nothing). The regressions of Duma 2005 publish
//! their 50 % alone: their slope is assumed, k = 3.3, as steep at 50 % as a logistic whose risk of
//! nothing is 1 %.
//!
//! Left out: predicted risks against pressure of water, and limits of force on synthetic eyes.

use crate::injury::kind::Injury;
use libm::{expm1, pow};

/// A published curve.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct EnergyCurve {
    /// The injury whose risk it gives.
    pub injury: Injury,
    /// Where the risk is 50 %, J/m2.
    pub half: f64,
    /// Its exponent k.
    pub steepness: f64,
    /// Whether that was published; it is assumed otherwise.
    pub slope_known: bool,
    /// Authors, year, journal.
    pub source: &'static str,
    /// Whose eyes were hit, and with what.
    pub data: &'static str,
}

/// The exponent where no slope is published.
const ASSUMED: f64 = 3.3;

/// A curve of the abstract, which publishes its slope, or else of Duma, whose is assumed.
const fn curve(injury: Injury, half: f64, slope: Option<f64>) -> EnergyCurve {
    let (steepness, source, data) = match slope {
        Some(slope) => (
            slope,
            "Invest Ophthalmol Vis Sci, meeting abstract 2394472",
            "13 human and 13 pig eyes, 6 mm airsoft at 19 and 26 kJ/m2",
        ),
        None => (
            ASSUMED,
            "Duma 2005, J Trauma 59:960",
            "species pooled; BBs, metal rods and foam at 2 to 122 m/s",
        ),
    };
    EnergyCurve { injury, half, steepness, slope_known: slope.is_some(), source, data }
}

/// Every curve.
pub static CURVES: &[EnergyCurve] = &[
    curve(Injury::GlobeRupture, 35_784.0, Some(2.596)),
    curve(Injury::GlobeRupture, 23_771.0, None),
    curve(Injury::RetinaBack, 30_351.0, None),
    curve(Injury::RetinaFront, 30_351.0, None),
    curve(Injury::LensDislocation, 21_672.0, Some(7.221)),
    curve(Injury::LensDislocation, 19_194.0, None),
    curve(Injury::Hyphema, 12_682.0, Some(1.952)),
    curve(Injury::Hyphema, 20_188.0, None),
    curve(Injury::CornealAbrasion, 1_503.0, None),
];

impl EnergyCurve {
    /// The curves of an injury.
    pub fn of(injury: Injury) -> impl Iterator<Item = &'static Self> {
        CURVES.iter().filter(move |curve| curve.injury == injury)
    }

    /// The risk at a normalized energy, J/m2.
    pub fn risk(&self, energy: f64) -> f64 {
        -expm1(-std::f64::consts::LN_2 * pow(energy / self.half, self.steepness))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn curves_pass_through_what_was_published_nothing_at_no_energy_and_half_at_their_50_percent() {
        for (injury, at_19, at_26) in [
            (Injury::GlobeRupture, 0.127, 0.27),
            (Injury::LensDislocation, 0.243, 0.943),
            (Injury::Hyphema, 0.786, 0.945),
        ] {
            let curve = EnergyCurve::of(injury).next().unwrap();
            let found = [19.1e3, 26.4e3].map(|energy| curve.risk(energy));
            assert!((found[0] - at_19).abs() < 2e-3, "{injury:?} {found:?}");
            assert!((found[1] - at_26).abs() < 2e-3, "{injury:?} {found:?}");
        }
        for curve in CURVES {
            assert_eq!(curve.risk(0.0), 0.0);
            assert!((curve.risk(curve.half) - 0.5).abs() < 1e-12);
        }
    }
}
