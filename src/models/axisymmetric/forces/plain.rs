//! The cells one by one: the tested reference of [`crate::models::axisymmetric::forces::quads`]
//! and the baseline of the benchmarks.

use crate::models::axisymmetric::eye::{AxisymmetricEye, Tissue};
use crate::models::axisymmetric::forces::state::{CellSums, Cells, NodeState};
use crate::models::axisymmetric::{forces::cell::Rest, recording::sensor};

/// Cells with lists of corners.
pub(crate) struct PlainCells {
    eye: AxisymmetricEye,
    cells: Vec<(Rest, [usize; 4])>,
    /// Weight of each cell in the mean pressure and in the sensor's.
    weights: Vec<(f64, f64)>,
    pressures: Vec<f64>,
}

impl PlainCells {
    pub fn new(eye: &AxisymmetricEye) -> Self {
        let cells: Vec<_> = eye.cells.iter().map(|of| (Rest::new(eye, of), of.corners)).collect();
        Self {
            weights: sensor::weights(eye),
            pressures: vec![0.0; cells.len()],
            cells,
            eye: eye.clone(),
        }
    }

    /// Elastic energy with node n at `at(n)`, J.
    pub fn energy(&self, at: impl Fn(usize) -> (f64, f64)) -> f64 {
        let stored = |(rest, corners): &(Rest, [usize; 4])| rest.energy(corners.map(&at));
        self.cells.iter().map(stored).sum()
    }
}

impl Cells for PlainCells {
    fn rest(&self) -> NodeState {
        let owners: Vec<_> = (0..self.eye.mass.len()).map(Some).collect();
        NodeState::new(&self.eye, &owners, self.eye.mesh.shell[0])
    }

    fn place(&self, node: usize) -> usize {
        node
    }

    fn forces(&mut self, state: &mut NodeState) -> CellSums {
        let none = f64::INFINITY;
        let mut sums = CellSums { limit: none, least_corner: none, ..CellSums::default() };
        state.fx.fill(0.0);
        state.fr.fill(0.0);
        for (i, (rest, corners)) in self.cells.iter().enumerate() {
            let response = rest.respond(
                corners.map(|n| (state.x[n], state.r[n])),
                corners.map(|n| (state.vx[n], state.vr[n])),
            );
            for (&node, force) in corners.iter().zip(response.force) {
                state.fx[node] += force.0;
                state.fr[node] += force.1;
            }
            self.pressures[i] = response.pressure;
            let (mean, sensor) = self.weights[i];
            sums.pressure += mean * response.pressure;
            sums.sensor += sensor * response.pressure;
            if self.eye.cells[i].region == Tissue::Globe {
                sums.volume += response.volume;
            }
            sums.limit = sums.limit.min(response.limit);
            sums.loss += response.loss;
            sums.least_corner = sums.least_corner.min(response.least_triangle);
        }
        sums
    }

    fn advance(&self, state: &mut NodeState, kick: f64, drift: f64) {
        state.advance(kick, drift);
    }

    fn pressures(&self) -> Vec<f64> {
        self.pressures.clone()
    }
}
