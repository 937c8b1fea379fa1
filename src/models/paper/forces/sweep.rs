//! One pass over the mesh: the four grid springs of each node, the force on it, and its update.
//!
//! The pass goes up through the vectors that hold anything that moves. Each computes the springs
//! that its nodes own, adds what the vectors below and to the left have left for it, and hands on
//! its part; then its nodes may move at once, as nothing that comes later needs their old places.

#![allow(
    unsafe_code,
    reason = "bounds are checked once a sweep: checked at every vector they took a tenth of the time"
)]

use crate::models::paper::forces::lanes::{
    Pair, Springs, Sums, V, fused, inverse_root_of, load, load_pair, shifted, splat, store_pair,
    zeros,
};
use crate::models::paper::forces::layout::{DIRECTIONS, LANES, SpringGroup, SurveyGroup};
use crate::models::paper::forces::{state::State, system::System};
use fearless_simd::{Simd, SimdBase};

/// What an update may read and write of neighbouring nodes: of each run a vector of values.
pub(crate) struct Nodes<'a, S: Simd> {
    pub simd: S,
    /// Place of the first node in its group.
    pub lane: usize,
    pub group: &'a SpringGroup,
    pub position: Pair<S>,
    pub velocity: (&'a mut [f64], &'a mut [f64]),
    pub acceleration: (&'a mut [f64], &'a mut [f64]),
}

impl<S: Simd> Nodes<'_, S> {
    #[inline(always)]
    pub fn speeds(&self) -> Pair<S> {
        load_pair(self.simd, (&*self.velocity.0, &*self.velocity.1), 0)
    }
}

/// What a sweep does with the force on some nodes; returns their new positions.
pub(crate) trait Update<S: Simd> {
    fn nodes(&mut self, nodes: Nodes<'_, S>, force: Pair<S>) -> Pair<S>;
}

/// A cache line.
#[repr(align(64))]
struct Line(#[expect(dead_code, reason = "only its place matters")] [u8; 64]);

/// A part of two runs, of which it is known that it is there.
///
/// # Safety
/// `at + len` is no more than the length of either.
#[inline(always)]
unsafe fn parts<'a>(x: &'a [f64], y: &'a [f64], at: usize, len: usize) -> (&'a [f64], &'a [f64]) {
    debug_assert!(at + len <= x.len() && at + len <= y.len());
    // SAFETY: as asked of the caller.
    unsafe { (x.get_unchecked(at..at + len), y.get_unchecked(at..at + len)) }
}

/// [`parts`] that may be written.
///
/// # Safety
/// As [`parts`].
#[inline(always)]
unsafe fn parts_mut<'a>(
    x: &'a mut [f64],
    y: &'a mut [f64],
    at: usize,
    len: usize,
) -> (&'a mut [f64], &'a mut [f64]) {
    debug_assert!(at + len <= x.len() && at + len <= y.len());
    // SAFETY: as asked of the caller.
    unsafe { (x.get_unchecked_mut(at..at + len), y.get_unchecked_mut(at..at + len)) }
}

/// Goes through all springs and gives `update` the force on each vector of nodes. What it returns
/// becomes their position, but in a survey, which moves nothing.
#[inline(always)]
pub(crate) fn sweep<S: Simd, const QUICK: bool, const SURVEY: bool>(
    simd: S,
    system: &System,
    state: &mut State,
    sums: &mut Sums<S>,
    update: &mut impl Update<S>,
) {
    // Known to be small, so that sums of it cannot wrap and bounds need checking once.
    let stride = system.rows.stride as u32 as usize;
    // Makes the compiler align the stack, else vectors kept there may straddle two cache lines.
    std::hint::black_box(&mut Line([0; 64]));
    let width = V::<S>::LEN;
    let shortest = splat(simd, system.shortest_squared);
    let State { position, velocity, acceleration, scratch, .. } = state;
    // Borrowed once, all of one length: a bound checked for one is checked for all.
    let len = position.x.len();
    let (x, y) = (&mut position.x[..len], &mut position.y[..len]);
    let (vx, vy) = (&mut velocity.x[..len], &mut velocity.y[..len]);
    let (ax, ay) = (&mut acceleration.x[..len], &mut acceleration.y[..len]);
    let (extra_x, extra_y) = (&scratch.extra.x[..len], &scratch.extra.y[..len]);
    let (up_x, up_y) = (&mut scratch.up.x[..len], &mut scratch.up.y[..len]);
    let [first, others @ ..] = system.active.as_slice() else { return };
    let last = *others.last().unwrap_or(first) as usize;
    let groups = &system.groups[..=last / LANES];
    let reach = stride + 1 + width;
    assert!(last + reach <= len, "a vector beyond the mesh");
    // Forces on their way to the next vector.
    let mut across = zeros(simd);
    let mut rising = zeros(simd);
    let mut after_last = 0;
    // One vector ahead, so that its roots are under way while the forces of this one are summed.
    // SAFETY: no slot is beyond `last`, of which `reach` values have been found to be there.
    let ahead = unsafe { parts(x, y, *first as usize, reach) };
    let mut next = Quartet::<S>::new::<QUICK>(simd, ahead, stride, shortest);
    for (&o, &following) in system.active.iter().zip(others) {
        let o = o as usize;
        let now = next;
        // SAFETY: as above.
        let ahead = unsafe { parts(x, y, following as usize, reach) };
        next = Quartet::<S>::new::<QUICK>(simd, ahead, stride, shortest);
        if o != after_last {
            // Between the two lies nothing that moves.
            across = zeros(simd);
            rising = zeros(simd);
        }
        after_last = o + width;
        let lane = o & (LANES - width);
        // SAFETY: no slot is beyond `last`, whose group is the last one.
        let group = unsafe { groups.get_unchecked(o / LANES) };
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
        let from_left =
            (shifted::<S>(across.0, onto_right.0), shifted::<S>(across.1, onto_right.1));
        let from_corner =
            (shifted::<S>(rising.0, to_corner.0), shifted::<S>(rising.1, to_corner.1));
        (across, rising) = (onto_right, to_corner);

        // SAFETY: of every run here `reach` values are there from `o` on, and `stride + width` are
        // fewer.
        let (above, extra, nodes) = unsafe {
            let nodes = Nodes {
                simd,
                lane,
                group,
                position: load_pair(simd, parts(x, y, o, width), 0),
                velocity: parts_mut(vx, vy, o, width),
                acceleration: parts_mut(ax, ay, o, width),
            };
            let extra = load_pair(simd, parts(extra_x, extra_y, o, width), 0);
            (parts_mut(up_x, up_y, o, stride + width), extra, nodes)
        };
        let below = load_pair(simd, (above.0, above.1), 0);
        let force = (
            ((to_right.0 + to_above.0) + (to_corner.0 - from_left.0)) + (below.0 + extra.0),
            ((to_right.1 + to_above.1) + (to_corner.1 - from_left.1)) + (below.1 + extra.1),
        );
        let onto_above = (
            (from_above.0 - to_above.0) - from_corner.0,
            (from_above.1 - to_above.1) - from_corner.1,
        );
        store_pair::<S>(above, stride, onto_above);
        let moved = update.nodes(nodes, force);
        if !SURVEY {
            // SAFETY: as above.
            store_pair::<S>(unsafe { parts_mut(x, y, o, width) }, 0, moved);
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
        stride: usize,
        shortest_squared: V<S>,
    ) -> Self {
        let reach = stride + 1 + V::<S>::LEN;
        let (x, y) = (&x[..reach], &y[..reach]);
        let here = load_pair(simd, (x, y), 0);
        let right = load_pair(simd, (x, y), 1);
        let above = load_pair(simd, (x, y), stride);
        let above_right = load_pair(simd, (x, y), stride + 1);
        // No closures here: they would not be compiled for the machine's vectors.
        let springs = [
            Springs::<S>::new::<QUICK>(here, right, shortest_squared),
            Springs::<S>::new::<QUICK>(here, above, shortest_squared),
            Springs::<S>::new::<QUICK>(here, above_right, shortest_squared),
            Springs::<S>::new::<QUICK>(above, right, shortest_squared),
        ];
        let inverse = [
            inverse_root_of::<S, QUICK>(simd, 0, springs[0].square),
            inverse_root_of::<S, QUICK>(simd, 1, springs[1].square),
            inverse_root_of::<S, QUICK>(simd, 2, springs[2].square),
            inverse_root_of::<S, QUICK>(simd, 3, springs[3].square),
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
        let (rising, falling) = (rising.span, falling.span);
        let cross = fused::<S, QUICK>(rising.1, falling.0, -(rising.0 * falling.1));
        let inverse = load(simd, &group.inverse_area, lane);
        let ratio = fused::<S, QUICK>(cross, inverse, load(simd, &group.no_quad, lane));
        sums.quad_ratio = sums.quad_ratio.min(ratio);
    }
}
