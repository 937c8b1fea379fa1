//! What a picture of an eye is made of, whatever its model: nodes, lines between them with the
//! part that they draw, what bounds its parts, the loaded arc and the object, each at rest and in
//! any frame.
//!
//! Places are those of the section: x from the cornea to the back, y up, in m. An axisymmetric eye
//! is drawn as its half and the mirror image of that, both turned to where the blow comes from. Of
//! a fine mesh about as many lines are drawn as level 1 has, and the whole shell, lens and wall.

use crate::run::kept::Frame;
use crate::run::places::{ORBIT_RADIUS_M, Region};
use nalgebra::{Point2, Vector2};

/// Room beyond the wall for the bone as it is drawn, in m.
const BONE_M: Vector2<f64> = Vector2::new(4.4e-3, 3.2e-3);
/// From the middle of the globe to where the object still has room, in m.
const BEFORE_M: f64 = 24e-3;
/// How far beyond a triangle a point that it holds may lie, as a share of it.
const BEYOND: f64 = 0.6;
/// Room around the outermost part, as a share.
const MARGIN: f64 = 1.03;

/// How far a picture of such places and the arrow of the blow reaches, across and up, in m.
pub(crate) fn reach(places: impl Iterator<Item = Point2<f64>>) -> (f64, f64) {
    let room = (ORBIT_RADIUS_M * MARGIN, ORBIT_RADIUS_M * MARGIN);
    places.fold(room, |(across, up), at| {
        (across.max(at.x.abs() * MARGIN), up.max(at.y.abs() * MARGIN))
    })
}

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

/// The lines that bound the parts of an eye, as nodes in their order.
#[derive(Debug, Clone, Default)]
pub struct Outlines {
    /// The shell all around, once: from the front over one side to the back and on.
    pub shell: Vec<usize>,
    /// Its thickness at each of them, in m.
    pub thickness: Vec<f64>,
    /// Front angle at which the cornea ends, in rad.
    pub limbus: f64,
    /// The wall from its front edge on the first side around the back to that on the other.
    pub wall: Vec<usize>,
    /// The free surface of what holds the globe, on each side from the wall to the shell.
    pub free: [Vec<usize>; 2],
    /// Whether the wall is bone and not a holder of a laboratory.
    pub bone: bool,
}

/// A point of the tissue between three nodes.
#[derive(Debug, Clone, Copy)]
pub struct Held {
    nodes: [usize; 3],
    shares: [f64; 3],
}

/// An eye as it is drawn.
#[derive(Debug, Clone, Default)]
pub struct Drawing {
    /// All nodes, mirrored ones included.
    pub nodes: Vec<DrawnNode>,
    /// All lines.
    pub lines: Vec<Line>,
    /// Cells between nodes; those of some models have a pressure of their own.
    pub cells: Vec<DrawnCell>,
    /// What bounds its parts.
    pub outlines: Outlines,
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
    /// What hits it.
    pub object: Option<DrawnObject>,
    /// The edge of the bone from the front, if it is not round: x towards the nose, y up, in m.
    pub rim: Vec<Point2<f64>>,
}

/// The object that hits the eye.
#[derive(Debug, Clone, Copy)]
pub struct DrawnObject {
    /// Radius in m.
    pub radius: f64,
    /// Radius of the rounded edge of a cylinder, in m; none of a sphere.
    pub edge: Option<f64>,
    /// Unit vector of its way.
    pub direction: Vector2<f64>,
}

impl DrawnCell {
    /// The two triangles that it consists of.
    pub fn triangles(&self) -> [[usize; 3]; 2] {
        let [a, b, c, d] = self.corners;
        [[a, b, c], [a, c, d]]
    }
}

/// The shares of the corners of a triangle that make up a place; negative where it lies outside.
pub fn shares([a, b, c]: [Point2<f64>; 3], at: Point2<f64>) -> Option<[f64; 3]> {
    let whole = (b - a).perp(&(c - a));
    let of = |p: Point2<f64>, q: Point2<f64>| (p - at).perp(&(q - at)) / whole;
    (whole != 0.0).then(|| [of(b, c), of(c, a), of(a, b)])
}

impl Drawing {
    /// Where a node is in a frame, with its displacement shown `zoom` times.
    pub fn place(&self, frame: &Frame, node: usize, zoom: f64) -> Point2<f64> {
        let DrawnNode { of, rest, mirrored, .. } = self.nodes[node];
        let moved = rest + (frame.positions[of] - rest) * zoom;
        self.in_the_section(moved, mirrored)
    }

    /// Where a node rests.
    pub fn at_rest(&self, node: &DrawnNode) -> Point2<f64> {
        self.in_the_section(node.rest, node.mirrored)
    }

    fn in_the_section(&self, at: Point2<f64>, mirrored: bool) -> Point2<f64> {
        self.turned(if mirrored { Point2::new(at.x, -at.y) } else { at })
    }

    /// The force on a node in a frame, in N.
    pub fn force(&self, frame: &Frame, node: usize) -> f64 {
        frame.forces[self.nodes[node].of]
    }

    /// The pressure in a cell in a frame, in Pa.
    pub fn pressure(&self, frame: &Frame, cell: &DrawnCell) -> f64 {
        frame.cells.get(cell.of).copied().unwrap_or_default()
    }

    /// The point of the tissue that rests nearest to a place inside the globe.
    pub fn held(&self, at: Point2<f64>) -> Option<Held> {
        let rest: Vec<_> = self.nodes.iter().map(|node| self.at_rest(node)).collect();
        let triangles = self.cells.iter().flat_map(DrawnCell::triangles);
        // Just outside of all cells it is the one that has to reach least beyond itself.
        let worth = |nodes: [usize; 3]| {
            let shares = shares(nodes.map(|node| rest[node]), at)?;
            Some((shares.into_iter().fold(1.0, f64::min), Held { nodes, shares }))
        };
        let all = triangles.filter_map(worth);
        let best = all.max_by(|a, b| a.0.total_cmp(&b.0))?;
        (best.0 > -BEYOND).then_some(best.1)
    }

    /// Where a point of the tissue is in a frame, with its displacement shown `zoom` times.
    pub fn moved(&self, frame: &Frame, held: &Held, zoom: f64) -> Point2<f64> {
        let parts = held.nodes.iter().zip(held.shares);
        let sum = parts.map(|(node, share)| self.place(frame, *node, zoom).coords * share);
        Point2::from(sum.sum::<Vector2<f64>>())
    }

    /// The object, and in a frame the middle of what is left of it: of a cylinder, of its face.
    pub fn object(&self, frame: &Frame) -> Option<(DrawnObject, Point2<f64>)> {
        Some((self.object?, self.turned(frame.projectile?)))
    }

    /// The corners of a picture of the eye, the bone and room for the object to come from.
    pub fn extent(&self) -> (Point2<f64>, Point2<f64>) {
        let nodes = self.outlines.wall.iter().chain(&self.outlines.shell);
        let places = nodes.map(|node| self.at_rest(&self.nodes[*node]));
        let middle = (Point2::origin(), Point2::origin());
        let (low, high) = places.fold(middle, |(low, high), at| (low.inf(&at), high.sup(&at)));
        let way = self.object.map_or(Vector2::x(), |object| object.direction);
        let from = Point2::from(way * -BEFORE_M);
        let (low, high) = (low - BONE_M, high + BONE_M);
        (low.inf(&from), high.sup(&from))
    }

    fn turned(&self, at: Point2<f64>) -> Point2<f64> {
        self.along.map_or(at, |along| {
            let across = Vector2::new(-along.y, along.x);
            Point2::from(along * at.x + across * at.y)
        })
    }
}
