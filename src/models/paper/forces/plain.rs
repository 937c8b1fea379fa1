//! The same physics as a plain loop over an edge list: velocity Verlet with exact drag.
//!
//! This is how most people would write it first. It is kept as the reference that the row kernel
//! is tested against and as the baseline that the benchmarks compare with.

use crate::models::paper::{eye::Eye, forces::load::ArcLoad};
use crate::models::pulse::Pulse;

/// An eye and its load as lists of edges and nodes.
#[derive(Debug, Clone)]
pub struct Plain {
    edges: Vec<(u32, u32)>,
    stiffness: Vec<f64>,
    rest: Vec<f64>,
    inverse_mass: Vec<f64>,
    decay: Vec<f64>,
    loads: Vec<(usize, f64, f64)>,
    pulse: Pulse,
    /// Position, in m.
    pub x: Vec<f64>,
    /// Position, in m.
    pub y: Vec<f64>,
    /// Velocity, in m/s.
    pub vx: Vec<f64>,
    /// Velocity, in m/s.
    pub vy: Vec<f64>,
    /// Force of springs and load, in N.
    pub fx: Vec<f64>,
    /// Force of springs and load, in N.
    pub fy: Vec<f64>,
}

impl Plain {
    /// Lists of `eye` under `load`, at rest.
    pub fn new(eye: &Eye, pulse: Pulse, load: &ArcLoad) -> Self {
        let n = eye.nodes.len();
        let free = |i: usize| !eye.nodes[i].fixed();
        Self {
            edges: eye.springs.iter().map(|s| (s.a as u32, s.b as u32)).collect(),
            stiffness: eye.springs.iter().map(|s| s.stiffness).collect(),
            rest: eye.springs.iter().map(|s| s.rest_length).collect(),
            inverse_mass: (0..n)
                .map(|i| if free(i) { 1.0 / eye.nodes[i].mass } else { 0.0 })
                .collect(),
            decay: eye.nodes.iter().map(|node| node.drag / node.mass).collect(),
            loads: load
                .shares
                .iter()
                .map(|&(i, s)| (i, s * load.direction.x, s * load.direction.y))
                .collect(),
            pulse,
            x: eye.nodes.iter().map(|node| node.position.x).collect(),
            y: eye.nodes.iter().map(|node| node.position.y).collect(),
            vx: vec![0.0; n],
            vy: vec![0.0; n],
            fx: vec![0.0; n],
            fy: vec![0.0; n],
        }
    }

    /// Number of springs that one evaluation goes through.
    pub fn springs(&self) -> usize {
        self.edges.len()
    }

    /// Forces at the present positions under a total load of `force` N.
    pub fn evaluate(&mut self, force: f64) {
        self.fx.fill(0.0);
        self.fy.fill(0.0);
        for (e, &(a, b)) in self.edges.iter().enumerate() {
            let (a, b) = (a as usize, b as usize);
            let (dx, dy) = (self.x[b] - self.x[a], self.y[b] - self.y[a]);
            let length = (dx * dx + dy * dy).sqrt();
            let g = self.stiffness[e] * (1.0 - self.rest[e] / length);
            self.fx[a] += g * dx;
            self.fy[a] += g * dy;
            self.fx[b] -= g * dx;
            self.fy[b] -= g * dy;
        }
        for &(i, px, py) in &self.loads {
            self.fx[i] += px * force;
            self.fy[i] += py * force;
        }
    }

    fn kick(&mut self, h: f64) {
        for i in 0..self.x.len() {
            self.vx[i] += h * self.fx[i] * self.inverse_mass[i];
            self.vy[i] += h * self.fy[i] * self.inverse_mass[i];
        }
    }

    /// Velocity Verlet over `window` seconds in steps of at most `step` seconds, ending a segment
    /// at every break of the load; `watch` is called after each step. Returns the evaluations made.
    pub fn run(&mut self, window: f64, step: f64, mut watch: impl FnMut(&Self, f64)) -> usize {
        let mut evaluations = 0;
        for segment in self.pulse.segments(window) {
            let n = ((segment.end - segment.start) / step).ceil().max(1.0);
            let h = (segment.end - segment.start) / n;
            let tables: Vec<(f64, f64)> = self
                .decay
                .iter()
                .map(|&g| {
                    let reach = if g == 0.0 { h } else { -libm::expm1(-g * h) / g };
                    (reach, libm::exp(-g * h))
                })
                .collect();
            self.evaluate(self.pulse.force(segment.piece, segment.start));
            evaluations += 1;
            for i in 1..=n as usize {
                self.kick(0.5 * h);
                for (j, (reach, keep)) in tables.iter().enumerate() {
                    self.x[j] += reach * self.vx[j];
                    self.y[j] += reach * self.vy[j];
                    self.vx[j] *= keep;
                    self.vy[j] *= keep;
                }
                let time = segment.start + h * i as f64;
                self.evaluate(self.pulse.force(segment.piece, time));
                evaluations += 1;
                self.kick(0.5 * h);
                watch(self, time);
            }
        }
        evaluations
    }
}
