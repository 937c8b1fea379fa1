//! What the motion means: the paper's index, and the risk of each injury beside it.
//!
//! The two are never mixed. The index has no source for its weights and is no probability; a risk
//! is one, of an injury by what its own tissue felt, fitted to what clinics counted.

mod blow;
pub mod clinic;
mod energy;
mod index;
mod kind;
mod object_kind;
mod outcomes;
pub mod points;
mod risk;
mod tissue;
pub mod way_in;
mod words;

pub use crate::injury::blow::{Blow, Population};
pub use crate::injury::energy::{CURVES, EnergyCurve};
pub use crate::injury::index::{DamageIndex, ENERGY, MERIDIAN, SHELL, Term};
pub use crate::injury::kind::{Injury, PerInjury};
pub use crate::injury::object_kind::{Features, KINDS, ObjectKind, apart_squared, features};
pub use crate::injury::outcomes::{Outcome, counted, outcomes};
pub use crate::injury::risk::{Felt, Risk, Share, assess, hit, told, worse};
pub use crate::injury::tissue::TissueCurve;
pub use crate::injury::words::{BURST, SIGNS, UNSAID, gravity, span, whole};
