//! The fit of the points of 50 % to what clinics and laboratories counted.

mod count;
mod curvature;
pub mod felt;
pub mod fit;
pub mod posterior;
mod shares;
