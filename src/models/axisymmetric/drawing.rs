//! The picture of the axisymmetric eye: its half section, the mirror image of that, and both
//! turned to where the blow comes from.
//!
//! Of a fine mesh about as many lines are drawn as level 1 has, and the whole shell, lens and
//! wall.

use crate::models::axisymmetric::{case::AxisymmetricCase, eye::AxisymmetricEye, eye::mesh::Block};
use crate::models::axisymmetric::{recording::sensor::monitored, time::run::AxisymmetricLoad};
use crate::run::drawing::{Drawing, DrawnCell, DrawnNode, Line, Outlines, reach};
use crate::run::places::Region;
use nalgebra::{Point2, Vector2};
use std::collections::{BTreeMap, BTreeSet};

/// The drawing of a case.
pub(crate) fn of(case: &AxisymmetricCase) -> Drawing {
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
        AxisymmetricLoad::Pulse(pulse, half_width) => Some((pulse.duration(), *half_width)),
        AxisymmetricLoad::Object(_) => None,
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
    let outlines = outlines(eye, &image);
    let mut drawing = Drawing {
        cells: cells.collect(),
        outlines,
        monitors: monitored(eye),
        loaded: loaded.flat_map(|ends| [ends, mirrored(ends)]).collect(),
        loaded_until: pulse.map_or(0.0, |(duration, _)| duration),
        along: Some(along),
        object: match &case.load {
            AxisymmetricLoad::Object(object) => Some(object.outline.drawn(along)),
            AxisymmetricLoad::Pulse(..) => None,
        },
        nodes,
        lines,
        ..Drawing::default()
    };
    drawing.reach = reach(drawing.nodes.iter().map(|node| drawing.at_rest(node)));
    drawing
}

/// What bounds the parts of the whole section, of whose nodes `image` has the mirror images.
fn outlines(eye: &AxisymmetricEye, image: &[usize]) -> Outlines {
    let mesh = &eye.mesh;
    // Both halves have the nodes on the axis.
    let around = |half: &[usize], ends: usize| {
        let other = half[..half.len() - 1].iter().skip(ends).rev();
        half.iter().copied().chain(other.map(|node| image[*node])).collect()
    };
    let shell: Vec<usize> = around(&mesh.shell, 1);
    let thickness = |node: &usize| {
        let (x, r) = eye.at(*node);
        eye.parameters.shell.at(libm::atan2(r, -x)).0
    };
    let half: Vec<f64> = mesh.shell.iter().map(thickness).collect();
    let other = half[1..half.len() - 1].iter().rev().copied();
    let free: Vec<usize> = mesh.blocks.get(2).map_or_else(Vec::new, |block| {
        block.nodes.iter().step_by(block.columns).rev().copied().collect()
    });
    Outlines {
        thickness: half.iter().copied().chain(other).collect(),
        shell,
        limbus: eye.parameters.shell.limbus,
        wall: if mesh.wall.is_empty() { Vec::new() } else { around(&mesh.wall, 0) },
        free: [free.clone(), free.into_iter().map(|node| image[node]).collect()],
        bone: eye.parameters.surround.is_some_and(|around| around.wall.is_bone()),
    }
}

/// The lines of the half section, and the nodes at which those of its cells cross.
fn half_section(eye: &AxisymmetricEye) -> (Vec<Line>, BTreeSet<usize>) {
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
            *sides.entry(sorted(cell.corners[i], cell.corners[(i + 1) % 4])).or_default() += 1;
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
        let region = if i == 2 { Region::Fat } else { Region::Interior };
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
        // Level k has (2k + 2)/4 times as many cells along each side as level 1.
        let coarse = (2.0 * intervals as f64 / f64::from(level + 1)).round().max(1.0);
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
    use crate::answer::solve::tests::answered_with;
    use crate::run::kept::{Keep, Spacing};
    use crate::scenario::{Geometry, Impact, Projectile, Scenario};

    #[test]
    fn an_axisymmetric_eye_is_drawn_as_a_whole_section_that_faces_the_blow() {
        let mut scenario = Scenario::of(Impact::Projectile(Projectile {
            angle_deg: 30.0,
            ..Projectile::default()
        }));
        scenario.window_ms = Some(0.05);
        scenario.numerics.geometry = Geometry::Axisymmetric;
        let keep = Keep { traces: false, frames: Some(Spacing::even(1e-5)) };
        let answer = answered_with(&scenario, keep);
        let drawing = answer.case.eye.drawing();
        let (first, last) = (&answer.run.frames[0], answer.run.frames.last().unwrap());
        let has = |region| drawing.lines.iter().any(|line| line.region == region);
        for region in [Region::Shell, Region::Retina, Region::Lens, Region::Orbit] {
            assert!(has(region), "{region:?}");
        }
        // The object comes from 30 degrees above the front and lies outside of the globe.
        let (object, core) = drawing.object(first).unwrap();
        let gap = core.coords.norm() - object.radius - 12e-3;
        assert!(gap.abs() < 1e-4, "{gap}");
        let angle = core.y.atan2(-core.x).to_degrees();
        assert!((angle - 30.0).abs() < 1e-3, "{angle}");
        // Every line has a mirror image about the line of the blow.
        let along = Vector2::new(30f64.to_radians().cos(), -30f64.to_radians().sin());
        let across = |p: Point2<f64>| p.coords.perp(&along);
        let sum: f64 =
            (0..drawing.nodes.len()).map(|node| across(drawing.place(last, node, 1.0))).sum();
        assert!(sum.abs() < 1e-9, "{sum}");
    }
}
