//! Motion: m a = springs + drag + load, solved by one of several integrators.
//!
//! `system` compiles an eye and a load into rows and `kernel` computes forces. `march` goes through the
//! window in the steps that a `stepper` makes: a `composition` of kicks and drifts, a `runge_kutta`
//! method. `method` has a row for each integrator, and `stability` bounds the step. `plain` is the same physics as a simple loop over an edge list: the tested reference of
//! the kernel and the baseline of the benchmarks.
//!
//! * An eye of nodes and springs on the grid needs nothing here: it is another [`crate::models::paper::eye::Eye`]. One
//!   of other elements, such as [`crate::models::axisymmetric`], brings its own rows, forces and march, because those of
//!   here are made for springs. What it keeps is that of [`Traces`] and [`Frame`]. It joins at
//!   `models::compiled`, a variant more, and brings its row of `run::rules`: its integrators, and how its
//!   error is told.
//!
//! The orbit is rigid and never integrated. Left out, as in the paper: rupture.

pub mod case;
mod drawing;
pub mod eye;
mod flags;
pub mod forces;
mod frames;
mod model;
mod readings;
pub mod recording;
pub(crate) mod rules;
pub mod time;
