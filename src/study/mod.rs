//! Runs: one case with its errors, and what is built from many.

pub mod accuracy;
pub mod bands;
pub mod batch;
mod case;
pub mod choose;
pub mod coverage;
pub mod ensemble;
mod flags;
pub mod hard_cases;
pub mod map;
mod mesh_error;
pub mod normal;
pub mod ordered;
pub mod outputs;
pub mod point;
mod quantity;
mod solve;
pub mod spreads;
pub mod statistics;
pub mod sweep;

pub use case::{Case, Refusal, Solution, Watch, unwatched};
pub use flags::{Flag, FlagKind};
pub use mesh_error::{FINEST_LEVEL, MeshError, MeshQuery, add_mesh_error};
pub use quantity::{PerQuantity, Quantity, difference_percent, headline, values};
pub use solve::{Answer, Errors, solve};
