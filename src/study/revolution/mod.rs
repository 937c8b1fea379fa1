//! Scenarios with the Physiological model: `case` compiles and moves one, `flags` says what limits its results,
//! `random` draws some. Its step error is told as any, by its row of [`super::rules`], and so is its mesh
//! error.

mod case;
pub(super) mod flags;
mod random;

pub use case::RevolutionCase;
pub(super) use random::random_object;

#[cfg(test)]
mod tests;
