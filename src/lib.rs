//! A blow to a human eye, simulated.
//!
//! [`scenario`] holds what a person asks for.

pub mod scenario;
