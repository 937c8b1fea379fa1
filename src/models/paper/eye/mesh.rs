//! Nodes: a square mesh mapped to a disc, cut into globe, shell, fat and orbit.
//!
//! Node (i, j) of the square has u = i - (n-1)/2, v = j - (n-1)/2 and ring r = max(|u|, |v|). The
//! concentric map puts it at radius r d and angle pi/4 v/u (where |u| >= |v|, plus pi for u < 0)
//! or pi/2 - pi/4 u/v (plus pi for v < 0), with d = 12 mm / (4.5 k). Level k has n = 15k + 1, so
//! level 1 is the paper's 16 x 16 mesh and every level holds the nodes of level 1.
//!
//! The paper draws the mapping without a formula; the concentric map keeps rings of the square as
//! circles, which its figure 5 shows.

use crate::models::paper::eye::lens;
use crate::run::places::{GLOBE_RADIUS_M, Region};
use crate::scenario::EyeInput;
use nalgebra::Point2;
use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, PI};

/// Ring index of the shell at level 1, in mesh units.
const SHELL_RING: f64 = 4.5;
/// Finer levels have nodes exactly on the edge of the opening.
const ANGLE_TOLERANCE_RAD: f64 = 1e-9 * PI / 180.0;

/// A point mass.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Node {
    /// Column and row in the square mesh.
    pub grid: (usize, usize),
    /// Rest position, in m.
    pub position: Point2<f64>,
    /// The part it belongs to.
    pub region: Region,
    /// Mass, in kg (that of a fat node for orbit nodes, which never move).
    pub mass: f64,
    /// Drag on its velocity, in N s/m.
    pub drag: f64,
}

impl Node {
    /// Whether the node never moves.
    pub fn fixed(&self) -> bool {
        self.region == Region::Orbit
    }

    /// [`front_angle`] of its place.
    pub fn front_angle(&self) -> f64 {
        front_angle(self.position)
    }
}

/// Angle of a point from the anterior pole, positive above, in radians.
fn front_angle(p: Point2<f64>) -> f64 {
    libm::atan2(p.y, -p.x)
}

pub(crate) struct SectionMesh {
    pub side: usize,
    pub nodes: Vec<Node>,
    pub quads: Vec<[usize; 4]>,
    /// Index into `nodes` of each place of the square mesh, if the opening leaves it.
    pub at: Vec<Option<usize>>,
}

impl SectionMesh {
    pub fn node_at(&self, i: usize, j: usize) -> Option<usize> {
        self.at[j * self.side + i]
    }
}

/// Concentric square-to-disc map of mesh coordinates to a point in units of the mesh: that of one
/// quadrant, reflected, so that mirror images agree to the last bit.
fn to_disc(u: f64, v: f64) -> Point2<f64> {
    let (across, up) = (u.abs(), v.abs());
    let ring = across.max(up);
    let angle = if ring == 0.0 {
        0.0
    } else if across >= up {
        FRAC_PI_4 * (up / across)
    } else {
        FRAC_PI_2 - FRAC_PI_4 * (across / up)
    };
    Point2::new((ring * libm::cos(angle)).copysign(u), (ring * libm::sin(angle)).copysign(v))
}

pub(crate) fn build(input: &EyeInput) -> SectionMesh {
    let k = f64::from(input.level);
    let side = 15 * input.level as usize + 1;
    let spacing = GLOBE_RADIUS_M / (SHELL_RING * k);
    let half = (side - 1) as f64 / 2.0;
    let opening = input.opening_deg.to_radians() + ANGLE_TOLERANCE_RAD;
    let retina = input.retina_deg.to_radians() + ANGLE_TOLERANCE_RAD;
    let globe_nodes = (9.0 * k + 1.0) * (9.0 * k + 1.0);
    let mass = input.globe_mass_g * 1e-3 / globe_nodes;
    // Drag follows node mass, so that the decay rate c/m is the same at every level.
    let refinement = 100.0 / globe_nodes;

    let mut nodes = Vec::with_capacity(side * side);
    let mut at = vec![None; side * side];
    for j in 0..side {
        for i in 0..side {
            let (u, v) = (i as f64 - half, j as f64 - half);
            let ring = u.abs().max(v.abs());
            let position = to_disc(u, v) * spacing;
            let region = if ring > SHELL_RING * k {
                if front_angle(position).abs() <= opening {
                    continue;
                }
                if ring < 7.5 * k { Region::Fat } else { Region::Orbit }
            } else if ring == SHELL_RING * k {
                let behind = PI - front_angle(position).abs() <= retina;
                if behind { Region::Retina } else { Region::Shell }
            } else if lens::holds(position) {
                Region::Lens
            } else {
                Region::Interior
            };
            let drag = if region.in_globe() { input.globe_drag_ns_m } else { input.fat_drag_ns_m };
            at[j * side + i] = Some(nodes.len());
            nodes.push(Node { grid: (i, j), position, region, mass, drag: drag * refinement });
        }
    }

    let mut mesh = SectionMesh { side, nodes, quads: Vec::new(), at };
    for j in 0..side - 1 {
        for i in 0..side - 1 {
            let corners = [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)];
            if let [Some(a), Some(b), Some(c), Some(d)] = corners.map(|(i, j)| mesh.node_at(i, j)) {
                mesh.quads.push([a, b, c, d]);
            }
        }
    }
    mesh
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_shell_is_a_circle_of_equal_steps() {
        let mesh = build(&EyeInput::default());
        let shell = mesh.nodes.iter().filter(|node| node.region.on_shell());
        let mut angles: Vec<f64> = shell.clone().map(|n| n.front_angle().to_degrees()).collect();
        angles.sort_by(f64::total_cmp);
        for ((i, angle), node) in angles.iter().enumerate().zip(shell) {
            assert!((node.position.coords.norm() - GLOBE_RADIUS_M).abs() < 1e-15);
            assert!((angle - (-175.0 + 10.0 * i as f64)).abs() < 1e-9);
        }
    }

    #[test]
    fn the_opening_keeps_nothing_in_front_but_the_globe() {
        for level in 1..=4 {
            let mesh = build(&EyeInput { level, ..EyeInput::default() });
            for node in mesh.nodes.iter().filter(|node| !node.region.in_globe()) {
                assert!(node.front_angle().to_degrees().abs() > 40.0 + 1e-10);
            }
        }
    }
}
