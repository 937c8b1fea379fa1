//! The section that pictures show: points of the eye in the plane of the blow and of its own axis.
//!
//! They are material points, placed by the half section of the axisymmetric eye on both sides of
//! the axis, and by rays through what holds the globe. The plane stays, the points may leave it:
//! they are shown from its side. Up in the picture is up at the eye, or its nose where the plane
//! lies flat.

use crate::models::axisymmetric::eye::mesh::{self as plane_mesh, Layers};
use crate::models::spatial::eye::orbit::Cavity;
use crate::models::spatial::eye::point::{Nodes, Point};
use crate::models::spatial::forces::object::{direction, towards};
use crate::models::spatial::{eye::SpatialEye, eye::mesh::Place};
use crate::models::spatial::{recording::sensor::monitored, time::run::SpatialBlow};
use crate::run::places::Region;
use crate::scenario::direction::upper;
use nalgebra::{Point2, Vector3};
use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// Cells in half a side of the core of the half section.
const HALF: usize = 6;
/// Rays and layers of what holds the globe, on each side.
const RAYS: usize = 12;
const LAYERS: usize = 4;
/// How much nearer to the middle a place of the globe is looked for: the mesh's sides are flat.
const INSIDE: f64 = 0.985;

/// Points of a ring around the axis.
const AROUND: usize = 48;

/// A point that is shown.
#[derive(Debug, Clone)]
pub(crate) struct Shown {
    pub point: Point,
    /// Where it rests, as it is shown, in m.
    pub rest: Point2<f64>,
    pub region: Region,
}

/// The section.
#[derive(Debug, Clone)]
pub(crate) struct Section {
    pub points: Vec<Shown>,
    /// Corners of its cells, and the cell of the eye that each lies in.
    pub cells: Vec<([usize; 4], usize)>,
    /// Both halves of the shell, from the front to the back.
    pub shell: [Vec<usize>; 2],
    /// Both halves of the wall, from the front to the back.
    pub wall: [Vec<usize>; 2],
    /// The free surface of what holds the globe, on each side from the wall to the shell.
    pub free: [Vec<usize>; 2],
    /// The points nearest to the monitored places.
    pub monitors: [usize; 4],
    /// The limbus and the equator all around.
    pub rings: [Vec<Point>; 2],
    /// Up in the picture, in the axes of the mesh.
    up: Vector3<f64>,
    /// Towards the nose and up at the eye, in the axes of the mesh.
    face: [Vector3<f64>; 2],
}

impl Section {
    pub fn new(eye: &SpatialEye, blow: &SpatialBlow) -> Self {
        let plane = blow.aim.plane();
        let azimuth = upper(plane) - blow.up;
        let mut section = Self {
            points: Vec::new(),
            cells: Vec::new(),
            shell: [Vec::new(), Vec::new()],
            wall: [Vec::new(), Vec::new()],
            free: [Vec::new(), Vec::new()],
            monitors: [0; 4],
            rings: [eye.parameters.shell.limbus, FRAC_PI_2].map(|front| {
                let azimuths = (0..AROUND).map(|i| TAU * i as f64 / AROUND as f64);
                let on_shell = |azimuth| eye.on_shell(direction(front, towards(azimuth)));
                azimuths.filter_map(on_shell).collect()
            }),
            up: towards(azimuth),
            face: [towards(FRAC_PI_2 - blow.up), towards(-blow.up)],
        };
        let nodes: Nodes = std::array::from_fn(|k| eye.mesh.at.iter().map(|p| p[k]).collect());
        for side in 0..2 {
            let azimuth = azimuth + side as f64 * PI;
            section.put_globe(eye, &nodes, azimuth, side);
            section.put_around(eye, &nodes, azimuth, side);
        }
        let places = monitored(eye, blow.up);
        section.monitors = places.map(|place| {
            let at = section.shown(place);
            let apart = |i: &usize| (section.points[*i].rest - at).norm();
            let near = (0..section.points.len()).min_by(|a, b| apart(a).total_cmp(&apart(b)));
            near.unwrap_or(0)
        });
        section
    }

    /// Where a place is shown.
    pub fn shown(&self, place: Vector3<f64>) -> Point2<f64> {
        Point2::new(place.x, place.dot(&self.up))
    }

    /// How far a place lies out of the plane that is shown, towards who looks at it.
    pub fn aside(&self, place: Vector3<f64>) -> f64 {
        place.dot(&Vector3::x().cross(&self.up))
    }

    /// Where a place is seen from the front: x towards the nose, y up.
    pub fn facing(&self, place: Vector3<f64>) -> Point2<f64> {
        Point2::from(self.face.map(|axis| place.dot(&axis)))
    }

    fn put(&mut self, nodes: &Nodes, point: Point, region: Region) -> usize {
        let rest = self.shown(point.of(nodes));
        self.points.push(Shown { point, rest, region });
        self.points.len() - 1
    }

    /// One half of the globe.
    fn put_globe(&mut self, eye: &SpatialEye, nodes: &Nodes, azimuth: f64, side: usize) {
        let parameters = &eye.parameters;
        let limbus = parameters.shell.limbus;
        let mesh = plane_mesh::build((HALF, Layers::EVEN), parameters.radius, limbus, None);
        let out = towards(azimuth);
        let mut number = vec![None; mesh.x.len()];
        for (node, number) in number.iter_mut().enumerate() {
            let place = Vector3::x() * mesh.x[node] + out * mesh.r[node];
            let (point, region) = if mesh.shell.contains(&node) {
                let back = mesh.x[node] > 0.0;
                (eye.on_shell(place), if back { Region::Retina } else { Region::Shell })
            } else {
                let found = eye.at(place * INSIDE, Some(Place::Globe));
                let lens = found.as_ref().is_some_and(|(_, cell)| eye.cells[*cell].lens > 0.5);
                let region = if lens { Region::Lens } else { Region::Interior };
                (found.map(|(point, _)| point), region)
            };
            if let Some(point) = point {
                *number = Some(self.put(nodes, point, region));
            }
        }
        for block in &mesh.blocks {
            for corners in block.cells() {
                let found: Vec<usize> = corners.iter().filter_map(|n| number[*n]).collect();
                let middle: Vector3<f64> = corners
                    .iter()
                    .map(|n| (Vector3::x() * mesh.x[*n] + out * mesh.r[*n]) * 0.25)
                    .sum();
                let cell = eye.at(middle * INSIDE, Some(Place::Globe));
                if let (Ok(corners), Some((_, cell))) = (<[usize; 4]>::try_from(found), cell) {
                    self.cells.push((corners, cell));
                }
            }
        }
        self.shell[side] = mesh.shell.iter().filter_map(|node| number[*node]).collect();
    }

    /// What holds the globe on one side.
    fn put_around(&mut self, eye: &SpatialEye, nodes: &Nodes, azimuth: f64, side: usize) {
        let (rim, radius) = (eye.rim.filter(|rim| !rim.is_round()), eye.parameters.radius);
        let Some(cavity) = Cavity::new(&eye.parameters, rim) else { return };
        let out = towards(azimuth);
        let direction = |front: f64| direction(front, out);
        let openings = (0..=180).map(|i| f64::from(i) * PI / 180.0);
        let opening = openings.take_while(|front| cavity.behind(direction(*front)) < 0.0);
        let opening = opening.last().unwrap_or(FRAC_PI_2);
        let mut grid = vec![[None; LAYERS + 1]; RAYS + 1];
        for (ray, row) in grid.iter_mut().enumerate() {
            let front = opening + (PI - opening) * ray as f64 / RAYS as f64;
            let direction = direction(front);
            let far = cavity.distance(direction);
            for (layer, place) in row.iter_mut().enumerate() {
                let share = layer as f64 / LAYERS as f64;
                let (point, region) = if layer == 0 {
                    (eye.on_shell(direction), Region::Shell)
                } else {
                    let shrunk = radius + (far - radius) * share * INSIDE;
                    let found = eye.at(direction * shrunk, Some(Place::Surround));
                    let region = if layer == LAYERS { Region::Orbit } else { Region::Fat };
                    (found.map(|(point, _)| point), region)
                };
                *place = point.map(|point| self.put(nodes, point, region));
            }
        }
        for rays in grid.windows(2) {
            for layer in 0..LAYERS {
                let corners =
                    [rays[0][layer], rays[0][layer + 1], rays[1][layer + 1], rays[1][layer]];
                let found: Vec<usize> = corners.into_iter().flatten().collect();
                let Ok(corners) = <[usize; 4]>::try_from(found) else { continue };
                let sum: Vector3<f64> =
                    corners.iter().map(|i| self.points[*i].point.of(nodes)).sum();
                if let Some((_, cell)) = eye.at(sum * 0.25, Some(Place::Surround)) {
                    self.cells.push((corners, cell));
                }
            }
        }
        self.wall[side] = grid.iter().filter_map(|row| row[LAYERS]).collect();
        self.free[side] = grid[0].iter().rev().copied().flatten().collect();
    }
}
