//! How the eye in three dimensions is solved and how its errors are told; see
//! [`crate::run::rules`].
//!
//! The leapfrog, its second run and the rules of refinement are those of the axisymmetric eye. What
//! differs is the mesh: level k has 2 k + 2 cells in half a side of its core, fewer than there, so
//! results scatter more from level to level. Against the axisymmetric eye straight on, level 1 is
//! within 3 % in pressure, 7 % in the stretch of the wall at the equator, 10 % at the retina's
//! front edge, 12 % in the stress of the sclera, 20 % in the stretch at the back, and up to 40 %
//! off in what pulls on lens and iris after a BB, once the share that a mesh reads of it is put in:
//! that comes late, in a vitreous that hardly holds it, and is not converged at level 3 either.
//! Their mesh errors say so.

use crate::models::axisymmetric::rules::OF_CELLS;
use crate::run::quantity::Quantity;
use crate::run::rules::{Estimate, MeshRules, MeshScatter, Refinement, Rules};
use crate::scenario::FINEST_SPATIAL_LEVEL;

/// Integrators, error estimates and mesh rules of the model.
pub(crate) static RULES: Rules = Rules {
    // A cell with its share of shell and nodes takes some 150 ns, a spring a little more than one.
    springs_an_element: 120.0,
    // Each step is chosen by the state, so results are not smooth to the last digit.
    estimate: Estimate { floor_percent: 0.1, ..OF_CELLS.estimate },
    // A run takes a second: what a shorter step would better is far below the mesh error.
    refinement: Refinement { error_percent: 3.0, balance_percent: 0.5, attempts: 2 },
    mesh: MeshRules {
        finest: FINEST_SPATIAL_LEVEL,
        finest_in_study: 3,
        witnesses: |level| [level, level + 1],
        fineness: |level| f64::from(level) + 1.0,
        scatter,
    },
    ..OF_CELLS
};

/// Read off nine blows straight on in gelatin at levels 1 and 2 beside the axisymmetric eye, see
/// the guide.
fn scatter(of: Quantity) -> MeshScatter {
    match of {
        // Accelerations over 20 us follow each wave, and each mesh has its own.
        _ if Quantity::FORCES.contains(&of) => MeshScatter::within(0.35, 0.5),
        // The wall's largest stretch wanders between quads.
        Quantity::EquatorStretch => MeshScatter::within(0.07, 0.4),
        Quantity::ScleralStress | Quantity::ShellGrowth | Quantity::MeridianGrowth => {
            MeshScatter::within(0.1, 0.4)
        }
        Quantity::BackStretch => MeshScatter::within(0.15, 0.5),
        Quantity::EdgeGrowth => MeshScatter::within(0.06, 0.4),
        Quantity::CornealEnergy => MeshScatter::within(0.2, 0.5),
        Quantity::LensPull => MeshScatter { least: 0.1, ..MeshScatter::within(0.3, 0.6) },
        Quantity::IrisPull => MeshScatter { least: 0.2, ..MeshScatter::within(0.4, 0.7) },
        Quantity::LensWay => MeshScatter::within(0.4, 0.6),
        _ => MeshScatter::within(0.06, 0.3),
    }
}
