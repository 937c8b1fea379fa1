//! The picture of the eye in three dimensions: its section in the plane of the blow.

use crate::models::axisymmetric::forces::object::ObjectOutline;
use crate::models::spatial::case::SpatialCase;
use crate::models::spatial::eye::SpatialEye;
use crate::models::spatial::forces::object::Aim;
use crate::models::spatial::recording::section::Section;
use crate::models::spatial::time::run::SpatialLoad;
use crate::run::drawing::{Drawing, DrawnCell, DrawnNode, DrawnObject, Line, MARGIN};
use crate::run::places::{ORBIT_RADIUS_M, Region};
use nalgebra::{Point2, Vector2, Vector3};
use std::collections::{BTreeMap, BTreeSet};

/// The drawing of a case.
pub(crate) fn of(case: &SpatialCase) -> Drawing {
    let section = Section::new(&case.eye, &case.blow);
    let aim = case.blow.in_mesh();
    let shown = section.shown(aim.way());
    let along = Vector2::new(shown.x, shown.y);
    let lines = lines(&section);
    let nodes = section
        .points
        .iter()
        .enumerate()
        .map(|(of, point)| DrawnNode {
            region: point.region,
            coarse: true,
            of,
            rest: point.rest,
            mirrored: false,
        });
    let nodes: Vec<DrawnNode> = nodes.collect();
    let room = (ORBIT_RADIUS_M * MARGIN, ORBIT_RADIUS_M * MARGIN);
    let reach = nodes.iter().fold(room, |(across, up), node| {
        let at: Point2<f64> = node.rest;
        (across.max(at.x.abs() * MARGIN), up.max(at.y.abs() * MARGIN))
    });
    let cells = section.cells.iter().enumerate();
    let pulse = match &case.blow.load {
        SpatialLoad::Pulse(pulse, half_width) => Some((pulse.duration(), *half_width)),
        SpatialLoad::Object(_) => None,
    };
    Drawing {
        cells: cells
            .map(|(of, (corners, _))| DrawnCell {
                corners: *corners,
                of,
            })
            .collect(),
        monitors: section.monitors,
        loaded: pulse.map_or(Vec::new(), |(_, half_width)| {
            loaded(&section, &case.eye, aim, half_width)
        }),
        loaded_until: pulse.map_or(0.0, |(duration, _)| duration),
        reach,
        along: None,
        object: case.object().map(|object| DrawnObject {
            radius: object.outline.radius(),
            edge: match object.outline {
                ObjectOutline::Sphere(_) => None,
                ObjectOutline::Cylinder(_, edge) => Some(edge),
            },
            direction: along.normalize(),
        }),
        nodes,
        lines,
    }
}

/// All lines with the part that they draw: shell and wall, the lens where it ends, and cells.
fn lines(section: &Section) -> Vec<Line> {
    let sorted = |a: usize, b: usize| (a.min(b), a.max(b));
    let region = |of: usize| section.points[of].region;
    let mut parts: BTreeMap<(usize, usize), Region> = BTreeMap::new();
    for &[a, b] in &section.wall {
        parts.insert(sorted(a, b), Region::Orbit);
    }
    for half in &section.shell {
        for ends in half.windows(2) {
            let both = ends.iter().all(|&of| region(of) == Region::Retina);
            let part = if both { Region::Retina } else { Region::Shell };
            parts.insert(sorted(ends[0], ends[1]), part);
        }
    }
    for (corners, _) in &section.cells {
        for i in 0..4 {
            let (a, b) = (corners[i], corners[(i + 1) % 4]);
            let around = |of: usize| matches!(region(of), Region::Fat | Region::Orbit);
            let part = if around(a) || around(b) {
                Region::Fat
            } else if region(a) == Region::Lens && region(b) == Region::Lens {
                Region::Lens
            } else {
                Region::Interior
            };
            parts.entry(sorted(a, b)).or_insert(part);
        }
    }
    let line = |(ends, region)| Line { ends, region };
    parts.into_iter().map(line).collect()
}

/// Pieces of the shell within an angle of where a pulse enters.
fn loaded(section: &Section, eye: &SpatialEye, aim: Aim, half_width: f64) -> Vec<(usize, usize)> {
    let nodes = std::array::from_fn(|k| eye.mesh.at.iter().map(|p| p[k]).collect());
    let way = aim.way();
    let under = |of: usize| {
        let at: Vector3<f64> = section.points[of].point.of(&nodes);
        libm::atan2(at.cross(&way).norm(), -at.dot(&way)) <= half_width
    };
    let pieces = section.shell.iter().flat_map(|half| half.windows(2));
    let mut seen = BTreeSet::new();
    pieces
        .map(|ends| (ends[0], ends[1]))
        .filter(|(a, b)| under(*a) || under(*b))
        .map(|(a, b)| (if under(a) { a } else { b }, if under(b) { b } else { a }))
        .filter(|ends| seen.insert(*ends))
        .collect()
}
