//! The filaments, which join shell nodes a fixed number of hops apart, compiled.
//!
//! The shell is gathered into a run with ghosts at both ends, so that the springs of one hop count
//! are vectors as well: place o against place o + hop.

use crate::models::paper::eye::{Eye, springs::SpringKind};
use crate::models::paper::forces::layout::{LANES, Lane, MovedRows};
use std::collections::HashMap;

/// Eight filaments of one hop count whose first ends lie side by side; what fills it up has
/// stiffness 0.
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
    pub strips: Vec<Strip>,
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
pub(crate) fn compile(eye: &Eye, rows: &MovedRows) -> Ring {
    let shell = &eye.landmarks.shell;
    let count = shell.len();
    // The upper half starts just above the posterior pole, or on it.
    let owned = shell.iter().take_while(|&&i| rows.owns(eye.nodes[i].grid.1)).count();
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
    let ghosts = by_hop.iter().map(|(h, _)| *h).max().unwrap_or(0).max(count.min(1));
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
            // Filaments may be switched off by a factor of 0; then they have neither energy nor
            // strain.
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
