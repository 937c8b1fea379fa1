//! The filaments, which join shell nodes a fixed number of hops apart, compiled.
//!
//! The shell is gathered into a run with ghosts at both ends, so that the springs of one hop count
//! are vectors as well: place o against place o + hop.

use crate::models::paper::eye::{Eye, springs::Spring, springs::SpringKind};
use crate::models::paper::forces::layout::{LANES, Lane, MovedRows};

/// Eight filaments of one hop count with first ends side by side; filled up with stiffness 0.
#[derive(Debug, Clone, Copy, Default)]
#[repr(align(64))]
pub(crate) struct Strip {
    pub stiffness: Lane,
    pub tension: Lane,
    pub half_compliance: Lane,
    pub inverse_tension: Lane,
    /// Gathered place of the first end of the first one.
    pub first: usize,
    /// Distance along the ring between the two ends.
    pub hop: usize,
    /// Where the forces on the first ends go.
    pub into: usize,
}

/// The ring of shell nodes, unrolled, with ghosts at both ends.
#[derive(Debug, Clone)]
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
    pub strips: Vec<Strip>,
}

impl Ring {
    /// Length of a run that every eight-lane access of the ring fits in.
    pub fn padded_len(&self) -> usize {
        (self.gather.len() + self.ghosts).next_multiple_of(LANES) + 2 * LANES
    }
}

/// The filaments of `eye` for the moved rows.
pub(crate) fn compile(eye: &Eye, rows: &MovedRows) -> Ring {
    let shell = &eye.landmarks.shell;
    let count = shell.len();
    // The upper half starts just above the posterior pole, or on it.
    let owned = shell.iter().take_while(|&&i| rows.owns(eye.nodes[i].grid.1)).count();
    let filaments = eye.springs.iter().filter(|spring| spring.kind == SpringKind::Filament);
    let filaments: Vec<&Spring> = filaments.collect();
    // Of each hop count one from each node of the shell, in the shell's order.
    let rounds = filaments.chunks_exact(count.max(1));
    let hops = rounds.clone().map(|round| shell.iter().take_while(|&&n| n != round[0].b).count());
    let hops: Vec<usize> = hops.collect();
    // One at least, so that every pair of neighbours is in the run.
    let ghosts = hops.iter().copied().max().unwrap_or(0).max(count.min(1));
    let at = |offset: usize| (offset + count * 2 - ghosts) % count;
    let row = |g: usize| eye.nodes[shell[at(g)]].grid;
    let gathered = (0..owned + 2 * ghosts).map(|g| rows.place(row(g)));
    let gather = gathered.map(|place| (place.slot as u32, place.sign())).collect();
    let weight = |g: usize| {
        let is_owned = (ghosts..ghosts + owned).contains(&g);
        if is_owned { rows.weight(row(g).1) } else { 0.0 }
    };
    // An eye without a shell has no pairs.
    let pairs = if ghosts == 0 { 0 } else { owned + 1 };
    let mut neighbours: Vec<f64> =
        (ghosts..ghosts + pairs).map(|g| 0.5 * (weight(g - 1) + weight(g))).collect();
    neighbours.resize(pairs.next_multiple_of(LANES), 0.0);
    let mut ring = Ring { gather, ghosts, owned, neighbours, hops, strips: Vec::new() };
    let run = ring.padded_len();
    for ((n, &hop), round) in ring.hops.iter().enumerate().zip(rounds) {
        let (first, end) = (ghosts - hop, ghosts + owned);
        for start in (first..end).step_by(LANES) {
            let mut strip = Strip { first: start, hop, into: n * run + start, ..Strip::default() };
            for (lane, g) in (start..end.min(start + LANES)).enumerate() {
                let spring = round[at(g)];
                // In the whole ring ghosts repeat springs that the other end owns: weight 1/2.
                let share = 0.5 * (weight(g) + weight(g + hop));
                let (k, l) = (spring.stiffness, spring.rest_length);
                strip.stiffness[lane] = k;
                strip.tension[lane] = k * l;
                // Filaments switched off by a factor of 0 have neither energy nor strain.
                if k > 0.0 {
                    strip.half_compliance[lane] = 0.5 * share / k;
                    strip.inverse_tension[lane] = 1.0 / (k * l);
                }
            }
            ring.strips.push(strip);
        }
    }
    ring
}
