//! The eye in three dimensions, for blows that are not straight on and orbits that are not round.
//!
//! * `eye`: the mesh of a ball, whole or half, the orbit around it, and what it is made of.
//! * `forces`: `math` lets each law be written once, for one number or a vector of them; `cell` and
//!   `corner` are the mechanics of one cell, `rows` runs them over many, `plain` one by one;
//!   `shell` and `hinge` are cornea and sclera, `object` and `contact` what hits them, `rim` the
//!   bone that stops the object and the globe.
//! * `time`: the leapfrog through the window.
//! * `recording`: `record`, `shape`, `tissue` and `sensor` read off what `results` keeps.
//! * `case` is an eye ready to be hit, which fills the trait
//!   [`EyeModel`](crate::run::model::EyeModel); `rules`, `readings` and `drawing` are its
//!   parts.
//!
//! Tissues, the surfaces of objects and the measures of injury are those of
//! [`axisymmetric`](crate::models::axisymmetric): straight on and on a round support both models
//! are the same eye.

pub mod case;
mod drawing;
pub mod eye;
pub(crate) mod forces;
#[cfg(test)]
mod forces_tests;
mod readings;
pub mod recording;
pub(crate) mod rules;
#[cfg(test)]
mod run_tests;
pub mod time;
