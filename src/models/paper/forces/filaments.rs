//! Forces of the filaments and of the load on the shell, and the length of the shell.

use crate::models::paper::forces::lanes::{
    Springs, Sums, V, fused, inverse_root, load, load_pair, splat, store_pair, total, zeros,
};
use crate::models::paper::forces::state::{Scratch, State};
use crate::models::paper::forces::{layout::LANES, system::System};
use fearless_simd::{Simd, SimdBase};

/// Length of the closed shell as it was last gathered, in m.
#[inline(always)]
pub(crate) fn shell_length<S: Simd, const QUICK: bool>(
    simd: S,
    system: &System,
    state: &State,
) -> f64 {
    let ring = &system.ring;
    let places = state.scratch.ring.slices();
    let mut sum = splat(simd, 0.0);
    let shortest = splat(simd, system.shortest_squared);
    for o in (0..ring.neighbours.len()).step_by(V::<S>::LEN) {
        let g = ring.ghosts - 1 + o;
        let (a, b) = (load_pair(simd, places, g), load_pair(simd, places, g + 1));
        let square = Springs::<S>::new::<QUICK>(a, b, shortest).square;
        let length = square * inverse_root::<S, QUICK>(simd, square);
        sum = fused::<S, QUICK>(length, load(simd, &ring.neighbours, o), sum);
    }
    total::<S>(sum)
}

/// Forces of filaments and load on the shell, into the extra forces.
#[inline(always)]
pub(crate) fn ring_forces<S: Simd, const QUICK: bool, const SURVEY: bool>(
    simd: S,
    system: &System,
    state: &mut State,
    force: f64,
    sums: &mut Sums<S>,
) {
    let ring = &system.ring;
    let s = &mut state.scratch;
    let (x, y) = state.position.slices();
    let len = ring.gather.len();
    let (ring_x, ring_y) = (&mut s.ring.x[..len], &mut s.ring.y[..len]);
    for ((to_x, to_y), &(slot, sign)) in ring_x.iter_mut().zip(ring_y).zip(&ring.gather) {
        *to_x = x[slot as usize];
        *to_y = sign * y[slot as usize];
    }
    filament_forces::<S, QUICK, SURVEY>(simd, system, s, sums);
    let (extra_x, extra_y) = s.extra.slices_mut();
    let hops = s.hops.slices();
    let run = ring.padded_len();
    let owned = &ring.gather[ring.ghosts..ring.ghosts + ring.owned];
    for (o, places) in owned.chunks(V::<S>::LEN).enumerate() {
        let on_first = ring.ghosts + o * V::<S>::LEN;
        let mut total = zeros(simd);
        for (n, hop) in ring.hops.iter().enumerate() {
            let pulled = load_pair(simd, hops, n * run + on_first);
            let pulling = load_pair(simd, hops, n * run + on_first - hop);
            total.0 += pulled.0 - pulling.0;
            total.1 += pulled.1 - pulling.1;
        }
        for ((&(slot, _), x), y) in places.iter().zip(total.0.as_slice()).zip(total.1.as_slice()) {
            extra_x[slot as usize] = *x;
            extra_y[slot as usize] = *y;
        }
    }
    for (slot, _, share) in &system.loaded {
        extra_x[*slot] += share.x * force;
        extra_y[*slot] += share.y * force;
    }
}

/// Forces of all filaments on their first ends.
#[inline(always)]
fn filament_forces<S: Simd, const QUICK: bool, const SURVEY: bool>(
    simd: S,
    system: &System,
    s: &mut Scratch,
    sums: &mut Sums<S>,
) {
    let shortest = splat(simd, system.shortest_squared);
    let (ring_x, ring_y) = s.ring.slices();
    let (hop_fx, hop_fy) = s.hops.slices_mut();
    let hop_fy = &mut hop_fy[..hop_fx.len()];
    let places = (ring_x, &ring_y[..ring_x.len()]);
    for strip in &system.ring.strips {
        for lane in (0..LANES).step_by(V::<S>::LEN) {
            let a = strip.first + lane;
            let springs = Springs::<S>::new::<QUICK>(
                load_pair(simd, places, a),
                load_pair(simd, places, a + strip.hop),
                shortest,
            );
            let inverse = inverse_root::<S, QUICK>(simd, springs.square);
            let stiffness = load(simd, &strip.stiffness, lane);
            let tension = load(simd, &strip.tension, lane);
            let (pull, force) = springs.force::<QUICK>(inverse, stiffness, tension);
            if SURVEY {
                sums.add::<QUICK>(
                    pull * (springs.square * inverse),
                    load(simd, &strip.half_compliance, lane),
                    load(simd, &strip.inverse_tension, lane),
                );
            }
            store_pair::<S>((hop_fx, hop_fy), strip.into + lane, force);
        }
    }
}
