//! Cornea and sclera: a membrane with some bending stiffness, a chain of cones.
//!
//! With the stretches e1 along the meridian and e2 around the axis, a segment stores
//! A0 t E/(2 (1 - nu^2)) (e1^2 + e2^2 + 2 nu e1 e2), where A0 is its area at rest. Between two
//! segments it stores (D/2) (2 pi r0 / l0) (change of angle)^2 with D = E t^3/12(1 - nu^2). Left
//! out: shear across the thickness, and bending around the axis.

use crate::models::axisymmetric::eye::AxisymmetricEye;
use std::f64::consts::PI;

/// Share of the mass of cells beside it that moves with it, per length of a segment or quad, in the
/// bound of the step.
pub(crate) const ENTRAINED: f64 = 0.2;
/// Courant number of the shell over that of the cells.
const COURANT: f64 = 0.5 / 0.6;

#[derive(Debug, Clone, Copy, PartialEq)]
struct Piece {
    length: f64,
    radius: f64,
    /// A0 t E/(1 - nu^2), N m.
    membrane: f64,
    /// E/(1 - nu^2) of the sclera, Pa, times its share of the ring: under a blow at an angle rings
    /// hold cornea too, and the sclera must not take all of their tension as soon as a little of it
    /// is there.
    sclera: f64,
}

/// A node between two segments.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Hinge {
    /// D 2 pi r0 / l0, N m.
    stiffness: f64,
    /// Cosine and sine of its angle at rest.
    rest: (f64, f64),
}

/// The chain.
pub(crate) struct Shell {
    pieces: Vec<Piece>,
    hinges: Vec<Hinge>,
    poisson: f64,
    /// Longest stable step, s.
    pub limit: f64,
    /// Length of half the closed chain at rest, m.
    pub rest_length: f64,
}

/// What the shell does at some instant.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct ShellState {
    /// Length of half the closed chain, m.
    pub length: f64,
    /// Stored, J.
    pub energy: f64,
}

/// Cosine and sine of the angle from one side to another, times the length of both.
fn turn(a: (f64, f64), b: (f64, f64)) -> (f64, f64) {
    (a.0 * b.0 + a.1 * b.1, a.0 * b.1 - a.1 * b.0)
}

impl Shell {
    pub fn new(eye: &AxisymmetricEye) -> Self {
        let p = &eye.parameters.shell;
        let plane = 1.0 - p.poisson * p.poisson;
        let at: Vec<(f64, f64)> = eye.mesh.shell.iter().map(|&n| eye.at(n)).collect();
        let side: Vec<(f64, f64)> =
            at.windows(2).map(|e| (e[1].0 - e[0].0, e[1].1 - e[0].1)).collect();
        let mut limit = f64::INFINITY;
        let mut pieces = Vec::new();
        for (i, segment) in eye.segments.iter().enumerate() {
            let length = libm::hypot(side[i].0, side[i].1);
            let radius = 0.5 * (at[i].1 + at[i + 1].1);
            let stretch = segment.modulus * segment.thickness / plane;
            pieces.push(Piece {
                length,
                radius,
                membrane: 2.0 * PI * radius * length * stretch,
                sclera: segment.sclera * p.sclera_modulus / plane,
            });
            let areal = p.density * segment.thickness
                + ENTRAINED * eye.parameters.vitreous.density * length;
            limit = limit.min(COURANT * length * (areal / stretch).sqrt());
        }
        let hinges = (1..pieces.len())
            .map(|i| {
                let bending = |k: usize| {
                    let s = &eye.segments[k];
                    s.modulus * s.thickness.powi(3) / (12.0 * plane)
                };
                let length = 0.5 * (pieces[i - 1].length + pieces[i].length);
                let (cos, sin) = turn(side[i - 1], side[i]);
                let norm = libm::hypot(cos, sin);
                Hinge {
                    stiffness: 0.5 * (bending(i - 1) + bending(i)) * 2.0 * PI * at[i].1 / length,
                    rest: (cos / norm, sin / norm),
                }
            })
            .collect();
        Self {
            rest_length: pieces.iter().map(|p| p.length).sum(),
            pieces,
            hinges,
            poisson: p.poisson,
            limit,
        }
    }

    /// Adds its forces to `fx`, `fr`, all from front to back, and puts the tension of the sclera in
    /// each segment, along and around, in Pa, into `tension`.
    pub fn forces(
        &self,
        (x, r): (&[f64], &[f64]),
        (fx, fr): (&mut [f64], &mut [f64]),
        tension: &mut [[f64; 2]],
    ) -> ShellState {
        let mut state = ShellState::default();
        let mut before = (0.0, 0.0, 0.0);
        for (i, piece) in self.pieces.iter().enumerate() {
            let side = (x[i + 1] - x[i], r[i + 1] - r[i]);
            let length = (side.0 * side.0 + side.1 * side.1).sqrt();
            let e1 = length / piece.length - 1.0;
            let e2 = 0.5 * (r[i] + r[i + 1]) / piece.radius - 1.0;
            let (s1, s2) = (e1 + self.poisson * e2, e2 + self.poisson * e1);
            state.energy += 0.5 * piece.membrane * (e1 * s1 + e2 * s2);
            state.length += length;
            tension[i] = [piece.sclera * s1, piece.sclera * s2];
            let along = piece.membrane * s1 / (piece.length * length);
            let around = 0.5 * piece.membrane * s2 / piece.radius;
            fx[i] += along * side.0;
            fx[i + 1] -= along * side.0;
            fr[i] += along * side.1 - around;
            fr[i + 1] -= along * side.1 + around;
            if i > 0 {
                let hinge = self.hinges[i - 1];
                // Turned back by the angle at rest: a fold beyond half a turn is the short way
                // round.
                let (cos, sin) = turn(hinge.rest, turn((before.0, before.1), side));
                let change = libm::atan2(sin, cos);
                let moment = hinge.stiffness * change;
                state.energy += 0.5 * moment * change;
                // The angle grows as the second side turns anticlockwise or the first clockwise.
                let m1 = moment / (before.2 * before.2);
                let m2 = moment / (length * length);
                let (g1, g2) = ((before.1 * m1, -before.0 * m1), (-side.1 * m2, side.0 * m2));
                fx[i - 1] += g1.0;
                fr[i - 1] += g1.1;
                fx[i] += g2.0 - g1.0;
                fr[i] += g2.1 - g1.1;
                fx[i + 1] -= g2.0;
                fr[i + 1] -= g2.1;
            }
            before = (side.0, side.1, length);
        }
        state
    }
}
