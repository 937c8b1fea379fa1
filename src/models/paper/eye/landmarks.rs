//! The places that results refer to: the shell in order, the apex, the meridian, the monitored
//! nodes.
//!
//! All are nodes of level 1, so they exist at every level (level k has the node (i, j) of level 1
//! at (k i, k j)). What is measured at them is measured over their hats, see
//! [`crate::models::paper::eye::hats`].

use crate::models::paper::eye::hats::{Hat, along_shell, of_displacement, of_force};
use crate::models::paper::eye::mesh::SectionMesh;
use crate::run::places::Monitor;

/// Column and row of a monitored node in the mesh of level 1.
fn grid(monitor: Monitor) -> (usize, usize) {
    match monitor {
        Monitor::Centre => (8, 8),
        Monitor::Front => (3, 8),
        Monitor::Right => (12, 8),
        Monitor::Top => (8, 12),
    }
}

/// Indices of the nodes that results refer to.
#[derive(Debug, Clone, PartialEq)]
pub struct Landmarks {
    /// The shell, anticlockwise, from just above the posterior pole.
    pub shell: Vec<usize>,
    /// The monitored nodes, in the order of [`Monitor::ALL`].
    pub monitors: [usize; 4],
    /// The two shell nodes beside the corneal apex, upper first.
    pub apex: [usize; 2],
    /// The ends of the vertical diameter, upper first.
    pub meridian: [usize; 2],
    /// What each monitored node stands for: weights of the forces on the nodes around it.
    pub monitor_hats: [Hat; 4],
    /// The corners of the paper's shell in order: weights of the positions along the shell.
    pub shell_hats: Vec<Hat>,
    /// The two nodes beside the corneal apex: weights of the displacements around them.
    pub apex_hats: [Hat; 2],
    /// The ends of the vertical diameter, likewise.
    pub meridian_hats: [Hat; 2],
}

/// How many hops apart two nodes lie on the closed line `shell`, the shorter way round, and the
/// place from which; none where one of them is not on it.
pub(crate) fn along(shell: &[usize]) -> impl Fn(usize, usize) -> Option<(usize, usize)> {
    let count = shell.len();
    let mut order = vec![None; shell.iter().max().map_or(0, |last| last + 1)];
    for (place, &node) in shell.iter().enumerate() {
        order[node] = Some(place);
    }
    let place = move |node: usize| order.get(node).copied().flatten();
    move |a, b| {
        let (a, b): (usize, usize) = (place(a)?, place(b)?);
        let (low, high) = (a.min(b), a.max(b));
        let straight = 2 * (high - low) <= count;
        Some(if straight { (high - low, low) } else { (count + low - high, high) })
    }
}

pub(crate) fn find(mesh: &SectionMesh, level: u32) -> Landmarks {
    let k = level as usize;
    let at = |(i, j): (usize, usize)| {
        mesh.node_at(i * k, j * k).expect("the globe is never cut by the opening")
    };
    let mirrored = |(i, j): (usize, usize)| (i, 15 - j);
    let (front, top) = (grid(Monitor::Front), grid(Monitor::Top));
    let (apex, meridian) = ([front, mirrored(front)], [top, mirrored(top)]);

    let mut shell: Vec<usize> =
        (0..mesh.nodes.len()).filter(|&i| mesh.nodes[i].region.on_shell()).collect();
    let angle = |i: usize| {
        let p = mesh.nodes[i].position;
        libm::atan2(p.y, p.x).rem_euclid(std::f64::consts::TAU)
    };
    shell.sort_by(|&a, &b| angle(a).total_cmp(&angle(b)));

    let on_paper = |&i: &usize| {
        let (column, row) = mesh.nodes[i].grid;
        column % k == 0 && row % k == 0
    };
    let first = shell.iter().position(on_paper).unwrap_or(0);
    let k = k.cast_signed();
    let mean = |grid| of_displacement(mesh, k, grid);
    Landmarks {
        shell_hats: along_shell(&shell, k, first),
        shell,
        monitors: Monitor::ALL.map(|m| at(grid(m))),
        apex: apex.map(at),
        meridian: meridian.map(at),
        monitor_hats: Monitor::ALL.map(|m| of_force(mesh, k, grid(m))),
        apex_hats: apex.map(mean),
        meridian_hats: meridian.map(mean),
    }
}
