//! What a picture of an eye is made of, whatever its model: nodes, lines between them with the
//! part that they draw, the loaded arc and the object's outline, each at rest and in any frame.
//!
//! Places are those of the section: x from the cornea to the back, y up, in m. An axisymmetric eye
//! is drawn as a whole section: its half, the mirror image of that, and both turned to where the
//! blow comes from. Of a fine mesh about as many lines are drawn as level 1 has, and the whole
//! shell, lens and wall.

use crate::run::kept::Frame;
use crate::run::places::Region;
use nalgebra::{Point2, Vector2};

/// Sides of the polygon that stands for a circle.
const SIDES: u32 = 48;
/// Room around the outermost part, as a share.
pub(crate) const MARGIN: f64 = 1.03;

/// A node that is drawn.
#[derive(Debug, Clone, Copy)]
pub struct DrawnNode {
    /// Which part of the eye it belongs to.
    pub region: Region,
    /// Whether it is drawn where only some nodes stand for all.
    pub coarse: bool,
    /// Index of the node in the frame.
    pub(crate) of: usize,
    /// Where it rests in the frame's own axes.
    pub(crate) rest: Point2<f64>,
    pub(crate) mirrored: bool,
}

/// A line between two nodes.
#[derive(Debug, Clone, Copy)]
pub struct Line {
    /// Indices of nodes.
    pub ends: (usize, usize),
    /// Part of the eye that the line belongs to.
    pub region: Region,
}

/// A cell between four nodes.
#[derive(Debug, Clone, Copy)]
pub struct DrawnCell {
    /// Indices of nodes, in order.
    pub corners: [usize; 4],
    /// Index of the cell in the frame.
    pub(crate) of: usize,
}

/// An eye as it is drawn.
#[derive(Debug, Clone)]
pub struct Drawing {
    /// All nodes, mirrored ones included.
    pub nodes: Vec<DrawnNode>,
    /// All lines.
    pub lines: Vec<Line>,
    /// Cells that have a pressure of their own, where the eye is made of such.
    pub cells: Vec<DrawnCell>,
    /// The nodes nearest to the four monitored places.
    pub monitors: [usize; 4],
    /// Pieces of the shell that a pulse loads; both ends are the same where it loads one node.
    pub loaded: Vec<(usize, usize)>,
    /// When the load ends, in s.
    pub loaded_until: f64,
    /// How far a picture reaches from the middle of the globe, across and up, in m.
    pub reach: (f64, f64),
    /// Which way a blow goes, if the frame's axes lie along it.
    pub(crate) along: Option<Vector2<f64>>,
    pub(crate) object: Option<DrawnObject>,
}

/// The object that hits the eye.
#[derive(Debug, Clone, Copy)]
pub(crate) struct DrawnObject {
    /// Radius in m.
    pub radius: f64,
    /// Radius of the rounded edge of a cylinder, in m; none of a sphere.
    pub edge: Option<f64>,
    /// Unit vector of its way.
    pub direction: Vector2<f64>,
}

impl Drawing {
    /// Where a node is in a frame, with its displacement shown `zoom` times.
    pub fn place(&self, frame: &Frame, node: usize, zoom: f64) -> Point2<f64> {
        let DrawnNode {
            of, rest, mirrored, ..
        } = self.nodes[node];
        let moved = rest + (frame.positions[of] - rest) * zoom;
        self.in_the_section(moved, mirrored)
    }

    /// Where a node rests.
    pub fn at_rest(&self, node: &DrawnNode) -> Point2<f64> {
        self.in_the_section(node.rest, node.mirrored)
    }

    fn in_the_section(&self, mut at: Point2<f64>, mirrored: bool) -> Point2<f64> {
        if mirrored {
            at.y = -at.y;
        }
        self.turned(at)
    }

    /// The force on a node in a frame, in N.
    pub fn force(&self, frame: &Frame, node: usize) -> f64 {
        frame.forces[self.nodes[node].of]
    }

    /// The pressure in a cell in a frame, in Pa.
    pub fn pressure(&self, frame: &Frame, cell: &DrawnCell) -> f64 {
        frame.cells.get(cell.of).copied().unwrap_or_default()
    }

    /// The outline of the object in a frame: a closed polygon.
    pub fn object(&self, frame: &Frame) -> Option<Vec<Point2<f64>>> {
        let DrawnObject {
            radius,
            edge,
            direction,
        } = self.object?;
        let centre = self.turned(frame.projectile?);
        let sideways = Vector2::new(-direction.y, direction.x);
        Some(match edge {
            None => {
                // A soft object is squeezed along its way; how it bulges is left out.
                let along = direction * (radius - 0.5 * frame.squeezed);
                let across = sideways * radius;
                let corner = |i: u32| {
                    let angle = std::f64::consts::TAU * f64::from(i) / f64::from(SIDES);
                    centre + along * libm::cos(angle) + across * libm::sin(angle)
                };
                (0..SIDES).map(corner).collect()
            }
            Some(edge) => {
                // Its length is not known: it is drawn as long as half of its width.
                let edges = [
                    (0.0, radius - edge),
                    (-0.3 * edge, radius - 0.3 * edge),
                    (-edge, radius),
                    (-radius.max(edge), radius),
                ];
                let below = edges.iter().rev().map(|&(x, y)| (x, -y));
                (edges.iter().copied().chain(below))
                    .map(|(x, y)| centre + direction * x + sideways * y)
                    .collect()
            }
        })
    }

    fn turned(&self, at: Point2<f64>) -> Point2<f64> {
        self.along.map_or(at, |along| {
            let across = Vector2::new(-along.y, along.x);
            Point2::from(along * at.x + across * at.y)
        })
    }
}
