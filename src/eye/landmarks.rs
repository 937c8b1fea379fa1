//! The places that results refer to: the shell in order, the apex, the meridian, the monitored nodes.
//!
//! All are nodes of level 1, so they exist at every level (level k has the node (i, j) of level 1
//! at (k i, k j)).

use super::mesh::Mesh;

/// One of the four nodes whose force is followed (paper, "Static plots").
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Monitor {
    /// 1.33 mm from the centre of the eye, 45 degrees up and back.
    Centre,
    /// On the cornea, 5 degrees above the anterior pole.
    Front,
    /// On the retina, 5 degrees above the posterior pole.
    Right,
    /// On the shell, 5 degrees behind 12 o'clock.
    Top,
}

impl Monitor {
    /// All four, in the paper's order.
    pub const ALL: [Self; 4] = [Self::Centre, Self::Front, Self::Right, Self::Top];

    /// Lower-case name, as used in reports.
    pub fn name(self) -> &'static str {
        match self {
            Self::Centre => "centre",
            Self::Front => "front",
            Self::Right => "right",
            Self::Top => "top",
        }
    }

    /// Column and row of the node in the mesh of level 1.
    fn grid(self) -> (usize, usize) {
        match self {
            Self::Centre => (8, 8),
            Self::Front => (3, 8),
            Self::Right => (12, 8),
            Self::Top => (8, 12),
        }
    }
}

/// Indices of the nodes that results refer to.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Landmarks {
    /// The shell, anticlockwise, from just above the posterior pole.
    pub shell: Vec<usize>,
    /// The monitored nodes, in the order of [`Monitor::ALL`].
    pub monitors: [usize; 4],
    /// The two shell nodes beside the corneal apex, upper first.
    pub apex: [usize; 2],
    /// The ends of the vertical diameter, upper first.
    pub meridian: [usize; 2],
}

pub(super) fn find(mesh: &Mesh, level: u32) -> Landmarks {
    let k = level as usize;
    let at = |(i, j): (usize, usize)| {
        mesh.node_at(i * k, j * k)
            .expect("the globe is never cut by the opening")
    };
    let mirrored = |(i, j): (usize, usize)| at((i, 15 - j));

    let mut shell: Vec<usize> = (0..mesh.nodes.len())
        .filter(|&i| mesh.nodes[i].region.on_shell())
        .collect();
    let angle = |i: usize| {
        let p = mesh.nodes[i].position;
        p.y.atan2(p.x).rem_euclid(std::f64::consts::TAU)
    };
    shell.sort_by(|&a, &b| angle(a).total_cmp(&angle(b)));

    Landmarks {
        shell,
        monitors: Monitor::ALL.map(|m| at(m.grid())),
        apex: [at(Monitor::Front.grid()), mirrored(Monitor::Front.grid())],
        meridian: [at(Monitor::Top.grid()), mirrored(Monitor::Top.grid())],
    }
}
