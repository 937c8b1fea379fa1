//! How a result is followed over time: a part of its row in the table of results.

use crate::run::kept::Traces;
use strum::VariantArray;

/// Traces that are shown together, in the order of the views of them and of the columns of CSV.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, VariantArray)]
pub enum Group {
    /// What the scenario prescribes.
    Input,
    /// Forces of nodes.
    NodeForces,
    /// What acts on the eye, and how the whole of it moves.
    Motion,
    /// Where the energy is.
    Energies,
    /// Pressures and stresses.
    Inside,
    /// What single tissues feel.
    Tissues,
    /// What the projectile does.
    Projectile,
}

/// How a result is followed over time.
#[derive(Clone, Copy)]
pub struct ResultTrace {
    /// What the trace is called, of which the result is the largest or the last value.
    pub label: &'static str,
    /// Its column in CSV: a contract.
    pub column: &'static str,
    /// The values, SI; empty where the scene has none.
    pub values: fn(&Traces) -> &[f64],
    /// What it is looked at with, and its place there.
    pub place: (Group, u8),
}
