//! What is read off the moving eye.

pub mod frames;
pub mod record;
pub mod results;
pub mod sensor;
pub(crate) mod tissue;
