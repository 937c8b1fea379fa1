//! Words for where a blow comes from, which stand for the values of several fields.

use super::Choices;
use crate::scenario::Scenario;
use std::f64::consts::PI;

/// The angle that a word alone stands for, in degrees.
const USUAL_DEG: f64 = 30.0;

/// Where an object comes from, in a word: it stands for an angle and an hour.
pub(super) struct Directions;

const STRAIGHT_ON: &str = "StraightOn";
/// Each word and its azimuth.
const WORDS: [(&str, f64); 4] =
    [("Above", 0.0), ("Nose", 0.5 * PI), ("Below", PI), ("Temple", 1.5 * PI)];

impl Choices for Directions {
    fn names(&self) -> Vec<&'static str> {
        let words = WORDS.iter().map(|(word, _)| *word);
        std::iter::once(STRAIGHT_ON).chain(words).collect()
    }

    fn synonyms(&self) -> &'static [(&'static str, &'static str)] {
        &[
            ("front", STRAIGHT_ON),
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
        if projectile.angle_deg == 0.0 {
            return Some(STRAIGHT_ON);
        }
        let azimuth = scenario.eye_side().azimuth(projectile.angle_clock);
        let quarter = (azimuth / (0.5 * PI)).round().rem_euclid(4.0) as usize;
        Some(WORDS[quarter].0)
    }

    fn set(&self, scenario: &mut Scenario, name: &str) -> bool {
        let side = scenario.eye_side();
        let same = self.get(scenario) == Some(name);
        let Some(projectile) = scenario.projectile_mut() else { return false };
        if same {
            return true;
        }
        if name == STRAIGHT_ON {
            projectile.angle_deg = 0.0;
            return true;
        }
        let Some((_, azimuth)) = WORDS.iter().find(|(word, _)| *word == name) else { return false };
        projectile.angle_clock = side.hour(*azimuth);
        if projectile.angle_deg == 0.0 {
            projectile.angle_deg = USUAL_DEG;
        }
        true
    }
}
