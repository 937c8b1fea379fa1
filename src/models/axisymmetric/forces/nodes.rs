//! The nodes of rows, many at once: their forces are gathered from the cells, and they move.

#![allow(
    clippy::inline_always,
    reason = "what is called within a vector dispatch must be compiled for its instructions"
)]

use crate::models::axisymmetric::forces::rows::{CellRows, RowRun};
use crate::models::axisymmetric::forces::state::NodeState;
use crate::models::paper::forces::lanes::{V, load, splat, store};
use fearless_simd::{Simd, SimdBase};

/// What the four cells around each node have left for it.
#[inline(always)]
pub(crate) fn gather<S: Simd>(simd: S, rows: &CellRows, run: RowRun, state: &mut NodeState) {
    let [c0, c1, c2, c3] = &rows.corners;
    for i in (0..run.node_places).step_by(V::<S>::LEN) {
        let at = run.corners + i;
        let fx = around(simd, [&c0.0, &c1.0, &c2.0, &c3.0], at, run.columns);
        let fr = around(simd, [&c0.1, &c1.1, &c2.1, &c3.1], at, run.columns);
        store::<S>(&mut state.fx, run.nodes + i, fx);
        store::<S>(&mut state.fr, run.nodes + i, fr);
    }
}

#[inline(always)]
fn around<S: Simd>(simd: S, of: [&[f64]; 4], at: usize, columns: usize) -> V<S> {
    let low = load(simd, of[0], at) + load(simd, of[1], at - 1);
    low + (load(simd, of[3], at - columns) + load(simd, of[2], at - columns - 1))
}

/// Kicks velocities over `kick` s, then moves nodes over `drift` s.
#[inline(always)]
pub(crate) fn advance<S: Simd>(simd: S, state: &mut NodeState, kick: f64, drift: f64) {
    let by = (kick, drift);
    move_along(simd, &mut state.x, &mut state.vx, &state.fx, &state.free_x, by);
    move_along(simd, &mut state.r, &mut state.vr, &state.fr, &state.free_r, by);
}

#[inline(always)]
fn move_along<S: Simd>(
    simd: S,
    x: &mut [f64],
    v: &mut [f64],
    f: &[f64],
    free: &[f64],
    (kick, drift): (f64, f64),
) {
    for i in (0..x.len()).step_by(V::<S>::LEN) {
        let force = load(simd, f, i) * load(simd, free, i);
        let speed = load(simd, v, i) + splat(simd, kick) * force;
        store::<S>(v, i, speed);
        let to = load(simd, x, i) + splat(simd, drift) * speed;
        store::<S>(x, i, to);
    }
}
