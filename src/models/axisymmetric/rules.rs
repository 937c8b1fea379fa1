//! How the axisymmetric eye is solved and how its errors are told; see [`crate::run::rules`].
//!
//! Its leapfrog is velocity Verlet with forces of viscosity that lag half a step, and its step
//! follows the stability bound, so the step of a plan is that of the eye at rest. Semi-implicit
//! Euler is there to be compared with.

use crate::models::axisymmetric::time::march::STEP_SHARE;
use crate::run::flags::FlagKind;
use crate::run::quantity::{Family, Quantity};
use crate::run::rules::{Automatic, Element, Estimate, MeshRules, MeshScatter, Refinement, Rules};
use crate::scenario::{FINEST_PHYSIOLOGICAL_LEVEL, Integrator};

/// Integrators, error estimates and mesh rules of the axisymmetric model.
pub(crate) static RULES: Rules = OF_CELLS;

/// The same, of which other eyes of cells take over what they share.
pub(crate) const OF_CELLS: Rules = Rules {
    name: "Physiological",
    element: Element::Cell,
    // A cell with its share of shell and nodes takes some 40 ns, a spring a little more than one.
    springs_an_element: 30.0,
    integrators: &[Integrator::VelocityVerlet, Integrator::SemiImplicitEuler],
    answer: AUTOMATIC,
    alone: AUTOMATIC,
    reference: Integrator::VelocityVerlet,
    may_lengthen: false,
    promise_percent: 1.0,
    step_follows_motion: true,
    estimate: Estimate {
        ratio: 1.5,
        // The lag makes the error fall with the first order.
        order: |_| 1,
        // Peaks of contact are less regular than that.
        safety: 2.0,
        // In 19 blows the true error was up to 2.1 times the difference, where 2 is expected.
        doubled_safety: 1.5,
        // Each step is chosen by the state, so results are not smooth to the last digit.
        floor_percent: 0.05,
        family: (Family::Motion, 0.1),
    },
    refinement: Refinement::WHILE_A_PERSON_WAITS,
    mesh: MeshRules {
        finest: FINEST_PHYSIOLOGICAL_LEVEL,
        finest_in_study: 3,
        witnesses: |level| [level + 1, level + 2],
        // Level k has 2 k + 4 cells in half a side of its core.
        fineness: |level| f64::from(level) + 2.0,
        scatter,
    },
    ends_early: "what acted is gone, and nothing grows",
    advice: |kind| match kind {
        FlagKind::MeshFolded | FlagKind::NotPredictable => Some("try a smaller blow"),
        // A soft face that is pressed in deeper than its edge is round has no normal to push along.
        FlagKind::EnergyImbalance => Some("try a rounder edge, a harder surface or a shorter step"),
        FlagKind::AngleBeyondTrust => Some("turn the blow nearer to the front"),
        _ => None,
    },
    silence: "none",
};

const AUTOMATIC: Automatic =
    Automatic { integrator: Integrator::VelocityVerlet, share: STEP_SHARE };

/// Read off random objects, and checked on others.
fn scatter(of: Quantity) -> MeshScatter {
    match of {
        Quantity::ShellGrowth => MeshScatter::within(0.09, 0.3),
        // Accelerations over 20 us follow each wave, and each mesh has its own.
        _ if Quantity::FORCES.contains(&of) => MeshScatter::within(0.25, 0.3),
        // The wall's largest stretch wanders between segments.
        Quantity::EquatorStretch | Quantity::BackStretch => MeshScatter::within(0.10, 0.3),
        // What the lens does late, hardly held by the vitreous, fades as the mesh gets finer.
        Quantity::LensPull => MeshScatter { least: 0.1, ..MeshScatter::within(0.6, 0.6) },
        Quantity::IrisPull => MeshScatter { least: 0.2, ..MeshScatter::within(0.35, 0.5) },
        Quantity::ScleralStress | Quantity::EdgeGrowth | Quantity::CornealEnergy => {
            MeshScatter::within(0.08, 0.3)
        }
        _ => MeshScatter::within(0.04, 0.3),
    }
}
