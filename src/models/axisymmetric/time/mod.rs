//! Through the window: a leapfrog whose step follows the stability bounds.

pub(crate) mod due;
pub mod march;
pub mod run;
pub mod until;
