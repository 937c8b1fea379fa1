//! The socket: what every model gives and what is asked of it.

pub mod drawing;
pub mod export;
pub mod flags;
pub mod fold;
pub mod kept;
pub mod model;
pub(crate) mod ordered;
pub mod places;
pub mod plan;
pub mod quantity;
pub mod raised;
pub mod readings;
pub mod refusal;
pub mod result_trace;
pub mod results;
pub mod rules;
pub mod sectors;
pub(crate) mod threads;
pub mod trace;
pub mod watch;
