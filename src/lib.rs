//! What a blow does to a human eye, and how far to trust the answer.
//!
//! ```
//! use contrecoup::answer::{mesh_error::add_mesh_error, solve::solve};
//! use contrecoup::run::{kept::Keep, quantity::Quantity, watch::unwatched};
//! use contrecoup::{Error, scenario::Scenario};
//!
//! fn main() -> Result<(), Error> {
//!     let blow = Scenario::default().check()?; // 300 N for 0.2 ms
//!     let mut answer = solve(&blow, Keep::default(), &mut unwatched)?;
//!     add_mesh_error(&blow, &mut answer, &mut unwatched)?; // solves two finer meshes
//!     let damage = answer.results()[Quantity::Damage]; // None where a scene has no such result
//!     let step = answer.errors.time_step[Quantity::Damage];
//!     let mesh = answer.errors.mesh.and_then(|errors| errors[Quantity::Damage]);
//!     println!("damage {damage:?} %, error of the step {step:?} %, of the mesh {mesh:?} %");
//!     assert!(damage > Some(26.0) && mesh > step && step > Some(0.0));
//!     Ok(())
//! }
//! ```
//!
//! A [`Scenario`](scenario::Scenario) has a default for every field, and units in their names; it
//! is also read [from a file](scenario::load) or from the [presets](scenario::library).
//! [`check`](scenario::Scenario::check) refuses what is out of range and gives the only type that
//! can be [solved](answer::solve::solve). The [`Answer`](answer::solve::Answer) holds each result
//! by its [`Quantity`](run::quantity::Quantity), its errors in % of it, and
//! [flags](run::flags::Flag) for what limits it. Many runs: [`many::sweep`], [`many::ensemble`],
//! [`many::comparison`]; see the folder `examples`. Without default features the library has none
//! of the command line's and the terminal's dependencies.
//!
//! The rooms, from the lowest; a lower one never imports a higher one:
//!
//! - [`scenario`]: what a person asks for, in their units, read, checked and changed;
//! - [`run`]: the socket: readings, traces, frames and flags of a run, whichever model gave them;
//! - [`models`]: one folder a model. A model turns a scenario into a mesh and moves it;
//! - [`injury`]: the paper's damage index and published injury curves, from readings;
//! - [`answer`]: one blow with the errors of step and mesh, and the risks that follow;
//! - [`many`]: sweeps, ensembles, maps, thresholds and comparisons, built of many runs;
//! - [`verify`]: stated errors against references, and the models against experiments;
//! - reports, the command line and the terminal app, which are no part of the library.
//!
//! A new model fills [`EyeModel`](run::model::EyeModel); a new result is a row of
//! [`Quantity`](run::quantity::Quantity). [`guide`] is what to read besides.
//!
//! Sines, logarithms and the like that lead to a result come from the crate `libm`: each system's C
//! library rounds them in its own way, and a contact carries such a last bit far.
//!
//! Research and education, not diagnosis.

pub mod answer;
#[cfg(feature = "app")]
#[doc(hidden)]
pub mod cli;
mod error;
mod files;
pub mod guide;
pub mod injury;
pub mod many;
pub mod models;
mod normal;
mod plain_text;
#[cfg(feature = "app")]
mod report;
pub mod run;
pub mod scenario;
#[cfg(feature = "app")]
#[doc(hidden)]
pub mod tui;
pub mod verify;
#[cfg(feature = "app")]
mod whole_file;

pub use crate::error::Error;
