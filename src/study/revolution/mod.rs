//! Scenarios with the axisymmetric model: `case` compiles and moves one, `flags` says what limits its results,
//! `mesh_error` how far its mesh may be off. Its step error is told as any, by its row of [`super::rules`].

mod case;
pub(super) mod flags;
pub(super) mod mesh_error;

pub use case::RevolutionCase;

#[cfg(test)]
mod tests;
