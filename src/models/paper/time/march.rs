//! The march through the window: segment by segment, step by step.
//!
//! A segment ends at every break of the load. At its start the acceleration is evaluated afresh,
//! because it may jump there; reusing the stale one costs an order of accuracy.

use crate::models::paper::forces::{kernel::Survey, state::State, system::System};
use crate::models::pulse::{Piece, Pulse, Segment};
use crate::run::plan::{Cost, Plan};
use crate::run::refusal::Refusal;

/// Steps that a segment is given at least, under load and after it, so that a short pulse and its
/// wake are resolved.
const LEAST_STEPS: (f64, f64) = (4.0, 2.0);

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

impl Plan {
    /// Steps that the step length asks of a segment, and the least it is given.
    fn needed_and_least(&self, segment: &Segment) -> (f64, f64) {
        let length = segment.end - segment.start;
        // A length that is a whole number of steps must not gain one by rounding.
        let needed = (length / self.step - 1e-9).ceil();
        if segment.piece == Piece::Nothing {
            (needed, LEAST_STEPS.1)
        } else {
            (needed, LEAST_STEPS.0)
        }
    }

    /// Number of steps that a segment takes.
    pub fn steps_in(&self, segment: &Segment) -> usize {
        let (needed, least) = self.needed_and_least(segment);
        (needed.max(least) * self.multiple.max(1.0)).ceil() as usize
    }

    /// Whether the segment is so short that the step length does not decide.
    pub fn at_least_steps(&self, segment: &Segment) -> bool {
        let (needed, least) = self.needed_and_least(segment);
        needed < least
    }

    /// Number of steps in all.
    pub fn steps(&self, pulse: &Pulse) -> usize {
        pulse.segments(self.window).iter().map(|s| self.steps_in(s)).sum()
    }

    /// Number of steps while the load acts.
    pub fn steps_under_load(&self, pulse: &Pulse) -> usize {
        pulse
            .segments(self.window)
            .iter()
            .filter(|s| s.piece != Piece::Nothing)
            .map(|s| self.steps_in(s))
            .sum()
    }

    /// The longest step it really takes, in s.
    pub fn longest_step(&self, pulse: &Pulse) -> f64 {
        pulse
            .segments(self.window)
            .iter()
            .map(|s| (s.end - s.start) / self.steps_in(s) as f64)
            .fold(0.0, f64::max)
    }
}

/// Moves `state` from 0 to the end of the window under `observer`'s eyes.
///
/// # Errors
/// [`Refusal::NotFinite`] as soon as the energy is not finite.
pub fn march(
    system: &System,
    plan: &Plan,
    state: &mut State,
    observer: &mut impl Observer,
) -> Result<Cost, Refusal> {
    let mut stepper = plan.integrator.method().stepper(system, plan);
    let mut cost = Cost::default();
    for segment in system.load().pulse.segments(plan.window) {
        let survey = stepper.begin(state, &segment, plan.steps_in(&segment), &mut cost);
        observer.begin(system, state, segment.piece, &survey);
        while state.time < segment.end {
            let survey = stepper.step(state, &segment, &mut cost);
            cost.steps += 1;
            let energies = survey.kinetic + survey.elastic + state.work + state.dissipated;
            if !energies.is_finite() {
                return Err(Refusal::NotFinite { time: state.time, step: cost.steps });
            }
            observer.step(system, state, segment.piece, &survey);
            if observer.satisfied() {
                return Ok(cost);
            }
        }
    }
    Ok(cost)
}
