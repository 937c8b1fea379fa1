//! Where a blow comes from and what it aims at, by the clock as an examiner who faces the patient
//! sees it: the nose lies at 3 o'clock of a right eye and at 9 of a left one.

use crate::scenario::{Impact, Projectile, Scenario, plain};
use serde::{Deserialize, Serialize};
use std::f64::consts::{FRAC_PI_4, PI, TAU};
use strum::IntoStaticStr;

/// Hours of a clock.
pub const HOURS: f64 = 12.0;
/// Radius of the globe, in mm.
pub const GLOBE_MM: f64 = 12.0;
/// An object at a greater angle, in degrees, would fly along the face.
pub const STEEPEST_OBJECT_DEG: f64 = 75.0;
/// The farthest beside the middle of the globe that an object may be aimed, in mm.
pub const FARTHEST_AIM_MM: f64 = 10.0;

/// Directions as hits come where nobody knows them, equally likely: angle in degrees and the hour
/// of it, offset in mm and the hour of that, of a right eye. Judged: nobody measured how eyes are
/// hit.
pub const AS_HITS_COME: [[f64; 4]; 6] = [
    [0.0, 12.0, 0.0, 12.0],
    [12.0, 9.0, 2.0, 9.0],
    [20.0, 7.5, 4.0, 6.0],
    [15.0, 4.0, 3.0, 3.0],
    [25.0, 10.0, 5.0, 11.0],
    [30.0, 8.0, 6.0, 8.0],
];

/// Whether it is known where a blow came from.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, IntoStaticStr)]
pub enum Directions {
    /// By its angle and offset.
    #[default]
    AsGiven,
    /// Nobody knows: it may be any of [`AS_HITS_COME`].
    NotKnown,
}

/// Which eye of a person.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, IntoStaticStr)]
pub enum Side {
    /// Its nose lies at 3 o'clock.
    #[default]
    Right,
    /// Its nose lies at 9 o'clock.
    Left,
}

impl Side {
    /// The azimuth about the eye's axis of an hour, in rad: 0 above, pi/2 at the nose.
    pub fn azimuth(self, hour: f64) -> f64 {
        self.turn(hour * TAU / HOURS)
    }

    /// The turn of the clock's hand at an azimuth, or the reverse: a left eye is the mirror image.
    pub fn turn(self, azimuth: f64) -> f64 {
        match self {
            Self::Right => azimuth,
            Self::Left => -azimuth,
        }
    }

    /// Its name, and what lies at the left and at the right of an examiner.
    pub fn seen(self) -> (&'static str, &'static str, &'static str) {
        match self {
            Self::Right => ("right", "temple", "nose"),
            Self::Left => ("left", "nose", "temple"),
        }
    }

    /// The hour of an azimuth, from 0.5 to below 12.5 in halves.
    pub fn hour(self, azimuth: f64) -> f64 {
        let turn = self.turn(azimuth);
        let halves = (2.0 * HOURS * turn / TAU).round().rem_euclid(2.0 * HOURS);
        if halves < 1.0 { HOURS } else { 0.5 * halves }
    }
}

/// Of an azimuth and its opposite that which lies higher, or at the nose where both lie level.
pub fn upper(azimuth: f64) -> f64 {
    let (up, nose) = (libm::cos(azimuth), libm::sin(azimuth));
    let lower = up < -1e-9 || (up < 1e-9 && nose < 0.0);
    azimuth + if lower { PI } else { 0.0 }
}

/// A direction about the eye's axis in words, as in `below and the temple`.
pub fn place(azimuth: f64) -> &'static str {
    const PLACES: [&str; 8] = [
        "above",
        "above and the nose",
        "the nose",
        "below and the nose",
        "below",
        "below and the temple",
        "the temple",
        "above and the temple",
    ];
    PLACES[(azimuth / FRAC_PI_4).round().rem_euclid(8.0) as usize]
}

/// An hour as people read it, as in `7:30`.
pub fn o_clock(hour: f64) -> String {
    let minutes = (60.0 * hour).round();
    let (whole, rest) = ((minutes / 60.0).floor(), minutes % 60.0);
    let whole = if whole < 1.0 { HOURS } else { whole };
    if rest == 0.0 { format!("{whole} o'clock") } else { format!("{whole}:{rest:02}") }
}

impl Impact {
    /// Turns an angle or offset below 0 to the other side of the clock.
    pub(super) fn by_the_clock(&mut self) {
        let Self::Projectile(projectile) = self else { return };
        // What is beyond the bounds is refused as it was given.
        let turned = |value: &mut f64, hour: &mut f64, most: f64| {
            if (-most..0.0).contains(value) {
                *value = -*value;
                let turned = (*hour + 0.5 * HOURS) % HOURS;
                *hour = if turned == 0.0 { HOURS } else { turned };
            }
        };
        turned(&mut projectile.angle_deg, &mut projectile.angle_clock, STEEPEST_OBJECT_DEG);
        turned(&mut projectile.offset_mm, &mut projectile.offset_clock, FARTHEST_AIM_MM);
    }
}

impl Scenario {
    /// Which eye it is.
    pub fn eye_side(&self) -> Side {
        self.physiological().map_or(Side::Right, |model| model.eye_side)
    }

    /// Keeps the nose and the temple where they were `before` at what is now the other eye.
    pub(super) fn mirror_from(&mut self, before: &Self) {
        let side = |scenario: &Self| scenario.physiological().map(|model| model.eye_side);
        let (Some(old), Some(new)) = (side(before), side(self)) else { return };
        if let (true, Self { impact: Impact::Projectile(object), .. }) = (old != new, self) {
            for hour in [&mut object.angle_clock, &mut object.offset_clock] {
                let mirrored = HOURS - *hour;
                *hour = if mirrored == 0.0 { HOURS } else { mirrored };
            }
        }
    }

    /// Where the blow comes from and what it aims at, in words.
    pub fn direction(&self) -> String {
        let words = match &self.impact {
            Impact::Projectile(object) => object.direction(self.eye_side()),
            Impact::ForcePulse(pulse) if pulse.angle_deg == 0.0 => None,
            Impact::ForcePulse(pulse) => {
                let side = if pulse.angle_deg > 0.0 { "above" } else { "below" };
                Some(format!("{} deg {side} the apex", plain(pulse.angle_deg.abs())))
            }
        };
        words.unwrap_or_else(|| "straight on".to_owned())
    }

    /// What lies at the top of a section along the path of an object: the side that it comes from,
    /// of an eye in three dimensions whichever of both is higher; none straight on.
    pub fn top(&self) -> Option<&'static str> {
        let hour = match self.projectile()? {
            object if object.angle_deg != 0.0 => object.angle_clock,
            object if object.offset_mm != 0.0 => object.offset_clock,
            _ => return None,
        };
        let azimuth = self.eye_side().azimuth(hour);
        Some(place(if self.is_spatial() { upper(azimuth) } else { azimuth }))
    }
}

impl Projectile {
    /// Comes from one of [`AS_HITS_COME`], at a right eye or mirrored at a left one.
    pub fn turn_to(&mut self, side: Side, [angle_deg, angle, offset_mm, offset]: [f64; 4]) {
        let hour = |hour: f64| side.hour(Side::Right.azimuth(hour));
        (self.angle_deg, self.angle_clock) = (angle_deg, hour(angle));
        (self.offset_mm, self.offset_clock) = (offset_mm, hour(offset));
    }

    /// Whether it flies along the eye's own axis.
    pub fn is_straight_on(&self) -> bool {
        self.angle_deg == 0.0 && self.offset_mm == 0.0
    }

    /// The front angle at which its path enters the globe, in degrees; none if it goes past.
    pub fn lands_at_deg(&self) -> Option<f64> {
        let inside = GLOBE_MM * GLOBE_MM - self.offset_mm * self.offset_mm;
        if inside < 0.0 {
            return None;
        }
        let angle = self.angle_deg.to_radians();
        let (sin, cos) = (libm::sin(angle), libm::cos(angle));
        let between = (self.angle_clock - self.offset_clock) * TAU / HOURS;
        // The aim is a point of the plane across the path: what lies along the path is taken off.
        let along = -sin * libm::cos(between);
        let across = (1.0 - along * along).max(0.0).sqrt();
        let back = if across > 0.0 { -along * cos / across * self.offset_mm } else { 0.0 };
        let x = back - cos * inside.sqrt();
        Some(libm::acos((-x / GLOBE_MM).clamp(-1.0, 1.0)).to_degrees())
    }

    /// Where it comes from and what it aims at, in words; none if straight on.
    pub fn direction(&self, side: Side) -> Option<String> {
        if self.directions == Directions::NotKnown {
            return Some("from where is not known".to_owned());
        }
        let from = place(side.azimuth(self.angle_clock));
        let towards = place(side.azimuth(self.offset_clock));
        let angle = format!("from {from} at {} deg", plain(self.angle_deg));
        let offset = format!("{} mm towards {towards}", plain(self.offset_mm));
        match (self.angle_deg == 0.0, self.offset_mm == 0.0) {
            (true, true) => None,
            (false, true) => Some(angle),
            (true, false) => Some(offset),
            (false, false) => Some(format!("{angle}, {offset}")),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scenario::set::set;

    #[test]
    fn the_nose_lies_at_3_of_a_right_eye_and_at_9_of_a_left_one() {
        for (side, hour) in [(Side::Right, 3.0), (Side::Left, 9.0)] {
            assert_eq!(place(side.azimuth(hour)), "the nose");
            assert_eq!(side.hour(0.5 * PI), hour);
            for half in 1..=24 {
                let hour = 0.5 * f64::from(half);
                assert_eq!(side.hour(side.azimuth(hour)), hour.max(0.5));
            }
        }
        assert_eq!((o_clock(12.0), o_clock(7.5)), ("12 o'clock".into(), "7:30".into()));
        assert_eq!(o_clock(0.5), "12:30");
    }

    #[test]
    fn an_angle_below_0_of_an_older_file_comes_from_below() {
        let text = "(name: \"x\", impact: Projectile((mass_g: 1.0, diameter_mm: 6.0, \
                    speed_m_s: 9.0, angle_deg: -30.0, offset_mm: -2.0)))";
        let read: Scenario = ron::from_str(text).unwrap();
        let read = read.projectile().unwrap();
        assert_eq!((read.angle_deg, read.angle_clock), (30.0, 6.0));
        assert_eq!((read.offset_mm, read.offset_clock), (2.0, 6.0));
        let words = "from below at 30 deg, 2 mm towards below";
        assert_eq!(read.direction(Side::Right).unwrap(), words);
    }

    #[test]
    fn a_path_lands_where_its_angle_and_its_offset_lead() {
        let at = |angle_deg, offset_mm, offset_clock| {
            let object = Projectile { angle_deg, offset_mm, offset_clock, ..Projectile::default() };
            object.lands_at_deg()
        };
        let near = |a: Option<f64>, b: f64| assert!((a.unwrap() - b).abs() < 1e-9, "{a:?} {b}");
        near(at(30.0, 0.0, 12.0), 30.0);
        near(at(0.0, 6.0, 3.0), 30.0);
        near(at(20.0, 6.0, 12.0), 50.0);
        near(at(20.0, 6.0, 6.0), 10.0);
        assert_eq!(at(0.0, 13.0, 3.0), None);
    }

    #[test]
    fn a_word_sets_the_hour_of_its_side_and_keeps_an_angle_that_is_there() {
        let mut scenario = Scenario::of(Impact::Projectile(Projectile::default()));
        let from = crate::scenario::fields::find("impact.from").unwrap();
        set(&mut scenario, "model.eye_side", "Left").unwrap();
        for (path, text, angle, hour, word) in [
            ("impact.from", "Temple", 30.0, 3.0, "Temple"),
            ("impact.angle_deg", "12", 12.0, 3.0, "Temple"),
            ("impact.from", "Below", 12.0, 6.0, "Below"),
            ("impact.from", "nasal", 12.0, 9.0, "Nose"),
            ("impact.from", "StraightOn", 0.0, 9.0, "StraightOn"),
        ] {
            set(&mut scenario, path, text).unwrap();
            let object = scenario.projectile().unwrap();
            assert_eq!((object.angle_deg, object.angle_clock), (angle, hour), "{text}");
            assert_eq!(from.text(&scenario).as_deref(), Some(word));
        }
        let left = set(&mut scenario, "impact.from", "left").unwrap_err();
        assert!(left.to_string().contains("the nose or the temple"), "{left}");
    }
}
