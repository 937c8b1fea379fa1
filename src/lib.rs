//! What a blow does to a human eye, and how far to trust the answer.
//!
//! ```
//! use contrecoup::answer::{mesh_error::add_mesh_error, quantity::Quantity, solve::solve};
//! use contrecoup::run::watch::unwatched;
//! use contrecoup::{Error, run::kept::Keep, scenario::Scenario};
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
//! by its [`Quantity`](answer::quantity::Quantity), its errors in % of it, and
//! [flags](run::flags::Flag) for what limits it. Many runs: [`many::sweep`], [`many::ensemble`],
//! [`many::comparison`]; the folder `examples` has a blow, a parallel sweep and a force curve of
//! one's own. Without default features the library has none of the command line's and the
//! terminal's dependencies.
//!
//! Data flows one way. [`scenario`] is what a person asks for, in their units; [`models`] turn it
//! into a mesh and move that; [`run`] holds what a run gives, whichever model it is of; [`answer`]
//! is one blow with its errors, and [`injury`] reads injuries off it; [`many`] is built of many
//! runs, and [`verify`] checks all that against references and experiments. Above them stand the
//! reports, the command line and the terminal app, which are no part of the library. A lower room
//! never imports a higher one. [`guide`] is what to read besides.
//!
//! Sines, logarithms and the like that lead to a result come from the crate `libm`: the C library
//! of each system rounds them in its own way, and the contact of an object carries such a last bit
//! far.
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
