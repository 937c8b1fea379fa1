//! The rim of the bony orbit, in four directions.
//!
//! Measured on computed tomographs of 15 caucasian and 12 east asian orbits (Arch Facial Plast Surg
//! 2011;13:51); 141 Koreans agree within 2.7 mm (Shin 2017, Anat Cell Biol 50:41).

use serde::{Deserialize, Serialize};

/// A length in four directions, in mm.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Around {
    /// At the brow.
    pub above: f64,
    /// At the nose.
    pub nose: f64,
    /// At the cheek.
    pub below: f64,
    /// At the temple.
    pub temple: f64,
}

/// Where the rim lies. A file gives its lengths, or says whose it is, as in `rim: EastAsian`.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(from = "Written")]
pub struct Rim {
    /// Behind the plane through the apex of the cornea.
    pub depth_mm: Around,
    /// Between globe and rim, radially.
    pub gap_mm: Around,
}

/// As a file has it. The reader of RON tells a word from lengths only to an untagged enum.
#[derive(Deserialize)]
#[serde(untagged, expecting = "expected Caucasian, EastAsian, or (depth_mm: (...), gap_mm: (...))")]
enum Written {
    Named(Named),
    Lengths { depth_mm: Around, gap_mm: Around },
}

#[derive(Deserialize)]
enum Named {
    Caucasian,
    EastAsian,
}

impl From<Written> for Rim {
    fn from(written: Written) -> Self {
        match written {
            Written::Named(Named::Caucasian) => Self::CAUCASIAN,
            Written::Named(Named::EastAsian) => Self::EAST_ASIAN,
            Written::Lengths { depth_mm, gap_mm } => Self { depth_mm, gap_mm },
        }
    }
}

const fn around(above: f64, nose: f64, below: f64, temple: f64) -> Around {
    Around { above, nose, below, temple }
}

impl Rim {
    /// The measured ones by their names.
    pub(super) const NAMED: [(&str, Self); 2] =
        [("Caucasian", Self::CAUCASIAN), ("EastAsian", Self::EAST_ASIAN)];
    /// Of 15 caucasian orbits.
    pub const CAUCASIAN: Self =
        Self { depth_mm: around(4.6, 5.9, 12.6, 20.6), gap_mm: around(3.7, 7.6, 6.6, 4.6) };
    /// Of 12 east asian orbits.
    pub const EAST_ASIAN: Self =
        Self { depth_mm: around(5.0, 6.8, 11.1, 17.5), gap_mm: around(2.1, 8.2, 6.5, 4.5) };
    /// Standard deviations between persons, of the caucasian orbits.
    pub const SPREAD: Self =
        Self { depth_mm: around(4.2, 3.0, 3.7, 2.6), gap_mm: around(2.1, 1.8, 2.2, 2.3) };

    /// Whose it is, or `Own` of lengths of one's own.
    pub fn name(&self) -> &'static str {
        Self::NAMED.iter().find(|(_, rim)| rim == self).map_or("Own", |(name, _)| name)
    }
}

impl Default for Rim {
    fn default() -> Self {
        Self::CAUCASIAN
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scenario::Scenario;
    use crate::scenario::load::{parse, to_ron};

    #[test]
    fn a_file_says_whose_rim_it_is_or_gives_its_lengths() {
        let file = |rim: &str| {
            let object = "Projectile(mass_g: 1, diameter_mm: 6, speed_m_s: 9)";
            let model = format!("Physiological(rim: {rim})");
            parse(&format!("(name: \"x\", model: {model}, impact: {object})"), "x.ron")
        };
        let rim = |scenario: Scenario| scenario.physiological().unwrap().rim;
        let asian = file("EastAsian").unwrap();
        assert_eq!(rim(parse(&to_ron(&asian), "y.ron").unwrap()), Rim::EAST_ASIAN);
        assert_eq!(rim(asian), Rim::EAST_ASIAN);
        let lengths = "(depth_mm: (above: 1, nose: 2.5, below: 3, temple: 4), \
                       gap_mm: (above: 1, nose: 2, below: 3, temple: 4))";
        assert_eq!(rim(file(lengths).unwrap()).depth_mm.nose, 2.5);
        let refused = file("Martian").unwrap_err().to_string();
        assert!(refused.contains("EastAsian"), "{refused}");
    }
}
