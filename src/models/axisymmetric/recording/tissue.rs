//! What single tissues feel: the measures that injuries are read from.
//!
//! With the front angle of a place at rest counted from the front pole: the wall's stretch along
//! the meridian, l/l0 - 1, at its largest between 60 and 120 degrees (rupture), and as a mean over
//! the area from 150 degrees to the back pole (retina at the back); the growth of the shell's
//! radius at 62 degrees, where the retina's front edge lies; how much farther than at rest the
//! lens's equator is from the shell at 62 degrees (what holds the lens) and at 45 degrees (the root
//! of the iris). Each goes through a low pass of 20 us. A rigid motion gives none of them anything,
//! and a mean weighs each segment by what of its area lies within, so that no border jumps from
//! one segment to the next as the mesh changes.
//!
//! Left out: zonules, iris and retina as bodies of their own. Under a blow at an angle these places
//! are rings about the line of the blow, not the anatomical ones.

use crate::models::axisymmetric::eye::{AxisymmetricEye, distance, front_angle};
use crate::models::axisymmetric::forces::state::NodeState;
use crate::models::axisymmetric::recording::results::Extremes;
use crate::models::axisymmetric::recording::sensor::{LowPass, between, on_shell};
use std::f64::consts::PI;

/// Front angles between which the wall's largest stretch is looked for, in degrees.
pub(crate) const EQUATOR_DEG: (f64, f64) = (60.0, 120.0);
/// Front angles of the retina at the back, in degrees.
pub(crate) const BACK_DEG: (f64, f64) = (150.0, 180.0);
/// Front angle of the retina's front edge and of what holds the lens, in degrees.
pub(crate) const EDGE_DEG: f64 = 62.0;
/// Front angle of the root of the iris, in degrees.
pub(crate) const IRIS_DEG: f64 = 45.0;
/// Place of the lens's equator at rest, in m.
pub(crate) const LENS_EQUATOR: (f64, f64) = (-6.6e-3, 4.5e-3);

/// A weighted mean of places of nodes.
type Point = Vec<(usize, f64)>;

/// A segment of the shell with its length at rest, in m, and its weight.
#[derive(Debug, Clone, Copy)]
struct Piece {
    /// Place of its first node; that of its second is the next.
    first: usize,
    length: f64,
    weight: f64,
}

/// What the tissues of one eye are read with.
pub(crate) struct Tissues {
    equator: Vec<(Piece, LowPass)>,
    back: Vec<Piece>,
    edge: Point,
    /// Its distance from the axis at rest, in m.
    edge_rest: f64,
    lens: Point,
    /// Where the lens and the iris are held, and how far that is from the lens at rest, in m.
    held: [(Point, f64); 2],
    passed: [LowPass; 4],
    /// Measures after the low pass, in the order of [`Extremes::tissue`].
    pub now: [f64; 5],
}

fn at(point: &[(usize, f64)], x: &[f64], r: &[f64]) -> (f64, f64) {
    point.iter().fold((0.0, 0.0), |(px, pr), &(place, share)| {
        (px + share * x[place], pr + share * r[place])
    })
}

/// Share of a stretch of front angles that lies within limits in degrees.
fn share_within((low, high): (f64, f64), (from, to): (f64, f64)) -> f64 {
    let within = high.min(to.to_radians()) - low.max(from.to_radians());
    (within / (high - low)).max(0.0)
}

impl Tissues {
    /// At rest; `place` tells where a node's coordinates lie in `state`.
    pub fn new(
        eye: &AxisymmetricEye,
        state: &NodeState,
        place: impl Fn(usize) -> usize + Copy,
    ) -> Self {
        let (x, r) = (&state.x, &state.r);
        let segments = eye.mesh.shell.windows(2).map(|ends| {
            let (a, b) = (eye.at(ends[0]), eye.at(ends[1]));
            let length = distance(a, b);
            let piece = Piece { first: place(ends[0]), length, weight: length * PI * (a.1 + b.1) };
            ((front_angle(a), front_angle(b)), piece)
        });
        let (mut equator, mut back) = (Vec::new(), Vec::new());
        for (angles, piece) in segments {
            if share_within(angles, EQUATOR_DEG) >= 0.5 {
                equator.push((piece, LowPass::default()));
            }
            let weight = piece.weight * share_within(angles, BACK_DEG);
            if weight > 0.0 {
                back.push(Piece { weight, ..piece });
            }
        }
        let whole: f64 = back.iter().map(|piece| piece.weight).sum();
        for piece in &mut back {
            piece.weight /= whole;
        }
        let lens = between(eye, LENS_EQUATOR, place);
        let edge = on_shell(eye, EDGE_DEG.to_radians(), place);
        let root = on_shell(eye, IRIS_DEG.to_radians(), place);
        let from_lens = |of: &Point| (of.clone(), distance(at(of, x, r), at(&lens, x, r)));
        Self {
            equator,
            back,
            held: [&edge, &root].map(from_lens),
            edge_rest: at(&edge, x, r).1,
            edge,
            lens,
            passed: [LowPass::default(); 4],
            now: [0.0; 5],
        }
    }

    /// Offers them to the extremes at `time`, in s; `share` is that of a low pass.
    pub fn read(&mut self, state: &NodeState, share: f64, time: f64, extremes: &mut Extremes) {
        let (x, r) = (&state.x[..], &state.r[..]);
        let stretch = |piece: &Piece| {
            let i = piece.first;
            let (dx, dr) = (x[i + 1] - x[i], r[i + 1] - r[i]);
            (dx * dx + dr * dr).sqrt() / piece.length - 1.0
        };
        let mut largest = 0.0_f64;
        for (piece, passed) in &mut self.equator {
            largest = largest.max(passed.pass(stretch(piece), share));
        }
        let back: f64 = self.back.iter().map(|p| p.weight * stretch(p)).sum();
        let edge = at(&self.edge, x, r).1 / self.edge_rest - 1.0;
        let lens = at(&self.lens, x, r);
        let [lens, iris] =
            self.held.each_ref().map(|(of, rest)| distance(at(of, x, r), lens) - rest);
        let raw = [back, edge, lens, iris];
        self.now[0] = largest;
        for ((now, passed), raw) in self.now[1..].iter_mut().zip(&mut self.passed).zip(raw) {
            *now = passed.pass(raw, share);
        }
        for (peak, now) in extremes.tissue.iter_mut().zip(self.now) {
            peak.offer(now, time);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::models::axisymmetric::forces::state::Cells;
    use crate::models::axisymmetric::{eye::parameters::Parameters, forces::plain::PlainCells};

    /// What is read where each node has gone from (x, r) to `moved`, once a low pass is over.
    fn read(level: u32, moved: impl Fn(f64, f64) -> (f64, f64)) -> [f64; 5] {
        let eye = AxisymmetricEye::new(&Parameters::default(), level);
        let cells = PlainCells::new(&eye);
        let mut state = cells.rest();
        let mut tissues = Tissues::new(&eye, &state, |node| cells.place(node));
        for i in 0..state.x.len() {
            (state.x[i], state.r[i]) = moved(state.x[i], state.r[i]);
        }
        let mut extremes = Extremes::at_rest();
        for step in 0..3 {
            tissues.read(&state, 1.0, f64::from(step), &mut extremes);
        }
        extremes.tissue.map(|peak| peak.value)
    }

    #[test]
    fn moving_and_turning_as_a_whole_is_felt_by_nothing() {
        for level in 1..=3 {
            assert!(read(level, |x, r| (x + 3e-3, r)).iter().all(|m| *m < 1e-12));
            // A turn is no motion of a body of revolution, but no distance in its section changes.
            let (sin, cos) = 0.3_f64.sin_cos();
            let turned = read(level, |x, r| (cos * x - sin * r, sin * x + cos * r));
            for measure in [0, 1, 3, 4] {
                assert!(turned[measure] < 1e-12, "{turned:?}");
            }
        }
    }

    #[test]
    fn an_eye_that_grows_by_a_share_is_stretched_by_it_everywhere() {
        for level in 1..=3 {
            let radius = Parameters::default().radius;
            let grown = read(level, |x, r| (1.05 * x, 1.05 * r));
            for stretch in &grown[..3] {
                assert!((stretch - 0.05).abs() < 1e-12, "{level}: {grown:?}");
            }
            for (pull, angle) in grown[3..].iter().zip([EDGE_DEG, IRIS_DEG]) {
                let (sin, cos) = angle.to_radians().sin_cos();
                let held = distance((-radius * cos, radius * sin), LENS_EQUATOR);
                // Between two nodes the shell is straight, not round.
                assert!((pull / (0.05 * held) - 1.0).abs() < 0.02, "{level}: {grown:?}");
            }
        }
        // Shrinking is no stretch.
        assert_eq!(read(1, |x, r| (0.9 * x, 0.9 * r)), [0.0; 5]);
    }
}
