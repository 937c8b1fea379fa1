//! The axisymmetric model: explicit and Lagrangian, as hydrocodes are.
//!
//! * `eye`: the mesh of a half section, and what it is made of in SI units.
//! * `forces`: `cell` is the mechanics of one cell, `quads` the same of many, with the nodes between
//!   them (`rows` lays them out), `plain` the loop that tests them; `shell` is cornea and sclera,
//!   `object` and `contact` what hits them, `face` the bone beside them.
//! * `time`: the leapfrog through the window.
//! * `recording`: `record` and `sensor` read off what `account` and `results` keep.
//! * `case` compiles a scenario and fills the trait [`EyeModel`](crate::run::model::EyeModel), of
//!   which `rules`, `readings`, `flags` and `drawing` are parts.

pub mod case;
mod drawing;
pub mod eye;
pub(crate) mod flags;
pub mod forces;
pub mod readings;
pub mod recording;
pub(crate) mod rules;
pub mod time;

pub use crate::models::axisymmetric::forces::object::{
    BallSpring, HARD, Object, ObjectOutline, ObjectSurface,
};
pub use crate::models::axisymmetric::recording::results::{Energy, EngineRun, Extremes};
pub use crate::models::axisymmetric::recording::sensor::monitored;
pub use crate::models::axisymmetric::time::march::{CellLoop, STEP_SHARE, Scheme, Steps, Stop};
pub use crate::models::axisymmetric::time::run::{
    AxisymmetricLoad, run, run_as, run_through, step_limit,
};
pub use crate::models::axisymmetric::time::until::Until;
#[cfg(test)]
mod case_tests;
#[cfg(test)]
pub(crate) mod forces_tests;
#[cfg(test)]
mod window_tests;
