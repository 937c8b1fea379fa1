//! The axisymmetric model: explicit and Lagrangian, as hydrocodes are.
//!
//! * `eye`: the mesh of a half section, and what it is made of in SI units.
//! * `forces`: `cell` is the mechanics of one cell, `quads` of many and of the nodes between
//!   them (`rows` lays them out), `plain` the loop that tests them; `shell` is cornea and sclera,
//!   `object` and `contact` what hits them, `face` the bone beside them.
//! * `time`: the leapfrog through the window.
//! * `recording`: `record` and `sensor` read off what `account` and `results` keep.
//! * `case` compiles a scenario and fills the trait [`EyeModel`](crate::run::model::EyeModel), of
//!   which `rules`, `readings`, `flags` and `drawing` are parts.

pub mod case;
#[cfg(test)]
mod case_tests;
mod drawing;
pub mod eye;
pub(crate) mod flags;
pub mod forces;
#[cfg(test)]
pub(crate) mod forces_tests;
pub mod readings;
pub mod recording;
pub(crate) mod rules;
pub mod time;
#[cfg(test)]
mod window_tests;
