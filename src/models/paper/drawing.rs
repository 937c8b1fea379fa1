//! The picture of the Paper model's section.
//!
//! Of a fine mesh about as many lines are drawn as level 1 has, and the whole shell, lens and
//! wall.

use crate::models::paper::eye::springs::{Spring, SpringKind};
use crate::models::paper::{case::PaperCase, eye::Eye, eye::mesh::Node};
use crate::run::drawing::{Drawing, DrawnCell, DrawnNode, Line, Outlines, reach};
use crate::run::places::Region;
use std::f64::consts::TAU;

/// The drawing of a case.
pub(crate) fn of(case: &PaperCase) -> Drawing {
    let eye = &case.eye;
    let coarse = |line: usize| line.is_multiple_of(eye.level as usize);
    let node = |(of, node): (usize, &Node)| DrawnNode {
        region: node.region,
        coarse: coarse(node.grid.0) && coarse(node.grid.1),
        of,
        rest: node.position,
        mirrored: false,
    };
    let line = |s: &Spring| Some(Line { ends: (s.a, s.b), region: part(eye, s)? });
    let shell = &eye.landmarks.shell;
    let is_loaded = |node: usize| case.load.shares.iter().any(|(n, _)| *n == node);
    let sides = shell.iter().zip(shell.iter().cycle().skip(1));
    let loaded = sides.filter(|(a, _)| is_loaded(**a));
    Drawing {
        nodes: eye.nodes.iter().enumerate().map(node).collect(),
        lines: eye.springs.iter().filter_map(line).collect(),
        monitors: eye.landmarks.monitors,
        loaded: loaded.map(|(&a, &b)| (a, if is_loaded(b) { b } else { a })).collect(),
        loaded_until: case.system.pulse.duration(),
        cells: (0..).zip(&eye.quads).map(|(of, &corners)| DrawnCell { corners, of }).collect(),
        outlines: outlines(eye),
        reach: reach(std::iter::empty()),
        ..Drawing::default()
    }
}

/// What bounds the parts; its shell has no thickness, so it is drawn with a mean one.
fn outlines(eye: &Eye) -> Outlines {
    const THICKNESS_M: f64 = 0.5e-3;
    const LIMBUS_DEG: f64 = 33.0;
    let around = |node: usize| eye.nodes[node].front_angle().rem_euclid(TAU);
    let ring = |of: fn(Region) -> bool| {
        let nodes = (0..eye.nodes.len()).filter(|node| of(eye.nodes[*node].region));
        let mut nodes: Vec<usize> = nodes.collect();
        nodes.sort_by(|a, b| around(*a).total_cmp(&around(*b)));
        nodes
    };
    let (shell, wall) = (ring(Region::on_shell), ring(|region| region == Region::Orbit));
    // What is free of the fat is a straight line from the wall's edge.
    let free = [wall.first(), wall.last()].map(|edge| {
        let apart = |node: usize, edge: usize| (around(node) - around(edge)).abs();
        let nearest = |edge: usize| {
            let by = |a: &&usize, b: &&usize| apart(**a, edge).total_cmp(&apart(**b, edge));
            shell.iter().min_by(by).copied()
        };
        edge.into_iter().flat_map(|&edge| [Some(edge), nearest(edge)]).flatten().collect()
    });
    Outlines {
        thickness: vec![THICKNESS_M; shell.len()],
        shell,
        limbus: LIMBUS_DEG.to_radians(),
        wall,
        free,
        bone: true,
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
    let both = |of: fn(Region) -> bool| of(a.region) && of(b.region);
    let line = if along == 1 { a.grid.1 } else { a.grid.0 };
    let on_coarse_line = line.is_multiple_of(eye.level as usize);
    if a.region == b.region && matches!(a.region, Region::Orbit | Region::Retina) {
        Some(a.region)
    } else if both(Region::on_shell) {
        Some(Region::Shell)
    } else if !on_coarse_line {
        None
    } else if a.region == Region::Lens && b.region == Region::Lens {
        Some(Region::Lens)
    } else {
        Some(if both(Region::in_globe) { Region::Interior } else { Region::Fat })
    }
}
