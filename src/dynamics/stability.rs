//! The largest step that cannot blow up, from the built mesh.
//!
//! A spring of stiffness k and any stretch has a tangent with eigenvalues k and k (1 - l0/l) <= k,
//! so x'Kx <= sum of k |xa - xb|^2 <= 2 sum over nodes of (sum of k at the node) |x|^2. Hence every
//! angular frequency of M^-1 K is at most omega = sqrt(2 max(sum of k at a node / its mass)), in
//! the rest shape and in any deformed one. It is the free-node form of Gershgorin's circles; one
//! pass over the springs, no iteration.
//!
//! An integrator that is stable for omega h up to c may take steps of c / omega; each c is where
//! the spectral radius of one step of the oscillator passes 1 (a test scans it). Drag adds three
//! conditions:
//!
//! * Semi-implicit Euler with its explicit drag of rate g needs (omega h)^2 + 2 g h <= 4.
//! * Drag that is the same everywhere never lowers the limit of a composition. Drag that differs
//!   between tissues can, because negative sub-steps amplify by up to exp(0.6 g h); g h is kept
//!   below 2, and for the Runge-Kutta methods within their interval on the real axis.
//! * Without drag the high-order compositions have hair-thin gaps far below their limit, which grow
//!   by at most 2.4e-3 a step. Any drag above g h = 0.005 closes them; below that the step stays
//!   under the first gap.

//!
//! Scenes with a projectile, a fluid or dashpots have one integrator, and its limit in `verlet`.

use super::integrator::Integrator;
use super::system::System;

/// Drag rate times step that closes the gaps.
const CLOSING_DRAG: f64 = 0.005;
/// Largest drag rate times step.
const MOST_DRAG: f64 = 2.0;

/// Largest step in s for which `integrator` is stable on `system` whatever its shape.
pub fn step_limit(integrator: Integrator, system: &System) -> f64 {
    if let Some(coupled) = system.coupled() {
        return coupled.step_limit();
    }
    // An eye without stiffness has no limit; it must still be seen to move.
    let omega = system.omega_bound().max(1.0);
    let most = system.decay[0].max(system.decay[1]);
    let least = system.decay[0].min(system.decay[1]);
    let by_stiffness = integrator.stability_limit() / omega;
    let by_drag = MOST_DRAG / most.max(f64::MIN_POSITIVE);
    match integrator {
        // Root of (omega h)^2 + 2 g h = 4, in the form that does not cancel.
        Integrator::SemiImplicitEuler => 4.0 / (most + (most * most + 4.0 * omega * omega).sqrt()),
        Integrator::Srkn6b | Integrator::Srkn11b => {
            let open = least * by_stiffness < CLOSING_DRAG;
            let stable = match integrator.first_gap() {
                Some(gap) if open => gap / omega,
                _ => by_stiffness,
            };
            stable.min(by_drag)
        }
        // Verlet's sub-steps are positive and never amplify, but a speed must not vanish within one.
        Integrator::VelocityVerlet | Integrator::Rk4 | Integrator::Dopri5 => {
            by_stiffness.min(by_drag)
        }
    }
}
