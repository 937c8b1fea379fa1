//! The Paper model: a section of point masses and springs, m a = springs + drag + load.
//!
//! * `eye`: the mesh, its springs and its landmarks, and a bound of its frequencies.
//! * `forces`: the eye compiled into rows (`layout`, `system`, `ring`), and the kernel that
//!   computes many springs at once. `plain` is the same physics as a loop over an edge list: the
//!   tested reference of the kernel and the baseline of the benchmarks.
//! * `time`: `march` goes through the window in the steps that a `stepper` makes, a `composition`
//!   of kicks and drifts or a `runge_kutta` method; `method` has a row for each integrator.
//! * `recording`: what is kept of a run.
//! * `case` compiles a scenario, `model` is the trait [`EyeModel`](crate::run::model::EyeModel);
//!   `rules`, `readings`, `flags` and `drawing` are its parts.
//!
//! The bony orbit is rigid and never moves. Left out, as in the paper: rupture.

pub mod case;
mod drawing;
pub mod eye;
mod flags;
pub mod forces;
mod model;
mod readings;
pub mod recording;
pub(crate) mod rules;
pub mod time;
