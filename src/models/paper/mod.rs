//! Motion: m a = springs + drag + load, solved by one of several integrators.
//!
//! `system` compiles an eye and a load into rows and `kernel` computes forces. `march` goes through the
//! window in the steps that a `stepper` makes: a `composition` of kicks and drifts, a `runge_kutta`
//! method. `method` has a row for each integrator, and `stability` bounds the step. `plain` is the same physics as a simple loop over an edge list: the tested reference of
//! the kernel and the baseline of the benchmarks.
//!
//! Where further things plug in, and what the compiler then asks for:
//!
//! * An integrator is a name in [`Integrator`] and a row in `method`.
//! * A force that is known beforehand is a [`Pulse`] on an [`ArcLoad`]. There are no objects here: a
//!   ball in a section is a rod, so `scenario` refuses them and the axisymmetric model takes them.
//! * An eye of nodes and springs on the grid needs nothing here: it is another [`crate::models::paper::eye::Eye`]. One
//!   of other elements, such as [`revolution`], brings its own rows, forces and march, because those of
//!   here are made for springs. What it keeps is that of [`Traces`] and [`Frame`]. It joins at
//!   `study::Compiled`, a variant more, and brings its row of `study::rules`: its integrators, and how its
//!   error is told.
//!
//! The orbit is rigid and never integrated. Left out, as in the paper: rupture.

pub mod case;
mod drawing;
pub mod eye;
mod flags;
pub mod forces;
mod frames;
mod readings;
pub mod recording;
pub(crate) mod rules;
pub mod time;
