//! What a picture of an eye is made of, whatever its model: nodes, lines between them with the part that they
//! draw, the loaded arc and the object's outline, each at rest and in any frame.
//!
//! Places are those of the section: x from the cornea to the back, y up, in m. A body of revolution is drawn
//! as a whole section: its half, the mirror image of that, and both turned to where the blow comes from.
//! Of a fine mesh about as many lines are drawn as level 1 has, and the whole shell, lens and wall.

use crate::models::axisymmetric::case::RevolutionCase;
use crate::models::axisymmetric::eye::RevolutionEye;
use crate::models::axisymmetric::eye::mesh::Block;
use crate::models::axisymmetric::forces::object::Outline;
use crate::models::axisymmetric::time::run::Blow;
use crate::models::compiled::Compiled;
use crate::models::paper::case::Case;
use crate::models::paper::eye::Eye;
use crate::models::paper::eye::mesh::{ORBIT_RADIUS_M, Region};
use crate::models::paper::eye::springs::{Spring, SpringKind};
use crate::run::kept::Frame;
use nalgebra::{Point2, Vector2};
use std::collections::{BTreeMap, BTreeSet};

/// Sides of the polygon that stands for a circle.
const SIDES: u32 = 48;
/// Room around the outermost part, as a share.
const MARGIN: f64 = 1.03;

/// A node that is drawn.
#[derive(Debug, Clone, Copy)]
pub struct DrawnNode {
    /// Which part of the eye it belongs to.
    pub region: Region,
    /// Whether it is one of those that stand for all where only nodes are drawn.
    pub coarse: bool,
    /// Its place in the frame.
    of: usize,
    /// Where it rests in the frame's own axes.
    rest: Point2<f64>,
    mirrored: bool,
}

/// A line between two nodes.
#[derive(Debug, Clone, Copy)]
pub struct Line {
    /// Indices of nodes.
    pub ends: (usize, usize),
    /// The part that it draws.
    pub region: Region,
}

/// A cell between four nodes.
#[derive(Debug, Clone, Copy)]
pub struct DrawnCell {
    /// Indices of nodes, in order.
    pub corners: [usize; 4],
    /// Its place in the frame.
    of: usize,
}

/// An eye as it is drawn.
#[derive(Debug, Clone)]
pub struct Drawing {
    /// All of them.
    pub nodes: Vec<DrawnNode>,
    /// All of them.
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
    along: Option<Vector2<f64>>,
    object: Option<Object>,
}

/// An object on its way.
#[derive(Debug, Clone, Copy)]
struct Object {
    outline: Outline,
    direction: Vector2<f64>,
}

impl Drawing {
    /// The drawing of an eye.
    pub fn of(case: &Compiled) -> Self {
        match case {
            Compiled::Section(case) => of_section(case),
            Compiled::Revolution(case) => of_revolution(case),
        }
    }

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
        let Object { outline, direction } = self.object?;
        let centre = self.turned(frame.projectile?);
        let sideways = Vector2::new(-direction.y, direction.x);
        Some(match outline {
            Outline::Sphere(radius) => {
                // A soft object is squeezed along its flight; how it bulges is left out.
                let along = direction * (radius - 0.5 * frame.squeezed);
                let across = sideways * radius;
                let corner = |i: u32| {
                    let angle = std::f64::consts::TAU * f64::from(i) / f64::from(SIDES);
                    centre + along * libm::cos(angle) + across * libm::sin(angle)
                };
                (0..SIDES).map(corner).collect()
            }
            Outline::Cylinder(radius, edge) => {
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

fn of_section(case: &Case) -> Drawing {
    let eye = &case.eye;
    let level = eye.level as usize;
    let node = |(of, node): (usize, &crate::models::paper::eye::mesh::Node)| DrawnNode {
        region: node.region,
        coarse: node.grid.0.is_multiple_of(level) && node.grid.1.is_multiple_of(level),
        of,
        rest: node.position,
        mirrored: false,
    };
    let line = |spring: &Spring| {
        let (ends, region) = ((spring.a, spring.b), part(eye, spring)?);
        Some(Line { ends, region })
    };
    let shell = &eye.landmarks.shell;
    let loaded = |node: usize| case.load.shares.iter().any(|(n, _)| *n == node);
    let next = shell.iter().cycle().skip(1);
    Drawing {
        nodes: eye.nodes.iter().enumerate().map(node).collect(),
        lines: eye.springs.iter().filter_map(line).collect(),
        monitors: eye.landmarks.monitors,
        loaded: shell
            .iter()
            .zip(next)
            .filter(|(a, _)| loaded(**a))
            .map(|(&a, &b)| (a, if loaded(b) { b } else { a }))
            .collect(),
        loaded_until: case.system.load().pulse.duration(),
        cells: Vec::new(),
        reach: (ORBIT_RADIUS_M * MARGIN, ORBIT_RADIUS_M * MARGIN),
        along: None,
        object: None,
    }
}

/// Which part of the eye a spring draws, if it is drawn at all: sides of the level-1 mesh, and
/// the whole shell, lens and orbit of any mesh.
fn part(eye: &Eye, spring: &Spring) -> Option<Region> {
    let (a, b) = (&eye.nodes[spring.a], &eye.nodes[spring.b]);
    let (along, across) = (a.grid.0.abs_diff(b.grid.0), a.grid.1.abs_diff(b.grid.1));
    if along + across != 1 || spring.kind == SpringKind::Filament {
        return None;
    }
    let both = |region| a.region == region && b.region == region;
    if both(Region::Orbit) {
        return Some(Region::Orbit);
    }
    if both(Region::Retina) {
        return Some(Region::Retina);
    }
    if a.region.on_shell() && b.region.on_shell() {
        return Some(Region::Shell);
    }
    let level = eye.level as usize;
    let on_coarse_line = if along == 1 {
        a.grid.1.is_multiple_of(level)
    } else {
        a.grid.0.is_multiple_of(level)
    };
    if !on_coarse_line {
        return None;
    }
    Some(if both(Region::Lens) {
        Region::Lens
    } else if a.region.in_globe() && b.region.in_globe() {
        Region::Interior
    } else {
        Region::Fat
    })
}

fn of_revolution(case: &RevolutionCase) -> Drawing {
    let eye = &case.eye;
    let angle = case.angle_deg.to_radians();
    let along = Vector2::new(libm::cos(angle), -libm::sin(angle));
    let (half, coarse) = half_section(eye);
    let regions = eye.node_regions();
    let rest = |of: usize| Point2::new(eye.at(of).0, eye.at(of).1);
    let node = |of: usize, mirrored: bool| DrawnNode {
        region: regions[of],
        coarse: coarse.contains(&of),
        of,
        rest: rest(of),
        mirrored,
    };
    let count = eye.mass.len();
    let mut nodes: Vec<DrawnNode> = (0..count).map(|of| node(of, false)).collect();
    // What lies on the axis is its own mirror image.
    let mut image = Vec::with_capacity(count);
    for of in 0..count {
        if rest(of).y == 0.0 {
            image.push(of);
        } else {
            image.push(nodes.len());
            nodes.push(node(of, true));
        }
    }
    let mirrored = |(a, b): (usize, usize)| (image[a], image[b]);
    let mut lines = half.clone();
    lines.extend(half.iter().filter_map(|line| {
        let ends = mirrored(line.ends);
        (ends != line.ends).then_some(Line { ends, ..*line })
    }));
    let pulse = match &case.load {
        Blow::Pulse(pulse, half_width) => Some((pulse.duration(), *half_width)),
        Blow::Object(_) => None,
    };
    let under = |node: usize| {
        let (x, r) = eye.at(node);
        pulse.is_some_and(|(_, half_width)| libm::atan2(r, -x) <= half_width)
    };
    let arc = eye.mesh.shell.windows(2).map(|ends| (ends[0], ends[1]));
    let arc = arc.filter(|(a, _)| under(*a));
    let loaded = arc.map(|(a, b)| (a, if under(b) { b } else { a }));
    let cells = eye.cells.iter().enumerate();
    let cells = cells.flat_map(|(of, cell)| {
        let corners = cell.corners;
        [corners, corners.map(|node| image[node])].map(|corners| DrawnCell { corners, of })
    });
    let mut drawing = Drawing {
        cells: cells.collect(),
        monitors: crate::models::axisymmetric::recording::sensor::monitored(eye),
        loaded: loaded.flat_map(|ends| [ends, mirrored(ends)]).collect(),
        loaded_until: pulse.map_or(0.0, |(duration, _)| duration),
        // The arrow of the blow needs some room too.
        reach: (ORBIT_RADIUS_M * MARGIN, ORBIT_RADIUS_M * MARGIN),
        along: Some(along),
        object: match &case.load {
            Blow::Object(object) => Some(Object {
                outline: object.outline,
                direction: along,
            }),
            Blow::Pulse(..) => None,
        },
        nodes,
        lines,
    };
    let places = drawing.nodes.iter().map(|node| drawing.at_rest(node));
    drawing.reach = places.fold(drawing.reach, |(across, up), at| {
        (across.max(at.x.abs() * MARGIN), up.max(at.y.abs() * MARGIN))
    });
    drawing
}

/// The lines of the half section, and the nodes at which those of its cells cross.
fn half_section(eye: &RevolutionEye) -> (Vec<Line>, BTreeSet<usize>) {
    let sorted = |a: usize, b: usize| (a.min(b), a.max(b));
    let regions = eye.node_regions();
    let mut parts: BTreeMap<(usize, usize), Region> = BTreeMap::new();
    for ends in eye.mesh.wall.windows(2) {
        parts.insert(sorted(ends[0], ends[1]), Region::Orbit);
    }
    for ends in eye.mesh.shell.windows(2) {
        let both = ends.iter().all(|&node| regions[node] == Region::Retina);
        let region = if both { Region::Retina } else { Region::Shell };
        parts.insert(sorted(ends[0], ends[1]), region);
    }
    // The lens is outlined where cells that are mostly lens meet others.
    let mut sides: BTreeMap<(usize, usize), usize> = BTreeMap::new();
    for cell in eye.cells.iter().filter(|cell| cell.lens > 0.5) {
        for i in 0..4 {
            *sides
                .entry(sorted(cell.corners[i], cell.corners[(i + 1) % 4]))
                .or_default() += 1;
        }
    }
    let on_axis = |node: usize| eye.at(node).1 == 0.0;
    for ((a, b), cells) in sides {
        if cells == 1 && !(on_axis(a) && on_axis(b)) {
            parts.entry((a, b)).or_insert(Region::Lens);
        }
    }
    let mut crossings = BTreeSet::new();
    for (i, block) in eye.mesh.blocks.iter().enumerate() {
        let region = if i == 2 {
            Region::Fat
        } else {
            Region::Interior
        };
        let (lines, corners) = coarse_lines(block, eye.level);
        crossings.extend(corners);
        for (a, b) in lines {
            parts.entry(sorted(a, b)).or_insert(region);
        }
    }
    let line = |(ends, region)| Line { ends, region };
    (parts.into_iter().map(line).collect(), crossings)
}

/// Edges on about as many rows and columns of a block as it has at level 1, and where these cross.
fn coarse_lines(block: &Block, level: u32) -> (Vec<(usize, usize)>, Vec<usize>) {
    let chosen = |intervals: usize| -> BTreeSet<usize> {
        // The mesh of level k has (2k + 2)/4 times as many cells along each side as that of level 1.
        let coarse = (2.0 * intervals as f64 / f64::from(level + 1))
            .round()
            .max(1.0);
        let place = |i: usize| (i as f64 * intervals as f64 / coarse).round() as usize;
        (0..=coarse as usize).map(place).collect()
    };
    let (rows, columns) = (block.nodes.len() / block.columns, block.columns);
    let (along, across) = (chosen(rows - 1), chosen(columns - 1));
    let node = |row: usize, column: usize| block.nodes[row * columns + column];
    let mut lines = Vec::new();
    for &row in &along {
        lines.extend((1..columns).map(|c| (node(row, c - 1), node(row, c))));
    }
    for &column in &across {
        lines.extend((1..rows).map(|r| (node(r - 1, column), node(r, column))));
    }
    let crossing = |row: &usize| across.iter().map(|c| node(*row, *c)).collect::<Vec<_>>();
    (lines, along.iter().flat_map(crossing).collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::answer::solve::solve;
    use crate::models::paper::case::unwatched;
    use crate::run::kept::Keep;
    use crate::run::kept::Spacing;
    use crate::scenario::{Impact, Model, Physiological, Projectile, Scenario};

    #[test]
    fn a_body_of_revolution_is_drawn_as_a_whole_section_that_faces_the_blow() {
        let scenario = Scenario {
            model: Model::Physiological(Physiological::default()),
            impact: Impact::Projectile(Projectile {
                angle_deg: 30.0,
                ..Projectile::default()
            }),
            window_ms: 0.05,
            ..Scenario::default()
        };
        let keep = Keep {
            traces: false,
            frames: Some(Spacing::even(1e-5)),
        };
        let answer = solve(&scenario.check().unwrap(), keep, &mut unwatched).unwrap();
        let drawing = Drawing::of(&answer.case);
        let (first, last) = (&answer.frames[0], answer.frames.last().unwrap());
        let has = |region| drawing.lines.iter().any(|line| line.region == region);
        for region in [Region::Shell, Region::Retina, Region::Lens, Region::Orbit] {
            assert!(has(region), "{region:?}");
        }
        // The object comes from 30 degrees above the front and lies outside of the globe.
        let outline = drawing.object(first).unwrap();
        let nearest = outline.iter().map(|p| p.coords.norm());
        let touch = outline
            .iter()
            .zip(nearest)
            .min_by(|a, b| a.1.total_cmp(&b.1));
        let (at, distance) = touch.unwrap();
        assert!((distance - 12e-3).abs() < 1e-4, "{distance}");
        let angle = at.y.atan2(-at.x).to_degrees();
        assert!((angle - 30.0).abs() < 4.0, "{angle}");
        // Every line has a mirror image about the line of the blow.
        let along = Vector2::new(30f64.to_radians().cos(), -30f64.to_radians().sin());
        let across = |p: Point2<f64>| p.coords.perp(&along);
        let sum: f64 = (0..drawing.nodes.len())
            .map(|node| across(drawing.place(last, node, 1.0)))
            .sum();
        assert!(sum.abs() < 1e-9, "{sum}");
    }
}
