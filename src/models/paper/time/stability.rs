//! The largest stable step, from the bound of [`frequency`](crate::models::paper::eye::frequency).
//!
//! An integrator that is stable for omega h up to c may take steps of c / omega; each c is where
//! the spectral radius of one step of the oscillator passes 1 (a test scans it). Drag adds three
//! conditions:
//!
//! * Semi-implicit Euler with its explicit drag of rate g needs (omega h)^2 + 2 g h <= 4.
//! * Drag that is the same everywhere never lowers the limit of a composition. Drag that differs
//!   between tissues can, because negative sub-steps amplify by up to exp(0.6 g h); g h is kept
//!   below 2, and for the Runge-Kutta methods within their interval on the real axis.
//! * Without drag the high-order compositions have hair-thin gaps far below their limit, which
//!   grow by at most 2.4e-3 a step. Any drag above g h = 0.005 closes them; below that the step
//!   stays under the first gap.

use crate::models::paper::{forces::system::System, time::stepper::Drag};
use crate::scenario::Integrator;

/// Drag rate times step that closes the gaps.
const CLOSING_DRAG: f64 = 0.005;
/// Largest drag rate times step.
const MAX_DRAG: f64 = 2.0;

/// Largest step in s for which `integrator` is stable on `system` whatever its shape.
pub fn step_limit(integrator: Integrator, system: &System) -> f64 {
    // An eye without stiffness has no limit; it must still be seen to move.
    let omega = system.omega_bound.max(1.0);
    let most = system.decay[0].max(system.decay[1]);
    let least = system.decay[0].min(system.decay[1]);
    let method = integrator.method();
    if method.drag == Drag::WithKick {
        // Root of (omega h)^2 + 2 g h = 4, in the form that does not cancel.
        return 4.0 / (most + (most * most + 4.0 * omega * omega).sqrt());
    }
    let by_stiffness = method.stability_limit / omega;
    let open = least * by_stiffness < CLOSING_DRAG;
    let stable = match method.first_gap {
        Some(gap) if open => gap / omega,
        _ => by_stiffness,
    };
    // Verlet's sub-steps are positive and never amplify, but a speed must not vanish within one.
    stable.min(MAX_DRAG / most.max(f64::MIN_POSITIVE))
}
