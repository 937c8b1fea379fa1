//! The published curves that the program knows.
//!
//! Each is kept as its source gives it: its measure, its species, its data. None is averaged with
//! another, and where two of one injury disagree, both are shown.
//!
//! Left out: limits of strain, and limits of the force on synthetic eyes, which are not forces on
//! a human one.

use crate::injury::curve::{
    ASSUMED_SLOPE, CurveForm, Eyes, Injury, InjuryCurve, Measure, Range, Slope, Standing,
};

const DUMA: &str = "Duma 2005, J Trauma 59:960";
const PROJECTILES: &str = "BBs, metal rods and foam at 2 to 122 m/s";

const fn logistic(half: f64) -> CurveForm {
    CurveForm::Logistic {
        half,
        slope: ASSUMED_SLOPE,
    }
}

/// A curve against normalized energy by Duma and others, who pooled published tests.
const fn pooled(injury: Injury, half: f64, remark: &'static str) -> InjuryCurve {
    InjuryCurve {
        injury,
        measure: Measure::NormalizedEnergy,
        form: logistic(half),
        source: DUMA,
        species: Eyes::Pooled,
        range: Range::Speed(2.0, 122.0),
        data: PROJECTILES,
        standing: Standing::SlopeAssumed,
        remark,
    }
}

/// Two points of risk that were stated for water streams (3,156 and 7,006 mmHg) fix a logistic
/// curve. Pressure was measured in eight pigs' eyes in 38 tests; the risks were computed from it,
/// and that of rupture was 0 % throughout.
const fn water_stream(injury: Injury, half: f64, slope: f64, remark: &'static str) -> InjuryCurve {
    InjuryCurve {
        injury,
        measure: Measure::Pressure,
        form: CurveForm::Logistic {
            half,
            // The lower risks are rounded; +-15 % of the slope covers that.
            slope: Slope {
                least: 0.85 * slope,
                usual: slope,
                most: 1.15 * slope,
            },
        },
        source: "Duma 2012, Curr Eye Res 37:279 (water streams)",
        species: Eyes::Pig,
        range: Range::Measure(0.4208e6, 0.9341e6),
        data: "eight pigs' eyes, 38 tests at 0.42 to 0.93 MPa; rupture 0 % throughout",
        standing: Standing::Reconstructed,
        remark,
    }
}

/// Every curve, the gravest injury first.
pub static CURVES: &[InjuryCurve] = &[
    pooled(Injury::GlobeRupture, 23_771.0, ""),
    InjuryCurve {
        source: "Kennedy 2006, Stapp Car Crash J 50",
        species: Eyes::Human,
        standing: Standing::Unverified,
        range: Range::Unknown,
        data: "human eyes; range not at hand, so that all counts as extrapolated",
        ..pooled(
            Injury::GlobeRupture,
            35_519.0,
            "figure from memory, not confirmed",
        )
    },
    InjuryCurve {
        injury: Injury::GlobeRupture,
        measure: Measure::Pressure,
        form: CurveForm::Normal {
            mean: 0.93e6,
            sd: 0.29e6,
            tests: 20,
        },
        source: "PMC3217427; Bisplinghoff 2009, Arch Ophthalmol 127:520",
        species: Eyes::Human,
        range: Range::Measure(0.35e6, 1.51e6),
        data: "20 eyes burst from inside, slow tests among them; mean +- 2 SD",
        standing: Standing::Published,
        remark: "fast means 0.91 and 0.97, 50 % at 0.90 MPa",
    },
    InjuryCurve {
        injury: Injury::GlobeRupture,
        measure: Measure::Pressure,
        form: CurveForm::Normal {
            mean: 1.64e6,
            sd: 0.32e6,
            // Of 20 eyes: how many burst fast and how many slowly (at 1.00 MPa) is not at hand.
            tests: 10,
        },
        source: "PMC3217427, pigs' eyes",
        species: Eyes::Pig,
        range: Range::Measure(1.0e6, 2.28e6),
        data: "fast tests of 20 eyes burst from inside, taken as half of them; mean +- 2 SD",
        standing: Standing::Published,
        remark: "50 % at 1.66 MPa; slow tests 1.00 +- 0.18 MPa",
    },
    InjuryCurve {
        source: "Weaver 2011, J Biomech Eng 133:031002",
        measure: Measure::Stress,
        range: Range::Measure(0.0, 30.18e6),
        data: "79 blows by 8 kinds of object, computed; to 30 MPa, the most at a burst",
        ..pooled(
            Injury::GlobeRupture,
            17.21e6,
            "the limit that told burst from whole best; no spread is published",
        )
    },
    pooled(
        Injury::RetinalDamage,
        30_351.0,
        "little data: above the point for rupture",
    ),
    water_stream(
        Injury::RetinalDamage,
        1.425e6,
        9.80,
        "0.1 % at 0.42 MPa, 3.3 % at 0.93 MPa",
    ),
    pooled(Injury::LensDislocation, 19_194.0, ""),
    pooled(Injury::Hyphema, 20_188.0, ""),
    water_stream(
        Injury::Hyphema,
        1.163e6,
        4.82,
        "4.4 % at 0.42 MPa, 27.8 % at 0.93 MPa",
    ),
    pooled(Injury::CornealAbrasion, 1_503.0, ""),
    InjuryCurve {
        injury: Injury::CornealAbrasion,
        measure: Measure::KineticEnergy,
        form: logistic(0.183),
        source: "Duma and Crandall 2000, J Trauma 48:786",
        species: Eyes::Pig,
        range: Range::Measure(0.0, 0.366),
        data: "foam of airbag covers; range taken as up to twice the 50 % point",
        standing: Standing::SlopeAssumed,
        remark: "measured with light foam",
    },
];

#[cfg(test)]
mod tests {
    use super::*;

    fn curve(injury: Injury, measure: Measure) -> &'static InjuryCurve {
        CURVES
            .iter()
            .find(|c| c.injury == injury && c.measure == measure)
            .unwrap()
    }

    #[test]
    fn every_curve_gives_one_half_at_its_published_point_and_rises() {
        for curve in CURVES {
            assert!((curve.risk(curve.half()) - 0.5).abs() < 1e-12);
            let mut before = curve.risk(0.0);
            for i in 1..=20 {
                let risk = curve.risk(curve.half() * f64::from(i) * 0.1);
                assert!(risk > before && risk <= 1.0);
                before = risk;
            }
        }
    }

    #[test]
    fn pressure_curves_pass_through_the_risks_that_were_published() {
        for (injury, pressure, risk) in [
            (Injury::Hyphema, 0.4208e6, 0.044),
            (Injury::Hyphema, 0.9341e6, 0.278),
            (Injury::RetinalDamage, 0.4208e6, 0.001),
            (Injury::RetinalDamage, 0.9341e6, 0.033),
        ] {
            let found = curve(injury, Measure::Pressure).risk(pressure);
            assert!((found / risk - 1.0).abs() < 0.05, "{injury:?}: {found}");
        }
        let rupture = curve(Injury::GlobeRupture, Measure::Pressure);
        assert!((rupture.risk(1.22e6) - 0.841_34).abs() < 1e-4);
        let of_pigs = |c: &&InjuryCurve| (c.injury, c.species) == (Injury::GlobeRupture, Eyes::Pig);
        let pigs = CURVES.iter().find(of_pigs).unwrap();
        assert!((pigs.risk(1.96e6) - 0.841_34).abs() < 1e-4);
        assert!(
            pigs.half() / rupture.half() > 1.7,
            "a pig's globe bears more"
        );
    }

    #[test]
    fn a_slope_that_is_assumed_shows_as_a_band_around_the_risk() {
        let lens = curve(Injury::LensDislocation, Measure::NormalizedEnergy);
        assert!((lens.risk(0.0) - 0.01).abs() < 1e-3);
        for value in [5e3, 3e4] {
            let (low, high) = lens.band(value);
            assert!(low < lens.risk(value) && lens.risk(value) < high);
        }
    }
}
