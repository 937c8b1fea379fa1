//! The eye in three dimensions: what its cells and its shell are made of, and what it weighs.
//!
//! Its own axes: x back along the optical axis, y up, z to the nose, from the middle of the globe.
//! The tissues and their constants are those of the axisymmetric eye, whose axis is here the eye's
//! and not the blow's. Thickness and stiffness of a quad of the shell, and the share of lens in a
//! cell, are means over it, so that no border jumps from one to the next as the mesh changes.
//! Left out as there: muscles, nerve, iris, zonules, the chambers' fluid as a body of its own, and
//! the pressure of a living eye.

pub mod mesh;
pub mod orbit;
pub(crate) mod point;

use crate::models::axisymmetric::eye::parameters::{Parameters, Surround};
use crate::models::axisymmetric::eye::part;
pub use crate::models::axisymmetric::eye::{Cell, Tissue};
use mesh::{Extent, Mesh};
use nalgebra::Vector3;
use orbit::{Cavity, OrbitRim, seen_from_the_middle};

/// Points along each side of a quad of the shell, and of a cell, that means over them take.
const ACROSS: usize = 4;

/// A piece of cornea or sclera.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ShellQuad {
    /// Anticlockwise as seen from outside.
    pub corners: [usize; 4],
    /// m.
    pub thickness: f64,
    /// Pa; of a mixture the one that gives the mean of modulus times thickness.
    pub modulus: f64,
    /// Share of sclera, 0 to 1.
    pub sclera: f64,
    /// Front angle and azimuth of its middle at rest, in rad.
    pub seen: (f64, f64),
}

/// The eye at rest.
#[derive(Debug, Clone, PartialEq)]
pub struct SpatialEye {
    /// Refinement level.
    pub level: u32,
    /// How much of it is computed.
    pub extent: Extent,
    /// What it was made from.
    pub parameters: Parameters,
    /// The rim in front of which there is nothing, where something holds the globe.
    pub rim: Option<OrbitRim>,
    /// Nodes and what lies between them.
    pub mesh: Mesh,
    /// Row by row.
    pub cells: Vec<Cell<8>>,
    /// The shell.
    pub quads: Vec<ShellQuad>,
    /// Mass of each node, kg.
    pub mass: Vec<f64>,
    /// Whether a node never moves.
    pub fixed: Vec<bool>,
}

/// How much of corner `i` of a cell is in a place at shares `s` of its three directions.
pub(crate) fn share_of(i: usize, s: [f64; 3]) -> f64 {
    let along = |bit: usize| if i >> bit & 1 == 1 { s[bit] } else { 1.0 - s[bit] };
    along(0) * along(1) * along(2)
}

/// The place in a cell at shares of its three directions.
pub(crate) fn within(p: &[Vector3<f64>; 8], s: [f64; 3]) -> Vector3<f64> {
    (0..8).map(|i| p[i] * share_of(i, s)).sum()
}

/// How much of each corner of a quad is in a place at shares of its two directions.
#[inline]
pub(crate) fn shares(s: f64, t: f64) -> [f64; 4] {
    [(1.0 - s) * (1.0 - t), s * (1.0 - t), s * t, (1.0 - s) * t]
}

/// The place on a quad at shares of its two directions.
pub(crate) fn upon(p: &[Vector3<f64>; 4], s: f64, t: f64) -> Vector3<f64> {
    (p[0] * (1.0 - s) + p[1] * s) * (1.0 - t) + (p[3] * (1.0 - s) + p[2] * s) * t
}

/// Shares of a piece that take a quarter, or an eighth, of what varies linearly.
pub(crate) const GAUSS: [f64; 2] = [0.211_324_865_405_187_1, 0.788_675_134_594_812_9];

/// Volume that each corner of a cell stands for.
fn volumes(p: &[Vector3<f64>; 8]) -> [f64; 8] {
    let mut volumes = [0.0; 8];
    for i in 0..8 {
        let s = [GAUSS[i & 1], GAUSS[i >> 1 & 1], GAUSS[i >> 2]];
        let along = |bit: usize| {
            let end = |value: f64| {
                let mut at = s;
                at[bit] = value;
                within(p, at)
            };
            end(1.0) - end(0.0)
        };
        let jacobian = along(0).dot(&along(1).cross(&along(2))) / 8.0;
        for (corner, volume) in volumes.iter_mut().enumerate() {
            let share = |bit: usize| if corner >> bit & 1 == 1 { s[bit] } else { 1.0 - s[bit] };
            *volume += jacobian * share(0) * share(1) * share(2);
        }
    }
    volumes
}

/// Area that each of the four points of a quad at such shares stands for.
pub(crate) fn areas(p: &[Vector3<f64>; 4], at: [f64; 2]) -> [f64; 4] {
    std::array::from_fn(|i| {
        let (s, t) = (at[i & 1], at[i >> 1]);
        let along = upon(p, 1.0, t) - upon(p, 0.0, t);
        let across = upon(p, s, 1.0) - upon(p, s, 0.0);
        0.25 * along.cross(&across).norm()
    })
}

/// Area of a quad.
pub(crate) fn area(p: &[Vector3<f64>; 4]) -> f64 {
    areas(p, GAUSS).iter().sum()
}

fn lens_share(parameters: &Parameters, p: &[Vector3<f64>; 8]) -> f64 {
    let lens = parameters.lens;
    let (along, across) = lens.half_axes;
    let centre = Vector3::new(lens.centre, 0.0, 0.0);
    let size = (p[7] - p[0]).norm();
    let nearest = p.iter().map(|p| (p - centre).norm()).fold(f64::INFINITY, f64::min);
    if nearest > along.max(across) + size {
        return 0.0;
    }
    let inside = |i: usize| {
        let share = |i: usize| part(i % ACROSS, ACROSS);
        let s = [share(i), share(i / ACROSS), share(i / ACROSS / ACROSS)];
        let at = within(p, s) - centre;
        (at.x / along).powi(2) + (at.y * at.y + at.z * at.z) / (across * across) <= 1.0
    };
    let points = ACROSS * ACROSS * ACROSS;
    (0..points).filter(|i| inside(*i)).count() as f64 / points as f64
}

fn quad(parameters: &Parameters, corners: [usize; 4], p: &[Vector3<f64>; 4]) -> ShellQuad {
    let at = |i: usize| upon(p, part(i % ACROSS, ACROSS), part(i / ACROSS, ACROSS));
    let fronts: [f64; ACROSS * ACROSS] = std::array::from_fn(|i| seen_from_the_middle(at(i)).0);
    let (thickness, modulus, sclera) = parameters.shell.means(&fronts);
    let seen = seen_from_the_middle(upon(p, 0.5, 0.5));
    ShellQuad { corners, thickness, modulus, sclera, seen }
}

impl SpatialEye {
    /// Builds the eye at a level from 1, which has 2 `level` + 2 cells in half a side of its core.
    /// Without a `rim` of its own what holds the globe is round.
    ///
    /// # Panics
    /// If half of an eye is asked for whose rim is not round.
    pub fn new(parameters: &Parameters, rim: Option<OrbitRim>, extent: Extent, level: u32) -> Self {
        assert!(
            extent == Extent::Full || rim.is_none_or(|rim| rim.is_round()),
            "half of an eye has a round rim"
        );
        let half = 2 * level as usize + 2;
        let (radius, surround) = (parameters.radius, parameters.surround.as_ref());
        let mesh = mesh::build(half, extent, radius, Cavity::new(parameters, rim));
        // Tests in gelatin were made with objects that fit its holder.
        let round = |of: &Surround| of.wall.is_bone().then(|| OrbitRim::round(of.edge(), radius));
        let cells = mesh.cells.iter().map(|&(corners, region)| {
            let lens = lens_share(parameters, &corners.map(|node| mesh.at[node]));
            Cell::new(parameters, corners, region, lens)
        });
        let quads = mesh.shell.iter();
        let quads = quads.map(|&of| quad(parameters, of, &of.map(|node| mesh.at[node])));
        let mut eye = Self {
            level,
            extent,
            parameters: *parameters,
            rim: surround.and_then(|surround| rim.or_else(|| round(surround))),
            cells: cells.collect(),
            quads: quads.collect(),
            mass: vec![0.0; mesh.at.len()],
            fixed: vec![false; mesh.at.len()],
            mesh,
        };
        for &node in &eye.mesh.wall {
            eye.fixed[node] = true;
        }
        eye.spread_mass();
        eye
    }

    /// Each corner gets what a function linear along each direction gives it.
    fn spread_mass(&mut self) {
        for cell in &self.cells {
            let p = cell.corners.map(|node| self.mesh.at[node]);
            for (node, volume) in cell.corners.into_iter().zip(volumes(&p)) {
                self.mass[node] += cell.material.density * volume;
            }
        }
        for quad in &self.quads {
            let p = quad.corners.map(|node| self.mesh.at[node]);
            let areal = self.parameters.shell.density * quad.thickness;
            for (i, area) in areas(&p, GAUSS).into_iter().enumerate() {
                let shares = shares(GAUSS[i & 1], GAUSS[i >> 1]);
                for (node, share) in quad.corners.into_iter().zip(shares) {
                    self.mass[node] += areal * area * share;
                }
            }
        }
    }

    /// Whether a node lies on the plane about which half an eye is mirrored.
    pub(crate) fn on_mirror(&self, node: usize) -> bool {
        self.extent == Extent::Half && self.mesh.at[node].z == 0.0
    }

    /// How often what is computed is there.
    pub(crate) fn copies(&self) -> f64 {
        if self.extent == Extent::Half { 2.0 } else { 1.0 }
    }

    /// Volume of a cell at rest, in m3.
    pub(crate) fn volume(&self, cell: &Cell<8>) -> f64 {
        volumes(&cell.corners.map(|node| self.mesh.at[node])).iter().sum()
    }

    /// The quads of the shell, and of the free sides of what holds it, that an object can touch.
    pub(crate) fn open_quads(&self) -> Vec<[usize; 4]> {
        /// Sides of a cell, anticlockwise as seen from outside.
        const SIDES: [[usize; 4]; 6] =
            [[0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1], [4, 5, 7, 6]];
        let mut met = std::collections::BTreeMap::<[usize; 4], (usize, [usize; 4])>::new();
        for cell in &self.cells {
            for side in SIDES {
                let quad = side.map(|corner| cell.corners[corner]);
                let mut sorted = quad;
                sorted.sort_unstable();
                met.entry(sorted).or_insert((0, quad)).0 += 1;
            }
        }
        let open = met.into_values().filter(|(count, quad)| {
            let held = quad.iter().all(|node| self.fixed[*node]);
            *count == 1 && !held && !quad.iter().all(|node| self.on_mirror(*node))
        });
        let mut open: Vec<[usize; 4]> = open.map(|(_, quad)| quad).collect();
        // From the front to the back.
        let along = |quad: &[usize; 4]| quad.iter().map(|n| self.mesh.at[*n].x).sum::<f64>();
        open.sort_by(|a, b| along(a).total_cmp(&along(b)).then(a.cmp(b)));
        open
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scenario::Rim;
    use std::f64::consts::PI;

    #[test]
    fn the_globe_comes_near_a_ball_and_half_of_it_is_half() {
        let parameters = Parameters { surround: None, ..Parameters::default() };
        let ball = 4.0 / 3.0 * PI * 12e-3_f64.powi(3);
        for level in 1..=3 {
            let eye = |extent| SpatialEye::new(&parameters, None, extent, level);
            let (whole, half) = (eye(Extent::Full), eye(Extent::Half));
            let volume = |eye: &SpatialEye| eye.cells.iter().map(|c| eye.volume(c)).sum::<f64>();
            let ratio = volume(&whole) / ball;
            assert!(ratio < 1.0 && ratio > 0.975, "{level} {ratio}");
            assert!((2.0 * volume(&half) / volume(&whole) - 1.0).abs() < 1e-12);
            let mass = |eye: &SpatialEye| eye.mass.iter().sum::<f64>();
            assert!((2.0 * mass(&half) / mass(&whole) - 1.0).abs() < 1e-12);
            assert!(mass(&whole) > 7.9e-3 && mass(&whole) < 8.5e-3, "{}", mass(&whole));
            let area: f64 =
                whole.quads.iter().map(|q| area(&q.corners.map(|n| whole.mesh.at[n]))).sum();
            assert!((area / (4.0 * PI * 12e-3 * 12e-3) - 1.0).abs() < 0.02);
            assert_eq!(whole.open_quads().len(), whole.quads.len());
            assert_eq!(half.open_quads().len(), half.quads.len());
        }
    }

    #[test]
    fn no_corner_of_a_cell_is_near_flat() {
        let orbit = Some(OrbitRim::from(&Rim::CAUCASIAN));
        for (rim, surround) in [
            (None, None),
            (None, Some(Surround::gelatin())),
            (None, Some(Surround::orbit())),
            (orbit, Some(Surround::orbit())),
        ] {
            for level in 1..=3 {
                let parameters = Parameters { surround, ..Parameters::default() };
                let eye = SpatialEye::new(&parameters, rim, Extent::Full, level);
                for cell in &eye.cells {
                    let p = cell.corners.map(|node| eye.mesh.at[node]);
                    let volume = eye.volume(cell);
                    for n in 0..8 {
                        let edge = |bit: usize| p[n | bit] - p[n & !bit];
                        let det = edge(1).dot(&edge(2).cross(&edge(4)));
                        assert!(det > 0.3 * volume, "{level} {p:?} {}", det / volume);
                    }
                }
            }
        }
    }

    #[test]
    fn the_rim_of_a_round_orbit_is_that_of_the_wall_and_fat_lies_behind_it_only() {
        let rim = OrbitRim::from(&Rim::CAUCASIAN);
        let eye = SpatialEye::new(&Parameters::default(), Some(rim), Extent::Full, 1);
        assert!(eye.open_quads().len() > eye.quads.len() / 4);
        let fat = eye.cells.iter().filter(|c| c.region == Tissue::Surround).count();
        assert!((500..900).contains(&fat), "{fat}");
        let round = SpatialEye::new(&Parameters::default(), None, Extent::Full, 1);
        let rim = round.rim.unwrap();
        assert!((rim.depth[0] - 5.6e-3).abs() < 0.1e-3 && (rim.gap[0] - 8e-3).abs() < 0.1e-3);
    }
}
