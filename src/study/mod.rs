//! Runs: one case with its errors, and what is built from many.

mod case;
mod flags;
mod quantity;
mod solve;

pub use case::{Case, Refusal, Solution, Watch, unwatched};
pub use flags::{Flag, FlagKind};
pub use quantity::{PerQuantity, Quantity, difference_percent, headline, values};
pub use solve::{Answer, Errors, solve};
