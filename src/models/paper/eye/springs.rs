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

use crate::models::paper::eye::{cross, lens::area_within, mesh::Node, mesh::SectionMesh};
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

/// Summed area of the triangles of a spring, in m2.
#[derive(Debug, Clone, Copy, Default)]
struct Areas {
    whole: f64,
    /// Of it, what lies in the lens; 0 if the lens is not taken by area.
    lens: f64,
}

fn kind_of(a: &Node, b: &Node, lens: bool) -> SpringKind {
    if !(a.region.in_globe() && b.region.in_globe()) {
        SpringKind::Fat
    } else if a.region.on_shell() && b.region.on_shell() {
        SpringKind::Sclera
    } else if lens && a.region == Region::Lens && b.region == Region::Lens {
        SpringKind::Lens
    } else {
        SpringKind::Rest
    }
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

    let mut areas: BTreeMap<(usize, usize), Areas> = BTreeMap::new();
    for quad in &mesh.quads {
        for p in 0..4 {
            for q in p + 1..4 {
                let (a, b) = (quad[p], quad[q]);
                let triangles =
                    (0..4).filter(|&r| r != p && r != q).map(|r| [a, b, quad[r]].map(position));
                let whole: f64 =
                    triangles.clone().map(|[a, b, c]| cross(a, b, c).abs() / 2.0).sum();
                let entry = areas.entry((a.min(b), a.max(b))).or_default();
                entry.whole += whole;
                if by_area {
                    entry.lens += triangles.map(area_within).sum::<f64>();
                }
            }
        }
    }

    let mut springs: Vec<Spring> = areas
        .into_iter()
        .map(|((a, b), areas)| {
            let mut kind = kind_of(&mesh.nodes[a], &mesh.nodes[b], by_nodes);
            let mut modulus_kpa = match kind {
                SpringKind::Fat => input.fat_kpa,
                SpringKind::Sclera | SpringKind::Filament => input.sclera_kpa * k,
                SpringKind::Lens => input.lens_kpa,
                SpringKind::Rest => input.rest_kpa,
            };
            if kind == SpringKind::Rest && areas.lens > 0.0 {
                let share = areas.lens / areas.whole;
                modulus_kpa += (input.lens_kpa - input.rest_kpa) * share;
                if share >= 0.5 {
                    kind = SpringKind::Lens;
                }
            }
            let modulus_pa = 1e3 * modulus_kpa;
            let rest_length = (position(b) - position(a)).norm();
            Spring {
                a,
                b,
                stiffness: modulus_pa * areas.whole / (rest_length * rest_length),
                rest_length,
                kind,
            }
        })
        .collect();

    let axial_stiffness = shell_axial_stiffness(&springs, shell) / k * input.filament_factor;
    let hops = if axial_stiffness > 0.0 { input.filament_hops.as_slice() } else { &[] };
    for &hop in hops {
        let stride = hop as usize * input.level as usize;
        for (i, &a) in shell.iter().enumerate() {
            let b = shell[(i + stride) % shell.len()];
            let rest_length = (position(b) - position(a)).norm();
            springs.push(Spring {
                a,
                b,
                stiffness: axial_stiffness / rest_length,
                rest_length,
                kind: SpringKind::Filament,
            });
        }
    }
    springs
}

/// Mean of stiffness times length over the springs between neighbours on the shell, in N.
fn shell_axial_stiffness(springs: &[Spring], shell: &[usize]) -> f64 {
    let neighbours: std::collections::BTreeSet<(usize, usize)> = shell
        .iter()
        .zip(shell.iter().cycle().skip(1))
        .map(|(&a, &b)| (a.min(b), a.max(b)))
        .collect();
    let sum: f64 = springs
        .iter()
        .filter(|s| neighbours.contains(&(s.a, s.b)))
        .map(|s| s.stiffness * s.rest_length)
        .sum();
    sum / shell.len() as f64
}
