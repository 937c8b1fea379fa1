//! The hinges between quads of the shell: its bending stiffness; see [`super::shell`].

#![allow(clippy::needless_range_loop, reason = "corners, components and lanes go together")]

use crate::models::paper::forces::layout::{LANES, Lane};
use crate::models::spatial::eye::SpatialEye;
use crate::models::spatial::forces::math::{
    Math, Plain, Three, Wide, by_component, cross, dot, minus, plus, times,
};
use crate::models::spatial::forces::state::NodeState;
use fearless_simd::Simd;
use std::collections::BTreeMap;

/// Least of 1 + the cosine of a hinge's angle, where one has closed.
const LEAST: f64 = 1e-3;

/// Eight hinges.
struct Group {
    /// Both ends of the edge, and the ends of the edges beyond on either side.
    nodes: [[u32; LANES]; 6],
    /// -1 where the second side is the image of the first, else 1.
    sign: Lane,
    /// D le/h, J; half of it at a mirror.
    stiffness: Lane,
    /// f at rest.
    rest: Lane,
    present: usize,
}

/// All hinges.
pub(crate) struct Hinges {
    groups: Vec<Group>,
}

/// A hinge to be put into a group.
#[derive(Debug, Clone, Copy)]
struct Hinge {
    nodes: [usize; 6],
    sign: f64,
    stiffness: f64,
    rest: f64,
}

/// f and how it changes with the ends of the edge and the middles beyond.
struct Bent<N> {
    f: N,
    slopes: [Three<N>; 4],
}

#[inline(always)]
fn bent<M: Math>(
    m: M,
    a: Three<M::N>,
    b: Three<M::N>,
    c: Three<M::N>,
    d: Three<M::N>,
) -> Bent<M::N> {
    let one = m.number(1.0);
    let e = minus(b, a);
    let (to_c, to_d) = (minus(c, a), minus(d, a));
    let (n1, n2) = (cross(e, to_c), cross(to_d, e));
    let (square, s1, s2) = (dot(e, e), dot(n1, n1), dot(n2, n2));
    let length = m.root(square);
    let inverse = m.over(one, m.root(s1 * s2));
    let cosine = dot(n1, n2) * inverse;
    let sine = m.over(dot(cross(n1, n2), e) * inverse, length);
    let f = m.over(m.number(2.0) * sine, m.most(one + cosine, m.number(LEAST)));
    // Of f for the angle, times the way of the angle with what lies beyond.
    let by = one + f * f * m.number(0.25);
    let on_c = times(n1, -(by * m.over(length, s1)));
    let on_d = times(n2, -(by * m.over(length, s2)));
    let inverse_square = m.over(one, square);
    let (tc, td) = (dot(to_c, e) * inverse_square, dot(to_d, e) * inverse_square);
    let on_a = plus(times(on_c, tc - one), times(on_d, td - one));
    let on_b = minus([m.number(0.0); 3], plus(times(on_c, tc), times(on_d, td)));
    Bent { f, slopes: [on_a, on_b, on_c, on_d] }
}

impl Hinges {
    pub fn new(eye: &SpatialEye) -> Self {
        let at = |node: usize| <[f64; 3]>::from(eye.mesh.at[node]);
        let plane = 1.0 - eye.parameters.shell.poisson.powi(2);
        let mut sides = BTreeMap::<[usize; 2], Vec<(usize, usize)>>::new();
        for (number, quad) in eye.quads.iter().enumerate() {
            for i in 0..4 {
                let (a, b) = (quad.corners[i], quad.corners[(i + 1) % 4]);
                sides.entry([a.min(b), a.max(b)]).or_default().push((number, i));
            }
        }
        let bending = |quad: usize| {
            let quad = eye.quads[quad];
            quad.modulus * quad.thickness.powi(3) / (12.0 * plane)
        };
        let hinges = sides.values().filter_map(|of| {
            let (first, i) = of[0];
            let corner = |quad: usize, i: usize| eye.quads[quad].corners[i % 4];
            let (a, b) = (corner(first, i), corner(first, i + 1));
            let beyond = [corner(first, i + 2), corner(first, i + 3)];
            let (second, other, sign) = match of.get(1) {
                Some(&(quad, i)) => (quad, [corner(quad, i + 2), corner(quad, i + 3)], 1.0),
                None if eye.on_mirror(a) && eye.on_mirror(b) => (first, beyond, -1.0),
                None => return None,
            };
            let middle = |[p, q]: [usize; 2]| times(plus(at(p), at(q)), 0.5);
            let (c, mut d) = (middle(beyond), middle(other));
            d[2] *= sign;
            let edge = minus(at(b), at(a));
            let length = dot(edge, edge).sqrt();
            let height = |of: [f64; 3]| {
                let n = cross(edge, minus(of, at(a)));
                dot(n, n).sqrt() / length
            };
            let apart = 0.5 * (height(c) + height(d));
            let copies = if sign < 0.0 { 0.5 } else { 1.0 };
            Some(Hinge {
                nodes: [a, b, beyond[0], beyond[1], other[0], other[1]],
                sign,
                stiffness: copies * 0.5 * (bending(first) + bending(second)) * length / apart,
                rest: bent(Plain, at(a), at(b), c, d).f,
            })
        });
        let hinges: Vec<Hinge> = hinges.collect();
        let groups = hinges.chunks(LANES).map(|hinges| {
            let of = |lane: usize| hinges[lane.min(hinges.len() - 1)];
            Group {
                nodes: std::array::from_fn(|i| {
                    std::array::from_fn(|lane| of(lane).nodes[i] as u32)
                }),
                sign: std::array::from_fn(|lane| of(lane).sign),
                stiffness: std::array::from_fn(|lane| {
                    if lane < hinges.len() { of(lane).stiffness } else { 0.0 }
                }),
                rest: std::array::from_fn(|lane| of(lane).rest),
                present: hinges.len(),
            }
        });
        Self { groups: groups.collect() }
    }

    /// Adds their forces to those of nodes; returns what they store, J.
    #[inline(always)]
    pub fn forces<S: Simd>(&self, simd: S, state: &mut NodeState) -> f64 {
        let m = Wide(simd);
        let half = m.number(0.5);
        let mut stored: Lane = [0.0; LANES];
        let mut at = [[[0.0; LANES]; 3]; 6];
        let mut on = [[[0.0; LANES]; 3]; 4];
        for group in &self.groups {
            for i in 0..6 {
                for k in 0..3 {
                    for lane in 0..LANES {
                        at[i][k][lane] = state.at[k][group.nodes[i][lane] as usize];
                    }
                }
            }
            for lane in (0..LANES).step_by(<Wide<S> as Math>::WIDTH) {
                let sign = m.load(&group.sign, lane);
                let a = by_component!(k => m.load(&at[0][k], lane));
                let b = by_component!(k => m.load(&at[1][k], lane));
                let c =
                    by_component!(k => (m.load(&at[2][k], lane) + m.load(&at[3][k], lane)) * half);
                let mut d =
                    by_component!(k => (m.load(&at[4][k], lane) + m.load(&at[5][k], lane)) * half);
                d[2] *= sign;
                let bent = bent(m, a, b, c, d);
                let over = bent.f - m.load(&group.rest, lane);
                let moment = m.load(&group.stiffness, lane) * over;
                let sum = m.load(&stored, lane) + half * moment * over;
                m.store(sum, &mut stored, lane);
                let push = -moment;
                for i in 0..4 {
                    for k in 0..3 {
                        let mut force = bent.slopes[i][k] * push;
                        if i > 1 {
                            force *= half;
                        }
                        if i == 3 && k == 2 {
                            force *= sign;
                        }
                        m.store(force, &mut on[i][k], lane);
                    }
                }
            }
            for i in 0..6 {
                let on = &on[[0, 1, 2, 2, 3, 3][i]];
                for k in 0..3 {
                    for lane in 0..group.present {
                        state.force[k][group.nodes[i][lane] as usize] += on[k][lane];
                    }
                }
            }
        }
        stored.iter().sum()
    }
}
