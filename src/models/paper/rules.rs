//! How the Paper model is solved and how its errors are told; see [`crate::run::rules`].

use crate::run::flags::FlagKind;
use crate::run::quantity::{Family, Quantity};
use crate::run::rules::{
    Automatic, Element, Estimate, LONGEST_SHARE, MeshRules, MeshScatter, Refinement, Rules,
};
use crate::scenario::{FINEST_LEVEL, Integrator};

/// Integrators, error estimates and mesh rules of the Paper model.
pub(crate) static RULES: Rules = Rules {
    name: "Paper",
    element: Element::Spring,
    springs_an_element: 1.0,
    integrators: Integrator::ALL,
    // The share leaves room for a second, coarser run below the limit.
    answer: Automatic { integrator: Integrator::Srkn6b, share: SHARE_OF_ANSWER },
    // As accurate at the same cost, with fewer and longer steps to record.
    alone: Automatic { integrator: Integrator::Srkn11b, share: LONGEST_SHARE },
    reference: Integrator::Srkn11b,
    // The automatic step is wasteful both ways among many runs: too short for the accuracy of a
    // stiff eye, too long for the pulse on a soft one.
    may_lengthen: true,
    // Far below what is not known of an eye, and cheap where a method is of high order.
    promise_percent: 0.1,
    step_follows_motion: false,
    estimate: Estimate {
        // The longest step that a run takes against an answer's.
        ratio: LONGEST_SHARE / SHARE_OF_ANSWER,
        order: Integrator::order,
        // With 5 and the family's share the stated errors hold in more than 95 % of random scenes
        // for each result and are 5 to 9 times the true ones in the median.
        safety: 5.5,
        // Twice as many steps leave a sixteenth of the error.
        doubled_safety: 1.0,
        // Rounding and the search for peaks end here.
        floor_percent: 1e-6,
        // The same waves pass the three nodes of the shell; the force at the centre is smoother.
        family: (Family::ShellForces, 0.03),
    },
    refinement: Refinement::WHILE_A_PERSON_WAITS,
    mesh: MeshRules {
        finest: FINEST_LEVEL,
        finest_in_study: 4,
        // At the finest levels one of them is the level itself.
        witnesses: |level| {
            let finest = (level + 2).min(FINEST_LEVEL);
            [finest - 1, finest]
        },
        fineness: f64::from,
        scatter,
    },
    ends_early: "nothing can change any more",
    advice: |kind| match kind {
        FlagKind::MeshFolded | FlagKind::NotPredictable => {
            Some("take the model Physiological, or a smaller blow")
        }
        FlagKind::EnergyImbalance => Some("try a shorter step"),
        _ => None,
    },
    // A pulse brings no energy of an object, and springs hold no pressure.
    silence: "not told: the section of the Paper model has no tissues to read; take the model \
              Physiological",
};

const SHARE_OF_ANSWER: f64 = 0.8;

/// Read off 144 random scenes, and checked on others.
fn scatter(of: Quantity) -> MeshScatter {
    match of {
        // The index and the vertical diameter are smoother than the rest.
        Quantity::Damage | Quantity::MeridianGrowth => {
            MeshScatter { order: 2, ..MeshScatter::within(0.055, 0.3) }
        }
        // Finer shells crumple where level 1 stretches, which leaves hardly any growth.
        Quantity::ShellGrowth => MeshScatter { least: 1e-3, ..MeshScatter::within(0.5, 0.5) },
        Quantity::Energy => MeshScatter::within(0.08, 0.3),
        Quantity::ForceCentre => MeshScatter::within(0.1, 0.3),
        Quantity::ForceFront => MeshScatter::within(0.25, 0.3),
        Quantity::ForceRight => MeshScatter::within(0.7, 0.12),
        Quantity::ForceTop => MeshScatter::within(0.3, 0.12),
        _ => MeshScatter::within(0.04, 0.3),
    }
}
