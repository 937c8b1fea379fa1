//! What the models compute, beside closed forms, references, conservation laws and experiments.

mod axisymmetric;
mod axisymmetric_validation;
#[cfg(feature = "app")]
mod claims;
#[cfg(feature = "app")]
mod ensemble_and_sweep;
#[cfg(feature = "app")]
mod experiments;
#[cfg(feature = "app")]
mod hard_cases;
mod injuries;
#[cfg(feature = "app")]
mod measured_pulses;
mod meshes;
mod objects;
mod outside_solver;
mod reference;
mod spatial;
#[cfg(feature = "app")]
mod speed_against_error;
mod springs;
mod stability_limits;
mod tissue_fit;

#[cfg(feature = "app")]
#[path = "../support/program.rs"]
mod program;
