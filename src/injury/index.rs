//! The paper's retinal damage index.
//!
//! damage = 25 S / 1.5 + 25 M / 4 + 50 E / 5.3 in percent, with S the growth of the shell's length
//! in %, M the growth of the vertical diameter in %, and E the energy imparted in J (paper,
//! "Prediction of retinal damage"). It is an index, not a probability: above 100 it grades the
//! extent. The paper gives no source for its weights and thresholds.

use crate::run::{quantity::Quantity, readings::Readings};

/// One of the three parts of the index.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Term {
    /// Share of the index at the threshold, in %.
    pub weight: f64,
    /// Value at which the part reaches its weight.
    pub threshold: f64,
}

/// Growth of the shell's length, in %.
pub const SHELL: Term = Term { weight: 25.0, threshold: 1.5 };
/// Growth of the vertical diameter, in %.
pub const MERIDIAN: Term = Term { weight: 25.0, threshold: 4.0 };
/// Energy imparted, in J.
pub const ENERGY: Term = Term { weight: 50.0, threshold: 5.3 };

impl Term {
    /// What `value` adds to the index, in %; nothing below 0.
    pub fn points(self, value: f64) -> f64 {
        // A comparison and not `max`, which would turn what is not a number into 0.
        let value = if value < 0.0 { 0.0 } else { value };
        self.weight * value / self.threshold
    }
}

/// The damage index and its parts.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DamageIndex {
    /// S, in %.
    pub shell_growth: f64,
    /// M, in %.
    pub meridian_growth: f64,
    /// E, in J.
    pub energy: f64,
}

impl DamageIndex {
    /// The parts of it by the readings of a run.
    pub fn of(readings: &Readings) -> Self {
        let value = |of| readings.value(of).unwrap_or_default();
        Self {
            shell_growth: 100.0 * value(Quantity::ShellGrowth),
            meridian_growth: 100.0 * value(Quantity::MeridianGrowth),
            energy: value(Quantity::Energy),
        }
    }

    /// The index, in %.
    pub fn damage(&self) -> f64 {
        SHELL.points(self.shell_growth)
            + MERIDIAN.points(self.meridian_growth)
            + ENERGY.points(self.energy)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_part_at_its_threshold_makes_one_hundred_and_shrinking_counts_as_nothing() {
        let damage = |shell_growth, meridian_growth, energy| {
            DamageIndex { shell_growth, meridian_growth, energy }.damage()
        };
        assert!((damage(1.5, 4.0, 5.3) - 100.0).abs() < 1e-12);
        assert!((damage(-1.0, -2.0, 0.53) - 5.0).abs() < 1e-12);
    }
}
