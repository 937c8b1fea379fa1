//! The steps of the colour scale: which force begins each, and how it is written.

use clap::ValueEnum;

use crate::answer::solve::Answer;

/// From which colours to which heat goes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, ValueEnum)]
pub enum HeatMap {
    /// The paper's, from red to white.
    #[default]
    Hot,
    /// Even steps of lightness from grey to yellow, alike to most who see colours otherwise.
    Cividis,
}

impl HeatMap {
    /// The other one.
    #[must_use]
    pub fn other(self) -> Self {
        if self == Self::Hot { Self::Cividis } else { Self::Hot }
    }
}

/// Where the steps of heat begin, in N: each twice the one before, the last at most the largest.
pub fn thresholds(largest: f64, steps: usize) -> Vec<f64> {
    let top = if largest > 0.0 { largest.log2().floor() as i32 } else { 0 };
    let above = |step: usize| i32::try_from(steps - 1 - step).unwrap_or(0);
    (0..steps).map(|step| 2f64.powi(top - above(step))).collect()
}

/// The step of a force; 0 below the first threshold.
pub fn step_of(force: f64, thresholds: &[f64]) -> usize {
    thresholds.iter().take_while(|t| force >= **t).count()
}

/// The largest force on any node in any frame, in N.
pub fn hottest(answer: &Answer) -> f64 {
    answer.run.frames.iter().flat_map(|frame| frame.forces.iter().copied()).fold(0.0, f64::max)
}

/// What ASCII shows for a step of heat.
pub fn heat_glyph(step: usize) -> char {
    char::from_digit(step as u32, 10).unwrap_or('9')
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn heat_doubles_from_step_to_step_up_to_the_largest_force() {
        assert_eq!(thresholds(64.0, 2), [32.0, 64.0]);
        assert_eq!(thresholds(0.0, 2), [0.5, 1.0]);
        let steps = thresholds(73.0, 5);
        assert_eq!(steps, [4.0, 8.0, 16.0, 32.0, 64.0]);
        let found = [0.0, 3.9, 4.0, 63.0, 73.0].map(|force| step_of(force, &steps));
        assert_eq!(found, [0, 0, 1, 4, 5]);
    }
}
