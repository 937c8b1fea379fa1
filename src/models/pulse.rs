//! The force pulse in time, in SI units.
//!
//! A pulse is smooth except at its breaks; a table has one at every knot. Integrators end a
//! segment at every break and look up the force by segment, so that a jump has a left and a right
//! value and no step straddles it.

use crate::scenario::{Curve, ForcePulse, PulseShape};
use std::f64::consts::PI;

/// The part of a pulse between two breaks.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Piece {
    /// Rising edge.
    Rise,
    /// Constant.
    Plateau,
    /// Falling edge.
    Fall,
    /// Half a sine.
    Arch,
    /// A straight line of a table: start and end, in s, and the shares of the force there.
    Line([f64; 2], [f64; 2]),
    /// After the pulse.
    Nothing,
}

/// A stretch of time with a smooth load.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Segment {
    /// First instant, in s.
    pub start: f64,
    /// Last instant, in s.
    pub end: f64,
    /// What the force does in between.
    pub piece: Piece,
}

/// Total force against time; cloning one copies no table.
#[derive(Debug, Clone, PartialEq)]
pub struct Pulse {
    /// In N; the peak, but of a table the force that a share of 1 stands for.
    force: f64,
    duration: f64,
    shape: PulseShape,
}

/// The lines of a curve whose last knot falls at `duration` s, each with its end, from time 0 on
/// without gaps. Before the first knot nothing acts.
fn lines(curve: &Curve, duration: f64) -> Vec<(f64, Piece)> {
    let seconds = |ms: f64| ms / curve.last_ms() * duration;
    let knots = curve.knots();
    let wait = (knots[0].0 > 0.0).then_some([(0.0, 0.0), (knots[0].0, 0.0)]);
    let pairs = knots.windows(2).map(|pair| [pair[0], pair[1]]);
    let line = |[(start, first), (end, last)]: [(f64, f64); 2]| {
        (seconds(end), Piece::Line([seconds(start), seconds(end)], [first, last]))
    };
    wait.into_iter().chain(pairs).map(line).collect()
}

impl Pulse {
    /// The pulse of a scenario, in SI units.
    pub fn new(input: &ForcePulse) -> Self {
        let duration = input.duration_ms * 1e-3;
        Self { force: input.force_n, duration, shape: input.shape.clone() }
    }

    /// Time from the start of the blow to the last force, in s.
    pub fn duration(&self) -> f64 {
        self.duration
    }

    fn edge(&self) -> f64 {
        match self.shape {
            PulseShape::SmoothRectangle { edge_fraction } => edge_fraction * self.duration,
            _ => 0.5 * self.duration,
        }
    }

    /// Smooth stretches from 0 to `window` seconds, in order.
    pub fn segments(&self, window: f64) -> Vec<Segment> {
        let edge = self.edge();
        let t = self.duration;
        let pieces = match &self.shape {
            PulseShape::HalfSine => vec![(t, Piece::Arch)],
            PulseShape::Table(curve) => lines(curve, t),
            _ => vec![(edge, Piece::Rise), (t - edge, Piece::Plateau), (t, Piece::Fall)],
        };
        let mut start = 0.0;
        let mut segments = Vec::with_capacity(4);
        for (end, piece) in pieces.into_iter().chain([(window, Piece::Nothing)]) {
            let end = end.min(window);
            // An edge of no length is a jump, not a segment.
            if end - start > 1e-12 * t {
                segments.push(Segment { start, end, piece });
                start = end;
            }
        }
        segments
    }

    /// Force at time `t` by the law of `piece`, in N.
    pub fn force(&self, piece: Piece, t: f64) -> f64 {
        let raised = |s: f64| match self.shape {
            PulseShape::SmoothRectangle { .. } => 0.5 - 0.5 * libm::cos(PI * s),
            _ => s,
        };
        self.force
            * match piece {
                Piece::Rise => raised(t / self.edge()),
                Piece::Plateau => 1.0,
                Piece::Fall => raised((self.duration - t) / self.edge()),
                Piece::Arch => libm::sin(PI * t / self.duration),
                Piece::Line([start, end], [first, last]) => {
                    first + (last - first) * ((t - start) / (end - start))
                }
                Piece::Nothing => 0.0,
            }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn pulse(shape: PulseShape) -> Pulse {
        Pulse::new(&ForcePulse { force_n: 100.0, duration_ms: 0.2, shape, ..ForcePulse::default() })
    }

    fn table(knots: &[(f64, f64)]) -> PulseShape {
        PulseShape::Table(Curve::new(knots.iter().copied()).unwrap())
    }

    /// Shapes, and the mean share of the force over the duration of each.
    fn shapes() -> [(PulseShape, f64); 7] {
        [
            (PulseShape::SmoothRectangle { edge_fraction: 0.1 }, 0.9),
            (PulseShape::SmoothRectangle { edge_fraction: 0.0 }, 1.0),
            (PulseShape::SmoothRectangle { edge_fraction: 0.5 }, 0.5),
            (PulseShape::Triangle, 0.5),
            (PulseShape::HalfSine, 2.0 / PI),
            (table(&[(0.0, 0.5), (0.01, 1.0), (0.07, -0.2), (0.2, 0.1)]), 0.125),
            (table(&[(0.05, 0.5), (0.0501, 1.0), (0.4, 0.0)]), 0.437_562_5),
        ]
    }

    #[test]
    fn segments_cover_the_window_without_gaps_and_the_force_adds_up_to_the_impulse() {
        for (shape, mean) in shapes() {
            let pulse = pulse(shape.clone());
            for window in [1e-4, 2e-4, 3e-3] {
                let segments = pulse.segments(window);
                assert_eq!(segments[0].start, 0.0);
                assert!((segments.last().unwrap().end - window).abs() < 1e-18);
                assert!(segments.windows(2).all(|pair| pair[0].end == pair[1].start));
            }
            let sum = |s: &Segment| {
                let h = (s.end - s.start) / 20_000.0;
                let middles = (0..20_000).map(|i| s.start + (f64::from(i) + 0.5) * h);
                middles.map(|t| h * pulse.force(s.piece, t)).sum::<f64>()
            };
            let impulse: f64 = pulse.segments(3e-4).iter().map(sum).sum();
            assert!((impulse / (100.0 * 0.2e-3 * mean) - 1.0).abs() < 1e-8, "{shape:?}");
        }
    }

    /// The force just before and just after `t`, and at `t` if nothing jumps there.
    fn force_at(pulse: &Pulse, t: f64) -> Vec<f64> {
        let segments = pulse.segments(1e-3);
        let there = segments.iter().filter(|s| s.start <= t && t <= s.end);
        there.map(|s| pulse.force(s.piece, t)).collect()
    }

    #[test]
    fn a_table_of_a_simple_shape_is_that_shape() {
        let rectangle = PulseShape::SmoothRectangle { edge_fraction: 0.0 };
        for (table, shape) in [
            (table(&[(0.0, 0.0), (0.1, 1.0), (0.2, 0.0)]), PulseShape::Triangle),
            (table(&[(0.0, 1.0), (0.2, 1.0)]), rectangle),
        ] {
            let (table, shape) = (pulse(table), pulse(shape));
            for t in (0..40).map(|i| f64::from(i) * 0.71e-5) {
                let (a, b) = (force_at(&table, t), force_at(&shape, t));
                assert!((a[0] - b[0]).abs() < 1e-11, "{t}: {a:?} {b:?}");
                assert!((a[a.len() - 1] - b[b.len() - 1]).abs() < 1e-11, "{t}: {a:?} {b:?}");
            }
        }
    }

    #[test]
    fn a_table_jumps_at_its_ends_waits_for_its_first_knot_may_pull_and_follows_a_duration() {
        let pulse = pulse(table(&[(0.05, 0.5), (0.1, -1.0), (0.2, 0.25)]));
        assert_eq!(force_at(&pulse, 0.02e-3), [0.0]);
        assert_eq!(force_at(&pulse, 0.05e-3), [0.0, 50.0]);
        assert_eq!(force_at(&pulse, 0.1e-3), [-100.0, -100.0]);
        assert_eq!(force_at(&pulse, 0.2e-3), [25.0, 0.0]);
        // A duration stretches it.
        let mut input = ForcePulse { force_n: 100.0, ..ForcePulse::default() };
        input.follow(Curve::new([(0.02, 0.5), (0.05, 1.0), (0.1, 0.0)]).unwrap());
        assert_eq!(Pulse::new(&input).duration(), 0.1e-3);
        input.duration_ms *= 3.0;
        assert!((force_at(&Pulse::new(&input), 0.15e-3)[0] - 100.0).abs() < 1e-10);
    }
}
