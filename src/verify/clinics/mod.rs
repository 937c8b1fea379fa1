//! The fit of the points of 50 % to what clinics and laboratories counted.

pub mod felt;
pub mod fit;
pub mod posterior;
