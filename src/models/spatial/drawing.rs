//! The picture of the eye in three dimensions: its section in the plane of the blow.

use crate::models::spatial::{case::SpatialCase, recording::section::Section};
use crate::run::drawing::{Drawing, DrawnCell, DrawnNode, Line, Outlines, reach};
use crate::run::places::Region;
use nalgebra::{Point2, Vector2};
use std::collections::BTreeMap;
use std::f64::consts::TAU;

/// Points around the rim.
const AROUND: usize = 72;

/// The drawing of a case.
pub(crate) fn of(case: &SpatialCase) -> Drawing {
    let section = Section::new(&case.eye, &case.blow);
    let shown = section.shown(case.blow.in_mesh().way());
    let along = Vector2::new(shown.x, shown.y);
    let lines = lines(&section);
    let nodes = section.points.iter().enumerate().map(|(of, point)| DrawnNode {
        region: point.region,
        coarse: true,
        of,
        rest: point.rest,
        mirrored: false,
    });
    let nodes: Vec<DrawnNode> = nodes.collect();
    let reach = reach(nodes.iter().map(|node| node.rest));
    let cells = section.cells.iter().enumerate();
    Drawing {
        cells: cells.map(|(of, (corners, _))| DrawnCell { corners: *corners, of }).collect(),
        outlines: outlines(case, &section),
        monitors: section.monitors,
        reach,
        object: Some(case.blow.object.outline.drawn(along.normalize())),
        nodes,
        lines,
        rim: rim(case),
        ..Drawing::default()
    }
}

/// The edge of the bone from the front.
fn rim(case: &SpatialCase) -> Vec<Point2<f64>> {
    let Some(rim) = case.eye.rim.filter(|rim| !rim.is_round()) else { return Vec::new() };
    let azimuths = (0..AROUND).map(|i| TAU * i as f64 / AROUND as f64);
    let point = |azimuth: f64| {
        let (_, r) = rim.at(azimuth, case.eye.parameters.radius);
        Point2::new(r * libm::sin(azimuth), r * libm::cos(azimuth))
    };
    azimuths.map(point).collect()
}

/// What bounds the parts of the section.
fn outlines(case: &SpatialCase, section: &Section) -> Outlines {
    let parameters = &case.eye.parameters;
    // Both halves have a point at the poles.
    let around = |[one, other]: &[Vec<usize>; 2], ends: usize| -> Vec<usize> {
        let back = other.len().saturating_sub(1);
        let other = other[..back].iter().skip(ends).rev();
        one.iter().chain(other).copied().collect()
    };
    let shell = around(&section.shell, 1);
    let thickness = |of: &usize| {
        let at = section.points[*of].rest;
        parameters.shell.at(libm::atan2(at.y.abs(), -at.x)).0
    };
    Outlines {
        thickness: shell.iter().map(thickness).collect(),
        shell,
        limbus: parameters.shell.limbus,
        wall: around(&section.wall, 0),
        free: section.free.clone(),
        bone: parameters.surround.is_some_and(|around| around.wall.is_bone()),
    }
}

/// All lines with the part that they draw: shell and wall, the lens where it ends, and cells.
fn lines(section: &Section) -> Vec<Line> {
    let sorted = |a: usize, b: usize| (a.min(b), a.max(b));
    let region = |of: usize| section.points[of].region;
    let mut parts: BTreeMap<(usize, usize), Region> = BTreeMap::new();
    for ends in section.wall.iter().flat_map(|half| half.windows(2)) {
        parts.insert(sorted(ends[0], ends[1]), Region::Orbit);
    }
    for ends in section.shell.iter().flat_map(|half| half.windows(2)) {
        let both = ends.iter().all(|&of| region(of) == Region::Retina);
        let part = if both { Region::Retina } else { Region::Shell };
        parts.insert(sorted(ends[0], ends[1]), part);
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
