//! How long a run lasts, and what is told or kept of it at even times.
//!
//! Where the end is known, the times are shares of it. Where it is not, they do not depend on it:
//! the balance of energy is taken at a fixed spacing, and a trace starts with a narrow one that
//! doubles whenever there are twice as many values as it needs.

use crate::run::kept::Traces;

/// Balances of energy taken over a time that is known.
const BALANCES: f64 = 100.0;
/// Time between two of a run whose end is not, s.
const BALANCE_EVERY: f64 = 30e-6;
/// Values of a trace that such a time is divided into; of a run whose end is not known there are up
/// to twice as many.
const TRACE_POINTS: f64 = 1000.0;
/// Their first spacing, s.
const TRACE_EVERY: f64 = 1e-6;

/// How long a run lasts.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Until {
    /// So many s, or less if nothing is kept and nothing can grow any more.
    Time(f64),
    /// Until nothing can grow any more, but this many s at most.
    Settled(f64),
}

impl From<f64> for Until {
    fn from(seconds: f64) -> Self {
        Self::Time(seconds)
    }
}

impl Until {
    /// As long as was asked, in ms, else until nothing can grow, but so many s at most.
    pub fn asked(window_ms: Option<f64>, most: f64) -> Self {
        window_ms.map_or(Self::Settled(most), |ms| Self::Time(ms * 1e-3))
    }

    /// The most there is to simulate, s.
    pub fn most(self) -> f64 {
        match self {
            Self::Time(most) | Self::Settled(most) => most,
        }
    }

    /// This with another most.
    pub(crate) fn within(self, most: f64) -> Self {
        match self {
            Self::Time(_) => Self::Time(most),
            Self::Settled(_) => Self::Settled(most),
        }
    }

    /// The share done at `time`; where the end is not known, a guess that only grows: a half when
    /// the slowest `swing` is over, s.
    pub(crate) fn share(self, time: f64, swing: f64) -> f64 {
        match self {
            Self::Time(most) => time / most,
            Self::Settled(_) => time / (time + swing),
        }
    }

    pub(crate) fn balance_every(self) -> f64 {
        match self {
            Self::Time(most) => most / BALANCES,
            Self::Settled(_) => BALANCE_EVERY,
        }
    }

    /// The spacing that a trace begins with, s.
    pub(crate) fn trace_every(self) -> f64 {
        match self {
            Self::Time(most) => most / TRACE_POINTS,
            Self::Settled(_) => TRACE_EVERY,
        }
    }

    /// Doubles the spacing `every` of traces that have grown too long, and leaves the values that
    /// would have been taken with it from the start.
    pub(crate) fn thin(self, traces: &mut Traces, every: &mut f64) {
        if matches!(self, Self::Settled(_)) && traces.time.len() as f64 >= 2.0 * TRACE_POINTS {
            *every *= 2.0;
            traces.thin(*every);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn thinned_traces_are_those_of_the_wider_spacing(
            steps in prop::collection::vec(1e-8..3e-6, 1..9000)
        ) {
            let until = Until::Settled(1.0);
            let mut every = until.trace_every();
            let mut kept = Traces::default();
            let (mut time, mut next) = (0.0, 0.0);
            let mut times = vec![];
            for step in steps {
                times.push(time);
                if time >= next {
                    kept.time.push(time);
                    until.thin(&mut kept, &mut every);
                    next = every * ((time / every).floor() + 1.0);
                }
                time += step;
            }
            let mut next = 0.0;
            times.retain(|time| {
                let due = *time >= next;
                if due {
                    next = every * ((time / every).floor() + 1.0);
                }
                due
            });
            prop_assert!(kept.time.len() < 2000);
            prop_assert_eq!(kept.time, times);
        }
    }

    #[test]
    fn the_share_done_never_falls_and_stays_below_one() {
        let share = |time| Until::Settled(60e-3).share(time, 3e-3);
        let shares: Vec<f64> = (0..100).map(|i| share(f64::from(i) * 1e-3)).collect();
        assert!(shares.is_sorted() && shares[0] == 0.0 && shares[99] < 1.0);
    }
}
