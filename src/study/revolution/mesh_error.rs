//! The mesh error of the eye of revolution.
//!
//! It is that of grid convergence of the first order from the next finer mesh: with M = 2k + 2 cells across
//! at level k, C/M - C/M' of the next is (M' - M)/M' of C/M. It is a bound with room rather than a
//! correction, so no limit is told. The finest level has the one below it for a neighbour.

use crate::eye::revolution::RevolutionEye;
use crate::study::flags::{Flag, FlagKind};
use crate::study::mesh_error::{Limits, MeshError, OnMesh};

/// The level whose results tell the error of `level`.
pub(in crate::study) fn neighbour(level: u32) -> u32 {
    if level >= RevolutionEye::FINEST {
        level - 1
    } else {
        level + 1
    }
}

/// The error of `own`, on the mesh of `level`, by the results of its [`neighbour`].
pub(in crate::study) fn of(own: &OnMesh, level: u32, other: &OnMesh) -> MeshError {
    let neighbour = neighbour(level);
    let factor = f64::from(neighbour + 1);
    let difference = other.results.difference_percent(&own.results);
    let folded = other.folded.filter(|_| own.folded.is_none());
    MeshError {
        errors: difference.map(|_, d| d.map(|d| factor * d)),
        limits: Limits::from_fn(|_| None),
        flag: folded.map(|time| Flag {
            kind: FlagKind::FinerMeshFolds,
            message: format!(
                "the mesh of level {neighbour} folds at {:.3} ms",
                time * 1e3
            ),
            time: Some(time),
        }),
    }
}
