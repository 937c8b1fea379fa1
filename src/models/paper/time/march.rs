//! The march through the window: segment by segment, step by step.
//!
//! A segment ends at every break of the load. At its start the acceleration is evaluated afresh,
//! because it may jump there; reusing the stale one costs an order of accuracy.

use crate::models::paper::forces::{kernel::Survey, state::State, system::System};
use crate::models::paper::time::{method::Method, stepper::EqualSteps};
use crate::models::pulse::{Piece, Pulse, Segment};
use crate::run::plan::{Cost, Plan};
use crate::run::refusal::Refusal;
use std::ops::ControlFlow;

/// Least steps of a segment under load and after it, to resolve a short pulse and its wake.
const LEAST_STEPS: (f64, f64) = (4.0, 2.0);

/// What is seen of a run at the start of a segment and at the end of each step.
#[derive(Debug, Clone, Copy)]
pub struct Moment<'a> {
    /// The eye, with its acceleration by the law of `piece`.
    pub state: &'a State,
    /// What is known of the whole of it.
    pub survey: &'a Survey,
    /// The law of the load.
    pub piece: Piece,
    /// Whether a segment starts here; no step ended.
    pub starts: bool,
}

/// Steps that the step length asks of a segment, and the least it is given.
fn needed_and_least(plan: &Plan, segment: &Segment) -> (f64, f64) {
    let length = segment.end - segment.start;
    // A length that is a whole number of steps must not gain one by rounding.
    let needed = (length / plan.step - 1e-9).ceil();
    let least = if segment.piece == Piece::Nothing { LEAST_STEPS.1 } else { LEAST_STEPS.0 };
    (needed, least)
}

/// Number of steps that a segment takes.
pub fn steps_in(plan: &Plan, segment: &Segment) -> usize {
    let (needed, least) = needed_and_least(plan, segment);
    (needed.max(least) * plan.multiple.max(1.0)).ceil() as usize
}

/// Whether the segment is so short that the step length does not decide.
pub fn at_least_steps(plan: &Plan, segment: &Segment) -> bool {
    let (needed, least) = needed_and_least(plan, segment);
    needed < least
}

/// Number of steps in all.
pub fn steps(plan: &Plan, pulse: &Pulse) -> usize {
    pulse.segments(plan.window).iter().map(|s| steps_in(plan, s)).sum()
}

/// The longest step it really takes, in s.
pub fn longest_step(plan: &Plan, pulse: &Pulse) -> f64 {
    pulse
        .segments(plan.window)
        .iter()
        .map(|s| (s.end - s.start) / steps_in(plan, s) as f64)
        .fold(0.0, f64::max)
}

/// Moves `state` from 0 to the end of the window, or until `see` has seen enough.
///
/// # Errors
/// [`Refusal::NotFinite`] as soon as the energy is not finite.
pub fn march(
    system: &System,
    plan: &Plan,
    state: &mut State,
    mut see: impl FnMut(Moment) -> ControlFlow<()>,
) -> Result<Cost, Refusal> {
    let mut stepper = Method::of(plan.integrator).stepper(system, plan);
    let mut cost = Cost::default();
    for segment in system.pulse.segments(plan.window) {
        let piece = segment.piece;
        state.time = segment.start;
        let survey = state.evaluate(system, piece);
        cost.evaluations += 1;
        let mut steps = EqualSteps::new(segment, steps_in(plan, &segment));
        stepper.begin(state, &steps);
        let mut seen = see(Moment { state, survey: &survey, piece, starts: true });
        while seen.is_continue() && state.time < segment.end {
            let survey = stepper.step(state, &mut steps, &mut cost);
            cost.steps += 1;
            let energies = survey.kinetic + survey.elastic + state.work + state.dissipated;
            if !energies.is_finite() {
                return Err(Refusal::NotFinite { time: state.time, step: cost.steps });
            }
            seen = see(Moment { state, survey: &survey, piece, starts: false });
        }
        if seen.is_break() {
            break;
        }
    }
    Ok(cost)
}
