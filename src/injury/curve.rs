//! An injury curve: the chance of an injury against one measure of the blow.
//!
//! Logistic, P = 1 / (1 + exp(-s (x/x50 - 1))), with x50 the published point of 50 % and s the
//! slope in units of x50. The regressions publish x50 but not s, so s is assumed and carries a
//! range, which is shown as a range of risk and drawn from by an ensemble. No confidence limits of
//! those x50 are at hand either: published points of one injury lie up to 20 % from their middle
//! (rupture at 23.8 and 35.5 kJ/m2, at 0.90 and 1.01 `MPa`), so [`POINT`] to both sides counts as
//! range. Normal, P = Phi((x - mean)/sd), where tests to failure publish both; its range is that
//! of the mean, 1.96 sd / sqrt(n) to both sides.

use crate::normal;

/// An injury that a curve speaks of.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Injury {
    /// The wall of the globe torn through.
    GlobeRupture,
    /// Any damage of the retina.
    RetinalDamage,
    /// The lens torn off its zonule.
    LensDislocation,
    /// Blood in the anterior chamber.
    Hyphema,
    /// Loss of the cornea's outermost layer.
    CornealAbrasion,
}

impl Injury {
    /// All of them, the gravest first.
    pub const ALL: [Self; 5] = [
        Self::GlobeRupture,
        Self::RetinalDamage,
        Self::LensDislocation,
        Self::Hyphema,
        Self::CornealAbrasion,
    ];

    /// The name for people.
    pub const fn name(self) -> &'static str {
        match self {
            Self::CornealAbrasion => "corneal abrasion",
            Self::LensDislocation => "lens dislocation",
            Self::Hyphema => "hyphema",
            Self::GlobeRupture => "globe rupture",
            Self::RetinalDamage => "retinal damage",
        }
    }

    /// Its name where there is room for one short word.
    pub fn word(self) -> &'static str {
        match self {
            Self::CornealAbrasion => "abrasion",
            Self::LensDislocation => "lens",
            Self::Hyphema => "hyphema",
            Self::GlobeRupture => "rupture",
            Self::RetinalDamage => "retina",
        }
    }

    /// Its name in JSON.
    pub fn key(self) -> &'static str {
        match self {
            Self::CornealAbrasion => "corneal_abrasion",
            Self::LensDislocation => "lens_dislocation",
            Self::Hyphema => "hyphema",
            Self::GlobeRupture => "globe_rupture",
            Self::RetinalDamage => "retinal_damage",
        }
    }
}

/// The measure of a blow that a curve gives the risk for.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Measure {
    /// Kinetic energy over the object's projected area, J/m^2 (the literature's kg/s^2).
    NormalizedEnergy,
    /// Kinetic energy, J.
    KineticEnergy,
    /// Peak pressure in the vitreous, Pa.
    Pressure,
    /// Peak tension of the sclera, Pa.
    Stress,
}

impl Measure {
    /// The name for people.
    pub fn name(self) -> &'static str {
        match self {
            Self::NormalizedEnergy => "normalized energy",
            Self::KineticEnergy => "kinetic energy",
            Self::Pressure => "peak pressure",
            Self::Stress => "scleral stress",
        }
    }

    /// Its name within a sentence.
    pub fn short(self) -> &'static str {
        match self {
            Self::NormalizedEnergy | Self::KineticEnergy => "energy",
            Self::Pressure => "pressure",
            Self::Stress => "scleral stress",
        }
    }

    /// Its name in JSON.
    pub fn key(self) -> &'static str {
        match self {
            Self::NormalizedEnergy => "normalized_energy",
            Self::KineticEnergy => "kinetic_energy",
            Self::Pressure => "peak_pressure",
            Self::Stress => "scleral_stress",
        }
    }

    /// The unit for people, and its size in SI units.
    pub fn unit(self) -> (&'static str, f64) {
        match self {
            Self::NormalizedEnergy => ("kJ/m2", 1e3),
            Self::KineticEnergy => ("J", 1.0),
            Self::Pressure | Self::Stress => ("MPa", 1e6),
        }
    }
}

/// The assumed slope of a logistic curve: at 4.6 the risk of nothing is 1 %.
pub const ASSUMED_SLOPE: Slope = Slope {
    least: 3.0,
    usual: 4.6,
    most: 7.0,
};

/// By this share the published point of 50 % of a curve of an assumed slope may be off.
const POINT: f64 = 0.15;

/// The slope of a logistic curve in units of 1/x50, with the range it may have.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Slope {
    /// The flattest that data would still allow.
    pub least: f64,
    /// The slope behind the risk that is shown.
    pub usual: f64,
    /// The steepest.
    pub most: f64,
}

/// The law of a curve; values in SI.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum CurveForm {
    /// Logistic through 50 % at `half`.
    Logistic {
        /// Where the risk is 50 %.
        half: f64,
        /// How steep.
        slope: Slope,
    },
    /// Cumulative normal.
    Normal {
        /// Where the risk is 50 %.
        mean: f64,
        /// Standard deviation.
        sd: f64,
        /// How many were tested.
        tests: u32,
    },
}

/// Standard errors of a mean to each side of it that hold 95 % of what it may be.
const STANDARD_ERRORS: f64 = 1.96;

/// Whose eyes were tested.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Eyes {
    /// Donated human eyes.
    Human,
    /// Pigs' eyes, whose globes bear 1.8 times the pressure.
    Pig,
    /// Several species in one regression.
    Pooled,
}

impl Eyes {
    /// In words.
    pub fn name(self) -> &'static str {
        match self {
            Self::Human => "human",
            Self::Pig => "pig",
            Self::Pooled => "pooled, species not told apart",
        }
    }
}

/// How well founded a curve is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Standing {
    /// Its points and its slope are published.
    Published,
    /// Its point of 50 % is published; its slope is assumed.
    SlopeAssumed,
    /// Derived here from two published points of risk.
    Reconstructed,
    /// Cited from memory: no source at hand confirms the figure.
    Unverified,
}

impl Standing {
    /// In words.
    pub fn name(self) -> &'static str {
        match self {
            Self::Published => "published",
            Self::SlopeAssumed => "slope assumed",
            Self::Reconstructed => "reconstructed",
            Self::Unverified => "unverified, slope assumed",
        }
    }
}

/// The range of its data, beyond which a curve extrapolates.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Range {
    /// Least and greatest value of the measure, in SI.
    Measure(f64, f64),
    /// Least and greatest speed of the object, in m/s: the source gives nothing else.
    Speed(f64, f64),
    /// Not known: every value counts as outside.
    Unknown,
}

/// One published curve.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct InjuryCurve {
    /// The injury whose risk it gives.
    pub injury: Injury,
    /// The measure that the risk is given for.
    pub measure: Measure,
    /// Its law and parameters.
    pub form: CurveForm,
    /// Authors, year, journal.
    pub source: &'static str,
    /// The species whose eyes were hit.
    pub species: Eyes,
    /// The data it rests on.
    pub range: Range,
    /// The range in words.
    pub data: &'static str,
    /// How well founded it is.
    pub standing: Standing,
    /// A remark for the reader; empty where there is none.
    pub remark: &'static str,
}

impl InjuryCurve {
    /// Risk at `value`, 0 to 1.
    pub fn risk(&self, value: f64) -> f64 {
        match self.form {
            CurveForm::Logistic { slope, .. } => self.risk_with(value, slope.usual),
            CurveForm::Normal { .. } => self.risk_with(value, 0.0),
        }
    }

    /// Risk at `value` if the slope were `slope`, in units of 1/x50; a normal curve has its own.
    pub fn risk_with(&self, value: f64, slope: f64) -> f64 {
        match self.form {
            CurveForm::Logistic { half, .. } => {
                1.0 / (1.0 + libm::exp(-slope * (value / half - 1.0)))
            }
            CurveForm::Normal { mean, sd, .. } => normal::below((value - mean) / sd),
        }
    }

    /// What a risk would be if the slope were `slope`, in units of 1/x50; a normal curve has its
    /// own.
    pub fn with_slope(&self, risk: f64, slope: f64) -> f64 {
        match self.form {
            CurveForm::Logistic { slope: own, .. } => {
                let steps = libm::log(risk / (1.0 - risk)) * slope / own.usual;
                1.0 / (1.0 + libm::exp(-steps))
            }
            CurveForm::Normal { .. } => risk,
        }
    }

    /// Least and greatest risk at `value` over the range of slopes, or of the mean.
    pub fn band(&self, value: f64) -> (f64, f64) {
        match self.form {
            CurveForm::Logistic { slope, .. } => {
                let point = match self.standing {
                    Standing::SlopeAssumed | Standing::Unverified => POINT,
                    Standing::Published | Standing::Reconstructed => 0.0,
                };
                let risks = |share: f64| {
                    [slope.least, slope.most].map(|s| self.risk_with(value / share, s))
                };
                let (low, high) = (risks(1.0 + point), risks(1.0 - point));
                (low[0].min(low[1]), high[0].max(high[1]))
            }
            CurveForm::Normal { sd, tests, .. } => {
                let off = STANDARD_ERRORS * sd / f64::from(tests).sqrt();
                (self.risk(value - off), self.risk(value + off))
            }
        }
    }

    /// Where the risk is 50 %, SI.
    pub fn half(&self) -> f64 {
        match self.form {
            CurveForm::Logistic { half, .. } => half,
            CurveForm::Normal { mean, .. } => mean,
        }
    }
}
