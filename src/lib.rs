//! A blow to a human eye, simulated.
//!
//! [`scenario`] holds what a person asks for; [`cli`] is the command line.

pub mod cli;
pub mod scenario;
