//! The cells one by one: the tested reference of [`super::rows`] and the baseline of its speed.

use crate::models::axisymmetric::forces::state::CellSums;
use crate::models::spatial::eye::{SpatialEye, Tissue};
use crate::models::spatial::forces::cell::{self, Constants, Eight, Fields, field};
use crate::models::spatial::forces::state::{Cells, NodeState};
use crate::models::spatial::{forces::math::Plain, recording::sensor};

/// Cells with lists of corners.
pub(crate) struct PlainCells {
    cells: Vec<(Constants, [usize; 8])>,
    pressures: Vec<f64>,
}

/// Places or velocities of the corners of a cell.
fn gathered(of: &[Vec<f64>; 3], corners: &[usize; 8]) -> Eight<f64> {
    corners.map(|n| [of[0][n], of[1][n], of[2][n]])
}

/// The constants of all cells of an eye, in order.
pub(crate) fn constants(eye: &SpatialEye) -> Vec<Constants> {
    let cells = eye.cells.iter().zip(sensor::weights(eye)).map(|(cell, weights)| {
        let mut constants = cell::constants(eye, cell);
        (constants[field::MEAN], constants[field::SENSOR]) = weights;
        constants[field::GLOBE] = f64::from(cell.region == Tissue::Globe);
        constants
    });
    cells.collect()
}

impl PlainCells {
    pub fn new(eye: &SpatialEye) -> Self {
        let corners = eye.cells.iter().map(|cell| cell.corners);
        let cells: Vec<_> = constants(eye).into_iter().zip(corners).collect();
        Self { pressures: vec![0.0; cells.len()], cells }
    }

    /// Elastic energy of what is computed, J.
    pub fn energy(&self, state: &NodeState) -> f64 {
        let stored = self.cells.iter();
        stored.map(|(c, corners)| cell::energy(c, &gathered(&state.at, corners))).sum()
    }

    /// The least corner of a cell over its volume at rest.
    pub fn least_corner(&self, state: &NodeState, cell: usize) -> f64 {
        let (c, corners) = &self.cells[cell];
        cell::least_corner(c, &gathered(&state.at, corners))
    }
}

impl Cells for PlainCells {
    fn forces(&mut self, state: &mut NodeState) -> CellSums {
        let mut sums = CellSums { least_corner: f64::INFINITY, ..CellSums::default() };
        let (mut rate, mut shrinking) = (0.0_f64, 0.0_f64);
        for ((c, corners), pressure) in self.cells.iter().zip(&mut self.pressures) {
            let (at, speed) = (gathered(&state.at, corners), gathered(&state.speed, corners));
            let response = cell::respond(Plain, Fields::of(c), &at, &speed);
            for (&node, force) in corners.iter().zip(response.force) {
                for (sum, force) in state.force.iter_mut().zip(force) {
                    sum[node] += force;
                }
            }
            *pressure = response.pressure;
            sums.pressure += c[field::MEAN] * response.pressure;
            sums.sensor += c[field::SENSOR] * response.pressure;
            sums.volume += c[field::GLOBE] * response.volume;
            sums.loss += response.loss;
            sums.least_corner = sums.least_corner.min(response.least_corner);
            shrinking = shrinking.max(response.shrinking);
            rate = rate.max(response.rate);
            let over = response.rate * response.rate - state.regular[0];
            for &node in corners.iter().filter(|_| over > 0.0) {
                state.stiff[node] += c[field::STIFF] * over;
            }
        }
        sums.shrinking = 1.0 / shrinking;
        sums.limit = 1.0 / rate.max(shrinking);
        sums
    }

    fn pressures(&self) -> Vec<f64> {
        self.pressures.clone()
    }
}
