//! The same physics as a plain loop over an edge list: velocity Verlet with exact drag.
//!
//! This is how most people would write it first. It is kept as the reference that the row kernel
//! is tested against and as the baseline that the benchmarks compare with.

use crate::models::paper::{eye::Eye, eye::springs::Spring, forces::load::ArcLoad};
use crate::models::pulse::Pulse;
use nalgebra::{Point2, Vector2};

/// An eye and its load as lists of edges and nodes.
#[derive(Debug, Clone)]
pub struct Plain {
    edges: Vec<Spring>,
    inverse_mass: Vec<f64>,
    decay: Vec<f64>,
    loads: Vec<(usize, Vector2<f64>)>,
    pulse: Pulse,
    /// Position of each node, in m.
    pub position: Vec<Point2<f64>>,
    /// Velocity, in m/s.
    pub velocity: Vec<Vector2<f64>>,
    /// Force of springs and load, in N.
    pub force: Vec<Vector2<f64>>,
}

impl Plain {
    /// Lists of `eye` under `load`, at rest.
    pub fn new(eye: &Eye, pulse: Pulse, load: &ArcLoad) -> Self {
        let nodes = || eye.nodes.iter();
        Self {
            edges: eye.springs.clone(),
            inverse_mass: nodes().map(|n| if n.fixed() { 0.0 } else { 1.0 / n.mass }).collect(),
            decay: nodes().map(|n| n.drag / n.mass).collect(),
            loads: load.shares.iter().map(|&(i, share)| (i, load.direction * share)).collect(),
            pulse,
            position: nodes().map(|n| n.position).collect(),
            velocity: vec![Vector2::zeros(); eye.nodes.len()],
            force: vec![Vector2::zeros(); eye.nodes.len()],
        }
    }

    /// Forces at the present positions under a total load of `force` N.
    fn evaluate(&mut self, force: f64) {
        self.force.fill(Vector2::zeros());
        for edge in &self.edges {
            let d = self.position[edge.b] - self.position[edge.a];
            let pull = d * (edge.stiffness * (1.0 - edge.rest_length / d.norm()));
            self.force[edge.a] += pull;
            self.force[edge.b] -= pull;
        }
        for (i, share) in &self.loads {
            self.force[*i] += share * force;
        }
    }

    fn kick(&mut self, h: f64) {
        for (i, velocity) in self.velocity.iter_mut().enumerate() {
            *velocity += self.force[i] * h * self.inverse_mass[i];
        }
    }

    /// Velocity Verlet over `window` seconds in steps of at most `step` seconds, ending a segment
    /// at every break of the load; `watch` is called after each step. Returns the evaluations made.
    pub fn run(&mut self, window: f64, step: f64, mut watch: impl FnMut(&Self, f64)) -> usize {
        let mut evaluations = 0;
        for segment in self.pulse.segments(window) {
            let n = ((segment.end - segment.start) / step).ceil().max(1.0);
            let h = (segment.end - segment.start) / n;
            let reach = |g: f64| if g == 0.0 { h } else { -libm::expm1(-g * h) / g };
            let drifts = self.decay.iter().map(|&g| (reach(g), libm::exp(-g * h)));
            let drifts: Vec<(f64, f64)> = drifts.collect();
            self.evaluate(self.pulse.force(segment.piece, segment.start));
            evaluations += 1;
            for i in 1..=n as usize {
                self.kick(0.5 * h);
                for (j, (reach, keep)) in drifts.iter().enumerate() {
                    self.position[j] += self.velocity[j] * *reach;
                    self.velocity[j] *= *keep;
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
