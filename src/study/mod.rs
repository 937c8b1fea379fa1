//! Runs: one case with its errors, and what is built from many.

pub mod accuracy;
pub mod batch;
mod case;
pub mod choose;
pub mod coverage;
mod flags;
pub mod hard_cases;
mod median;
mod mesh_error;
mod quantity;
mod solve;

pub use case::{Case, Refusal, Solution, Watch, unwatched};
pub use flags::{Flag, FlagKind};
pub use median::median;
pub use mesh_error::{FINEST_LEVEL, MeshError, MeshQuery, add_mesh_error};
pub use quantity::{PerQuantity, Quantity, difference_percent, headline, values};
pub use solve::{Answer, Errors, solve};
