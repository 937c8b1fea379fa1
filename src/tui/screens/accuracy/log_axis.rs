//! A logarithmic axis: where a value lies on it, and which values are labelled.

use crate::report::format::trimmed;

/// Fewer ticks than so many tell nothing of an axis.
const FEW: usize = 3;

#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LogAxis {
    /// Common logarithm of its beginning.
    pub low: f64,
    /// Common logarithm of its end.
    pub high: f64,
}

impl LogAxis {
    /// Wide enough for all values, with a margin.
    pub fn over(values: impl Iterator<Item = f64>) -> Self {
        let logs = values.filter(|v| v.is_finite() && *v > 0.0).map(|v| (v.log10(), v.log10()));
        let ends = logs.reduce(|a, b| (a.0.min(b.0), a.1.max(b.1)));
        let (low, high) = ends.unwrap_or((0.0, 1.0));
        let margin = (0.04 * (high - low)).max(0.05);
        Self { low: low - margin, high: high + margin }
    }

    /// Where a value lies, from 0 to 1.
    pub fn share(self, value: f64) -> f64 {
        ((value.log10() - self.low) / (self.high - self.low)).clamp(0.0, 1.0)
    }

    /// Values to be labelled, at most so many unless there is but one decade.
    pub fn ticks(self, most: usize) -> Vec<f64> {
        let (first, last) = (self.low.floor() as i32, self.high.ceil() as i32);
        let within = |v: &f64| (self.low..=self.high).contains(&v.log10());
        let over = |steps: &[f64]| -> Vec<f64> {
            let decades = (first..=last).map(|n| 10f64.powi(n));
            let values = decades.flat_map(|one| steps.iter().map(move |m| m * one));
            values.filter(within).collect()
        };
        let even = |count: u32| -> Vec<f64> {
            (0..9 * count).map(|i| 1.0 + f64::from(i) / f64::from(count)).collect()
        };
        // The narrower the axis, the finer the steps.
        let sets = [vec![1.0, 2.0, 5.0], even(1), even(2), even(5), even(10)];
        let all = sets.iter().map(|steps| over(steps));
        let fitting: Vec<Vec<f64>> = all.filter(|ticks| ticks.len() <= most).collect();
        let mut enough = fitting.iter().filter(|ticks| ticks.len() >= FEW);
        if let Some(ticks) = enough.next().or(fitting.last()) {
            return ticks.clone();
        }
        // Powers of ten, with as many left out between two as it takes.
        let decades = |apart: i32| {
            let some = (first..=last).filter(|n| n.rem_euclid(apart) == 0);
            some.map(|n| 10f64.powi(n)).filter(within).collect::<Vec<f64>>()
        };
        let mut ever_fewer = (1..).map(decades);
        ever_fewer.find(|ticks| ticks.len() <= most.max(1)).unwrap_or_default()
    }
}

/// A tick's number, which has one digit or two.
pub fn tick_label(value: f64) -> String {
    if (0.99e-3..1e6).contains(&value) { trimmed(value) } else { format!("{value:.0e}") }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ticks_are_powers_of_ten_where_there_are_many_and_have_short_names() {
        let axis = LogAxis::over([1e-6, 30.0].into_iter());
        assert_eq!(axis.ticks(4).len(), 4);
        assert!(axis.ticks(4).iter().all(|t| (t.log10() % 1.0).abs() < 1e-9));
        let narrow = LogAxis::over([1.1, 4.0].into_iter());
        assert_eq!(narrow.ticks(5), [1.0, 2.0, 3.0, 4.0]);
        assert_eq!(narrow.ticks(2), [1.0, 2.0]);
        let error = LogAxis::over([4.3, 4.8].into_iter());
        let ticks: Vec<String> = error.ticks(8).into_iter().map(tick_label).collect();
        assert_eq!(ticks, ["4", "4.5", "5"]);
        let labels = [1e-6, 1e-3, 0.02, 0.1, 1.0, 50.0].map(tick_label);
        assert_eq!(labels, ["1e-6", "0.001", "0.02", "0.1", "1", "50"]);
        // Over one value or none it still has a length.
        for axis in [LogAxis::over([3.0].into_iter()), LogAxis::over([0.0].into_iter())] {
            assert!(axis.high > axis.low && axis.share(3.0).is_finite());
        }
    }
}
