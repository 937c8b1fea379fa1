//! Springs: every side and diagonal of every quad, and the filaments of the sclera.
//!
//! Van Gelder's rule gives k = E h A / l^2, with A the summed area of all triangles made of three
//! corners of one quad that have the spring as a side (paper, "Spring constant"). The depth h is
//! 1 m: the paper uses E in Pa with no thickness, and only this unit depth gives its own stiffness
//! and displacements.
//!
//! A filament joins shell nodes several hops apart with the axial stiffness EA of the shell's own
//! springs. Sclera springs are multiplied by k and filaments divided by k at level k, so that the
//! tension of the shell for a given stretch does not depend on the mesh.

use crate::models::paper::eye::{landmarks::along, lens::area_within, mesh::SectionMesh};
use crate::run::places::Region;
use crate::scenario::{EyeInput, Lens};
use std::collections::BTreeMap;

/// What a spring is made of.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum SpringKind {
    /// An end in fat or on the orbit.
    Fat,
    /// Both ends on the shell.
    Sclera,
    /// In the lens: by both ends, or by half of its area at least.
    Lens,
    /// Any other inside the globe.
    Rest,
    /// Joins shell nodes several hops apart.
    Filament,
}

/// A linear spring between two nodes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Spring {
    /// Index of one end.
    pub a: usize,
    /// Index of the other end.
    pub b: usize,
    /// Stiffness, in N/m.
    pub stiffness: f64,
    /// Length at rest, in m.
    pub rest_length: f64,
    /// What it is made of.
    pub kind: SpringKind,
}

pub(crate) fn build(input: &EyeInput, mesh: &SectionMesh, shell: &[usize]) -> Vec<Spring> {
    let k = f64::from(input.level);
    let position = |i: usize| mesh.nodes[i].position;
    let (by_nodes, by_area) = match input.lens {
        Lens::Auto => (input.level == 1, input.level > 1),
        Lens::Nodes => (true, false),
        Lens::Area => (false, true),
        Lens::Soft => (false, false),
    };

    // Of the triangles of each spring: their area, and what of it lies in a lens by area; in m2.
    let mut areas: BTreeMap<(usize, usize), (f64, f64)> = BTreeMap::new();
    for quad in &mesh.quads {
        for p in 0..4 {
            for q in p + 1..4 {
                let (a, b) = (quad[p], quad[q]);
                let triangles =
                    (0..4).filter(|&r| r != p && r != q).map(|r| [a, b, quad[r]].map(position));
                let whole = triangles.clone().map(|[a, b, c]| (b - a).perp(&(c - a)).abs() / 2.0);
                let entry = areas.entry((a.min(b), a.max(b))).or_default();
                entry.0 += whole.sum::<f64>();
                if by_area {
                    entry.1 += triangles.map(area_within).sum::<f64>();
                }
            }
        }
    }

    let joined = |(a, b), stiffness: &dyn Fn(f64) -> f64, kind| {
        let rest_length = (position(b) - position(a)).norm();
        Spring { a, b, stiffness: stiffness(rest_length), rest_length, kind }
    };
    let mut springs: Vec<Spring> = areas
        .into_iter()
        .map(|(ends, (area, in_lens))| {
            let (a, b) = (mesh.nodes[ends.0].region, mesh.nodes[ends.1].region);
            let (mut kind, mut modulus_kpa) = if !(a.in_globe() && b.in_globe()) {
                (SpringKind::Fat, input.fat_kpa)
            } else if a.on_shell() && b.on_shell() {
                (SpringKind::Sclera, input.sclera_kpa * k)
            } else if by_nodes && a == Region::Lens && b == Region::Lens {
                (SpringKind::Lens, input.lens_kpa)
            } else {
                (SpringKind::Rest, input.rest_kpa)
            };
            if kind == SpringKind::Rest && in_lens > 0.0 {
                let share = in_lens / area;
                modulus_kpa += (input.lens_kpa - input.rest_kpa) * share;
                if share >= 0.5 {
                    kind = SpringKind::Lens;
                }
            }
            joined(ends, &|length| 1e3 * modulus_kpa * area / (length * length), kind)
        })
        .collect();

    let axial_stiffness = shell_axial_stiffness(&springs, shell) / k * input.filament_factor;
    let hops = if axial_stiffness > 0.0 { input.filament_hops.as_slice() } else { &[] };
    for &hop in hops {
        let stride = hop as usize * input.level as usize;
        for (i, &a) in shell.iter().enumerate() {
            let ends = (a, shell[(i + stride) % shell.len()]);
            springs.push(joined(ends, &|length| axial_stiffness / length, SpringKind::Filament));
        }
    }
    springs
}

/// Mean of stiffness times length over the springs between neighbours on the shell, in N.
fn shell_axial_stiffness(springs: &[Spring], shell: &[usize]) -> f64 {
    let along = along(shell);
    let neighbours = springs.iter().filter(|s| along(s.a, s.b).is_some_and(|(hop, _)| hop == 1));
    neighbours.map(|s| s.stiffness * s.rest_length).sum::<f64>() / shell.len() as f64
}
