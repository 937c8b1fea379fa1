//! The ball in hexahedra: a cube mapped to a ball in the core, and layers of six patches around it
//! to the shell and on to the wall.
//!
//! Points of the cube are (u, v, w), each from -M to M, with q the largest of |u|, |v|, |w|. Their
//! direction is (tan a u, tan a v, tan a w) with a = pi/4q, so that all lie at even angles. With t
//! the angle from the back, rows on the four side patches are bent to circles of latitude,
//! t <- (1 - b)(pi/2 - a u) + b t with b = (u/q)^2, and all are drawn to the front,
//! t' = t + 0.2 sin t. The core lies at Rc (q/M) (0.425 (u, v, w)/q + 0.5 direction): a mean of a
//! cube and a ball, so that no corner of a cell is flat. Layers lead along straight lines from its
//! border to the shell and from there to the wall.
//!
//! x runs from the front of the eye to its back, y up, z to the nose, all from the middle of the
//! globe. Half a ball is that with z >= 0. Rows of cells follow u within the core and on the side
//! patches, which are unrolled around the axis, and v at the front and at the back.

pub use crate::models::axisymmetric::eye::Tissue as Place;
use crate::models::axisymmetric::eye::mesh::graded;
use crate::models::spatial::eye::orbit::Cavity;
use nalgebra::Vector3;
use std::collections::HashMap;
use std::f64::consts::{FRAC_PI_2, FRAC_PI_4};

/// How much of the core's border is a cube's, and how much a ball's.
const CUBE: f64 = 0.425;
const BALL: f64 = 0.5;
/// How much closer rows lie in front.
const GRADING: f64 = 0.2;
/// Radius of the core's map as a share of the globe's.
const CORE: f64 = 0.6;
/// By which share layers are thinner at the shell than on average, within it and beyond. A thick
/// cell is more mass than moves with the shell: with 0.3 and 0.2 and a core of 0.55 level 1 was up
/// to 11 % too high in pressure and a third at the back.
const WITHIN: f64 = 0.65;
const BEYOND: f64 = 0.3;
/// Layers between core and shell, and between shell and wall, per half side of the core.
const GLOBE_LAYERS: f64 = 0.8;
const AROUND_LAYERS: f64 = 0.9;

/// How much of the eye is computed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Extent {
    /// One side of a plane through the eye's axis; the other is its mirror image.
    Half,
    /// All of it.
    Full,
}

/// Nodes at rest and what lies between them.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Mesh {
    /// Place of each node, in m.
    pub at: Vec<Vector3<f64>>,
    /// Corners of each cell by the bits of their number: along its row, across it, and outward.
    pub cells: Vec<([usize; 8], Place)>,
    /// Quads of the shell, anticlockwise as seen from outside.
    pub shell: Vec<[usize; 4]>,
    /// Nodes that are fixed.
    pub wall: Vec<usize>,
}

/// A point of the cube.
type Place3 = (i64, i64, i64);

/// Angle from the back and azimuth of a point of the cube.
fn angles((u, v, w): Place3) -> (f64, f64) {
    let q = u.abs().max(v.abs()).max(w.abs());
    let step = FRAC_PI_4 / q as f64;
    let tan = |i: i64| libm::tan(step * i as f64);
    let (x, y, z) = (tan(u), tan(v), tan(w));
    let mut angle = libm::acos(x / (x * x + y * y + z * z).sqrt());
    if u.abs() < q {
        let bent = (u as f64 / q as f64).powi(2);
        angle = (1.0 - bent) * (FRAC_PI_2 - step * u as f64) + bent * angle;
    }
    (angle + GRADING * libm::sin(angle), libm::atan2(z, y))
}

/// Direction of a point of the cube from the middle.
fn direction(of: Place3) -> Vector3<f64> {
    let (angle, azimuth) = angles(of);
    let across = libm::sin(angle);
    // On a plane of symmetry there is no rounding.
    let part = |i: i64, value: f64| if i == 0 { 0.0 } else { across * value };
    Vector3::new(libm::cos(angle), part(of.1, libm::cos(azimuth)), part(of.2, libm::sin(azimuth)))
}

/// A mesh that grows.
struct Builder {
    half: i64,
    extent: Extent,
    mesh: Mesh,
    /// Node of each point of the cube in each layer; layer 0 is the core.
    known: HashMap<(usize, Place3), usize>,
}

impl Builder {
    fn put(&mut self, layer: usize, of: Place3, at: Vector3<f64>) {
        self.known.insert((layer, of), self.mesh.at.len());
        self.mesh.at.push(at);
    }

    fn node(&self, layer: usize, of: Place3) -> usize {
        self.known[&(layer, of)]
    }

    fn nearest_w(&self) -> i64 {
        if self.extent == Extent::Half { 0 } else { -self.half }
    }

    /// The border of a square of (v, w), from below over the nose's side up and around, so that
    /// along, across and outward turn as x, y and z do. That of the whole ends where it begins.
    fn ring(&self) -> Vec<(i64, i64)> {
        let m = self.half;
        let mut ring: Vec<(i64, i64)> = (0..m).map(|w| (-m, w)).collect();
        ring.extend((-m..m).map(|v| (v, m)));
        ring.extend((0..=m).rev().map(|w| (m, w)));
        if self.extent == Extent::Full {
            ring.extend((-m..0).rev().map(|w| (m, w)));
            ring.extend((-m..m).rev().map(|v| (v, -m)));
            ring.extend((-m + 1..=0).map(|w| (-m, w)));
        }
        ring
    }

    /// Points on the surface of the cube in the order of nodes.
    fn surface(&self) -> Vec<Place3> {
        let m = self.half;
        let mut ring = self.ring();
        if self.extent == Extent::Full {
            ring.pop();
        }
        let sides = ring.into_iter().flat_map(|(v, w)| (-m..=m).map(move |u| (u, v, w)));
        let inner = |w: i64| (1 - m..m).map(move |v| (v, w));
        let ends: Vec<_> = (self.nearest_w().max(1 - m)..m).flat_map(inner).collect();
        let back = ends.iter().map(|&(v, w)| (m, v, w));
        let front = ends.iter().map(|&(v, w)| (-m, v, w));
        sides.chain(back).chain(front).collect()
    }

    fn core(&mut self, radius: f64) {
        let m = self.half;
        for w in self.nearest_w()..=m {
            for v in -m..=m {
                for u in -m..=m {
                    let q = u.abs().max(v.abs()).max(w.abs()) as f64;
                    let mut at = Vector3::zeros();
                    if q > 0.0 {
                        let cube = Vector3::new(u as f64, v as f64, w as f64) * (CUBE / q);
                        at = (cube + direction((u, v, w)) * BALL) * (CORE * radius * q / m as f64);
                    }
                    self.put(0, (u, v, w), at);
                }
            }
        }
        for w in self.nearest_w()..m {
            for v in -m..m {
                for u in -m..m {
                    let corners = std::array::from_fn(|i| {
                        let bit = |of: usize| i64::from(i >> of & 1 == 1);
                        self.node(0, (u + bit(0), v + bit(1), w + bit(2)))
                    });
                    self.mesh.cells.push((corners, Place::Globe));
                }
            }
        }
    }

    /// Nodes of the layer after `before`, and the cells between the two.
    fn layer(&mut self, before: usize, place: Place, at: impl Fn(&Self, Place3) -> Vector3<f64>) {
        let (m, after) = (self.half, before + 1);
        for of in self.surface() {
            self.put(after, of, at(self, of));
        }
        let mut cells = Vec::new();
        for ends in self.ring().windows(2) {
            for u in -m..m {
                cells.push(std::array::from_fn(|i| {
                    let (v, w) = ends[i >> 1 & 1];
                    self.node(before + (i >> 2), (u + i64::from(i & 1 == 1), v, w))
                }));
            }
        }
        for (u, flip) in [(m, false), (-m, true)] {
            for w in self.nearest_w()..m {
                for v in -m..m {
                    cells.push(std::array::from_fn(|i| {
                        let across = i64::from((i >> 1 & 1 == 1) != flip);
                        self.node(before + (i >> 2), (u, v + i64::from(i & 1 == 1), w + across))
                    }));
                }
            }
        }
        self.mesh.cells.extend(cells.into_iter().map(|cell| (cell, place)));
    }
}

/// Builds the mesh of a core of 2 `half` cells a side in a globe of `radius` m.
pub(crate) fn build(half: usize, extent: Extent, radius: f64, cavity: Option<Cavity>) -> Mesh {
    let half_side = i64::try_from(half).expect("a mesh that fits in memory");
    let mut builder =
        Builder { half: half_side, extent, mesh: Mesh::default(), known: HashMap::new() };
    builder.core(radius);
    let layers = (GLOBE_LAYERS * half as f64).round() as usize;
    for layer in 0..layers {
        let share = graded(layer + 1, layers, WITHIN);
        builder.layer(layer, Place::Globe, |of, point| {
            let inner = of.mesh.at[of.node(0, point)];
            inner + (direction(point) * radius - inner) * share
        });
    }
    let in_layer = if extent == Extent::Half { 12 } else { 24 } * half * half;
    let last = builder.mesh.cells.len() - in_layer;
    builder.mesh.shell = builder.mesh.cells[last..]
        .iter()
        .map(|(corners, _)| [corners[4], corners[5], corners[7], corners[6]])
        .collect();
    let Some(cavity) = cavity else { return builder.mesh };
    let around = (AROUND_LAYERS * half as f64).round() as usize;
    for layer in 0..around {
        let share = graded(layer + 1, around, -BEYOND);
        builder.layer(layers + layer, Place::Surround, |_, point| {
            let direction = direction(point);
            direction * (radius + (cavity.distance(direction) - radius) * share)
        });
    }
    builder.mesh.hold(&cavity);
    let outer = builder.surface().into_iter().map(|of| builder.node(layers + around, of));
    let held = |node: &usize| cavity.behind(builder.mesh.at[*node]) >= -1e-9;
    builder.mesh.wall = outer.filter(held).collect();
    builder.mesh.without_loose_nodes()
}

impl Mesh {
    /// Leaves out what lies in front of the opening: of a cell the mean of its corners.
    fn hold(&mut self, cavity: &Cavity) {
        let at = &self.at;
        self.cells.retain(|(corners, place)| {
            let behind: f64 = corners.iter().map(|n| cavity.behind(at[*n])).sum();
            *place == Place::Globe || behind >= -1e-9
        });
    }

    /// Leaves out nodes that no cell has.
    fn without_loose_nodes(mut self) -> Self {
        let mut used = vec![false; self.at.len()];
        for (corners, _) in &self.cells {
            for &node in corners {
                used[node] = true;
            }
        }
        self.wall.retain(|node| used[*node]);
        let (mut renamed, mut kept) = (vec![usize::MAX; self.at.len()], Vec::new());
        for node in (0..self.at.len()).filter(|node| used[*node]) {
            renamed[node] = kept.len();
            kept.push(self.at[node]);
        }
        self.at = kept;
        let corners = self.cells.iter_mut().flat_map(|(corners, _)| corners);
        for node in corners.chain(self.shell.iter_mut().flatten()).chain(&mut self.wall) {
            *node = renamed[*node];
        }
        self
    }
}
