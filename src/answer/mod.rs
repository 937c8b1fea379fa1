//! One blow answered: its results with their errors, and what limits them.

pub mod brief;
pub mod choose;
pub mod compiled;
pub mod directions;
pub mod mesh_error;
pub mod solve;
pub mod uncertain;
pub mod validity;

/// What answers, like everything above, are told in.
pub use crate::run::results;
