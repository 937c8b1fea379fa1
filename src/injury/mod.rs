//! What the motion means: the paper's index, and published injury curves beside it.
//!
//! The two are never mixed. The index has no source for its weights and is no probability; the
//! curves are probabilities, each with its measure, source, species and data.

mod curve;
mod index;
mod published;
mod risk;
mod verdict;

pub(crate) use crate::injury::curve::ASSUMED_SLOPE;
pub use crate::injury::curve::{
    CurveForm, Eyes, Injury, InjuryCurve, Measure, Range, Slope, Standing,
};
pub use crate::injury::index::{DamageIndex, ENERGY, MERIDIAN, SHELL, Term};
pub use crate::injury::published::CURVES;
pub use crate::injury::risk::{Caution, Computed, FlyingObject, MARKS, Measures, Risk};
pub(crate) use crate::injury::risk::{assess, curve_of};
pub use crate::injury::verdict::{AT_LEAST, Part, Validity, Verdict, gravity, lines, span};
pub(crate) use crate::injury::verdict::{verdict, verdicts};
