//! An injury curve: the chance of an injury against one measure of the blow.
//!
//! Logistic, P = 1 / (1 + exp(-s (x/x50 - 1))), with x50 the published point of 50 % and s the slope
//! in units of x50. The regressions publish x50 but not s, so s is assumed and carries a range,
//! which is shown as a range of risk and drawn from by an ensemble.
//! Normal, P = Phi((x - mean)/sd), where tests to failure publish both.
//!
//! Left out: confidence limits of the published points themselves, which no source at hand gives.

use crate::normal;

/// An injury that a curve speaks of.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Injury {
    /// Loss of the cornea's outermost layer.
    CornealAbrasion,
    /// The lens torn off its zonule.
    LensDislocation,
    /// Blood in the anterior chamber.
    Hyphema,
    /// The wall of the globe torn through.
    GlobeRupture,
    /// Any damage of the retina.
    RetinalDamage,
}

impl Injury {
    /// All of them, from the front of the eye to its back.
    pub const ALL: [Self; 5] = [
        Self::CornealAbrasion,
        Self::LensDislocation,
        Self::Hyphema,
        Self::GlobeRupture,
        Self::RetinalDamage,
    ];

    /// Its name for people.
    pub fn name(self) -> &'static str {
        match self {
            Self::CornealAbrasion => "corneal abrasion",
            Self::LensDislocation => "lens dislocation",
            Self::Hyphema => "hyphema",
            Self::GlobeRupture => "globe rupture",
            Self::RetinalDamage => "retinal damage",
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

/// What a curve runs against.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Measure {
    /// Kinetic energy over the object's projected area, J/m^2 (the literature's kg/s^2).
    NormalizedEnergy,
    /// Kinetic energy, J.
    KineticEnergy,
    /// Peak pressure in the vitreous, Pa.
    Pressure,
}

impl Measure {
    /// Its name for people.
    pub fn name(self) -> &'static str {
        match self {
            Self::NormalizedEnergy => "normalized energy",
            Self::KineticEnergy => "kinetic energy",
            Self::Pressure => "peak pressure",
        }
    }

    /// Its name in JSON.
    pub fn key(self) -> &'static str {
        match self {
            Self::NormalizedEnergy => "normalized_energy",
            Self::KineticEnergy => "kinetic_energy",
            Self::Pressure => "peak_pressure",
        }
    }

    /// The unit that people read, and how many SI units it holds.
    pub fn unit(self) -> (&'static str, f64) {
        match self {
            Self::NormalizedEnergy => ("kJ/m2", 1e3),
            Self::KineticEnergy => ("J", 1.0),
            Self::Pressure => ("MPa", 1e6),
        }
    }
}

/// The assumed slope of a logistic curve: at 4.6 the risk of nothing is 1 %.
pub const ASSUMED_SLOPE: Slope = Slope {
    least: 3.0,
    usual: 4.6,
    most: 7.0,
};

/// The slope of a logistic curve in units of 1/x50, with the range it may have.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Slope {
    /// The flattest that data would still allow.
    pub least: f64,
    /// Taken for the figure shown.
    pub usual: f64,
    /// The steepest.
    pub most: f64,
}

/// The law of a curve; values in SI.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Form {
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
    },
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
    /// Of the measure itself, SI.
    Measure(f64, f64),
    /// Of the object's speed, m/s: the source gives no other.
    Speed(f64, f64),
    /// Not at hand: every value counts as outside.
    Unknown,
}

/// One published curve.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Curve {
    /// The injury whose risk it gives.
    pub injury: Injury,
    /// What the risk runs against.
    pub measure: Measure,
    /// Its law and parameters.
    pub form: Form,
    /// Authors, year, journal.
    pub source: &'static str,
    /// The species whose eyes were hit.
    pub species: &'static str,
    /// The data it rests on.
    pub range: Range,
    /// The range in words.
    pub data: &'static str,
    /// How well founded it is.
    pub standing: Standing,
    /// Anything a reader must know beside.
    pub remark: &'static str,
}

/// Below this share of its point of 50 % a curve of an assumed slope shows that slope only: its risk
/// of nothing is 1 %.
const LITTLE: f64 = 0.1;

impl Curve {
    /// Whether `value` lies where nothing but an assumed slope makes the risk.
    pub fn says_little(&self, value: f64) -> bool {
        matches!(self.form, Form::Logistic { half, .. } if value < LITTLE * half)
    }

    /// Risk at `value`, 0 to 1.
    pub fn risk(&self, value: f64) -> f64 {
        match self.form {
            Form::Logistic { slope, .. } => self.risk_with(value, slope.usual),
            Form::Normal { .. } => self.risk_with(value, 0.0),
        }
    }

    /// Risk at `value` if the slope were `slope`, in units of 1/x50; a normal curve has its own.
    pub fn risk_with(&self, value: f64, slope: f64) -> f64 {
        match self.form {
            Form::Logistic { half, .. } => 1.0 / (1.0 + (-slope * (value / half - 1.0)).exp()),
            Form::Normal { mean, sd } => normal::below((value - mean) / sd),
        }
    }

    /// Least and greatest risk at `value` over the range of slopes.
    pub fn band(&self, value: f64) -> (f64, f64) {
        match self.form {
            Form::Logistic { slope, .. } => {
                let ends = [slope.least, slope.most].map(|s| self.risk_with(value, s));
                (ends[0].min(ends[1]), ends[0].max(ends[1]))
            }
            Form::Normal { .. } => (self.risk(value), self.risk(value)),
        }
    }

    /// Where the risk is 50 %, SI.
    pub fn half(&self) -> f64 {
        match self.form {
            Form::Logistic { half, .. } => half,
            Form::Normal { mean, .. } => mean,
        }
    }
}
