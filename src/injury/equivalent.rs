//! One number that people understand: the speed of a BB of which the tissue would feel the same.
//!
//! A steel BB of 4.5 mm and 0.345 g, straight on at a human eye in its orbit. Its measures were
//! computed on level 1 at a grid of speeds (`contrecoup verify fit` does it again); between them
//! log m is linear in log v, and where a measure falls with speed the largest so far counts, so
//! that a larger measure never has a slower BB.

use crate::injury::kind::{Injury, PerInjury};
use std::fmt;

/// What a BB is, said once beside its speeds.
pub const A_BB: &str = "a BB is a steel ball of 4.5 mm, 0.345 g";

/// Speeds, m/s, and the measure of each injury at each of them, SI.
pub static BBS: [(f64, PerInjury<f64>); 12] = [
    (3.0, [0.985e-3, 0.545e-3, 0.00251, 8.4e-05, 0.119e-3, 372.0]),
    (5.0, [0.00236, 0.00122, 0.00602, 0.163e-3, 0.22e-3, 958.0]),
    (8.0, [0.00475, 0.00217, 0.0122, 0.254e-3, 0.342e-3, 2270.0]),
    (12.0, [0.00794, 0.00347, 0.0212, 0.353e-3, 0.487e-3, 4480.0]),
    (18.0, [0.0127, 0.00539, 0.0344, 0.492e-3, 0.673e-3, 8020.0]),
    (26.0, [0.019, 0.00839, 0.0505, 0.665e-3, 0.947e-3, 13_900.0]),
    (38.0, [0.0286, 0.0135, 0.0721, 0.00102, 0.00157, 22_300.0]),
    (56.0, [0.0424, 0.0227, 0.0979, 0.00197, 0.00322, 39_600.0]),
    (75.0, [0.0547, 0.0331, 0.119, 0.00328, 0.00492, 64_900.0]),
    (100.0, [0.0687, 0.0465, 0.136, 0.00431, 0.00628, 107_000.0]),
    (140.0, [0.0799, 0.0684, 0.146, 0.00382, 0.00732, 203_000.0]),
    (190.0, [0.0989, 0.0869, 0.165, 0.00541, 0.00942, 375_000.0]),
];

/// A BB in place of what hit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Equivalent {
    /// Slower than the slowest of the table, m/s.
    Under(f64),
    /// m/s.
    At(f64),
    /// Faster than the fastest, m/s.
    Over(f64),
}

impl Equivalent {
    /// The speed, or the end of the table beyond which it lies, m/s.
    pub fn speed(self) -> f64 {
        let (Self::Under(speed) | Self::At(speed) | Self::Over(speed)) = self;
        speed
    }
}

impl fmt::Display for Equivalent {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Self::Under(speed) => write!(f, "a BB at under {speed:.0} m/s"),
            Self::At(speed) => write!(f, "a BB at {speed:.0} m/s"),
            Self::Over(speed) => write!(f, "a BB at over {speed:.0} m/s"),
        }
    }
}

/// The BB of which the tissue of `injury` would feel as much.
pub fn equivalent(injury: Injury, measure: f64) -> Equivalent {
    let table = BBS.map(|(speed, measures)| (speed, measures[injury as usize]));
    let mut before = table[0];
    if measure < before.1 {
        return Equivalent::Under(before.0);
    }
    for (speed, at) in table {
        if at > measure {
            let share = libm::log(measure / before.1) / libm::log(at / before.1);
            return Equivalent::At(before.0 * libm::pow(speed / before.0, share));
        }
        if at > before.1 {
            before = (speed, at);
        }
    }
    Equivalent::Over(table[table.len() - 1].0)
}
