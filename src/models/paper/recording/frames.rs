//! Frames: where every node is, and the force on it, at chosen instants, for replay and export.
//!
//! A frame falls between two step ends; positions come from dense output and forces from one
//! evaluation at them, so a frame is as accurate as the steps and a replay never simulates.

use crate::models::paper::recording::dense::Interval;
use crate::models::paper::{eye::Eye, forces::state::State, forces::system::System};
use crate::models::pulse::Piece;
use crate::run::kept::{Frame, Spacing};

/// Collects frames during a run.
#[derive(Debug, Clone)]
pub(crate) struct FrameTaker {
    spacing: Spacing,
    masses: Vec<f64>,
    probe: State,
    taken: usize,
    /// What has been taken, and not been taken away.
    pub frames: Vec<Frame>,
}

impl FrameTaker {
    /// Frames of the motion of `eye`.
    pub fn new(spacing: Spacing, eye: &Eye, system: &System) -> Self {
        Self {
            spacing,
            masses: eye.nodes.iter().map(|n| if n.fixed() { 0.0 } else { n.mass }).collect(),
            probe: State::at_rest(system),
            taken: 0,
            frames: Vec::new(),
        }
    }

    /// Takes the frame at the very start.
    pub fn begin(&mut self, system: &System, state: &State) {
        if self.taken == 0 {
            self.probe.copy_motion(system, state);
            self.keep(system, 0.0);
        }
    }

    /// Takes the frames that fall in a step by the load law `piece`.
    pub fn step(&mut self, step: Interval, piece: Piece) {
        let system = step.system;
        loop {
            let due = self.spacing.due(self.taken);
            // The frame at the end of the window must not be lost to rounding.
            if due > step.after.time + 1e-9 * self.spacing.every {
                break;
            }
            let share = ((due - step.before.time) / step.length()).min(1.0);
            self.probe.time = step.time(share);
            for node in 0..self.masses.len() {
                let place = system.place(node);
                if !place.mirrored {
                    let path = step.path(&[(node, 1.0)]);
                    self.probe.set(place, path.position(share).into(), path.velocity(share));
                }
            }
            self.probe.evaluate(system, piece);
            self.keep(system, due);
        }
    }

    /// Keeps what the probe shows.
    fn keep(&mut self, system: &System, time: f64) {
        let (probe, nodes) = (&self.probe, 0..self.masses.len());
        let force = |n| self.masses[n] * probe.acceleration(system, system.place(n)).norm();
        self.frames.push(Frame {
            time,
            positions: nodes.clone().map(|n| probe.position(system.place(n))).collect(),
            forces: nodes.map(force).collect(),
            ..Frame::default()
        });
        self.taken += 1;
    }
}
