//! One pass over the mesh: the four grid springs of each node, the force on it, and its update.
//!
//! The pass goes up through the vectors that hold anything that moves. Each computes the springs
//! that its nodes own, adds what the vectors below and to the left have left for it, and hands on
//! its part; then its nodes may move at once, as nothing that comes later needs their old places.

#![allow(
    clippy::inline_always,
    reason = "what is called within a vector dispatch must be compiled for its instructions"
)]

use super::lanes::{
    Pair, Springs, Sums, V, fused, inverse_root, load, load_pair, shifted, splat, store, zeros,
};
use super::state::State;
use super::system::{DIRECTIONS, Group, LANES, SurveyGroup, System};
use fearless_simd::{Simd, SimdBase};

/// What an update may read and write of the nodes that start at `slot`.
pub(super) struct Nodes<'a, S: Simd> {
    pub simd: S,
    pub slot: usize,
    /// Place of the first node in its group.
    pub lane: usize,
    pub group: &'a Group,
    pub position: Pair<S>,
    pub vx: &'a mut [f64],
    pub vy: &'a mut [f64],
    pub ax: &'a mut [f64],
    pub ay: &'a mut [f64],
}

/// What a sweep does with the force on some nodes; returns their new positions.
pub(super) trait Update<S: Simd> {
    fn nodes(&mut self, nodes: Nodes<'_, S>, force: Pair<S>) -> Pair<S>;
}

/// A cache line.
#[repr(align(64))]
struct Line(#[expect(dead_code, reason = "only its place matters")] [u8; 64]);

/// Goes through all springs and gives `update` the force on each vector of nodes. When `MOVE`, what
/// `update` returns becomes their position.
#[inline(always)]
pub(super) fn sweep<S: Simd, const QUICK: bool, const SURVEY: bool, const MOVE: bool>(
    simd: S,
    system: &System,
    state: &mut State,
    sums: &mut Sums<S>,
    update: &mut impl Update<S>,
) {
    // Known to be small, so that sums of it cannot wrap and bounds need checking once.
    let stride = system.stride as u32 as usize;
    // Makes the compiler align the stack, else vectors kept there may straddle two cache lines.
    std::hint::black_box(&mut Line([0; 64]));
    let width = V::<S>::LEN;
    let shortest = splat(simd, system.shortest_squared);
    let State {
        x,
        y,
        vx,
        vy,
        ax,
        ay,
        scratch,
        ..
    } = state;
    // Borrowed once, all of one length: a bound checked for one is checked for all.
    let len = x.len();
    let (x, y): (&mut [f64], &mut [f64]) = (&mut x[..len], &mut y[..len]);
    let (vx, vy): (&mut [f64], &mut [f64]) = (&mut vx[..len], &mut vy[..len]);
    let (ax, ay): (&mut [f64], &mut [f64]) = (&mut ax[..len], &mut ay[..len]);
    let (extra_x, extra_y) = (&scratch.extra_x[..len], &scratch.extra_y[..len]);
    let (up_x, up_y) = (&mut scratch.up_x[..len], &mut scratch.up_y[..len]);
    // Forces on their way to the next vector.
    let mut across = zeros(simd);
    let mut rising = zeros(simd);
    let mut after_last = 0;
    let [first, others @ ..] = system.active.as_slice() else {
        return;
    };
    // One vector ahead, so that its roots are under way while the forces of this one are summed.
    let mut next = Quartet::<S>::new::<QUICK>(simd, (x, y), *first as usize, stride, shortest);
    for (&o, &following) in system.active.iter().zip(others) {
        let o = o as usize;
        let now = next;
        next = Quartet::<S>::new::<QUICK>(simd, (x, y), following as usize, stride, shortest);
        if o != after_last {
            // Between the two lies nothing that moves.
            across = zeros(simd);
            rising = zeros(simd);
        }
        after_last = o + width;
        let (group, lane) = (&system.groups[o / LANES], o & (LANES - width));
        let mut forces = [zeros(simd); DIRECTIONS];
        let mut pulls = [shortest; DIRECTIONS];
        #[allow(clippy::needless_range_loop, reason = "five arrays share the index")]
        for d in 0..DIRECTIONS {
            let stiffness = load(simd, &group.stiffness[d], lane);
            let tension = load(simd, &group.tension[d], lane);
            (pulls[d], forces[d]) =
                now.springs[d].force::<QUICK>(now.inverse[d], stiffness, tension);
        }
        if SURVEY {
            now.survey::<QUICK>(simd, (&system.survey[o / LANES], lane), pulls, sums);
        }
        let [to_right, to_above, to_corner, from_above] = forces;
        // Springs whose far end is one node to the right of here, and of above.
        let onto_right = (to_right.0 + from_above.0, to_right.1 + from_above.1);
        let from_left = (
            shifted::<S>(across.0, onto_right.0),
            shifted::<S>(across.1, onto_right.1),
        );
        let from_corner = (
            shifted::<S>(rising.0, to_corner.0),
            shifted::<S>(rising.1, to_corner.1),
        );
        (across, rising) = (onto_right, to_corner);

        let below = load_pair(simd, up_x, up_y, o);
        let extra = load_pair(simd, extra_x, extra_y, o);
        let force = (
            ((to_right.0 + to_above.0) + (to_corner.0 - from_left.0)) + (below.0 + extra.0),
            ((to_right.1 + to_above.1) + (to_corner.1 - from_left.1)) + (below.1 + extra.1),
        );
        store::<S>(
            up_x,
            o + stride,
            (from_above.0 - to_above.0) - from_corner.0,
        );
        store::<S>(
            up_y,
            o + stride,
            (from_above.1 - to_above.1) - from_corner.1,
        );

        let position = load_pair(simd, x, y, o);
        let nodes = Nodes {
            simd,
            slot: o,
            lane,
            group,
            position,
            vx,
            vy,
            ax,
            ay,
        };
        let moved = update.nodes(nodes, force);
        if MOVE {
            store::<S>(x, o, moved.0);
            store::<S>(y, o, moved.1);
        }
    }
}

/// The four springs that each of some neighbouring nodes owns.
struct Quartet<S: Simd> {
    springs: [Springs<S>; DIRECTIONS],
    inverse: [V<S>; DIRECTIONS],
}

impl<S: Simd> Quartet<S> {
    #[inline(always)]
    fn new<const QUICK: bool>(
        simd: S,
        (x, y): (&[f64], &[f64]),
        slot: usize,
        stride: usize,
        shortest_squared: V<S>,
    ) -> Self {
        let reach = stride + 1 + V::<S>::LEN;
        let (x, y) = (&x[slot..][..reach], &y[slot..][..reach]);
        let here = load_pair(simd, x, y, 0);
        let right = load_pair(simd, x, y, 1);
        let above = load_pair(simd, x, y, stride);
        let above_right = load_pair(simd, x, y, stride + 1);
        let springs = [
            Springs::<S>::new::<QUICK>(here, right, shortest_squared),
            Springs::<S>::new::<QUICK>(here, above, shortest_squared),
            Springs::<S>::new::<QUICK>(here, above_right, shortest_squared),
            Springs::<S>::new::<QUICK>(above, right, shortest_squared),
        ];
        let inverse = [
            inverse_root::<S, QUICK>(simd, springs[0].square),
            inverse_root::<S, QUICK>(simd, springs[1].square),
            inverse_root::<S, QUICK>(simd, springs[2].square),
            inverse_root::<S, QUICK>(simd, springs[3].square),
        ];
        Self { springs, inverse }
    }

    /// Adds the springs, whose tensions over their lengths are `pulls`, and the quads to `sums`.
    #[inline(always)]
    fn survey<const QUICK: bool>(
        &self,
        simd: S,
        (group, lane): (&SurveyGroup, usize),
        pulls: [V<S>; DIRECTIONS],
        sums: &mut Sums<S>,
    ) {
        for (d, pull) in pulls.into_iter().enumerate() {
            sums.add::<QUICK>(
                pull * (self.springs[d].square * self.inverse[d]),
                load(simd, &group.half_compliance[d], lane),
                load(simd, &group.inverse_tension[d], lane),
            );
        }
        // The signed area of a quad is half the cross product of its diagonals.
        let [.., rising, falling] = &self.springs;
        let cross = fused::<S, QUICK>(rising.dy, falling.dx, -(rising.dx * falling.dy));
        let inverse = load(simd, &group.inverse_area, lane);
        let ratio = fused::<S, QUICK>(cross, inverse, load(simd, &group.no_quad, lane));
        sums.quad_ratio = sums.quad_ratio.min(ratio);
    }
}
