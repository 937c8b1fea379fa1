//! What a node of the paper's mesh stands for on a finer one: a hat of nodes around it.
//!
//! A finer mesh has lighter nodes, so what a single node feels depends on the mesh and has no
//! limit. The tissue that a node of level 1 stands for is the same at every level. At level k it
//! is the nodes less than k places away, with the weight (1 - |u|/k)(1 - |v|/k) at u columns and v
//! rows from the middle: the bilinear hat of level 1. Along the shell it is (1 - |o|/k)/k at o
//! shell nodes away. At level 1 a hat is its middle node with weight 1, so the paper's own
//! measures come out to the last bit.

use crate::models::paper::eye::mesh::{Node, SectionMesh};
use nalgebra::Vector2;

/// Nodes with weights.
pub type Hat = Vec<(usize, f64)>;

/// The weighted sum of something of each node.
pub(crate) fn sum(nodes: &[(usize, f64)], of: impl Fn(usize) -> Vector2<f64>) -> Vector2<f64> {
    nodes.iter().map(|&(node, weight)| of(node) * weight).sum()
}

/// Weight of a node of level k so many places away from the middle of a hat.
fn weight(away: isize, k: isize) -> f64 {
    1.0 - away.abs() as f64 / k as f64
}

/// The hat of the node at `grid` of level 1, of all nodes that move: weights for a sum of forces.
pub(crate) fn of_force(mesh: &SectionMesh, k: isize, grid: (usize, usize)) -> Hat {
    let middle = (grid.0.cast_signed() * k, grid.1.cast_signed() * k);
    let reach = 1 - k..k;
    let places = reach.clone().flat_map(|v| reach.clone().map(move |u| (u, v)));
    let hat = places.filter_map(|(u, v)| {
        let node = mesh.node_at((middle.0 + u) as usize, (middle.1 + v) as usize)?;
        (!mesh.nodes[node].fixed()).then(|| (node, weight(u, k) * weight(v, k)))
    });
    hat.collect()
}

/// The same within the globe, by mass and with a sum of 1: weights for a mean of displacements.
pub(crate) fn of_displacement(mesh: &SectionMesh, k: isize, grid: (usize, usize)) -> Hat {
    let mut hat = of_force(mesh, k, grid);
    let node = |i: usize| -> &Node { &mesh.nodes[i] };
    hat.retain(|&(i, _)| node(i).region.in_globe());
    let whole: f64 = hat.iter().map(|&(i, w)| w * node(i).mass).sum();
    for (i, weight) in &mut hat {
        *weight *= node(*i).mass / whole;
    }
    hat
}

/// The hats along `shell`, all nodes of the shell in order, of those that are on it at level 1.
pub(crate) fn along_shell(shell: &[usize], k: isize, first: usize) -> Vec<Hat> {
    let count = shell.len().cast_signed();
    let middles = (first.cast_signed()..count).step_by(k as usize);
    let hat = |middle: isize| {
        let nodes = (1 - k..k).map(|o| {
            let node = shell[(middle + o).rem_euclid(count) as usize];
            (node, weight(o, k) / k as f64)
        });
        nodes.collect()
    };
    middles.map(hat).collect()
}
