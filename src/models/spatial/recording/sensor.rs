//! What instruments read off the eye: the mean pressure, a sensor at the back, and accelerometers
//! at the four monitored places.
//!
//! The sensor sits on the eye's own axis, as in experiments, and the accelerometers in its vertical
//! plane. Low pass and running means are the axisymmetric eye's.

use crate::models::axisymmetric::recording::sensor::{
    SENSOR_REACH, SENSOR_X, SMOOTHING_S, Velocities,
};
use crate::models::spatial::eye::point::{Nodes, Point};
use crate::models::spatial::eye::{SpatialEye, within};
use crate::models::spatial::{eye::mesh::Place, forces::object::towards};
use nalgebra::Vector3;

/// Points along each side of a cell that tell how much of it the sensor takes.
const POINTS: usize = 6;

/// What a cell counts.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Weights {
    /// In the mean pressure of the globe.
    pub mean: f64,
    /// In the sensor's.
    pub sensor: f64,
    /// 1 in the globe.
    pub globe: f64,
}

/// Weights by volume at rest, the sensor's as far as a cell lies within its reach.
pub(crate) fn weights(eye: &SpatialEye) -> Vec<Weights> {
    let centre = Vector3::new(SENSOR_X, 0.0, 0.0);
    let near = |p: &[Vector3<f64>; 8]| {
        let far = p.iter().all(|p| (p - centre).norm() > 3.0 * SENSOR_REACH);
        if far {
            return 0.0;
        }
        let count = POINTS * POINTS * POINTS;
        let part = |i: usize| (i as f64 + 0.5) / POINTS as f64;
        let inside = |i: &usize| {
            let s = [part(i % POINTS), part(i / POINTS % POINTS), part(i / POINTS / POINTS)];
            (within(p, s) - centre).norm() <= SENSOR_REACH
        };
        (0..count).filter(inside).count() as f64 / count as f64
    };
    let mut weights: Vec<Weights> = eye
        .cells
        .iter()
        .map(|cell| {
            let globe = f64::from(cell.place == Place::Globe);
            let volume = globe * eye.volume(cell);
            Weights {
                mean: volume,
                sensor: volume * near(&cell.corners.map(|node| eye.mesh.at[node])),
                globe,
            }
        })
        .collect();
    let total = |of: fn(&Weights) -> f64| weights.iter().map(of).sum::<f64>();
    let (mean, sensor) = (total(|w| w.mean), total(|w| w.sensor));
    for w in &mut weights {
        w.mean /= mean;
        w.sensor /= sensor;
    }
    weights
}

/// The four monitored places, in axes turned so that azimuth `up` is up: in the globe 1.333 mm up
/// and back of its middle; on the shell 5 degrees above the front pole, 5 degrees above the back
/// pole, and 5 degrees behind the top.
pub(crate) fn monitored(eye: &SpatialEye, up: f64) -> [Vector3<f64>; 4] {
    let above = towards(-up);
    let aim = eye.parameters.radius / 9.0 * std::f64::consts::FRAC_1_SQRT_2;
    let on_shell = |front_deg: f64| {
        let front = front_deg.to_radians();
        let (along, across) = (-libm::cos(front), libm::sin(front));
        (Vector3::x() * along + above * across) * eye.parameters.radius
    };
    [(Vector3::x() + above) * aim, on_shell(5.0), on_shell(175.0), on_shell(95.0)]
}

/// The four monitored places and what they have been through.
#[derive(Debug, Clone)]
pub(crate) struct Accelerometers {
    places: [Option<Point>; 4],
    velocities: Velocities<3>,
}

impl Accelerometers {
    /// At rest.
    pub fn new(eye: &SpatialEye, up: f64) -> Self {
        let [inside, shell @ ..] = monitored(eye, up);
        let [front, right, top] = shell.map(|place| eye.on_shell(place));
        let inside = eye.at(inside, Some(Place::Globe)).map(|(point, _)| point);
        Self { places: [inside, front, right, top], velocities: Velocities::default() }
    }

    /// Mean accelerations over the last 20 us up to `time` s of the velocities, m/s2.
    pub fn read(&mut self, speed: &Nodes, time: f64) -> [f64; 4] {
        let of = |i: usize| -> Vector3<f64> {
            self.places[i].as_ref().map_or(Vector3::zeros(), |p| p.of(speed))
        };
        let change = self.velocities.change(std::array::from_fn(of), time);
        change.map(|change| change.norm() / SMOOTHING_S)
    }
}
