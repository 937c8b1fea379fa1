//! Kinds of object whose injuries were counted in clinics, and how near an object is to each.
//!
//! Two objects are as far apart as d, the length of the vector of differences of log10 of their
//! diameters, of their masses over their cross sections and of the moduli of their surfaces, over
//! [`SCALES`]. At d = 1 they share about half of what is their kind's own.
//!
//! Speeds at the eye were not published: median, spread (as hits come) and how far the median is
//! known, both in log10, are judged.

use crate::scenario::{Projectile, Scenario, Surface};
use libm::log10;

/// Sizes of a difference in log10 of diameter, of mass over cross section, and of modulus.
const SCALES: [f64; 3] = [0.35, 0.6, 1.0];
/// The modulus of a hard surface, in `MPa`: steel's, for an eye, is no other than this.
const HARD_MPA: f64 = 1000.0;
/// That of what bursts at first touch, in `MPa`.
const SPLASHING_MPA: f64 = 1.0;

/// What makes objects alike, each over its scale.
pub type Features = [f64; 3];

/// What makes an object like others.
pub fn features(object: &Projectile) -> Features {
    let modulus = match object.surface {
        Surface::Hard => HARD_MPA,
        Surface::Elastic { modulus_mpa } | Surface::Inflated { modulus_mpa, .. } => modulus_mpa,
        Surface::Splashing => SPLASHING_MPA,
    };
    let wide = object.diameter_mm;
    let all = [log10(wide), log10(object.mass_g / (wide * wide)), log10(modulus.min(HARD_MPA))];
    std::array::from_fn(|i| all[i] / SCALES[i])
}

/// The square of how far apart two objects are.
pub fn apart_squared(a: &Features, b: &Features) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b) * (a - b)).sum()
}

/// A kind of object.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ObjectKind {
    /// Its name in tables.
    pub key: &'static str,
    /// Several of it, for people.
    pub name: &'static str,
    /// The preset that stands for it.
    pub preset: &'static str,
    /// Median speed at the eye, m/s.
    pub usual_m_s: f64,
    /// Standard deviation of log10 of the speed at the eye.
    pub spread: f64,
    /// How far log10 of the median is known: a standard deviation.
    pub unsure: f64,
    /// Speeds that were computed for the fit, m/s.
    pub speeds: &'static [f64],
}

const fn kind(
    key: &'static str,
    (name, preset): (&'static str, &'static str),
    [usual_m_s, spread, unsure]: [f64; 3],
    speeds: &'static [f64],
) -> ObjectKind {
    ObjectKind { key, name, preset, usual_m_s, spread, unsure, speeds }
}

/// All of them.
#[rustfmt::skip]
pub static KINDS: [ObjectKind; 13] = [
    kind("airsoft", ("airsoft pellets", "airsoft-75"), [55.0, 0.10, 0.08], &[35.0, 50.0, 65.0, 80.0, 100.0]),
    kind("paintball", ("paintballs", "paintball"), [65.0, 0.08, 0.06], &[30.0, 45.0, 60.0, 75.0, 90.0]),
    kind("air-gun", ("air-gun pellets", "air-rifle-pellet"), [75.0, 0.25, 0.20], &[40.0, 70.0, 110.0, 160.0, 200.0]),
    kind("foam-dart", ("foam darts", "foam-dart"), [18.0, 0.12, 0.08], &[10.0, 16.0, 22.0, 30.0, 40.0]),
    kind("gel-ball", ("gel balls", "gel-ball"), [45.0, 0.08, 0.05], &[30.0, 40.0, 50.0, 60.0, 75.0]),
    kind("squash", ("squash balls", "squash-ball"), [22.0, 0.18, 0.12], &[8.0, 15.0, 25.0, 38.0, 55.0]),
    kind("racquetball", ("racquetballs", "racquetball"), [22.0, 0.18, 0.12], &[10.0, 18.0, 28.0, 40.0]),
    kind("tennis", ("tennis balls", "tennis-ball"), [20.0, 0.18, 0.12], &[8.0, 15.0, 25.0, 38.0, 52.0]),
    kind("golf", ("golf balls", "golf-ball"), [40.0, 0.15, 0.10], &[10.0, 18.0, 28.0, 42.0, 60.0]),
    kind("soccer", ("soccer balls", "soccer-ball"), [15.0, 0.12, 0.08], &[6.0, 10.0, 15.0, 21.0, 30.0]),
    kind("shuttlecock", ("shuttlecocks", "shuttlecock"), [28.0, 0.18, 0.12], &[8.0, 15.0, 25.0, 40.0, 60.0]),
    kind("cork", ("champagne corks", "champagne-cork"), [11.0, 0.12, 0.08], &[6.0, 9.0, 13.0, 18.0, 25.0]),
    kind("rubber-round", ("40 mm rubber rounds", "rubber-round"), [75.0, 0.10, 0.08], &[20.0, 40.0, 55.0, 70.0]),
];

impl ObjectKind {
    /// The kind of that name in tables.
    pub fn find(key: &str) -> Option<&'static Self> {
        KINDS.iter().find(|kind| kind.key == key)
    }

    /// The scenario that stands for it.
    ///
    /// # Panics
    /// Never: each names a preset of the program, as a test says.
    pub fn scenario(&self) -> Scenario {
        let preset = crate::scenario::library::built_in().into_iter();
        let mut own = preset.filter(|preset| preset.name == self.preset);
        let scenario = own.next().and_then(|preset| preset.scenario().ok());
        scenario.expect("a kind names a preset of the program")
    }

    /// What makes it like others.
    ///
    /// # Panics
    /// Never: its preset has an object.
    pub fn features(&self) -> Features {
        features(self.scenario().projectile().expect("a kind is an object"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_kind_is_an_object_and_is_nearest_to_itself() {
        for kind in &KINDS {
            let own = kind.features();
            assert!(own.iter().all(|feature| feature.is_finite()));
            for other in KINDS.iter().filter(|other| other.key != kind.key) {
                assert!(
                    apart_squared(&own, &other.features()) > 0.01,
                    "{} {}",
                    kind.key,
                    other.key
                );
            }
            assert!(kind.speeds.is_sorted() && kind.speeds.len() >= 4);
        }
    }
}
