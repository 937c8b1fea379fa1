//! What is read off the moving eye.

pub(crate) mod account;
pub mod record;
pub mod results;
pub mod sensor;
pub(crate) mod tissue;
