//! Frames: where every node is, and the force on it, at chosen instants, for replay and export.
//!
//! A frame falls between two step ends; positions come from dense output and forces from one
//! evaluation at them, so a frame is as accurate as the steps and a replay never simulates.

use crate::models::paper::recording::dense::Path;
use crate::models::paper::{eye::Eye, forces::state::State, forces::system::System};
use crate::models::pulse::Piece;
use crate::run::kept::{Frame, Spacing};

/// Collects frames during a run.
#[derive(Debug, Clone)]
pub struct FrameTaker {
    spacing: Spacing,
    nodes: usize,
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
            nodes: eye.nodes.len(),
            masses: eye.nodes.iter().map(|n| if n.fixed() { 0.0 } else { n.mass }).collect(),
            probe: State::at_rest(system),
            taken: 0,
            frames: Vec::new(),
        }
    }

    fn due(&self) -> f64 {
        self.spacing.due(self.taken)
    }

    /// Takes the frame at the very start.
    pub fn begin(&mut self, system: &System, state: &State) {
        if self.taken == 0 {
            self.keep(system, state);
        }
    }

    /// Takes the frames that fall in the step from `before` to `after`.
    pub fn step(&mut self, system: &System, (before, after): (&State, &State), piece: Piece) {
        let h = after.time - before.time;
        // The frame at the end of the window must not be lost to rounding.
        while self.due() <= after.time + 1e-9 * self.spacing.every {
            let share = ((self.due() - before.time) / h).min(1.0);
            let mut probe = std::mem::take(&mut self.probe);
            probe.time = before.time + share * h;
            for node in 0..self.nodes {
                let place = system.place(node);
                if !place.mirrored {
                    let path = Path::between(system, before, after, node);
                    probe.set(place, path.position(share), path.velocity(share));
                }
            }
            probe.evaluate(system, piece);
            self.keep(system, &probe);
            self.probe = probe;
        }
    }

    fn keep(&mut self, system: &System, state: &State) {
        self.frames.push(Frame {
            front: None,
            time: self.due(),
            positions: (0..self.nodes).map(|n| state.position(system.place(n))).collect(),
            forces: (0..self.nodes)
                .map(|n| self.masses[n] * state.acceleration(system, system.place(n)).norm())
                .collect(),
            cells: Vec::new(),
            projectile: None,
            squeezed: 0.0,
            pressure: None,
        });
        self.taken += 1;
    }
}
