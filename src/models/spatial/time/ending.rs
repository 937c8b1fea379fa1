//! When a blow in three dimensions has told all.
//!
//! Lens and root of the iris swing on in a vitreous that hardly holds them long after an object has
//! left, and again as the globe comes back from bone. What clinics count is told as well by their
//! pull up to [`AFTER`] from the last touch, and so that is what is read of them, however long a
//! run lasts. A run ends
//!
//! * when the object is clear of the eye and does not come, that time is over, and nothing else
//!   that is read has grown by more than [`WORTH`] for a swing of the eye; or
//! * when the object, still at the eye, has no flight left that could reach it, and nothing that is
//!   read has grown for [`LYING`] swings. So ends what lies in the orbit or draws back slowly.
//!
//! Both are rules, not proofs: tests run random blows on to three times as long.

use crate::models::axisymmetric::recording::results::Extremes as Common;
use crate::models::spatial::recording::results::Extremes;

/// How long after the object has last touched the eye the pull on lens and iris is read, s.
pub(crate) const AFTER: f64 = 1.5e-3;
/// The share by which a measure grows at least if that is worth telling.
const WORTH: f64 = 0.01;
/// The share of the energy that it brought below which an object's flight can reach nothing.
const SPENT: f64 = 1e-3;
/// How many swings a run goes on after the last growth while the object lies at the eye.
const LYING: f64 = 2.5;
/// Measures that any end waits for, and with lens and iris all of them.
const WAITED_FOR: usize = 9;
const ALL: usize = WAITED_FOR + 2;

/// What the end of a run depends on.
pub(crate) struct Ending {
    last_touch: f64,
    /// The slowest swing of the eye, s.
    swing: f64,
    /// What each measure was when it last grew by so much that it is worth telling.
    told: [f64; ALL],
    /// When any did, of those that all wait for and of all, s.
    grown: [f64; 2],
}

impl Ending {
    pub fn new(swing: f64) -> Self {
        Self { last_touch: 0.0, swing, told: [0.0; ALL], grown: [0.0; 2] }
    }

    /// The object touches the eye at `time`, s.
    pub fn touched(&mut self, time: f64) {
        self.last_touch = time;
    }

    /// Whether lens and iris are still read.
    pub fn reads_pulls(&self, time: f64) -> bool {
        time <= self.last_touch + AFTER
    }

    /// Takes how far the measures have grown at `time`, s.
    pub fn grow(&mut self, common: &Common, extremes: &Extremes, time: f64) {
        let sectors = &extremes.sectors;
        let sum = |hours: &[f64]| hours.iter().sum::<f64>();
        let now = [
            sum(&sectors.equator),
            sum(&sectors.back),
            sum(&sectors.edge),
            common.pressure.value,
            common.scleral_stress.value,
            common.shortening.value,
            common.shell_growth.value,
            common.equator_growth.value,
            common.energy_given.value,
            sum(&sectors.lens),
            sum(&sectors.iris),
        ];
        for (i, (told, now)) in self.told.iter_mut().zip(now).enumerate() {
            if now > (1.0 + WORTH) * *told {
                *told = now;
                self.grown[1] = time;
                if i < WAITED_FOR {
                    self.grown[0] = time;
                }
            }
        }
    }

    /// Whether a run may end at `time`, s, when the object is `clear` of the eye or not and has so
    /// much energy left, as a share of what it brought, with which it comes nearer.
    pub fn is_reached(&self, clear: bool, comes_with: f64, time: f64) -> bool {
        if clear {
            !self.reads_pulls(time) && time >= self.grown[0] + self.swing
        } else {
            comes_with < SPENT && time >= self.grown[1] + LYING * self.swing
        }
    }
}
