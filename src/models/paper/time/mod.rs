//! Through the window: the integrators, their steps and the largest of them.

pub mod composition;
pub mod march;
pub mod method;
pub mod runge_kutta;
pub mod stepper;
