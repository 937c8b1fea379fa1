//! Cornea and sclera: a membrane of quads with some bending stiffness, without rotations.
//!
//! From the metric C of two edges against that at rest come the determinant and the trace of the
//! stretch, d = sqrt(det C) and s = sqrt(tr C + 2 d), and the law of the axisymmetric shell in
//! them,
//!
//!   W = E/(2 (1 - nu^2)) (s^2 - 2 (1 + nu) s - 2 (1 - nu) d + 2 (1 + nu)),
//!
//! needs no principal directions. Three quarters of a quad are its middle, a quarter its four
//! corners, so that no motion of it is free. Between two quads lies a hinge: with the angle from
//! one to the other, each spanned by their edge and the middle of the edge beyond, and
//! f = 2 tan(angle/2) less that at rest, it stores (D/2) (le/h) f^2, where le is the length of the
//! edge, h the distance of the middles and D = E t^3/12 (1 - nu^2). At a mirror the other quad is
//! the image of the first. Left out: shear across the thickness.

#![allow(clippy::needless_range_loop, reason = "corners, components and lanes go together")]

use crate::models::axisymmetric::forces::shell::ENTRAINED;
use crate::models::paper::forces::layout::{LANES, Lane};
use crate::models::spatial::eye::{SpatialEye, area, upon};
use crate::models::spatial::forces::hinge::Hinges;
use crate::models::spatial::forces::math::{
    Math, Three, Wide, by_component, dot, minus, plus, times,
};
use crate::models::spatial::forces::state::NodeState;
use fearless_simd::{Level, Simd, dispatch};
use nalgebra::{Matrix2, Vector3};

/// Courant number of the shell over that of the cells.
const COURANT: f64 = 0.5;
/// How much of a quad is its middle.
const MIDDLE: f64 = 0.75;
/// Least determinant of a metric, where a quad is flat as a line.
const LEAST: f64 = 1e-6;

/// What is constant of the middle or a corner of eight quads.
#[derive(Debug, Clone, Copy, Default)]
struct Metric {
    /// From edges to unit vectors at rest, by rows.
    rest: [Lane; 4],
    /// E t A/(2 (1 - nu^2)), J.
    stiffness: Lane,
}

/// Eight quads.
struct Group {
    corners: [[u32; LANES]; 4],
    /// The middle, then the corners.
    metrics: [Metric; 5],
    /// E/(1 - nu^2) of the sclera, Pa, times its share.
    sclera: Lane,
    present: usize,
}

/// Cornea and sclera.
pub(crate) struct Shell {
    groups: Vec<Group>,
    hinges: Hinges,
    quads: usize,
    poisson: f64,
    level: Level,
    /// Largest tension of the sclera in each quad, Pa.
    pub tension: Vec<f64>,
    /// Stretch of each quad along the meridian, as a share.
    pub along: Vec<f64>,
    /// Longest stable step, s.
    pub limit: f64,
}

/// Unit vectors along the meridian to the back, and around the axis, in the plane of two edges.
fn directions(at: Vector3<f64>, edges: [Vector3<f64>; 2]) -> [Vector3<f64>; 2] {
    let normal = edges[0].cross(&edges[1]).normalize();
    let back = Vector3::x();
    let along = back - at * (back.dot(&at) / at.norm_squared());
    let along = along - normal * normal.dot(&along);
    let along = if along.norm() > 1e-9 { along.normalize() } else { edges[0].normalize() };
    [along, normal.cross(&along)]
}

/// From edges to unit vectors at rest, by rows.
fn rest(at: Vector3<f64>, edges: [Vector3<f64>; 2]) -> [f64; 4] {
    let to = directions(at, edges);
    let of = Matrix2::from_fn(|row, column| to[row].dot(&edges[column]));
    let inverse = of.try_inverse().unwrap_or_else(Matrix2::identity);
    [inverse[(0, 0)], inverse[(0, 1)], inverse[(1, 0)], inverse[(1, 1)]]
}

/// Edges of the middle of a quad and of its corners, from its nodes in order.
fn edges(p: [Vector3<f64>; 4]) -> [[Vector3<f64>; 2]; 5] {
    let corner = |i: usize| [p[(i + 1) % 4] - p[i], p[(i + 3) % 4] - p[i]];
    [
        [(p[1] + p[2] - p[0] - p[3]) * 0.5, (p[2] + p[3] - p[0] - p[1]) * 0.5],
        corner(0),
        corner(1),
        corner(2),
        corner(3),
    ]
}

impl Shell {
    pub fn new(eye: &SpatialEye, level: Level) -> Self {
        let p = &eye.parameters.shell;
        let plane = 1.0 - p.poisson * p.poisson;
        let mut limit = f64::INFINITY;
        let mut groups = Vec::new();
        for quads in eye.quads.chunks(LANES) {
            let mut group = Group {
                corners: [[0; LANES]; 4],
                metrics: [Metric::default(); 5],
                sclera: [0.0; LANES],
                present: quads.len(),
            };
            for lane in 0..LANES {
                let quad = quads[lane.min(quads.len() - 1)];
                let at = quad.corners.map(|node| eye.mesh.at[node]);
                let shell = quad.modulus * quad.thickness / plane;
                let whole = area(&at);
                let doubled: f64 = edges(at)[1..].iter().map(|[a, b]| a.cross(b).norm()).sum();
                for (i, edges) in edges(at).into_iter().enumerate() {
                    let metric = &mut group.metrics[i];
                    let middle = upon(&at, 0.5, 0.5);
                    for (to, value) in metric.rest.iter_mut().zip(rest(middle, edges)) {
                        to[lane] = value;
                    }
                    let share = if i == 0 {
                        MIDDLE
                    } else {
                        (1.0 - MIDDLE) * edges[0].cross(&edges[1]).norm() / doubled
                    };
                    metric.stiffness[lane] = 0.5 * shell * whole * share;
                }
                for (to, node) in group.corners.iter_mut().zip(quad.corners) {
                    to[lane] = node as u32;
                }
                group.sclera[lane] = quad.sclera * p.sclera_modulus / plane;
                let sides = (0..4).map(|i| (at[(i + 1) % 4] - at[i]).norm());
                let shortest = sides.fold(f64::INFINITY, f64::min);
                let areal = p.density * quad.thickness
                    + ENTRAINED * eye.parameters.vitreous.density * shortest;
                limit = limit.min(COURANT * shortest * (areal / shell).sqrt());
            }
            groups.push(group);
        }
        Self {
            groups,
            hinges: Hinges::new(eye),
            quads: eye.quads.len(),
            poisson: p.poisson,
            level,
            tension: vec![0.0; eye.quads.len().next_multiple_of(LANES)],
            along: vec![0.0; eye.quads.len().next_multiple_of(LANES)],
            limit,
        }
    }

    /// Adds the forces of the shell to those of nodes; returns what it stores, J.
    pub fn forces(&mut self, state: &mut NodeState) -> f64 {
        let level = self.level;
        let quads = dispatch!(level, simd => membrane(simd, self, state));
        let hinges = &self.hinges;
        quads + dispatch!(level, simd => hinges.forces(simd, state))
    }

    /// Tension of the sclera in each quad, Pa.
    pub fn tensions(&self) -> &[f64] {
        &self.tension[..self.quads]
    }
}

/// Forces on two edges, what is stored, the metric, and its determinant and trace as stretches.
struct Stretched<N> {
    on: [Three<N>; 2],
    energy: N,
    along: N,
    s: N,
    d: N,
}

#[inline(always)]
fn stretched<M: Math>(
    m: M,
    metric: &Metric,
    lane: usize,
    g: [Three<M::N>; 2],
    poisson: f64,
) -> Stretched<M::N> {
    let h: [M::N; 4] = [
        m.load(&metric.rest[0], lane),
        m.load(&metric.rest[1], lane),
        m.load(&metric.rest[2], lane),
        m.load(&metric.rest[3], lane),
    ];
    let first = plus(times(g[0], h[0]), times(g[1], h[2]));
    let second = plus(times(g[0], h[1]), times(g[1], h[3]));
    let (c11, c22, c12) = (dot(first, first), dot(second, second), dot(first, second));
    let d = m.root(m.most(c11 * c22 - c12 * c12, m.number(LEAST)));
    let s = m.root(c11 + c22 + d + d);
    let stiffness = m.load(&metric.stiffness, lane);
    let by_s = m.number(2.0) - m.over(m.number(2.0 * (1.0 + poisson)), s);
    let by_d = m.over(by_s - m.number(2.0 * (1.0 - poisson)), d);
    // Twice the slopes of the energy for c11 and c22, and that for c12.
    let on_11 = stiffness * (by_s + by_d * c22);
    let on_22 = stiffness * (by_s + by_d * c11);
    let on_12 = -(stiffness * by_d * c12);
    let to_first = plus(times(first, on_11), times(second, on_12));
    let to_second = plus(times(second, on_22), times(first, on_12));
    let constant = m.number(2.0 * (1.0 + poisson));
    let energy =
        stiffness * (s * s - constant * s - m.number(2.0 * (1.0 - poisson)) * d + constant);
    Stretched {
        on: [
            plus(times(to_first, h[0]), times(to_second, h[1])),
            plus(times(to_first, h[2]), times(to_second, h[3])),
        ],
        energy,
        along: c11,
        s,
        d,
    }
}

#[inline(always)]
fn membrane<S: Simd>(simd: S, shell: &mut Shell, state: &mut NodeState) -> f64 {
    let m = Wide(simd);
    let half = m.number(0.5);
    let mut stored: Lane = [0.0; LANES];
    let mut at = [[[0.0; LANES]; 3]; 4];
    let mut on = at;
    for (number, group) in shell.groups.iter().enumerate() {
        for i in 0..4 {
            for k in 0..3 {
                for lane in 0..LANES {
                    at[i][k][lane] = state.at[k][group.corners[i][lane] as usize];
                }
            }
        }
        for lane in (0..LANES).step_by(<Wide<S> as Math>::WIDTH) {
            let p = [
                by_component!(k => m.load(&at[0][k], lane)),
                by_component!(k => m.load(&at[1][k], lane)),
                by_component!(k => m.load(&at[2][k], lane)),
                by_component!(k => m.load(&at[3][k], lane)),
            ];
            let mut force = [[m.number(0.0); 3]; 4];
            let first = times(minus(plus(p[1], p[2]), plus(p[0], p[3])), half);
            let second = times(minus(plus(p[2], p[3]), plus(p[0], p[1])), half);
            let of = stretched(m, &group.metrics[0], lane, [first, second], shell.poisson);
            let (a, b) = (times(of.on[0], half), times(of.on[1], half));
            force[0] = plus(force[0], plus(a, b));
            force[1] = plus(force[1], minus(b, a));
            force[2] = minus(force[2], plus(a, b));
            force[3] = plus(force[3], minus(a, b));
            let mut energy = of.energy;
            let (one, place) = (m.number(1.0), number * LANES + lane);
            m.store(m.root(of.along) - one, &mut shell.along, place);
            let apart = m.root(m.most(of.s * of.s * m.number(0.25) - of.d, m.number(0.0)));
            let (most, least) = (of.s * half + apart, of.s * half - apart);
            let poisson = m.number(shell.poisson);
            let tension = m.load(&group.sclera, lane) * (most - one + poisson * (least - one));
            m.store(tension, &mut shell.tension, place);
            for i in 0..4 {
                let (next, before) = ((i + 1) % 4, (i + 3) % 4);
                let edges = [minus(p[next], p[i]), minus(p[before], p[i])];
                let of = stretched(m, &group.metrics[i + 1], lane, edges, shell.poisson);
                energy += of.energy;
                force[next] = minus(force[next], of.on[0]);
                force[before] = minus(force[before], of.on[1]);
                force[i] = plus(force[i], plus(of.on[0], of.on[1]));
            }
            for i in 0..4 {
                for k in 0..3 {
                    m.store(force[i][k], &mut on[i][k], lane);
                }
            }
            let sum = m.load(&stored, lane) + energy;
            m.store(sum, &mut stored, lane);
        }
        for i in 0..4 {
            for k in 0..3 {
                for lane in 0..group.present {
                    state.force[k][group.corners[i][lane] as usize] += on[i][k][lane];
                }
            }
        }
    }
    stored.iter().sum()
}
