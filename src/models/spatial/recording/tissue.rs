//! What single tissues feel, by clock hour: the measures that injuries are read from.
//!
//! They are those of the axisymmetric eye at its front angles, which are here the eye's own, and
//! each is the largest over the azimuth:
//!
//! * stretch of the wall along the meridian between 60 and 120 degrees. Where an object touches it,
//!   a quad shows its dent, and is left out while it does;
//! * mean of that stretch over each quadrant from 150 degrees to the back pole;
//! * stretch of the ring at 62 degrees over each hour: straight on that is the growth of its
//!   radius;
//! * how much farther than at rest the lens's equator is from the shell at 62 and at 45 degrees, at
//!   each hour.
//!
//! Coarse cells hold the lens faster than fine ones: level 1 reads 0.50 to 0.89 of the pull on it
//! that the axisymmetric eye gives straight on, and 0.50 to 1.4 of that on the iris (11 blows in
//! gelatin). Both are divided by the mean of that; what is left of it is in their mesh errors.
//!
//! Each goes through a low pass of 20 us. A rigid motion gives none of them anything.

use crate::models::axisymmetric::recording::tissue::{
    BACK_DEG, EDGE_DEG, EQUATOR_DEG, IRIS_DEG, LENS_EQUATOR,
};
use crate::models::axisymmetric::{eye::part, recording::sensor::LowPass};
use crate::models::spatial::eye::mesh::{Extent, Place};
use crate::models::spatial::eye::orbit::seen_from_the_middle;
use crate::models::spatial::eye::point::{Nodes, Point};
use crate::models::spatial::eye::{SpatialEye, area, upon};
use crate::models::spatial::forces::object::{direction, towards};
use crate::models::spatial::recording::results::Extremes;
use crate::run::kept::Peak;
use crate::run::sectors::{HOURS, QUADRANTS};
use nalgebra::Vector3;
use std::f64::consts::{PI, TAU};

/// Pieces of an hour along the ring at the retina's front edge.
const PIECES: usize = 4;
/// Points along each side of a quad that tell how much of it lies within limits.
const POINTS: usize = 6;

/// The share of the pull on lens and iris that each level reads, the last that of finer ones too.
const READ: [[f64; 2]; 3] = [[0.63, 0.82], [0.78, 0.92], [0.85, 0.95]];

/// A quad of the shell near the equator.
struct EquatorQuad {
    quad: usize,
    /// How much of it lies within the band.
    share: f64,
    /// Hours of it and of its mirror image.
    hours: [usize; 2],
    passed: LowPass,
}

/// How far the lens's equator is from where it is held.
struct Held {
    lens: Point,
    shell: Point,
    rest: f64,
    passed: LowPass,
}

/// What the tissues of one eye are read with.
pub(crate) struct Tissues {
    equator: Vec<EquatorQuad>,
    /// Quads with their weights in each quadrant.
    back: Vec<(usize, [f64; QUADRANTS])>,
    back_passed: [LowPass; QUADRANTS],
    ring: Vec<Point>,
    ring_rest: Vec<f64>,
    ring_passed: [LowPass; HOURS],
    /// At the retina's front edge and at the root of the iris, hour by hour.
    held: [Vec<Held>; 2],
    /// What the mesh reads of the pull on each.
    read: [f64; 2],
    /// Measures after the low pass, in the order of the axisymmetric eye's.
    pub now: [f64; 5],
}

/// The piece, `of` so many around the axis from one with `from` in its middle, of an azimuth.
fn piece(azimuth: f64, from: f64, of: usize) -> usize {
    let turns = (azimuth - from) / TAU;
    ((turns * of as f64).round().rem_euclid(of as f64)) as usize % of
}

impl Tissues {
    /// At rest, of an eye in axes turned so that azimuth `up` is up.
    pub fn new(eye: &SpatialEye, at: &Nodes, up: f64) -> Self {
        let images: &[f64] = if eye.extent == Extent::Half { &[1.0, -1.0] } else { &[1.0] };
        let (mut equator, mut back) = (Vec::new(), Vec::new());
        for (number, quad) in eye.quads.iter().enumerate() {
            let p = quad.corners.map(|node| eye.mesh.at[node]);
            let part = |i: usize| part(i % POINTS, POINTS);
            let points = (0..POINTS * POINTS)
                .map(|i| seen_from_the_middle(upon(&p, part(i), part(i / POINTS))));
            let within = |front: f64, (from, to): (f64, f64)| {
                (from.to_radians()..=to.to_radians()).contains(&front)
            };
            let count = (POINTS * POINTS) as f64;
            let banded = points.clone().filter(|(front, _)| within(*front, EQUATOR_DEG));
            let share = banded.count() as f64 / count;
            let hour = |sign: f64| piece(sign * quad.seen.1 + up, 0.0, HOURS);
            if share > 0.0 {
                let hours = [hour(1.0), hour(images[images.len() - 1])];
                let passed = LowPass::default();
                equator.push(EquatorQuad { quad: number, share, hours, passed });
            }
            let whole = area(&p) / count;
            let mut weights = [0.0; QUADRANTS];
            for (_, azimuth) in points.filter(|(front, _)| within(*front, BACK_DEG)) {
                for sign in images {
                    weights[piece(sign * azimuth + up, 0.25 * PI, QUADRANTS)] += whole;
                }
            }
            if weights.iter().any(|weight| *weight > 0.0) {
                back.push((number, weights));
            }
        }
        for quadrant in 0..QUADRANTS {
            let whole: f64 = back.iter().map(|(_, weights)| weights[quadrant]).sum();
            for (_, weights) in &mut back {
                weights[quadrant] /= whole;
            }
        }
        let count = HOURS * PIECES;
        let azimuth = |hour: f64| TAU * hour / HOURS as f64 - up;
        let ring = (0..count).filter_map(|i| {
            let hour = (i as f64) / PIECES as f64 - 0.5;
            eye.on_shell(direction(EDGE_DEG.to_radians(), towards(azimuth(hour))))
        });
        let ring: Vec<Point> = ring.collect();
        let ring_rest = lengths(&ring, at);
        let held = [EDGE_DEG, IRIS_DEG].map(|front| {
            let held = (0..HOURS).filter_map(|hour| {
                let (out, (x, r)) = (towards(azimuth(hour as f64)), LENS_EQUATOR);
                let (lens, _) = eye.at(Vector3::x() * x + out * r, Some(Place::Globe))?;
                let shell = eye.on_shell(direction(front.to_radians(), out))?;
                let rest = (shell.of(at) - lens.of(at)).norm();
                Some(Held { rest, lens, shell, passed: LowPass::default() })
            });
            held.collect()
        });
        Self {
            equator,
            back,
            back_passed: [LowPass::default(); QUADRANTS],
            ring,
            ring_rest,
            ring_passed: [LowPass::default(); HOURS],
            held,
            read: READ[(eye.level.max(1) as usize - 1).min(READ.len() - 1)],
            now: [0.0; 5],
        }
    }

    /// Offers them to their peaks and to the extremes at `time`, in s; `share` is of a low pass,
    /// `along` the stretch of each quad and `touched` whether the object touches it. What pulls on
    /// lens and iris counts only where `pulls` are read.
    pub fn read(
        &mut self,
        eye: &SpatialEye,
        at: &Nodes,
        (along, touched): (&[f64], &[bool]),
        (share, time): (f64, f64),
        pulls: bool,
        peaks: &mut [Peak; 5],
        e: &mut Extremes,
    ) {
        self.now = [0.0; 5];
        for quad in &mut self.equator {
            let passed = quad.passed.pass(along[quad.quad], share);
            if touched[quad.quad] {
                continue;
            }
            let stretch = passed * quad.share;
            for hour in quad.hours {
                felt(&mut self.now[0], &mut e.sectors.equator[hour], stretch);
            }
            if stretch > peaks[0].value {
                peaks[0].offer(stretch, time);
                e.equator_at = eye.quads[quad.quad].seen;
            }
        }
        for quadrant in 0..QUADRANTS {
            let mean = self.back.iter().map(|(quad, w)| w[quadrant] * along[*quad]);
            let mean = self.back_passed[quadrant].pass(mean.sum(), share);
            felt(&mut self.now[1], &mut e.sectors.back[quadrant], mean);
        }
        let mut before = self.ring.last().map_or(Vector3::zeros(), |p| p.of(at));
        let mut lengths = [0.0; HOURS * PIECES];
        for (i, point) in self.ring.iter().enumerate() {
            let here = point.of(at);
            lengths[(i + HOURS * PIECES - 1) % (HOURS * PIECES)] = (here - before).norm();
            before = here;
        }
        for hour in 0..HOURS {
            let of = |lengths: &[f64]| -> f64 {
                lengths[hour * PIECES..(hour + 1) * PIECES].iter().sum()
            };
            let grown = of(&lengths) / of(&self.ring_rest) - 1.0;
            let stretch = self.ring_passed[hour].pass(grown, share);
            felt(&mut self.now[2], &mut e.sectors.edge[hour], stretch);
        }
        for (which, held) in self.held.iter_mut().enumerate() {
            let to = if which == 0 { &mut e.sectors.lens } else { &mut e.sectors.iris };
            for (hour, held) in held.iter_mut().enumerate() {
                let apart = (held.shell.of(at) - held.lens.of(at)).norm() - held.rest;
                let pulled = held.passed.pass(apart / self.read[which], share);
                let most = &mut self.now[3 + which];
                *most = most.max(pulled);
                if pulls {
                    to[hour] = to[hour].max(pulled);
                }
            }
        }
        let told = if pulls { peaks.len() } else { 3 };
        for (peak, now) in peaks.iter_mut().zip(self.now).take(told).skip(1) {
            peak.offer(now, time);
        }
    }
}

/// Takes a value to the largest now and to that of its sector.
fn felt(now: &mut f64, sector: &mut f64, value: f64) {
    (*now, *sector) = (now.max(value), sector.max(value));
}

/// Lengths from each point of a closed ring to the next.
fn lengths(ring: &[Point], at: &Nodes) -> Vec<f64> {
    let places: Vec<Vector3<f64>> = ring.iter().map(|point| point.of(at)).collect();
    let next = places.iter().cycle().skip(1);
    places.iter().zip(next).map(|(a, b)| (b - a).norm()).collect()
}
