//! Through the window: a leapfrog whose step follows the stability bounds.

pub mod run;
pub mod until;
