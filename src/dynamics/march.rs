//! The march through the window: segment by segment, step by step.
//!
//! A segment ends at every break of the load. At its start the acceleration is evaluated afresh,
//! because it may jump there; reusing the stale one costs an order of accuracy.

use super::integrator::{self, Integrator};
use super::kernel::{self, Survey};
use super::load::Piece;
use super::state::State;
use super::system::System;

/// Steps that a segment under load is given at least, so that a short pulse is resolved.
const LEAST_STEPS_UNDER_LOAD: f64 = 4.0;

/// Someone who watches every step.
pub trait Observer {
    /// A segment starts: the state's acceleration has just been evaluated by its law.
    fn begin(&mut self, system: &System, state: &State, piece: Piece, survey: &Survey);
    /// A step ended.
    fn step(&mut self, system: &System, state: &State, piece: Piece, survey: &Survey);
    /// Whether the rest of the window may be left out.
    fn satisfied(&self) -> bool {
        false
    }
}

/// How to move.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Plan {
    /// The method.
    pub integrator: Integrator,
    /// Longest step, in s.
    pub step: f64,
    /// Simulated time, in s.
    pub window: f64,
    /// Local error allowed a step in the energy norm, for integrators that choose their steps.
    pub local_tolerance: f64,
}

/// The local tolerance unless another is asked for.
pub const LOCAL_TOLERANCE: f64 = 1e-5;

/// What a march cost.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Cost {
    /// Steps taken.
    pub steps: usize,
    /// Force evaluations.
    pub evaluations: usize,
}

/// A march that could not be finished.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[error("the motion is no longer finite at {:.6} ms (step {step}): the step is unstable", time * 1e3)]
pub struct Diverged {
    /// Simulated time, in s.
    pub time: f64,
    /// Number of the step.
    pub step: usize,
}

/// Number of steps a segment of `length` seconds takes.
fn steps_in(length: f64, longest: f64, piece: Piece) -> usize {
    // A length that is a whole number of steps must not gain one by rounding.
    let needed = (length / longest - 1e-9).ceil().max(1.0);
    if piece == Piece::Nothing {
        needed as usize
    } else {
        needed.max(LEAST_STEPS_UNDER_LOAD) as usize
    }
}

/// Moves `state` from 0 to the end of the window under `observer`'s eyes.
///
/// # Errors
/// [`Diverged`] as soon as the energy is not finite.
pub fn march(
    system: &System,
    plan: &Plan,
    state: &mut State,
    observer: &mut impl Observer,
) -> Result<Cost, Diverged> {
    let pulse = system.load().pulse;
    let mut cost = Cost::default();
    for segment in pulse.segments(plan.window) {
        let length = segment.end - segment.start;
        let steps = steps_in(length, plan.step, segment.piece);
        let h = length / steps as f64;
        let mut stepper = integrator::stepper(
            plan.integrator,
            system,
            segment,
            steps,
            plan.local_tolerance,
        );

        state.time = segment.start;
        let force = pulse.force(segment.piece, segment.start);
        let survey = kernel::evaluate(system, state, force, 0.0);
        cost.evaluations += 1;
        observer.begin(system, state, segment.piece, &survey);
        let mut taken = 0;
        while state.time < segment.end {
            let survey = stepper.step(system, state, segment.piece);
            taken += 1;
            cost.steps += 1;
            if !plan.integrator.adaptive() {
                // Computed, not summed, so that rounding does not pile up over many steps.
                state.time = if taken == steps {
                    segment.end
                } else {
                    segment.start + h * taken as f64
                };
            }
            if !(survey.kinetic + survey.elastic).is_finite() {
                return Err(Diverged {
                    time: state.time,
                    step: cost.steps,
                });
            }
            observer.step(system, state, segment.piece, &survey);
            if observer.satisfied() {
                cost.evaluations += stepper.evaluations();
                return Ok(cost);
            }
        }
        cost.evaluations += stepper.evaluations();
    }
    Ok(cost)
}
