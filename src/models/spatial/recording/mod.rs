//! What is read off the moving eye.

pub(crate) mod record;
pub(crate) mod results;
pub(crate) mod section;
pub(crate) mod sensor;
pub(crate) mod shape;
pub(crate) mod tissue;
