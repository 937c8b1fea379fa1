//! Runs: one case with its errors, and what is built from many.

pub mod accuracy;
pub(crate) mod bands;
pub mod batch;
mod believed;
#[doc(hidden)]
pub mod calibrate;
mod case;
pub mod choose;
pub mod comparison;
pub mod compiled;
pub mod course;
#[doc(hidden)]
pub mod coverage;
pub mod drawing;
pub mod ensemble;
#[doc(hidden)]
pub mod experiments;
mod flags;
mod frames;
#[doc(hidden)]
pub mod hard_cases;
mod left;
pub mod map;
pub mod mesh_coverage;
mod mesh_error;
pub(crate) mod ordered;
pub mod point;
pub mod quantity;
mod results;
mod revolution;
mod root;
mod rules;
mod solve;
pub(crate) mod spreads;
mod statistics;
mod step_error;
pub mod sweep;
pub mod threshold;
pub mod tolerance_coverage;
pub mod total;
#[doc(hidden)]
pub mod validate;
mod validity;

pub use bands::{Band, Checks};
pub use believed::Scene;
#[doc(hidden)]
pub use case::Solution;
pub use case::{Case, Refusal, Watch, unwatched};
pub use compiled::{Compiled, Element};
pub use flags::{Flag, FlagKind};
pub use left::Left;
pub use mesh_error::{
    FINEST_LEVEL, Limit, Limits, MeshError, MeshQuery, add_mesh_error, witnesses,
};
pub use quantity::Quantity;
pub use results::{PerQuantity, Results};
pub use revolution::RevolutionCase;
pub use solve::{Answer, Cut, Errors, solve};
#[doc(hidden)]
/// What an ensemble of a scenario draws: for who makes one up, as tests of pictures do.
#[doc(hidden)]
pub use spreads::inputs;
pub use spreads::{Input, Shape};
pub use statistics::median;
pub use validity::Spoiled;
