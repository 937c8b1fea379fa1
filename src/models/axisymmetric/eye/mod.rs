//! The eye, axisymmetric about the line of the blow.
//!
//! x runs along that line from the front of the eye to its back, r >= 0 is the distance from it,
//! and the origin is the globe's centre. Quads carry vitreous, lens and what surrounds the globe;
//! a chain of segments carries cornea and sclera.
//!
//! A blow at an angle turns the eye within its own axis of symmetry: the shell's thickness and
//! stiffness, and the share of lens in a cell, are means over the azimuth. They are means over the
//! segment and the cell as well, so that no border jumps from one to the next as the mesh changes.
//! Left out: muscles, nerve, iris, zonules, the chambers' fluid as a body of its own, and the
//! pressure of a living eye.

pub mod mesh;
pub mod parameters;

use crate::models::axisymmetric::forces::cell::volume;
use crate::run::places::Region as Part;
use mesh::{Layers, Mesh};
use nalgebra::Point2;
use parameters::{Material, Parameters, SUBZONAL_PA};
use std::f64::consts::PI;
use std::sync::LazyLock;

/// Points around one half of the axis, whose mirror is the other, that means over the azimuth take.
const AZIMUTHS: usize = 32;
/// Points along a segment, and along each side of a cell, that means over them take.
const ALONG: usize = 16;
const ACROSS: usize = 4;

/// What a cell belongs to.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Tissue {
    /// Vitreous, aqueous and lens.
    Globe,
    /// Fat or gelatin.
    Surround,
}

/// A ring with the section of a quad, whose four corners are anticlockwise, or a hexahedron, whose
/// eight go by the bits of their number: along its row, across it, and outward.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cell<const CORNERS: usize> {
    /// Its nodes.
    pub corners: [usize; CORNERS],
    /// Whether it lies in the globe or in what holds it.
    pub region: Tissue,
    /// Share of lens, 0 to 1.
    pub lens: f64,
    /// What fills it.
    pub material: Material,
    /// Stiffness against folding, in Pa.
    pub subzonal: f64,
}

impl<const N: usize> Cell<N> {
    /// One of the globe, with its share of lens, or of what holds that.
    pub(crate) fn new(of: &Parameters, corners: [usize; N], region: Tissue, lens: f64) -> Self {
        let around = of.surround.filter(|_| region == Tissue::Surround).map(|s| s.material);
        let lens = if around.is_none() { lens } else { 0.0 };
        let material = around.unwrap_or_else(|| of.lens.material.mixed(of.vitreous, lens));
        // What keeps soft cells from folding stays softer than they are.
        let subzonal = around.map_or(SUBZONAL_PA, |soft| SUBZONAL_PA.min(0.5 * soft.bulk));
        Self { corners, region, lens, material, subzonal }
    }

    /// The part of a picture that it belongs to.
    pub(crate) fn part(&self) -> Part {
        match self.region {
            Tissue::Surround => Part::Fat,
            Tissue::Globe if self.lens > 0.0 => Part::Lens,
            Tissue::Globe => Part::Interior,
        }
    }
}

/// A piece of cornea or sclera, between node i and node i + 1 of the shell.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ShellSegment {
    /// m.
    pub thickness: f64,
    /// Pa; of a mixture the one that gives the mean of modulus times thickness.
    pub modulus: f64,
    /// Share of sclera, 0 to 1.
    pub sclera: f64,
    /// Front angle of its middle at rest, in rad.
    pub front_angle: f64,
}

/// The eye at rest.
#[derive(Debug, Clone, PartialEq)]
pub struct AxisymmetricEye {
    /// Refinement level; 0 of a mesh that is none.
    pub level: u32,
    /// What it was made from.
    pub parameters: Parameters,
    /// Nodes and rows.
    pub mesh: Mesh,
    /// Block by block, row by row.
    pub cells: Vec<Cell<4>>,
    /// Segments of the shell, from the front to the back.
    pub segments: Vec<ShellSegment>,
    /// Mass of each node, kg.
    pub mass: Vec<f64>,
    /// Whether a node never moves.
    pub fixed: Vec<bool>,
}

fn middle(points: &[(f64, f64)]) -> (f64, f64) {
    let n = points.len() as f64;
    let sum = points.iter().fold((0.0, 0.0), |s, p| (s.0 + p.0, s.1 + p.1));
    (sum.0 / n, sum.1 / n)
}

/// Volumes of the quarters of a cell next to each of its corners.
pub(crate) fn quarters(p: [(f64, f64); 4]) -> [f64; 4] {
    let centre = middle(&p);
    std::array::from_fn(|i| {
        let (before, after) = (p[(i + 3) % 4], p[(i + 1) % 4]);
        volume([p[i], middle(&[p[i], after]), centre, middle(&[p[i], before])]).0
    })
}

/// Middle of the piece `i` of `count` of a whole.
pub(crate) fn part(i: usize, count: usize) -> f64 {
    (i as f64 + 0.5) / count as f64
}

/// Front angle, in rad, of a place (x, r).
pub(crate) fn front_angle((x, r): (f64, f64)) -> f64 {
    libm::atan2(r, -x)
}

pub(crate) fn distance(a: (f64, f64), b: (f64, f64)) -> f64 {
    libm::hypot(a.0 - b.0, a.1 - b.1)
}

/// The place at shares of the two directions of a quad.
pub(crate) fn upon([a, b, c, d]: &[(f64, f64); 4], s: f64, t: f64) -> (f64, f64) {
    let at = |a: f64, b: f64, c: f64, d: f64| (1.0 - t) * (a + s * (b - a)) + t * (d + s * (c - d));
    (at(a.0, b.0, c.0, d.0), at(a.1, b.1, c.1, d.1))
}

pub(crate) fn mean(values: impl Iterator<Item = f64>) -> f64 {
    let (sum, count) = values.fold((0.0, 0.0), |(sum, count), value| (sum + value, count + 1.0));
    sum / count
}

/// Cosines of the azimuths that a turned eye is averaged over.
static AROUND: LazyLock<[f64; AZIMUTHS]> =
    LazyLock::new(|| std::array::from_fn(|i| libm::cos(part(i, AZIMUTHS) * PI)));

/// Angle from the axis of the eye at `front` rad from the line of the blow, for all azimuths.
fn own_angles(front: f64, axis: f64) -> impl Iterator<Item = f64> {
    let azimuths = if axis == 0.0 { 1 } else { AZIMUTHS };
    let along = libm::cos(front) * libm::cos(axis);
    let across = libm::sin(front) * libm::sin(axis);
    AROUND[..azimuths].iter().map(move |cosine| {
        if axis == 0.0 { front } else { libm::acos((along + across * cosine).clamp(-1.0, 1.0)) }
    })
}

impl Parameters {
    /// The segment between two points of the shell.
    fn segment(&self, [a, b]: [(f64, f64); 2]) -> ShellSegment {
        let front = |s: f64| front_angle((a.0 + s * (b.0 - a.0), a.1 + s * (b.1 - a.1)));
        let angles = (0..ALONG).flat_map(|i| own_angles(front(part(i, ALONG)), self.axis_angle));
        let (thickness, modulus, sclera) = self.shell.means(&angles.collect::<Vec<f64>>());
        ShellSegment { thickness, modulus, sclera, front_angle: front(0.5) }
    }

    fn lens_share(&self, corners: [(f64, f64); 4]) -> f64 {
        let (along, across) = self.lens.half_axes;
        // A cell all of which is farther away has none, whichever way the eye is turned.
        let farthest = self.lens.centre.abs() + along.max(across);
        let nearest =
            corners.map(|(x, r)| libm::hypot(x, r)).into_iter().fold(f64::INFINITY, f64::min);
        if nearest > farthest + distance(corners[2], corners[0]) {
            return 0.0;
        }
        mean((0..ACROSS * ACROSS).flat_map(|i| {
            let (s, t) = (part(i % ACROSS, ACROSS), part(i / ACROSS, ACROSS));
            let at = upon(&corners, s, t);
            let distance = libm::hypot(at.0, at.1);
            own_angles(front_angle(at), self.axis_angle).map(move |own| {
                let (x, r) = (-distance * libm::cos(own), distance * libm::sin(own));
                let inside = ((x - self.lens.centre) / along).powi(2) + (r / across).powi(2) <= 1.0;
                f64::from(inside)
            })
        }))
    }
}

impl AxisymmetricEye {
    /// Finest level.
    pub const FINEST: u32 = 5;

    /// Builds the eye at a level from 1, of results at most [`Self::FINEST`]; a coarser core than
    /// that of level 1 was seen to be off by 10 to 20 % in pressure and stress.
    pub fn new(parameters: &Parameters, level: u32) -> Self {
        Self { level, ..Self::with_core(parameters, 2 * level as usize + 4, Layers::THIN) }
    }

    /// Builds the eye with `half` cells in half a side of its core.
    pub fn with_core(parameters: &Parameters, half: usize, layers: Layers) -> Self {
        let limbus = parameters.shell.limbus;
        let wall = parameters.surround.map(|s| (s.wall, s.opening));
        let mesh = mesh::build((half, layers), parameters.radius, limbus, wall);
        let at = |node: usize| (mesh.x[node], mesh.r[node]);
        let regions = [Tissue::Globe, Tissue::Globe, Tissue::Surround];
        let cells = mesh.blocks.iter().zip(regions).flat_map(|(block, region)| {
            block.cells().map(move |corners| {
                Cell::new(parameters, corners, region, parameters.lens_share(corners.map(at)))
            })
        });
        let segments = mesh.shell.windows(2);
        let mut eye = Self {
            level: 0,
            parameters: *parameters,
            cells: cells.collect(),
            segments: segments.map(|e| parameters.segment([at(e[0]), at(e[1])])).collect(),
            mass: vec![0.0; mesh.x.len()],
            fixed: vec![false; mesh.x.len()],
            mesh,
        };
        for &node in &eye.mesh.wall {
            eye.fixed[node] = true;
        }
        eye.spread_mass();
        eye
    }

    /// Of a cell each corner gets its quarter, of a segment each end what a linear function gives.
    fn spread_mass(&mut self) {
        for cell in &self.cells {
            let quarters = quarters(cell.corners.map(|node| self.at(node)));
            for (&node, quarter) in cell.corners.iter().zip(quarters) {
                self.mass[node] += cell.material.density * quarter;
            }
        }
        for (i, segment) in self.segments.iter().enumerate() {
            let (a, b) = (self.mesh.shell[i], self.mesh.shell[i + 1]);
            let (length, ra, rb) = (distance(self.at(b), self.at(a)), self.at(a).1, self.at(b).1);
            let per_radius = self.parameters.shell.density * segment.thickness * PI * length / 3.0;
            self.mass[a] += per_radius * (2.0 * ra + rb);
            self.mass[b] += per_radius * (ra + 2.0 * rb);
        }
    }

    /// x and r of a node at rest, in m.
    pub fn at(&self, node: usize) -> (f64, f64) {
        (self.mesh.x[node], self.mesh.r[node])
    }

    /// Middle of a cell at rest, in m, and the part of a picture that it belongs to.
    pub(crate) fn place(&self, cell: usize) -> (Point2<f64>, Part) {
        let cell = &self.cells[cell];
        let (x, r) = middle(&cell.corners.map(|node| self.at(node)));
        (Point2::new(x, r), cell.part())
    }

    /// The part of the section that each node lies in. A node between lens and vitreous is of the
    /// lens if more of its cells' mass is; the retina reaches from the back to the equator.
    pub fn node_regions(&self) -> Vec<Part> {
        let mut regions = vec![Part::Interior; self.mass.len()];
        let mut lens = vec![(0.0, 0.0); self.mass.len()];
        for cell in &self.cells {
            for &node in &cell.corners {
                match cell.region {
                    Tissue::Surround => regions[node] = Part::Fat,
                    Tissue::Globe => {
                        lens[node].0 += cell.lens;
                        lens[node].1 += 1.0;
                    }
                }
            }
        }
        for (region, (lens, cells)) in regions.iter_mut().zip(lens) {
            if lens > 0.5 * cells {
                *region = Part::Lens;
            }
        }
        for &node in &self.mesh.shell {
            let (x, _) = self.at(node);
            regions[node] = if x > 0.0 { Part::Retina } else { Part::Shell };
        }
        for &node in &self.mesh.wall {
            regions[node] = Part::Orbit;
        }
        regions
    }
}

#[cfg(test)]
mod tests {
    use super::parameters::Surround;
    use super::*;

    fn eye(level: u32, surround: Option<Surround>, axis_angle: f64) -> AxisymmetricEye {
        let parameters = Parameters { axis_angle, surround, ..Parameters::default() };
        AxisymmetricEye::new(&parameters, level)
    }

    /// What the shell has of something, per 2 pi of it: a sum over its area.
    fn over_shell(eye: &AxisymmetricEye, of: impl Fn(&ShellSegment) -> f64) -> f64 {
        let segments = eye.segments.iter().zip(eye.mesh.shell.windows(2));
        let each = segments.map(|(segment, ends)| {
            let (a, b) = (eye.at(ends[0]), eye.at(ends[1]));
            of(segment) * 0.5 * (a.1 + b.1) * distance(a, b)
        });
        each.sum()
    }

    /// What its cells have of something, by their volume.
    fn over_cells(eye: &AxisymmetricEye, of: impl Fn(&Cell<4>) -> f64) -> f64 {
        let each = eye.cells.iter();
        each.map(|cell| of(cell) * volume(cell.corners.map(|node| eye.at(node))).0).sum()
    }

    #[test]
    fn limbus_and_opening_lie_on_nodes_of_the_shell_at_every_level() {
        for level in 1..=12 {
            for surround in [Surround::orbit(), Surround::gelatin()] {
                let eye = eye(level, Some(surround), 0.0);
                for mark in [eye.parameters.shell.limbus, surround.opening] {
                    let off = |node: &usize| (front_angle(eye.at(*node)) - mark).abs();
                    let least = eye.mesh.shell.iter().map(off).fold(f64::INFINITY, f64::min);
                    assert!(least < 1e-12, "{level} {mark} {least}");
                }
                let rim = front_angle(surround.edge());
                assert!((rim - surround.opening).abs() < 1e-12);
                let pure = |s: &ShellSegment| s.sclera == 0.0 || s.sclera == 1.0;
                assert!(eye.segments.iter().all(pure));
            }
        }
    }

    #[test]
    fn the_mass_of_shell_and_lens_hardly_depends_on_the_mesh() {
        for axis in [0.0, 0.6] {
            let measures = [1, 2, 4, 8].map(|level| {
                let eye = eye(level, None, axis);
                let lens = over_cells(&eye, |cell| cell.lens);
                let shell = over_shell(&eye, |segment| segment.thickness);
                [lens, shell]
            });
            for coarse in measures {
                for (coarse, fine) in coarse.into_iter().zip(measures[3]) {
                    assert!((coarse / fine - 1.0).abs() < 0.04, "{axis} {measures:?}");
                }
            }
        }
    }

    #[test]
    fn cells_turn_anticlockwise_and_no_corner_is_near_flat() {
        for level in 1..=AxisymmetricEye::FINEST {
            for surround in [None, Some(Surround::orbit()), Some(Surround::gelatin())] {
                let eye = eye(level, surround, 0.0);
                for cell in &eye.cells {
                    let p = cell.corners.map(|node| eye.at(node));
                    for i in 0..4 {
                        let (a, b, c) = (p[(i + 3) % 4], p[i], p[(i + 1) % 4]);
                        let (u, v) = ((c.0 - b.0, c.1 - b.1), (a.0 - b.0, a.1 - b.1));
                        let corner = (u.0 * v.1 - u.1 * v.0).atan2(u.0 * v.0 + u.1 * v.1);
                        let degrees = corner.to_degrees();
                        assert!(degrees > 25.0 && degrees < 160.0, "{level} {p:?} {degrees}");
                    }
                }
            }
        }
    }

    #[test]
    fn the_globe_weighs_what_its_volumes_weigh_and_comes_near_a_ball() {
        for level in 1..=AxisymmetricEye::FINEST {
            let eye = eye(level, None, 0.0);
            let cells = over_cells(&eye, |cell| cell.material.density);
            let shell = over_shell(&eye, |segment| 2.0 * PI * 1100.0 * segment.thickness);
            let mass: f64 = eye.mass.iter().sum();
            assert!((mass / (cells + shell) - 1.0).abs() < 1e-12);
            assert!(eye.mass.iter().all(|&m| m > 0.0));
            assert!(mass > 8e-3 && mass < 8.5e-3, "{mass}");
        }
    }

    #[test]
    fn a_turned_eye_has_the_same_shell_on_the_whole_and_none_of_its_cornea_at_the_back() {
        let straight = eye(5, None, 0.0);
        let turned = eye(5, None, 0.7);
        for of in [|s: &ShellSegment| s.thickness, |s: &ShellSegment| s.thickness * s.modulus] {
            let ratio = over_shell(&turned, of) / over_shell(&straight, of);
            assert!((ratio - 1.0).abs() < 0.02, "{ratio}");
        }
        assert!(turned.segments.last().is_some_and(|s| s.sclera == 1.0));
        let mixed = |s: &ShellSegment| s.sclera > 0.2 && s.sclera < 0.8;
        assert!(turned.segments.iter().any(mixed));
    }
}
