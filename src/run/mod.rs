//! The socket: what every model gives and what is asked of it.

pub mod drawing;
pub mod export;
pub mod flags;
pub mod fold;
pub mod kept;
pub mod raised;
pub mod rules;
