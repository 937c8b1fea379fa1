//! Forces of the filaments, which join shell nodes a fixed number of hops apart, and of the load.
//!
//! The shell is gathered into a run with ghosts at both ends, so that the springs of one hop count
//! are vectors as well: place o against place o + hop.

#![allow(
    clippy::inline_always,
    reason = "what is called within a vector dispatch must be compiled for its instructions"
)]

use crate::models::paper::eye::Eye;
use crate::models::paper::eye::springs::SpringKind;
use crate::models::paper::forces::lanes::{
    Springs, Sums, V, fused, inverse_root, load, load_pair, splat, store, total, zeros,
};
use crate::models::paper::forces::state::{Scratch, State};
use crate::models::paper::forces::system::{LANES, Lane, Rows, System};
use fearless_simd::{Simd, SimdBase};
use std::collections::HashMap;

/// Eight filaments of one hop count whose first ends lie side by side; what fills it up has stiffness 0.
#[derive(Debug, Clone, Copy, Default)]
#[repr(align(64))]
pub(crate) struct Strip {
    stiffness: Lane,
    tension: Lane,
    half_compliance: Lane,
    inverse_tension: Lane,
    /// Gathered place of the first end of the first one.
    first: usize,
    /// Distance along the ring between the two ends.
    hop: usize,
    /// Where the forces on the first ends go.
    into: usize,
}

/// The ring of shell nodes, unrolled, with ghosts at both ends.
#[derive(Debug, Clone, Default)]
pub(crate) struct Ring {
    /// Where each gathered place is read, and the sign of its y.
    pub gather: Vec<(u32, f64)>,
    /// Number of ghosts before the first owned place.
    pub ghosts: usize,
    /// Number of owned places.
    pub owned: usize,
    /// How many pairs of neighbours on the shell each pair in the run stands for, from the last
    /// ghost before the owned places on.
    pub neighbours: Vec<f64>,
    /// The hop counts.
    pub hops: Vec<usize>,
    /// All filaments.
    strips: Vec<Strip>,
}

impl Ring {
    /// Length of a run that every eight-lane access of the ring fits in.
    pub fn padded_len(&self) -> usize {
        (self.gather.len() + self.ghosts).next_multiple_of(LANES) + 2 * LANES
    }

    /// Filaments that are computed.
    pub fn filaments(&self) -> usize {
        let stiffness = self.strips.iter().flat_map(|strip| strip.stiffness);
        stiffness.filter(|&k| k > 0.0).count()
    }

    /// Length of the runs of all hop counts.
    pub fn hops_len(&self) -> usize {
        self.padded_len() * self.hops.len()
    }
}

/// The filaments of `eye` for the moved rows.
pub(crate) fn compile(eye: &Eye, rows: &Rows) -> Ring {
    let shell = &eye.landmarks.shell;
    let count = shell.len();
    // The upper half starts just above the posterior pole, or on it.
    let owned = shell
        .iter()
        .take_while(|&&i| rows.owns(eye.nodes[i].grid.1))
        .count();
    let mut by_hop: Vec<(usize, HashMap<usize, usize>)> = Vec::new();
    let order: HashMap<usize, usize> = shell.iter().enumerate().map(|(o, &i)| (i, o)).collect();
    for (index, spring) in eye.springs.iter().enumerate() {
        if spring.kind != SpringKind::Filament {
            continue;
        }
        let start = order[&spring.a];
        let hop = (order[&spring.b] + count - start) % count;
        match by_hop.iter_mut().find(|(h, _)| *h == hop) {
            Some((_, starts)) => {
                starts.insert(start, index);
            }
            None => by_hop.push((hop, HashMap::from([(start, index)]))),
        }
    }
    // One at least, so that every pair of neighbours is in the run.
    let ghosts = by_hop
        .iter()
        .map(|(h, _)| *h)
        .max()
        .unwrap_or(0)
        .max(count.min(1));
    let at = |offset: usize| (offset + count * 2 - ghosts) % count;
    let gather: Vec<(u32, f64)> = (0..owned + 2 * ghosts)
        .map(|g| {
            let place = rows.place(eye.nodes[shell[at(g)]].grid);
            (place.slot as u32, place.sign())
        })
        .collect();
    let weight = |g: usize| {
        if g < ghosts || g >= ghosts + owned {
            0.0
        } else {
            rows.weight(eye.nodes[shell[at(g)]].grid.1)
        }
    };
    let mut ring = Ring {
        gather,
        ghosts,
        owned,
        neighbours: Vec::new(),
        hops: by_hop.iter().map(|(hop, _)| *hop).collect(),
        strips: Vec::new(),
    };
    let run = ring.padded_len();
    for (n, (hop, starts)) in by_hop.iter().enumerate() {
        let first = ghosts - hop;
        let earlier = ring.strips.len();
        for o in (0..owned + hop).step_by(LANES) {
            ring.strips.push(Strip {
                first: first + o,
                hop: *hop,
                into: n * run + first + o,
                ..Strip::default()
            });
        }
        for o in 0..owned + hop {
            let spring = &eye.springs[starts[&at(first + o)]];
            // In the whole ring the ghosts repeat springs that the other end owns, at weight 1/2.
            let share = 0.5 * (weight(first + o) + weight(first + o + hop));
            let (k, l) = (spring.stiffness, spring.rest_length);
            let (strip, lane) = (&mut ring.strips[earlier + o / LANES], o % LANES);
            strip.stiffness[lane] = k;
            strip.tension[lane] = k * l;
            // Filaments may be switched off by a factor of 0; then they have neither energy nor strain.
            if k > 0.0 {
                strip.half_compliance[lane] = 0.5 * share / k;
                strip.inverse_tension[lane] = 1.0 / (k * l);
            }
        }
    }
    // An eye without a shell has no pairs.
    let pairs = if ghosts == 0 { 0 } else { owned + 1 };
    ring.neighbours = (0..pairs.next_multiple_of(LANES))
        .map(|n| {
            if n < pairs {
                let g = ghosts - 1 + n;
                0.5 * (weight(g) + weight(g + 1))
            } else {
                0.0
            }
        })
        .collect();
    ring
}

/// Length of the closed shell as it was last gathered, in m.
#[inline(always)]
pub(crate) fn shell_length<S: Simd, const QUICK: bool>(
    simd: S,
    system: &System,
    state: &State,
) -> f64 {
    let ring = &system.ring;
    let (x, y): (&[f64], &[f64]) = (&state.scratch.ring_x, &state.scratch.ring_y);
    let mut sum = splat(simd, 0.0);
    let shortest = splat(simd, system.shortest_squared);
    for o in (0..ring.neighbours.len()).step_by(V::<S>::LEN) {
        let g = ring.ghosts - 1 + o;
        let (a, b) = (load_pair(simd, x, y, g), load_pair(simd, x, y, g + 1));
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
    let (x, y): (&[f64], &[f64]) = (&state.x, &state.y);
    let len = ring.gather.len();
    let (ring_x, ring_y) = (&mut s.ring_x[..len], &mut s.ring_y[..len]);
    for ((to_x, to_y), &(slot, sign)) in ring_x.iter_mut().zip(ring_y).zip(&ring.gather) {
        *to_x = x[slot as usize];
        *to_y = sign * y[slot as usize];
    }
    filament_forces::<S, QUICK, SURVEY>(simd, system, s, sums);
    let (extra_x, extra_y): (&mut [f64], &mut [f64]) = (&mut s.extra_x, &mut s.extra_y);
    let (hop_fx, hop_fy): (&[f64], &[f64]) = (&s.hop_fx, &s.hop_fy);
    let run = ring.padded_len();
    let owned = &ring.gather[ring.ghosts..ring.ghosts + ring.owned];
    for (o, places) in owned.chunks(V::<S>::LEN).enumerate() {
        let on_first = ring.ghosts + o * V::<S>::LEN;
        let mut total = zeros(simd);
        for (n, hop) in ring.hops.iter().enumerate() {
            let pulled = load_pair(simd, hop_fx, hop_fy, n * run + on_first);
            let pulling = load_pair(simd, hop_fx, hop_fy, n * run + on_first - hop);
            total.0 += pulled.0 - pulling.0;
            total.1 += pulled.1 - pulling.1;
        }
        for ((&(slot, _), x), y) in places
            .iter()
            .zip(total.0.as_slice())
            .zip(total.1.as_slice())
        {
            extra_x[slot as usize] = *x;
            extra_y[slot as usize] = *y;
        }
    }
    for &(slot, px, py) in &system.load().shares {
        extra_x[slot] += px * force;
        extra_y[slot] += py * force;
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
    let (ring_x, ring_y): (&[f64], &[f64]) = (&s.ring_x, &s.ring_y);
    let (hop_fx, hop_fy): (&mut [f64], &mut [f64]) = (&mut s.hop_fx, &mut s.hop_fy);
    let hop_fy = &mut hop_fy[..hop_fx.len()];
    let ring_y = &ring_y[..ring_x.len()];
    for strip in &system.ring.strips {
        for lane in (0..LANES).step_by(V::<S>::LEN) {
            let a = strip.first + lane;
            let springs = Springs::<S>::new::<QUICK>(
                load_pair(simd, ring_x, ring_y, a),
                load_pair(simd, ring_x, ring_y, a + strip.hop),
                shortest,
            );
            let inverse = inverse_root::<S, QUICK>(simd, springs.square);
            let stiffness = load(simd, &strip.stiffness, lane);
            let tension = load(simd, &strip.tension, lane);
            let (pull, (fx, fy)) = springs.force::<QUICK>(inverse, stiffness, tension);
            if SURVEY {
                sums.add::<QUICK>(
                    pull * (springs.square * inverse),
                    load(simd, &strip.half_compliance, lane),
                    load(simd, &strip.inverse_tension, lane),
                );
            }
            let into = strip.into + lane;
            store::<S>(hop_fx, into, fx);
            store::<S>(hop_fy, into, fy);
        }
    }
}
