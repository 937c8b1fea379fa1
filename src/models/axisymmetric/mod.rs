//! Motion of the axisymmetric eye: explicit, Lagrangian, as hydrocodes are.
//!
//! `cell` is the mechanics of one cell, `quads` the same of many (`rows` lays them out, `nodes` moves what is between
//! them), `plain` the loop that tests them; `shell` is cornea and sclera, `object` and `contact` what hits them, `face` the
//! bone beside them; `run` is the leapfrog through the window, `record`, `frames` and `sensor` read off what `results` keeps.

pub mod case;
mod drawing;
pub mod eye;
mod flags;
pub mod forces;
mod model;
pub mod readings;
pub mod recording;
pub(crate) mod rules;
pub mod time;

pub use crate::models::axisymmetric::forces::object::{BallSpring, HARD, Object, ObjectOutline, ObjectSurface};
pub use crate::models::axisymmetric::recording::results::{Energy, EngineRun, Extremes};
pub use crate::models::axisymmetric::recording::sensor::monitored;
pub use crate::models::axisymmetric::time::run::{
    AxisymmetricLoad, CellLoop, STEP_SHARE, Scheme, Steps, Stop, run, run_as, run_through, step_limit,
};
#[cfg(test)]
mod case_tests;
#[cfg(test)]
mod tests;
