//! Runs: one case with its errors, and what is built from many.

pub mod accuracy;
pub mod bands;
pub mod batch;
pub mod calibrate;
mod case;
pub mod choose;
pub mod coverage;
pub mod ensemble;
pub mod experiments;
mod flags;
mod frames;
pub mod hard_cases;
pub mod map;
pub mod mesh_coverage;
mod mesh_error;
pub mod ordered;
pub mod point;
pub mod quantity;
mod results;
mod rules;
mod solve;
pub mod spreads;
pub mod statistics;
mod step_error;
pub mod sweep;
pub mod validate;

pub use case::{Case, Refusal, Solution, Watch, unwatched};
pub use flags::{Flag, FlagKind};
pub use frames::frames;
pub use mesh_error::{
    FINEST_LEVEL, Limit, Limits, MeshError, MeshQuery, add_mesh_error, witnesses,
};
pub use quantity::Quantity;
pub use results::{PerQuantity, Results};
pub use solve::{Answer, Errors, solve};
pub use statistics::median;
