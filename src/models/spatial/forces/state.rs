//! Positions, velocities and forces of the nodes, and what moves them.

use crate::models::axisymmetric::forces::state::CellSums;
use crate::models::spatial::eye::{SpatialEye, point::Nodes};
use nalgebra::Vector3;

/// The nodes of the moving eye. Positions belong to full steps, velocities to half steps.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct NodeState {
    /// m.
    pub at: Nodes,
    /// m/s.
    pub speed: Nodes,
    /// N.
    pub force: Nodes,
    /// 1/kg, 0 where a node is held.
    pub free: Nodes,
    /// What stiff cells add to the squared rate of each node, times its mass, kg/s2.
    pub stiff: Vec<f64>,
    /// The squared rate above which a cell is stiff, 1/s2, and what a mesh without such has.
    pub regular: [f64; 2],
}

/// The cells of an eye, in one form of computing them or another.
pub(crate) trait Cells {
    /// Adds the forces of cells to those of nodes.
    fn forces(&mut self, state: &mut NodeState) -> CellSums;
    /// Pressure of each cell of the eye after `forces`, Pa.
    fn pressures(&self) -> Vec<f64>;
}

/// A vector of a node.
#[inline]
pub(crate) fn vector(of: &Nodes, node: usize) -> Vector3<f64> {
    Vector3::new(of[0][node], of[1][node], of[2][node])
}

impl NodeState {
    /// At rest.
    pub fn new(eye: &SpatialEye) -> Self {
        let n = eye.mesh.at.len();
        let zeros = || vec![0.0; n];
        let free = |node: usize, component: usize| {
            if eye.fixed[node] || (component == 2 && eye.on_mirror(node)) {
                0.0
            } else {
                1.0 / eye.mass[node]
            }
        };
        Self {
            at: std::array::from_fn(|k| eye.mesh.at.iter().map(|p| p[k]).collect()),
            speed: std::array::from_fn(|_| zeros()),
            force: std::array::from_fn(|_| zeros()),
            free: std::array::from_fn(|k| (0..n).map(|node| free(node, k)).collect()),
            stiff: zeros(),
            regular: [f64::INFINITY, 0.0],
        }
    }

    /// Takes all forces away, and what is stiff.
    pub fn release(&mut self) {
        self.stiff.fill(0.0);
        for force in &mut self.force {
            force.fill(0.0);
        }
    }

    /// Adds a force on a node, N.
    #[inline]
    pub fn push(&mut self, node: usize, force: Vector3<f64>) {
        for k in 0..3 {
            self.force[k][node] += force[k];
        }
    }

    /// The largest squared rate of any node, 1/s2.
    pub fn rate_squared(&self) -> f64 {
        let over = self.stiff.iter().zip(&self.free[0]);
        self.regular[1] + over.fold(0.0, |most, (stiff, free)| (stiff * free).max(most))
    }

    /// Makes a node of `mass` kg stiffer by `stiffness` N/m that loses `damping` N s/m.
    pub fn stiffen(&mut self, node: usize, mass: f64, (stiffness, damping): (f64, f64)) {
        // With both, h^2 K/4 + h C/2 = m.
        let squared = self.regular[1] + (self.stiff[node] + 0.25 * stiffness) / mass;
        let lost = 0.25 * damping / mass;
        let rate = lost + (lost * lost + squared).sqrt();
        self.stiff[node] = mass * (rate * rate - self.regular[1]);
    }

    /// Kicks velocities over `kick` s, then moves nodes over `drift` s.
    pub fn advance(&mut self, kick: f64, drift: f64) {
        for k in 0..3 {
            let (at, speed) = (&mut self.at[k], &mut self.speed[k]);
            let (force, free) = (&self.force[k], &self.free[k]);
            for (((at, speed), force), free) in at.iter_mut().zip(speed).zip(force).zip(free) {
                *speed += kick * force * free;
                *at += drift * *speed;
            }
        }
    }
}
