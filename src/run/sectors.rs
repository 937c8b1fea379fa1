//! What tissues felt by clock hour, where a model tells it: the rows of a fundus chart.
//!
//! Hours are counted from 12 o'clock towards the nose: at a right eye, as an examiner sees it, they
//! are those of the clock, at a left eye they run against it. Values are in SI.

/// Clock hours.
pub const HOURS: usize = 12;
/// Quadrants: upper at the nose, lower at the nose, lower at the temple, upper at the temple.
pub const QUADRANTS: usize = 4;

/// The largest values over time.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Sectors {
    /// Stretch of the wall along the meridian between 60 and 120 degrees from the front.
    pub equator: [f64; HOURS],
    /// Stretch of the ring at the retina's front edge.
    pub edge: [f64; HOURS],
    /// Mean stretch of the wall along the meridian at the back.
    pub back: [f64; QUADRANTS],
    /// How much farther than at rest the lens's equator is from what holds it, m.
    pub lens: [f64; HOURS],
    /// How much farther than at rest it is from the root of the iris, m.
    pub iris: [f64; HOURS],
}

impl Sectors {
    /// The hour with the largest of some values, of several the first.
    pub fn strongest(of: &[f64]) -> usize {
        (1..of.len()).fold(0, |most, hour| if of[hour] > of[most] { hour } else { most })
    }
}
