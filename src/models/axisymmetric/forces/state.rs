//! Positions, velocities and forces of the nodes, and what moves them.

use crate::models::axisymmetric::eye::AxisymmetricEye;
use crate::models::paper::forces::layout::{LANES, Lane};
use std::ops::Range;

/// The nodes of the moving eye. Positions belong to full steps, velocities to half steps.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct NodeState {
    /// m.
    pub x: Vec<f64>,
    pub r: Vec<f64>,
    /// m/s.
    pub vx: Vec<f64>,
    pub vr: Vec<f64>,
    /// N.
    pub fx: Vec<f64>,
    pub fr: Vec<f64>,
    /// 1/kg, 0 where a node is held.
    pub free_x: Vec<f64>,
    pub free_r: Vec<f64>,
    /// Nodes of the shell, from front to back.
    pub shell: Range<usize>,
}

/// What the cells say at some instant, beside their forces.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct CellSums {
    /// Longest stable step, s.
    pub limit: f64,
    /// Power lost to viscosity, W.
    pub loss: f64,
    /// Mean pressure of the globe, Pa.
    pub pressure: f64,
    /// Mean pressure of the cells at the sensor, Pa.
    pub sensor: f64,
    /// Volume of the globe, m3.
    pub volume: f64,
    /// Smallest corner over its volume at rest.
    pub least_corner: f64,
    /// Longest step by how fast corners shrink, s, where cells tell it apart.
    pub shrinking: f64,
}

/// Sums of many cells by place in a group of eight.
#[derive(Default)]
pub(crate) struct Totals {
    pub loss: Lane,
    pub mean: Lane,
    pub sensor: Lane,
    pub volume: Lane,
    /// 1/s, most.
    pub rate: Lane,
    /// 1/s, most.
    pub shrinking: Lane,
    /// Least.
    pub corner: Lane,
}

impl Totals {
    pub fn new() -> Self {
        Self { corner: [f64::INFINITY; LANES], ..Self::default() }
    }

    /// Over all places.
    pub fn sums(&self) -> CellSums {
        let sum = |of: &Lane| of.iter().sum::<f64>();
        let most = |of: &Lane| of.iter().copied().fold(0.0, f64::max);
        CellSums {
            limit: 1.0 / most(&self.rate),
            shrinking: 1.0 / most(&self.shrinking),
            loss: sum(&self.loss),
            pressure: sum(&self.mean),
            sensor: sum(&self.sensor),
            volume: sum(&self.volume),
            least_corner: self.corner.iter().copied().fold(f64::INFINITY, f64::min),
        }
    }
}

/// The cells of an eye, in one form of computing them or another.
pub(crate) trait Cells {
    /// A state at rest.
    fn rest(&self) -> NodeState;
    /// Where a node of the eye is found in the state.
    fn place(&self, node: usize) -> usize;
    /// Sets the forces of all nodes to those of the cells.
    fn forces(&mut self, state: &mut NodeState) -> CellSums;
    /// Kicks velocities over `kick` s, then moves nodes over `drift` s.
    fn advance(&self, state: &mut NodeState, kick: f64, drift: f64);
    /// Pressure of each cell of the eye after `forces`, Pa.
    fn pressures(&self) -> Vec<f64>;
}

impl NodeState {
    /// At rest: at each place the node that owns it, if one does, and the shell from such a place.
    pub fn new(eye: &AxisymmetricEye, owners: &[Option<usize>], shell: usize) -> Self {
        let mesh = &eye.mesh;
        let read = |of: &dyn Fn(usize) -> f64, none: f64| -> Vec<f64> {
            owners.iter().map(|o| o.map_or(none, of)).collect()
        };
        let free = |i: usize| if eye.fixed[i] { 0.0 } else { 1.0 / eye.mass[i] };
        let off_axis = |i: usize| if mesh.r[i] == 0.0 { 0.0 } else { free(i) };
        let zeros = vec![0.0; owners.len()];
        Self {
            x: read(&|i| mesh.x[i], 0.0),
            // Off the axis, as radii are divided by.
            r: read(&|i| mesh.r[i], eye.parameters.radius),
            vx: zeros.clone(),
            vr: zeros.clone(),
            fx: zeros.clone(),
            fr: zeros,
            free_x: read(&free, 0.0),
            free_r: read(&off_axis, 0.0),
            shell: shell..shell + mesh.shell.len(),
        }
    }

    /// x and r of a place, m.
    pub fn at(&self, place: usize) -> (f64, f64) {
        (self.x[place], self.r[place])
    }

    /// Kicks velocities over `kick` s, then moves nodes over `drift` s.
    pub fn advance(&mut self, kick: f64, drift: f64) {
        for i in 0..self.x.len() {
            self.vx[i] += kick * self.fx[i] * self.free_x[i];
            self.vr[i] += kick * self.fr[i] * self.free_r[i];
            self.x[i] += drift * self.vx[i];
            self.r[i] += drift * self.vr[i];
        }
    }
}
