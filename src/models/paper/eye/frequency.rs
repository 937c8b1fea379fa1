//! An upper bound of every frequency of a built mesh, which limits the step.
//!
//! A spring of stiffness k and any stretch has a tangent with eigenvalues k and k (1 - l0/l) <= k,
//! so x'Kx <= sum of k |xa - xb|^2 <= 2 sum over nodes of (sum of k at the node) |x|^2. Hence
//! every angular frequency of M^-1 K is at most omega = sqrt(2 max(sum of k at a node / its
//! mass)), in the rest shape and in any deformed one. It is the free-node form of Gershgorin's
//! circles; one pass over the springs, no iteration.
//!
//! A node of a stiff shell has many springs, whose far ends cannot all swing against it at once.
//! The springs along the shell, to neighbours and by filaments, join nodes h apart on a ring of N.
//! With `k_h` the largest stiffness of hop h, what they hold is at most the sum over h and o of
//! `k_h |x_o - x_(o+h)|^2`, and the largest eigenvalue of this circulant matrix is L, the largest
//! over j of the sum over h of `2 k_h (1 - cos(2 pi j h / N))`. With all other springs as before,
//! omega^2 is at most the largest (L on the shell, else 0, + 2 sum of other k) / mass. The lower
//! of the two bounds holds: a seventh lower for a shell much stiffer than the rest, where it is
//! within 3 % of the highest frequency that springs at rest length could have if they resisted in
//! every direction.

use crate::models::paper::eye::springs::{Spring, SpringKind};
use crate::models::paper::eye::{Eye, landmarks::along};
use std::collections::BTreeMap;
use std::f64::consts::TAU;

/// Upper bound of every angular frequency of `eye` in any shape, in rad/s.
pub(crate) fn omega_bound(eye: &Eye) -> f64 {
    // The first takes each node by itself.
    highest(eye, |_| true, 0.0).min(omega_by_ring(eye))
}

/// The bound that takes the springs along the shell together, in rad/s.
fn omega_by_ring(eye: &Eye) -> f64 {
    let count = eye.landmarks.shell.len();
    let along = along(&eye.landmarks.shell);
    let on_ring = |spring: &Spring| {
        let pair = along(spring.a, spring.b);
        pair.filter(|(hop, _)| spring.kind == SpringKind::Filament || *hop == 1)
    };
    // Several springs may join the same two nodes: their stiffnesses add up.
    let mut pairs: BTreeMap<(usize, usize), f64> = BTreeMap::new();
    for spring in &eye.springs {
        if let Some(pair) = on_ring(spring) {
            *pairs.entry(pair).or_default() += spring.stiffness;
        }
    }
    let mut stiffest: BTreeMap<usize, f64> = BTreeMap::new();
    for ((hop, _), stiffness) in pairs {
        let most = stiffest.entry(hop).or_default();
        *most = most.max(stiffness);
    }
    let held = |wave: usize| -> f64 {
        let each = stiffest.iter().map(|(hop, k)| {
            let turn = TAU * (wave * hop % count) as f64 / count as f64;
            2.0 * k * (1.0 - libm::cos(turn))
        });
        each.sum()
    };
    let by_shell = (0..=count / 2).map(held).fold(0.0, f64::max);
    highest(eye, |spring| on_ring(spring).is_none(), by_shell)
}

/// Root of the largest (`by_shell`, but on the shell only, + 2 sum of k)/mass over the nodes that
/// move, in rad/s, of the springs that count.
fn highest(eye: &Eye, counts: impl Fn(&Spring) -> bool, by_shell: f64) -> f64 {
    let mut sums = vec![0.0; eye.nodes.len()];
    for spring in eye.springs.iter().filter(|spring| counts(spring)) {
        sums[spring.a] += spring.stiffness;
        sums[spring.b] += spring.stiffness;
    }
    let moving = eye.nodes.iter().zip(sums).filter(|(node, _)| !node.fixed());
    let squared = moving.map(|(node, sum)| {
        let extra = if node.region.on_shell() { by_shell } else { 0.0 };
        (extra + 2.0 * sum) / node.mass
    });
    squared.fold(0.0, f64::max).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scenario::EyeInput;

    /// The highest frequency of springs that resist in every direction, from below, in rad/s.
    fn iterated(eye: &Eye) -> f64 {
        let still = |i: usize| eye.nodes[i].fixed();
        let start = |i: usize| if still(i) { 0.0 } else { (i * 7919 % 101) as f64 - 50.0 };
        let mut x: Vec<f64> = (0..eye.nodes.len()).map(start).collect();
        let norm = |x: &[f64]| x.iter().map(|v| v * v).sum::<f64>().sqrt();
        let mut highest = 0.0;
        for _ in 0..2000 {
            let mut y = vec![0.0; x.len()];
            for spring in &eye.springs {
                let force = spring.stiffness * (x[spring.a] - x[spring.b]);
                y[spring.a] += force / eye.nodes[spring.a].mass;
                y[spring.b] -= force / eye.nodes[spring.b].mass;
            }
            (0..y.len()).filter(|i| still(*i)).for_each(|i| y[i] = 0.0);
            let length = norm(&y);
            highest = length / norm(&x);
            x = y.into_iter().map(|v| v / length).collect();
        }
        highest.sqrt()
    }

    #[test]
    fn both_bounds_lie_above_the_highest_frequency_and_the_shells_is_close_where_it_is_stiff() {
        for (sclera_kpa, lens_kpa, filament_hops) in [
            (2600.0, 6880.0, vec![2, 3, 4]),
            (30e3, 100.0, vec![2, 3, 4]),
            (30e3, 100.0, vec![18]),
            (30e3, 100.0, vec![2, 34]),
            (30e3, 100.0, vec![1, 35]),
            (30e3, 100.0, vec![]),
            (1.0, 1.0, vec![5]),
        ] {
            let eye = Eye::build(&EyeInput {
                sclera_kpa,
                lens_kpa,
                filament_hops: filament_hops.clone(),
                ..EyeInput::default()
            });
            let (bound, truth) = (omega_bound(&eye), iterated(&eye));
            let ratios = (highest(&eye, |_| true, 0.0) / bound, truth / bound);
            assert!(ratios.0 >= 1.0 && ratios.1 <= 1.0, "{filament_hops:?} {ratios:?}");
            if sclera_kpa > 1e4 && filament_hops == [2, 3, 4] {
                assert!(ratios.0 > 1.15 && ratios.1 > 0.96, "{ratios:?}");
            }
        }
    }
}
