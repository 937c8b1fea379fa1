//! One blow answered: its results with their errors, and what limits them.

pub mod believed;
pub mod brief;
pub mod choose;
pub mod compiled;
pub mod derived;
pub mod mesh_error;
pub mod results;
pub mod solve;
pub mod step_error;
pub mod validity;
