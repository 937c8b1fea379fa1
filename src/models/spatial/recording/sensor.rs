//! What instruments read off the eye: the mean pressure, a sensor at the back, and accelerometers
//! at the four monitored places.
//!
//! The sensor sits on the eye's own axis, as in experiments, and the accelerometers in its vertical
//! plane. Low pass and running means are the axisymmetric eye's.

use crate::models::axisymmetric::eye::part;
use crate::models::axisymmetric::recording::sensor::{
    SENSOR_REACH, SENSOR_X, SMOOTHING_S, Velocities, weighed,
};
use crate::models::spatial::eye::point::{Nodes, Point};
use crate::models::spatial::eye::{SpatialEye, Tissue, within};
use crate::models::spatial::forces::object::{direction, towards};
use nalgebra::Vector3;

/// Points along each side of a cell that tell how much of it the sensor takes.
const POINTS: usize = 6;

/// Weight of each cell in the mean pressure of the globe, and in the sensor's.
pub(crate) fn weights(eye: &SpatialEye) -> Vec<(f64, f64)> {
    let centre = Vector3::new(SENSOR_X, 0.0, 0.0);
    let near = |p: &[Vector3<f64>; 8]| {
        if p.iter().all(|p| (p - centre).norm() > 3.0 * SENSOR_REACH) {
            return 0.0;
        }
        let count = POINTS * POINTS * POINTS;
        let inside = |i: &usize| {
            let s = [i, &(i / POINTS), &(i / POINTS / POINTS)].map(|i| part(i % POINTS, POINTS));
            (within(p, s) - centre).norm() <= SENSOR_REACH
        };
        (0..count).filter(inside).count() as f64 / count as f64
    };
    let cells = eye.cells.iter().map(|cell| {
        let near = near(&cell.corners.map(|node| eye.mesh.at[node]));
        (cell.region, eye.volume(cell), near)
    });
    weighed(cells)
}

/// The monitored places of the axisymmetric eye, in axes turned so that azimuth `up` is up.
pub(crate) fn monitored(eye: &SpatialEye, up: f64) -> [Vector3<f64>; 4] {
    let above = towards(-up);
    let aim = eye.parameters.radius / 9.0 * std::f64::consts::FRAC_1_SQRT_2;
    let on_shell = |front: f64| direction(front.to_radians(), above) * eye.parameters.radius;
    [(Vector3::x() + above) * aim, on_shell(5.0), on_shell(175.0), on_shell(95.0)]
}

/// The four monitored places and what they have been through.
pub(crate) struct Accelerometers {
    places: [Option<Point>; 4],
    velocities: Velocities<3>,
}

impl Accelerometers {
    /// At rest.
    pub fn new(eye: &SpatialEye, up: f64) -> Self {
        let [inside, shell @ ..] = monitored(eye, up);
        let [front, right, top] = shell.map(|place| eye.on_shell(place));
        let inside = eye.at(inside, Some(Tissue::Globe)).map(|(point, _)| point);
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
