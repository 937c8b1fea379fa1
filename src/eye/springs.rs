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

use super::mesh::{Mesh, Region};
use super::{Node, cross};
use crate::scenario::EyeInput;
use std::collections::BTreeMap;

/// What a spring is made of.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum SpringKind {
    /// An end in fat or on the orbit.
    Fat,
    /// Both ends on the shell.
    Sclera,
    /// Both ends in the lens.
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

pub(super) fn build(input: &EyeInput, mesh: &Mesh, shell: &[usize]) -> Vec<Spring> {
    let k = f64::from(input.level);
    let position = |i: usize| mesh.nodes[i].position;
    let area = |a, b, c| cross(position(a), position(b), position(c)).abs() / 2.0;

    let mut area_sums: BTreeMap<(usize, usize), f64> = BTreeMap::new();
    for quad in &mesh.quads {
        for p in 0..4 {
            for q in p + 1..4 {
                let (a, b) = (quad[p], quad[q]);
                let sum: f64 = (0..4)
                    .filter(|&r| r != p && r != q)
                    .map(|r| area(a, b, quad[r]))
                    .sum();
                *area_sums.entry((a.min(b), a.max(b))).or_default() += sum;
            }
        }
    }

    let mut springs: Vec<Spring> = area_sums
        .into_iter()
        .map(|((a, b), area_sum)| {
            let kind = kind_of(&mesh.nodes[a], &mesh.nodes[b], input.lens);
            let modulus_pa = 1e3
                * match kind {
                    SpringKind::Fat => input.fat_kpa,
                    SpringKind::Sclera | SpringKind::Filament => input.sclera_kpa * k,
                    SpringKind::Lens => input.lens_kpa,
                    SpringKind::Rest => input.rest_kpa,
                };
            let rest_length = (position(b) - position(a)).norm();
            Spring {
                a,
                b,
                stiffness: modulus_pa * super::UNIT_DEPTH_M * area_sum
                    / (rest_length * rest_length),
                rest_length,
                kind,
            }
        })
        .collect();

    let axial_stiffness = shell_axial_stiffness(&springs, shell) / k * input.filament_factor;
    let hops = if axial_stiffness > 0.0 {
        input.filament_hops.as_slice()
    } else {
        &[]
    };
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
