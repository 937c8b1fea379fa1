//! What the inputs that are not known do to the risks: one run for each of them.
//!
//! Each uncertain input is moved alone by one standard deviation, to the side on which it matters
//! more. By how much more log10 of each measure then moves than it does under the objects that the
//! curves were matched with, in quadrature, is its standard deviation. An ensemble checks it.
//!
//! Left out: inputs that hang together, and curvature over more than one standard deviation.

use crate::answer::uncertain::{UncertainInput, inputs};
use crate::answer::{brief::single, results::InputDoubt, solve::Answer};
use crate::injury::{Blow, Injury, PerInjury};
use crate::run::ordered::{self, until};
use crate::run::refusal::Refusal;
use crate::scenario::{Geometry, Scenario};
use std::f64::consts::PI;
use std::ops::ControlFlow;
use std::sync::atomic::AtomicBool;

/// What of an answer its input doubt depends on, so that it can be estimated elsewhere.
#[derive(Debug, Clone, Copy)]
pub struct InputQuery {
    measures: Option<PerInjury<f64>>,
    /// Whether bone was met: what it did not touch does not depend on where bone lies.
    meets_bone: bool,
}

/// By how much log10 goes from one value to another; 0 where there is nothing to compare.
fn way(from: f64, to: f64) -> f64 {
    let way = libm::log10(to / from);
    if way.is_finite() { way } else { 0.0 }
}

/// Where neither brow nor nose shields an eye, in rad about its axis: below and the temple.
const BARE_SIDE: f64 = 1.25 * PI;

/// The scenario with one input moved by a standard deviation.
fn moved(scenario: &Scenario, input: &UncertainInput) -> Scenario {
    let mut moved = scenario.clone();
    moved.doubt.clear();
    input.put(&mut moved, input.one_off());
    if let Some(was) = scenario.projectile()
        && let Some(now) = moved.projectile_mut()
    {
        let from = scenario.eye_side().hour(BARE_SIDE);
        if was.angle_deg == 0.0 {
            now.angle_clock = from;
        }
        if was.offset_mm == 0.0 {
            now.offset_clock = from;
        }
    }
    moved
}

impl InputQuery {
    /// The question for `answer`.
    pub fn of(answer: &Answer) -> Self {
        let measures = Injury::ALL.iter().map(|injury| answer.result(injury.measure()));
        let bone = ["peak_rim_force_n", "globe_on_bone_n"];
        Self {
            measures: measures.collect::<Option<Vec<f64>>>().and_then(|all| all.try_into().ok()),
            meets_bone: bone.iter().any(|force| answer.run.detail(force) > Some(0.0)),
        }
    }

    /// Runs the answered `scenario` once for each input, on all cores; tells `progress` the share.
    ///
    /// # Errors
    /// [`Refusal::Cancelled`] if it was stopped. An input that cannot be moved so counts as known.
    pub fn estimate(
        &self,
        scenario: &Scenario,
        stop: &AtomicBool,
        mut progress: impl FnMut(f64) + Send,
    ) -> Result<InputDoubt, Refusal> {
        let Some(from) = self.measures else { return Ok(InputDoubt::default()) };
        let mut inputs = inputs(scenario);
        inputs.retain(|input| input.is_run() && (self.meets_bone || !input.is_of_bone()));
        let energy = Blow::of(scenario).energy;
        // What another eye computes is compared with what that eye says of the scene as it is.
        let other = |geometry: &Geometry| {
            let needed = |input| moved(scenario, input).geometry() == Some(*geometry);
            Some(*geometry) != scenario.geometry() && inputs.iter().any(needed)
        };
        let geometries = [Geometry::Half, Geometry::Full].into_iter().filter(other);
        let as_it_is = |geometry: Geometry| {
            let mut same = scenario.clone();
            same.doubt.clear();
            same.numerics.geometry = geometry;
            same
        };
        let measures = |scenario: &Scenario| -> Result<PerInjury<f64>, Refusal> {
            let brief = single(&scenario.check()?, None, &mut until(stop))?;
            let value = |injury: &Injury| brief.values[injury.measure()].unwrap_or(0.0);
            Ok(std::array::from_fn(|i| value(&Injury::ALL[i])))
        };
        let bases: Vec<(Geometry, PerInjury<f64>)> =
            geometries.filter_map(|g| Some((g, measures(&as_it_is(g)).ok()?))).collect();
        let run = |index: usize| {
            let input = &inputs[index];
            let there = moved(scenario, input);
            let curves = input.moves_curves(input.one_off());
            let other = bases.iter().find(|(g, _)| Some(*g) == there.geometry());
            let from = other.map_or(from, |(_, base)| *base);
            match measures(&there) {
                Ok(to) => Some(Some(InputDoubt {
                    measures: std::array::from_fn(|i| way(from[i], to[i]) - curves[i]),
                    energy: energy
                        .map_or(0.0, |energy| way(energy, Blow::of(&there).energy.unwrap_or(0.0))),
                })),
                Err(Refusal::Cancelled) => None,
                Err(_) => Some(None),
            }
        };
        let mut doubt = InputDoubt::default();
        let mut done = 0;
        ordered::run((0, inputs.len()), stop, run, |_, moved: Option<InputDoubt>| {
            done += 1;
            progress(done as f64 / inputs.len() as f64);
            if let Some(moved) = moved {
                for (sum, way) in doubt.measures.iter_mut().zip(moved.measures) {
                    *sum = libm::hypot(*sum, way);
                }
                doubt.energy = libm::hypot(doubt.energy, moved.energy);
            }
            ControlFlow::Continue(())
        });
        if done < inputs.len() { Err(Refusal::Cancelled) } else { Ok(doubt) }
    }
}
