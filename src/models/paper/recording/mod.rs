//! What a run leaves behind: extremes over every step, traces, frames.
//!
//! A replay, a chart or an export reads a [`Recording`]; none of them simulates.

mod dense;
mod frames;
mod lengths;
pub(super) mod recorder;
mod settling;

use crate::run::kept::{Frame, Peak, Traces};
use crate::run::{fold::Fold, plan::Cost};

/// Largest values over every step.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct PaperExtremes {
    /// |sum w m a| over the hats of the monitored nodes, in N; at level 1 |m a| of the node.
    pub force: [Peak; 4],
    /// Corneal apex displacement, in m.
    pub apex: Peak,
    /// Growth of the closed shell's length, as a share of its length.
    pub shell_growth: Peak,
    /// Growth of the vertical diameter, as a share of it.
    pub meridian_growth: Peak,
    /// Work done by the load, in J.
    pub work: f64,
    /// Energy stored in all springs, in J, at step ends.
    pub elastic: Peak,
    /// Largest strain of a spring, |l/l0 - 1|.
    pub strain: Peak,
    /// Smallest ratio of a quad's signed area to its area at rest.
    pub least_quad_ratio: f64,
    /// How the mesh folded: quads whose signed area reached zero.
    pub fold: Option<Fold>,
    /// Largest |work in - kinetic - elastic - dissipated| as a share of the work in.
    pub energy_residual: f64,
    /// Whether a growth was largest at the very end of the window.
    pub still_rising: bool,
    /// Whether the energy left at the end of the window could still raise a force or the growth of
    /// the shell; if not, those are proven final.
    pub could_rise: bool,
    /// Whether a load was so small that all it does is rounding, and was taken as nothing.
    pub lost_in_rounding: bool,
}

/// Everything kept of one run.
#[derive(Debug, Clone, PartialEq)]
pub struct Recording {
    /// Largest values over every step.
    pub extremes: PaperExtremes,
    /// Values at step ends, if they were asked for.
    pub traces: Option<Traces>,
    /// Frames, if they were asked for.
    pub frames: Vec<Frame>,
    /// Steps and force evaluations.
    pub cost: Cost,
    /// Time simulated, in s: less than the window if all readings were final before.
    pub simulated: f64,
}
