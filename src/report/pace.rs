//! How far long work is and how long it goes on, in words: `59 of 256, about 20 s`.
//!
//! The time left is what is left of the work at the pace of what was done so far. It is said in
//! round numbers that count down; only where the work turns out much longer do they rise, so that
//! nobody reads a jumping figure.

use std::time::Duration;

/// The times that are said, in s.
const SAID: [f64; 19] = [
    2.0, 5.0, 10.0, 15.0, 20.0, 30.0, 45.0, 60.0, 120.0, 180.0, 300.0, 600.0, 900.0, 1200.0,
    1800.0, 3600.0, 7200.0, 18000.0, 36000.0,
];
/// No time is said before this many s have passed and this share is done; of work of hours a
/// smaller share tells, after so many s.
const FIRST: (f64, f64) = (1.0, 0.002);
const LATEST: f64 = 5.0;
/// The time that is said rises only where the work takes this many times as long.
const LONGER: f64 = 1.5;

#[derive(Debug, Clone, Copy, Default)]
pub struct Pace {
    /// The share done at the first report, and its time, in s.
    first: Option<(f64, f64)>,
    /// The share done last.
    pub share: f64,
    /// How long the rest takes, in s and as it is said, once that is known.
    pub left: Option<f64>,
    /// How much is done in 1 s, once that is known.
    rate: Option<f64>,
}

impl Pace {
    /// Takes the share done, from 0 to 1, at a time in s from the beginning.
    pub fn advance(&mut self, share: f64, elapsed: Duration) {
        let now = elapsed.as_secs_f64();
        if share < 0.5 * self.share {
            // Another part of the work has begun.
            *self = Self::default();
        }
        self.share = share;
        let (before, began) = *self.first.get_or_insert((share, now));
        let (done, took) = (share - before, now - began);
        if took < FIRST.0 || done <= 0.0 || (done < FIRST.1 && took < LATEST) {
            return;
        }
        self.rate = Some(done / took);
        let left = (1.0 - share) * took / done;
        let near = near(left);
        let keeps = |said: &f64| near > *said && left < LONGER * said;
        self.left = Some(self.left.filter(keeps).unwrap_or(near));
    }

    /// How long it takes until this share is done, in words, once that is known.
    pub fn until(&self, share: f64) -> Option<String> {
        let left = (share - self.share).max(0.0) / self.rate?;
        Some(time(near(left)))
    }

    /// The progress as a count of pieces where they are counted, else in %.
    pub fn done(&self, of: Option<usize>) -> String {
        match of {
            // What is nearly done is not yet.
            Some(of) => format!("{} of {of}", (self.share * of as f64 + 1e-6).floor()),
            None => format!("{:.0} %", (100.0 * self.share).floor()),
        }
    }

    /// The progress, and how long the rest takes, once that is known.
    pub fn words(&self, of: Option<usize>) -> String {
        let left = self.left.map_or_else(String::new, |left| format!(", {}", time(left)));
        self.done(of) + &left
    }
}

/// The least time of [`SAID`] that is no less than this, in s.
fn near(left: f64) -> f64 {
    SAID.into_iter().find(|said| left <= *said).unwrap_or(SAID[SAID.len() - 1])
}

fn time(seconds: f64) -> String {
    match seconds {
        s if s >= 3600.0 => format!("about {} h", s / 3600.0),
        s if s >= 60.0 => format!("about {} min", s / 60.0),
        s => format!("about {s} s"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_time_left_counts_down_and_rises_only_where_the_work_turns_out_longer() {
        let mut pace = Pace::default();
        let mut at = |share: f64, ms: u64| {
            pace.advance(share, Duration::from_millis(ms));
            pace.words(Some(256))
        };
        assert_eq!(at(0.0, 0), "0 of 256");
        assert_eq!(at(0.02, 500), "5 of 256", "too early to say");
        assert_eq!(at(0.1, 2000), "25 of 256, about 20 s");
        // A little slower, a little faster: nothing moves.
        assert_eq!(at(0.15, 3800), "38 of 256, about 20 s");
        assert_eq!(at(0.2, 4200), "51 of 256, about 20 s");
        assert_eq!(at(0.5, 10_000), "128 of 256, about 10 s");
        assert_eq!(at(0.51, 40_000), "130 of 256, about 45 s");
        assert_eq!(at(1.0, 78_000), "256 of 256, about 2 s");
    }

    #[test]
    fn work_that_goes_on_tells_its_time_by_what_it_does_now() {
        let mut pace = Pace::default();
        pace.advance(0.9, Duration::ZERO);
        pace.advance(0.91, Duration::from_secs(10));
        assert_eq!(pace.words(None), "91 %, about 2 min");
        assert_eq!(pace.until(0.92).unwrap(), "about 10 s");
        assert_eq!(pace.until(0.5).unwrap(), "about 2 s", "soon");
        assert_eq!(Pace::default().until(0.5), None);
        pace.advance(0.95, Duration::from_secs(10_000));
        assert_eq!(pace.words(None), "95 %, about 5 h");
    }
}
