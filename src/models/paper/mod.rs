//! Motion: m a = springs + drag + load, solved by one of several integrators.
//!
//! `system` compiles an eye and a load into rows and `kernel` computes forces. `march` goes through the
//! window in the steps that a `stepper` makes: a `composition` of kicks and drifts, a `runge_kutta`
//! method, or the substepped `verlet`. `method` has a row for each integrator, and `stability` bounds
//! the step. `plain` is the same physics as a simple loop over an edge list: the tested reference of
//! the kernel and the baseline of the benchmarks.
//!
//! A scene with a projectile has it in `coupled` (`contact`) and is moved by `verlet`; any other does none
//! of its work. `scene` tells which it is. [`crate::models::axisymmetric`] is the other eye, made of cells.
//!
//! Where further things plug in, and what the compiler then asks for:
//!
//! * An integrator is a name in [`Integrator`] and a row in `method`.
//! * A kind of impact is a variant of [`crate::scenario::Impact`]. [`SceneKind::of`] says what it
//!   needs, `case::Case::with` what is compiled of it. A force that is known beforehand is a [`Pulse`]
//!   on an [`ArcLoad`]; a body that the eye pushes back is a part of [`Coupled`], which takes its force,
//!   its energy and its share of the stability bound, and keeps its state in [`Readings`].
//! * An eye of nodes and springs on the grid needs nothing here: it is another [`crate::models::paper::eye::Eye`]. One
//!   of other elements, such as [`crate::models::axisymmetric`], brings its own rows, forces and march, because those of
//!   here are made for springs. What it keeps is that of [`Traces`] and [`Frame`]. It joins at
//!   `models::compiled`, a variant more, and brings its row of `run::rules`: its integrators, and how its
//!   error is told.
//!
//! The orbit is rigid and never integrated. Left out, as in the paper: rupture.

pub mod case;
pub mod eye;
pub mod flags;
pub mod forces;
pub mod frames;
pub mod recording;
pub mod time;
