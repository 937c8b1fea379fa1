//! The models: each turns a scenario into an eye, moves it and reads it off.

pub mod axisymmetric;
pub mod compiled;
pub mod left;
pub mod paper;
