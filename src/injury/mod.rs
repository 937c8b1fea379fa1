//! What the motion means: the paper's index, and published injury curves beside it.
//!
//! The two are never mixed. The index has no source for its weights and is no probability; the
//! curves are probabilities, each with its measure, source, species and data.

mod curve;
mod index;
mod published;
mod risk;
mod verdict;

pub(crate) use curve::ASSUMED_SLOPE;
pub use curve::{Curve, Eyes, Form, Injury, Measure, Range, Slope, Standing};
pub use index::{DamageIndex, ENERGY, MERIDIAN, SHELL, Term};
pub use published::CURVES;
pub use risk::{Blow, Caution, Computed, MARKS, Measures, Risk};
pub(crate) use risk::{assess, curve_of};
pub use verdict::{AT_LEAST, Part, Validity, Verdict, gravity, lines, span};
pub(crate) use verdict::{verdict, verdicts};
