//! How a run is stepped, and what it cost.

use crate::scenario::Integrator;

/// The integrator and the steps of a run.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Plan {
    /// The method.
    pub integrator: Integrator,
    /// Longest step, in s.
    pub step: f64,
    /// Simulated time, in s.
    pub window: f64,
    /// Multiplies the number of steps of every segment, 1 or more.
    pub multiple: f64,
    /// Local error allowed a step in the energy norm, for integrators that choose their steps.
    pub local_tolerance: f64,
}

/// The local tolerance unless another is asked for.
pub const LOCAL_TOLERANCE: f64 = 1e-5;

/// What a run cost.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Cost {
    /// Steps taken.
    pub steps: usize,
    /// Force evaluations.
    pub evaluations: usize,
}
