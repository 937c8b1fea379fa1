//! What is built from many runs.

pub mod accuracy;
pub mod bands;
pub mod comparison;
pub mod ensemble;
pub mod falling;
pub mod map;
mod root;
pub mod statistics;
pub mod sweep;
pub mod threshold;
