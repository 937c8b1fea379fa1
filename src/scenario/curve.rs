//! A force curve as a person recorded it: knots in time with straight lines between them.
//!
//! Each knot is a time in ms from the start of the blow and a share, the multiple of the
//! scenario's `force_n` that acts then. Before the first knot and after the last nothing acts.
//! Shares below 0 pull: a load cell rings through zero, and to cut that off would change the
//! impulse. Left out: smoothing, resampling and any search for the start of the blow.

use crate::scenario::problem::plain;
use serde::de::{Error, SeqAccess, Visitor};
use serde::{Deserialize, Deserializer, Serialize, Serializer};
use std::fmt;
use std::sync::Arc;

/// Times and shares, in order; cloning one copies no knot.
#[derive(Debug, Clone, PartialEq)]
pub struct Curve {
    knots: Arc<[(f64, f64)]>,
}

/// A curve that cannot be taken.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{0}")]
pub struct CurveError(String);

/// The time of the last knot, in ms, at least and at most.
const END_MS: (f64, f64) = (1e-4, 100.0);
/// The greatest share, either way.
const GREATEST_SHARE: f64 = 1e5;
/// Knots at least this share of their time apart, so that rounding can tell them from each other.
const LEAST_GAP: f64 = 1e-6;
/// Nothing but 0 is nearer to 0: no recording is.
const LEAST_SIZE: f64 = 1e-30;

impl Curve {
    /// The most knots: each stretch between two takes a few steps at least.
    pub const MAX_KNOTS: usize = 2000;

    /// A curve through knots of a time in ms and a share.
    ///
    /// # Errors
    /// Too few or too many knots, times that do not rise, numbers out of range.
    pub fn new(knots: impl IntoIterator<Item = (f64, f64)>) -> Result<Self, CurveError> {
        let mut growing = Growing::default();
        for (time, share) in knots {
            growing.push(time, share)?;
        }
        growing.finish()
    }

    /// Times in ms and shares.
    pub fn knots(&self) -> &[(f64, f64)] {
        &self.knots
    }

    /// Time of the last knot, in ms.
    pub fn last_ms(&self) -> f64 {
        self.knots[self.knots.len() - 1].0
    }

    /// The largest share, either way.
    pub fn peak(&self) -> f64 {
        self.knots.iter().fold(0.0, |peak, (_, share)| peak.max(share.abs()))
    }
}

/// A curve that is being read, knot by knot, so that the first bad one is known where it stands.
#[derive(Debug, Default)]
pub(super) struct Growing(Vec<(f64, f64)>);

impl Growing {
    /// Takes the next knot.
    pub fn push(&mut self, time: f64, share: f64) -> Result<(), CurveError> {
        let refused = |message: String| Err(CurveError(message));
        let (time_said, share_said) = (plain(time), plain(share));
        let (most, most_share) = (END_MS.1, plain(GREATEST_SHARE));
        if self.0.len() == Curve::MAX_KNOTS {
            let most = Curve::MAX_KNOTS;
            return refused(format!(
                "more than {most} knots; take every second or third of the recording"
            ));
        }
        for (what, number, said) in [("time", time, &time_said), ("share", share, &share_said)] {
            if !number.is_finite() {
                return refused(format!("{what} {said} is not a finite number"));
            }
            if number != 0.0 && number.abs() < LEAST_SIZE {
                return refused(format!("{what} {said} is too small, and not 0"));
            }
        }
        if !(0.0..=most).contains(&time) {
            return refused(format!(
                "time {time_said} is out of range: allowed 0 to {most} ms from the start of the blow"
            ));
        }
        if share.abs() > GREATEST_SHARE {
            return refused(format!(
                "share {share_said} is out of range: allowed -{most_share} to {most_share}"
            ));
        }
        if let Some(&(before, _)) = self.0.last() {
            let said = plain(before);
            if time <= before {
                return refused(format!(
                    "time {time_said} does not come after {said}: times must rise"
                ));
            }
            if time - before < LEAST_GAP * time {
                return refused(format!(
                    "time {time_said} is too close to {said}: knots lie a millionth of their time apart"
                ));
            }
        }
        // Of the two zeros, the one without a sign.
        self.0.push((time + 0.0, share + 0.0));
        Ok(())
    }

    /// The whole curve.
    pub fn finish(self) -> Result<Curve, CurveError> {
        let last = match self.0[..] {
            [.., _, last] => last.0,
            [_] => return Err(CurveError("one knot is no curve: it takes 2".to_owned())),
            [] => return Err(CurveError("no knots: a curve takes 2".to_owned())),
        };
        if last < END_MS.0 {
            return Err(CurveError(format!(
                "the curve ends at {} ms: allowed {} to {} ms (times are in ms)",
                plain(last),
                plain(END_MS.0),
                plain(END_MS.1)
            )));
        }
        Ok(Curve { knots: self.0.into() })
    }
}

impl Serialize for Curve {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_seq(self.knots.iter())
    }
}

impl<'de> Deserialize<'de> for Curve {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_seq(Knots)
    }
}

/// Reads knots one by one and stops at the first bad one.
struct Knots;

impl<'de> Visitor<'de> for Knots {
    type Value = Curve;

    fn expecting(&self, formatter: &mut fmt::Formatter) -> fmt::Result {
        formatter.write_str("a list of knots (t_ms, share)")
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<Curve, A::Error> {
        let mut growing = Growing::default();
        while let Some((time, share)) = list.next_element()? {
            growing.push(time, share).map_err(A::Error::custom)?;
        }
        growing.finish().map_err(A::Error::custom)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_curve_keeps_its_knots_and_knows_its_end_and_peak() {
        let knots = [(0.1, 0.0), (0.2, -3.0), (0.5, 2.0)];
        let curve = Curve::new(knots).unwrap();
        assert_eq!(curve.knots(), knots);
        assert_eq!((curve.last_ms(), curve.peak()), (0.5, 3.0));
        assert!(Curve::new((0..Curve::MAX_KNOTS).map(|i| (i as f64 * 1e-3, 1.0))).is_ok());
    }

    #[test]
    fn what_is_no_curve_is_refused_with_the_value() {
        for (knots, said) in [
            (&[(0.0, 0.0), (0.2, 1.0), (0.2, 0.0)][..], "0.2 does not come after 0.2"),
            (&[(1.0, 0.0), (1.000_000_1, 1.0)], "too close to 1"),
            (&[(-0.1, 0.0), (0.1, 1.0)], "time -0.1 is out of range"),
            (&[(0.0, 0.0), (101.0, 1.0)], "time 101 is out of range"),
            (&[(0.0, 0.0), (f64::INFINITY, 1.0)], "time inf is not"),
            (&[(0.0, 2e5), (0.1, 1.0)], "share 200000 is out of range"),
            (&[(0.0, 1e-300), (0.1, 1.0)], "share 1e-300 is too small"),
        ] {
            let complaint = Curve::new(knots.iter().copied()).unwrap_err().to_string();
            assert!(complaint.contains(said), "{complaint}");
        }
    }
}
