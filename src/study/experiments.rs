//! Published experiments as scenarios, with what was measured and what is read from the run.
//!
//! The plane model takes a ball for a disc, that is, for a rod of the eye's depth: it engages more
//! of the eye than the ball did. The mass and face of the impactor in the orbit are not published;
//! a heavy disc of 20 mm is taken, so that its speed hardly changes.
//!
//! Pressure in the pig's eye is taken as pressure in the human one (species factor 1: it is a load,
//! and the two eyes are of like size). Strength is not: a pig's globe bursts at 1.8 times the
//! pressure of a human one (1.64 against 0.91), so bursting is compared with the limit of the
//! species that was shot at.

use crate::scenario::{Impact, Model, Physiological, Projectile, Scenario};

/// What is read from a run to be compared.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Reading {
    /// Contact force when the object has pushed the front of the eye in by so much, in m: N.
    ForceAtTravel(f64),
    /// Peak pressure in the vitreous, Pa.
    PeakPressure,
    /// The vitreous area that is farthest from that at rest, as a share of it.
    FarthestArea,
    /// Largest displacement of the corneal apex, m.
    Apex,
    /// Largest shortening from front to back, as a share of the diameter.
    Shortening,
    /// Largest growth of the vertical diameter, as a share of it.
    Widening,
    /// When that growth is largest, s.
    TimeOfWidening,
}

/// What was measured, SI.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Band {
    /// A mean with its spread.
    Spread(f64, f64),
    /// A single value without a spread; a share of it is allowed on both sides.
    Single(f64, f64),
    /// Between two values.
    Between(f64, f64),
    /// Whatever was seen says that it stayed below.
    Below(f64),
    /// Whatever was seen says that it went above.
    Above(f64),
}

impl Band {
    /// Least and greatest value that agrees.
    pub fn limits(self) -> (f64, f64) {
        match self {
            Self::Spread(mean, sd) => (mean - sd, mean + sd),
            Self::Single(value, share) => (value / (1.0 + share), value * (1.0 + share)),
            Self::Between(low, high) => (low, high),
            Self::Below(limit) => (f64::NEG_INFINITY, limit),
            Self::Above(limit) => (limit, f64::INFINITY),
        }
    }

    /// The value to form a ratio with.
    pub fn typical(self) -> f64 {
        match self {
            Self::Spread(value, _)
            | Self::Single(value, _)
            | Self::Below(value)
            | Self::Above(value) => value,
            Self::Between(low, high) => 0.5 * (low + high),
        }
    }

    /// Whether `value` agrees.
    pub fn holds(self, value: f64) -> bool {
        let (low, high) = self.limits();
        (low..=high).contains(&value)
    }
}

/// How well an experiment's figures are founded.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Mark {
    /// In the cited source.
    Published,
    /// Part of it is from memory.
    Unverified,
}

impl Mark {
    /// In a word.
    pub fn name(self) -> &'static str {
        match self {
            Self::Published => "published",
            Self::Unverified => "unverified",
        }
    }
}

/// One figure of one experiment.
#[derive(Debug, Clone, Copy)]
pub struct Experiment {
    /// Short name.
    pub key: &'static str,
    /// What was done and measured.
    pub what: &'static str,
    /// The same as a scenario.
    pub scenario: fn() -> Scenario,
    /// What is compared.
    pub reading: Reading,
    /// With what.
    pub measured: Band,
    /// Unit for people, and how many SI units it holds.
    pub unit: (&'static str, f64),
    /// Whether the model was fitted to it.
    pub fitted: bool,
    /// How well founded the figure is.
    pub mark: Mark,
    /// Whose eyes.
    pub species: &'static str,
    /// Where it was published.
    pub source: &'static str,
}

fn shot(name: &str, mass_g: f64, diameter_mm: f64, speed_m_s: f64, window_ms: f64) -> Scenario {
    Scenario {
        name: name.to_owned(),
        model: Model::Physiological(Physiological::default()),
        impact: Impact::Projectile(Projectile {
            mass_g,
            diameter_mm,
            speed_m_s,
            ..Projectile::default()
        }),
        window_ms,
        ..Scenario::default()
    }
}

/// Taken for the face of the impactor, which is not published.
const IMPACTOR_MM: f64 = 20.0;

fn impactor_8() -> Scenario {
    shot("blunt impactor, 8.2 m/s", 1000.0, IMPACTOR_MM, 8.2, 1.1)
}
fn impactor_10() -> Scenario {
    shot("blunt impactor, 10 m/s", 1000.0, IMPACTOR_MM, 10.0, 1.35)
}
fn ball_6() -> Scenario {
    shot("6.35 mm steel ball, 6.2 m/s", 1.05, 6.35, 6.2, 3.0)
}
fn ball_66() -> Scenario {
    shot("6.35 mm steel ball, 66.5 m/s", 1.05, 6.35, 66.5, 2.0)
}
fn bb_56() -> Scenario {
    shot("steel BB, 56 m/s", 0.345, 4.5, 56.0, 2.0)
}
fn bb_92() -> Scenario {
    shot("steel BB, 92 m/s", 0.345, 4.5, 92.0, 2.0)
}
fn bb_62() -> Scenario {
    shot("steel BB, 62.5 m/s", 0.345, 4.5, 62.5, 2.0)
}
fn airsoft_99() -> Scenario {
    shot("airsoft pellet, 99 m/s", 0.25, 6.0, 99.0, 2.0)
}
fn foam() -> Scenario {
    shot("airbag foam, 30 m/s", 0.03, 6.0, 30.0, 2.0)
}
fn baseball() -> Scenario {
    let mut scenario = shot("baseball, 41.2 m/s", 145.0, 74.0, 41.2, 5.0);
    if let Impact::Projectile(ball) = &mut scenario.impact {
        ball.stiffness = crate::scenario::ProjectileStiffness::Linear { n_per_m: 2.4e5 };
    }
    scenario.eye.opening_deg = 61.0;
    scenario
}
fn papers_pulse() -> Scenario {
    Scenario::default()
}

const KENNEDY: &str = "Kennedy and Duma 2008, J Biomech 41:3297";
const DUMA_2012: &str = "Duma 2012, Curr Eye Res 37:43";
const STITZEL: &str = "Stitzel 2002, Stapp 46:81; burst: PMC3217427";
/// 50 % burst pressure of a human globe, dynamic.
const BURST: f64 = 0.90e6;
/// The same of a pig's: mean less one standard deviation.
const PIG_BURST_LOW: f64 = 1.32e6;
const N: (&str, f64) = ("N", 1.0);
const MPA: (&str, f64) = ("MPa", 1e6);
const PERCENT: (&str, f64) = ("%", 0.01);
const MM: (&str, f64) = ("mm", 1e-3);
const MS: (&str, f64) = ("ms", 1e-3);
/// Allowed where a source gives a value without a spread.
const NO_SPREAD: f64 = 0.3;

/// Every experiment that the model is held against: first those that it was fitted to.
pub static EXPERIMENTS: &[Experiment] = &[
    Experiment {
        key: "orbit-force",
        what: "blunt impactor 8.2 m/s: force at 7.5 mm",
        scenario: impactor_8,
        reading: Reading::ForceAtTravel(7.5e-3),
        measured: Band::Spread(271.0, 51.0),
        unit: N,
        fitted: true,
        mark: Mark::Published,
        species: "human",
        source: KENNEDY,
    },
    Experiment {
        key: "orbit-area",
        what: "the same: vitreous area",
        scenario: impactor_8,
        reading: Reading::FarthestArea,
        measured: Band::Between(0.99, 1.01),
        unit: PERCENT,
        fitted: true,
        mark: Mark::Published,
        species: "computed, human",
        source: "after Ikeda 2024, Clin Ophthalmol 18:2575",
    },
    Experiment {
        key: "slow-ball",
        what: "6.35 mm ball 6.2 m/s: peak pressure",
        scenario: ball_6,
        reading: Reading::PeakPressure,
        measured: Band::Single(0.27e6, NO_SPREAD),
        unit: MPA,
        fitted: true,
        mark: Mark::Published,
        species: "pig",
        source: DUMA_2012,
    },
    Experiment {
        key: "fast-ball",
        what: "6.35 mm ball 66.5 m/s: peak pressure",
        scenario: ball_66,
        reading: Reading::PeakPressure,
        measured: Band::Single(3.52e6, NO_SPREAD),
        unit: MPA,
        fitted: true,
        mark: Mark::Published,
        species: "pig",
        source: DUMA_2012,
    },
    Experiment {
        key: "bb-whole",
        what: "BB 56 m/s, globe whole: peak pressure",
        scenario: bb_56,
        reading: Reading::PeakPressure,
        measured: Band::Below(BURST),
        unit: MPA,
        fitted: true,
        mark: Mark::Unverified,
        species: "human",
        source: STITZEL,
    },
    Experiment {
        key: "bb-burst",
        what: "BB 92 m/s, globe burst: peak pressure",
        scenario: bb_92,
        reading: Reading::PeakPressure,
        measured: Band::Above(BURST),
        unit: MPA,
        fitted: true,
        mark: Mark::Unverified,
        species: "human",
        source: STITZEL,
    },
    Experiment {
        key: "bb-area",
        what: "BB 56 m/s: vitreous area",
        scenario: bb_56,
        reading: Reading::FarthestArea,
        measured: Band::Between(0.99, 1.01),
        unit: PERCENT,
        fitted: true,
        mark: Mark::Published,
        species: "computed, human",
        source: "after Ikeda 2024, Clin Ophthalmol 18:2575",
    },
    Experiment {
        key: "orbit-force-10",
        what: "blunt impactor 10 m/s: force at 12 mm",
        scenario: impactor_10,
        reading: Reading::ForceAtTravel(12e-3),
        measured: Band::Single(295.0, NO_SPREAD),
        unit: N,
        fitted: false,
        mark: Mark::Published,
        species: "human, one test",
        source: "interim report of the same group",
    },
    Experiment {
        key: "pellet-burst",
        what: "airsoft 99 m/s, pig globe opened: pressure",
        scenario: airsoft_99,
        reading: Reading::PeakPressure,
        measured: Band::Above(PIG_BURST_LOW),
        unit: MPA,
        fitted: false,
        mark: Mark::Published,
        species: "pig",
        source: "Marshall 2011, Am J Forensic Med Pathol 32; PMC3217427",
    },
    Experiment {
        key: "foam-whole",
        what: "airbag foam 30 m/s, globe whole: pressure",
        scenario: foam,
        reading: Reading::PeakPressure,
        measured: Band::Below(BURST),
        unit: MPA,
        fitted: false,
        mark: Mark::Unverified,
        species: "human",
        source: "Stitzel 2002 and 2005; PMC3217427",
    },
    Experiment {
        key: "baseball-burst",
        what: "baseball 41.2 m/s, globe burst: pressure",
        scenario: baseball,
        reading: Reading::PeakPressure,
        measured: Band::Above(BURST),
        unit: MPA,
        fitted: false,
        mark: Mark::Unverified,
        species: "human",
        source: STITZEL,
    },
    Experiment {
        key: "bb-shortening",
        what: "BB 62.5 m/s: shortening front to back",
        scenario: bb_62,
        reading: Reading::Shortening,
        measured: Band::Single(0.41, NO_SPREAD),
        unit: PERCENT,
        fitted: false,
        mark: Mark::Unverified,
        species: "pig",
        source: "Delori 1969, Invest Ophthalmol 8:290",
    },
    Experiment {
        key: "bb-widening",
        what: "BB 62.5 m/s: growth of the equator",
        scenario: bb_62,
        reading: Reading::Widening,
        measured: Band::Single(0.28, NO_SPREAD),
        unit: PERCENT,
        fitted: false,
        mark: Mark::Unverified,
        species: "pig",
        source: "Delori 1969, Invest Ophthalmol 8:290",
    },
    Experiment {
        key: "bb-time",
        what: "the same: when the equator is widest",
        scenario: bb_62,
        reading: Reading::TimeOfWidening,
        measured: Band::Single(0.4e-3, NO_SPREAD),
        unit: MS,
        fitted: false,
        mark: Mark::Unverified,
        species: "pig",
        source: "Delori 1969, Invest Ophthalmol 8:290",
    },
    Experiment {
        key: "paper-apex",
        what: "Paper model, 300 N for 0.2 ms: apex",
        scenario: papers_pulse,
        reading: Reading::Apex,
        measured: Band::Between(1e-3, 3e-3),
        unit: MM,
        fitted: false,
        mark: Mark::Published,
        species: "the paper's own claim",
        source: "the paper, figure 9",
    },
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_experiment_is_a_sound_scenario_with_a_name_of_its_own() {
        for (i, experiment) in EXPERIMENTS.iter().enumerate() {
            assert_eq!((experiment.scenario)().check().err(), None);
            assert!(!EXPERIMENTS[..i].iter().any(|e| e.key == experiment.key));
            assert!(experiment.measured.holds(match experiment.measured {
                Band::Below(limit) => 0.99 * limit,
                Band::Above(limit) => 1.01 * limit,
                other => other.typical(),
            }));
        }
    }

    #[test]
    fn fitted_rows_stand_before_those_that_were_not() {
        assert!(EXPERIMENTS.is_sorted_by_key(|e| !e.fitted));
    }
}
