//! Words for where a blow comes from, which stand for the values of several fields.

use super::Choices;
use crate::scenario::{Directions as Known, Scenario};
use std::f64::consts::FRAC_PI_4;

/// The angle that a word alone stands for, in degrees.
const USUAL_DEG: f64 = 30.0;

/// Where an object comes from, in a word: it stands for an angle and an hour.
pub(super) struct Directions;

const STRAIGHT_ON: &str = "StraightOn";
const NOT_KNOWN: &str = "NotKnown";
/// Each word, from above by eighths of a turn towards the nose.
const WORDS: [&str; 8] =
    ["Above", "AboveNose", "Nose", "BelowNose", "Below", "BelowTemple", "Temple", "AboveTemple"];

impl Choices for Directions {
    fn names(&self) -> Vec<&'static str> {
        [NOT_KNOWN, STRAIGHT_ON].into_iter().chain(WORDS).collect()
    }

    fn synonyms(&self) -> &'static [(&'static str, &'static str)] {
        &[
            ("front", STRAIGHT_ON),
            ("unknown", NOT_KNOWN),
            ("superior", "Above"),
            ("nasal", "Nose"),
            ("medial", "Nose"),
            ("inferior", "Below"),
            ("temporal", "Temple"),
            ("lateral", "Temple"),
        ]
    }

    fn unclear(&self, typed: &str) -> Option<&'static str> {
        let sides = ["left", "right"];
        let is_side = sides.iter().any(|side| typed.eq_ignore_ascii_case(side));
        is_side.then_some("may be the nose or the temple: it depends on the eye")
    }

    fn get(&self, scenario: &Scenario) -> Option<&'static str> {
        let projectile = scenario.projectile()?;
        if projectile.directions == Known::NotKnown {
            return Some(NOT_KNOWN);
        }
        if projectile.angle_deg == 0.0 {
            return Some(STRAIGHT_ON);
        }
        let azimuth = scenario.eye_side().azimuth(projectile.angle_clock);
        let eighth = (azimuth / FRAC_PI_4).round().rem_euclid(8.0) as usize;
        Some(WORDS[eighth])
    }

    fn set(&self, scenario: &mut Scenario, name: &str) -> bool {
        let side = scenario.eye_side();
        let same = self.get(scenario) == Some(name);
        let Some(projectile) = scenario.projectile_mut() else { return false };
        if same {
            return true;
        }
        projectile.directions = Known::AsGiven;
        if name == NOT_KNOWN {
            projectile.directions = Known::NotKnown;
            (projectile.angle_deg, projectile.offset_mm) = (0.0, 0.0);
            return true;
        }
        if name == STRAIGHT_ON {
            projectile.angle_deg = 0.0;
            return true;
        }
        let Some(eighth) = WORDS.iter().position(|word| *word == name) else { return false };
        projectile.angle_clock = side.hour(eighth as f64 * FRAC_PI_4);
        if projectile.angle_deg == 0.0 {
            projectile.angle_deg = USUAL_DEG;
        }
        true
    }
}
