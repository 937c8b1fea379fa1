//! Frames: where every node is, and the force on it, at even intervals, for replay and export.
//!
//! A frame falls between two step ends; positions come from dense output and forces from one
//! evaluation at them, so a frame is as accurate as the steps and a replay never simulates.

use super::coupled;
use super::dense::Path;
use crate::dynamics::{Piece, State, System};
use crate::eye::Eye;
use nalgebra::Point2;

/// All nodes at one instant.
#[derive(Debug, Clone, PartialEq)]
pub struct Frame {
    /// Time, in s.
    pub time: f64,
    /// Position of each node of the eye, in m.
    pub positions: Vec<Point2<f64>>,
    /// |m a| of each node of the eye, in N; 0 for the orbit.
    pub forces: Vec<f64>,
    /// Centre of the projectile, in m, where the scene has one.
    pub projectile: Option<Point2<f64>>,
    /// Intraocular pressure, in Pa, where the scene has a fluid.
    pub pressure: Option<f64>,
}

/// Collects frames during a march.
#[derive(Debug, Clone)]
pub struct FrameTaker {
    every: f64,
    nodes: usize,
    masses: Vec<f64>,
    probe: State,
    /// What has been taken.
    pub frames: Vec<Frame>,
}

impl FrameTaker {
    /// A frame every `every` seconds of the motion of `eye`.
    pub fn new(every: f64, eye: &Eye, system: &System) -> Self {
        Self {
            every,
            nodes: eye.nodes.len(),
            masses: eye
                .nodes
                .iter()
                .map(|n| if n.fixed() { 0.0 } else { n.mass })
                .collect(),
            probe: State::at_rest(system),
            frames: Vec::new(),
        }
    }

    fn due(&self) -> f64 {
        self.every * self.frames.len() as f64
    }

    /// Takes the frame at the very start.
    pub fn begin(&mut self, system: &System, state: &State) {
        if self.frames.is_empty() {
            self.keep(system, state);
        }
    }

    /// Takes the frames that fall in the step from `before` to `after`.
    pub fn step(&mut self, system: &System, (before, after): (&State, &State), piece: Piece) {
        let h = after.time - before.time;
        // The frame at the end of the window must not be lost to rounding.
        while self.due() <= after.time + 1e-9 * self.every {
            let share = ((self.due() - before.time) / h).min(1.0);
            let mut probe = std::mem::replace(&mut self.probe, State::empty());
            probe.time = before.time + share * h;
            for node in 0..self.nodes {
                let place = system.place(node);
                if !place.mirrored {
                    let path = Path::between(system, before, after, node);
                    probe.set(place, path.position(share), path.velocity(share));
                }
            }
            probe.readings = after.readings;
            probe.readings.body.position = coupled::centre(before, after, share);
            probe.evaluate(system, piece);
            self.keep(system, &probe);
            self.probe = probe;
        }
    }

    fn keep(&mut self, system: &System, state: &State) {
        self.frames.push(Frame {
            time: self.due(),
            positions: (0..self.nodes)
                .map(|n| state.position(system.place(n)))
                .collect(),
            forces: (0..self.nodes)
                .map(|n| self.masses[n] * state.acceleration(system, system.place(n)).norm())
                .collect(),
            projectile: system
                .coupled()
                .filter(|c| c.contact.is_some())
                .map(|_| state.readings.body.position),
            pressure: system
                .coupled()
                .filter(|c| c.fluid.is_some())
                .map(|_| state.readings.pressure),
        });
    }
}
