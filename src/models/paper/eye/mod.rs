//! Anatomy to mesh: nodes, springs and landmarks of the eye in its orbit. No time in it.
//!
//! The sagittal section lies in the plane with +x from the cornea to the back of the eye and +y
//! up. The centre of the globe is the origin. Positions are in m, stiffness in N/m, mass in kg,
//! drag in N s/m.
//!
//! Source: Sathyanarayanan, Mahadas and Hung (2013), Methods. Left out, as in the paper: iris,
//! ciliary body, optic nerve and muscles, which the 16 x 16 mesh cannot resolve.

pub mod frequency;
pub mod hats;
pub mod landmarks;
pub mod lens;
pub mod mesh;
pub mod springs;

use crate::scenario::EyeInput;
use landmarks::Landmarks;
use mesh::Node;
use nalgebra::Point2;
use springs::Spring;

/// Twice the signed area of a quad: the cross product of its diagonals.
pub(crate) fn crossed([a, b, c, d]: [Point2<f64>; 4]) -> f64 {
    (c - a).perp(&(d - b))
}

/// The eye at rest: a mesh of nodes joined by springs, with the places that results refer to.
#[derive(Debug, Clone, PartialEq)]
pub struct Eye {
    /// Refinement level k.
    pub level: u32,
    /// Nodes a side of the square mesh, 15k + 1.
    pub side: usize,
    /// Half-angle of the front opening, in radians.
    pub opening_rad: f64,
    /// The nodes that the front opening leaves, row by row.
    pub nodes: Vec<Node>,
    /// Indices into `nodes` of each quad's corners, anticlockwise from its lower left.
    pub quads: Vec<[usize; 4]>,
    /// Every spring, the filaments last.
    pub springs: Vec<Spring>,
    /// Nodes with a name.
    pub landmarks: Landmarks,
}

impl Eye {
    /// Builds the eye that `input` asks for. The input must have been validated.
    pub fn build(input: &EyeInput) -> Self {
        let mesh = mesh::build(input);
        let landmarks = landmarks::find(&mesh, input.level);
        let springs = springs::build(input, &mesh, &landmarks.shell);
        Self {
            level: input.level,
            side: mesh.side,
            opening_rad: input.opening_deg.to_radians(),
            nodes: mesh.nodes,
            quads: mesh.quads,
            springs,
            landmarks,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::springs::SpringKind;
    use super::*;

    fn level(level: u32) -> Eye {
        Eye::build(&EyeInput { level, ..EyeInput::default() })
    }

    #[test]
    fn level_one_has_the_papers_counts_and_filaments_as_stiff_as_the_shell_for_their_length() {
        let eye = level(1);
        assert_eq!(eye.nodes.len(), 220);
        assert_eq!(eye.nodes.iter().filter(|node| !node.fixed()).count(), 174);
        for (kind, count) in [
            (SpringKind::Rest, 299),
            (SpringKind::Fat, 433),
            (SpringKind::Sclera, 40),
            (SpringKind::Lens, 3),
            (SpringKind::Filament, 108),
        ] {
            assert_eq!(eye.springs.iter().filter(|s| s.kind == kind).count(), count, "{kind:?}");
        }
        assert_eq!(eye.springs.len(), 883);
        let fixed = |node: usize| eye.nodes[node].fixed();
        let works = |s: &&Spring| s.stiffness > 0.0 && !(fixed(s.a) && fixed(s.b));
        assert_eq!(eye.springs.iter().filter(works).count(), 838);
        assert_eq!(eye.nodes.iter().filter(|n| n.region.in_globe()).count(), 100);
        assert_eq!(eye.landmarks.shell.len(), 36);
        for spring in eye.springs.iter().filter(|s| s.kind == SpringKind::Filament) {
            let value = spring.stiffness * spring.rest_length;
            assert!((value - 1.1505e4).abs() < 0.5, "{value}");
        }
    }

    #[test]
    fn finer_levels_contain_every_node_of_level_one_and_weigh_as_much() {
        for k in 1..=4 {
            let fine = level(k);
            for node in &level(1).nodes {
                let grid = (node.grid.0 * k as usize, node.grid.1 * k as usize);
                let same = fine.nodes.iter().find(|f| f.grid == grid);
                let same = same.unwrap_or_else(|| panic!("level {k} lacks {:?}", node.grid));
                assert!((same.position - node.position).norm() < 1e-15);
                assert_eq!(same.region, node.region);
            }
            let globe = fine.nodes.iter().filter(|n| n.region.in_globe());
            assert!((globe.map(|n| n.mass).sum::<f64>() - 7.5e-3).abs() < 1e-12);
        }
    }

    #[test]
    fn the_mesh_is_its_own_mirror_image() {
        for k in 1..=3 {
            let eye = level(k);
            let grid = |node: usize| eye.nodes[node].grid;
            let mirror = |node: usize| (grid(node).0, eye.side - 1 - grid(node).1);
            for spring in &eye.springs {
                let ends = [mirror(spring.a), mirror(spring.b)];
                let twin = eye.springs.iter().find(|t| {
                    let (p, q) = (grid(t.a), grid(t.b));
                    t.kind == spring.kind && (ends == [p, q] || ends == [q, p])
                });
                let twin = twin.unwrap_or_else(|| panic!("level {k}: no twin of {spring:?}"));
                assert!((twin.stiffness / spring.stiffness - 1.0).abs() < 1e-9);
            }
        }
    }
}
