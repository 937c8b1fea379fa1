//! The largest step that cannot blow up, from the built mesh.
//!
//! A spring of stiffness k and any stretch has a tangent with eigenvalues k and k (1 - l0/l) <= k,
//! so x'Kx <= sum of k |xa - xb|^2 <= 2 sum over nodes of (sum of k at the node) |x|^2. Hence every
//! angular frequency of M^-1 K is at most omega = sqrt(2 max(sum of k at a node / its mass)), in
//! the rest shape and in any deformed one. It is the free-node form of Gershgorin's circles; one
//! pass over the springs, no iteration.
//!
//! An integrator that is stable for omega h up to c may take steps of c / omega. With explicit drag
//! of rate g, semi-implicit Euler needs (omega h)^2 + 2 g h <= 4.

use super::integrator::Integrator;
use super::system::System;

/// Share of the limit that an automatic step takes.
pub const SAFETY: f64 = 0.9;

/// Largest step in s for which `integrator` is stable on `system` whatever its shape.
pub fn step_limit(integrator: Integrator, system: &System) -> f64 {
    // An eye without stiffness has no limit; it must still be seen to move.
    let omega = system.omega_bound().max(1.0);
    match integrator {
        Integrator::SemiImplicitEuler => {
            let g = system.decay[0].max(system.decay[1]);
            // Root of (omega h)^2 + 2 g h = 4, in the form that does not cancel.
            4.0 / (g + (g * g + 4.0 * omega * omega).sqrt())
        }
        _ => integrator.stability_limit() / omega,
    }
}
