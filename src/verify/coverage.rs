//! Whether the stated step errors hold: many random scenes, each against a reference.
//!
//! A scene is drawn from a scrambled Sobol sequence, so a seed names it for good: a pulse on the Paper
//! model (force, duration, angle, width, shape, filaments), or an object at the eye of revolution (mass,
//! size, speed, angle, outline, surface, spring; the eye and what holds it). The reference takes many
//! times as many steps in every segment of the load. A scene whose mesh folds promises nothing and is
//! counted apart, and so is an object that goes through the eye, which is refused.

use crate::answer::results::Results;
use crate::answer::solve::solve;
use crate::many::statistics::median;
use crate::run::flags::FlagKind;
use crate::run::kept::Keep;
use crate::run::plan::Plan;
use crate::run::quantity::Quantity;
use crate::run::refusal::Refusal;
use crate::run::watch::unwatched;
use crate::scenario::{EyeInput, ForcePulse, Impact, PulseShape, Scenario};
use rayon::prelude::*;
use std::ops::ControlFlow;
use std::sync::atomic::{AtomicU32, Ordering};

/// Most scenes that the sequence has for one seed.
pub const MAX_SCENES: u32 = 1 << 16;

/// What is drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Drawn {
    /// Pulses on the Paper model.
    Pulses,
    /// Objects at the eye of revolution.
    Objects,
}

impl Drawn {
    /// How many times as many steps the reference takes.
    pub fn fineness(self) -> f64 {
        match self {
            Self::Pulses => 100.0,
            // Its steps cost far more, and its errors fall with the first order.
            Self::Objects => 8.0,
        }
    }

    /// Random scene number `index` of `seed`.
    pub fn scene(self, index: u32, seed: u32) -> Scenario {
        match self {
            Self::Pulses => pulse(index, seed),
            Self::Objects => crate::verify::random_object::random_object(index, seed),
        }
    }
}

/// A draw from 0 to 1: number `index`, dimension `dimension`.
pub(crate) fn draw(index: u32, dimension: u32, seed: u32) -> f64 {
    f64::from(sobol_burley::sample(index, dimension, seed))
}

fn pulse(index: u32, seed: u32) -> Scenario {
    let between =
        |dimension, low: f64, high: f64| low + (high - low) * draw(index, dimension, seed);
    let shape = match between(5, 0.0, 3.0) as u32 {
        0 => PulseShape::SmoothRectangle {
            edge_fraction: between(6, 0.0, 0.5),
        },
        1 => PulseShape::Triangle,
        _ => PulseShape::HalfSine,
    };
    // One scene in four is head-on, as most presets are.
    let head_on = draw(index, 10, seed) < 0.25;
    let hops = between(8, 0.0, 8.0) as u32;
    Scenario {
        name: format!("random scene {index} of seed {seed}"),
        impact: Impact::ForcePulse(ForcePulse {
            force_n: between(0, 20.0, 700.0),
            duration_ms: between(1, 0.05, 0.35),
            angle_deg: if head_on {
                0.0
            } else {
                between(2, -38.0, 38.0)
            },
            half_width_deg: between(3, 3.0, 35.0),
            shape,
        }),
        eye: EyeInput {
            filament_hops: [2, 3, 4]
                .into_iter()
                .filter(|h| hops >> (h - 2) & 1 == 1)
                .collect(),
            filament_factor: between(9, 0.2, 3.0),
            ..EyeInput::default()
        },
        ..Scenario::default()
    }
}

/// Claimed and true errors of one scene.
#[derive(Debug, Clone)]
pub struct Checked {
    /// Number of the scene.
    pub index: u32,
    /// Stated step error of each result, in %.
    pub claimed: Results,
    /// True error of each result, in %.
    pub truth: Results,
    /// Whether the mesh folded or the object went through, so that nothing is promised.
    pub folded: bool,
}

impl Checked {
    /// A scene that promises nothing.
    pub(crate) fn nothing(index: u32) -> Self {
        Self {
            index,
            claimed: Results::from_fn(|_| None),
            truth: Results::from_fn(|_| None),
            folded: true,
        }
    }
}

/// What many scenes showed for one result.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Coverage {
    /// The result.
    pub quantity: Quantity,
    /// Scenes whose true error lies within the stated one, in %.
    pub within: f64,
    /// Median of stated over true error; where no true error is seen the ratio counts as infinite.
    pub median_ratio: f64,
    /// Median true error, in %.
    pub median_truth: f64,
    /// Largest true error, in %.
    pub largest_truth: f64,
}

/// A stated error that did not hold.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Miss {
    /// Number of the scene.
    pub index: u32,
    /// The result.
    pub quantity: Quantity,
    /// Stated error, in %.
    pub claimed: f64,
    /// True error, in %.
    pub truth: f64,
}

/// Solves scenes 0 to `count` of `seed`, of what is `drawn`, each with its reference, on all threads of the present
/// pool. The order and every bit of the result are the same for any number of threads. `watch` is
/// told the share of scenes done after each, and may stop the rest.
///
/// # Errors
/// Whatever a scene refuses; none should. [`Refusal::Cancelled`] if the watch stopped it.
pub fn check(
    drawn: Drawn,
    count: u32,
    seed: u32,
    watch: &(dyn Fn(f64) -> ControlFlow<()> + Sync),
) -> Result<Vec<Checked>, Refusal> {
    let done = AtomicU32::new(0);
    (0..count)
        .into_par_iter()
        .map(|index| {
            let checked = check_one(drawn, index, seed)?;
            let done = done.fetch_add(1, Ordering::Relaxed) + 1;
            match watch(f64::from(done) / f64::from(count)) {
                ControlFlow::Continue(()) => Ok(checked),
                ControlFlow::Break(()) => Err(Refusal::Cancelled),
            }
        })
        .collect()
}

fn check_one(drawn: Drawn, index: u32, seed: u32) -> Result<Checked, Refusal> {
    let scene = drawn.scene(index, seed).check()?;
    let answer = match solve(&scene, Keep::default(), &mut unwatched) {
        Err(Refusal::WentThrough(_)) => {
            return Ok(Checked::nothing(index));
        }
        answer => answer?,
    };
    let fine = Plan {
        multiple: answer.plan.multiple * drawn.fineness(),
        ..answer.plan
    };
    let reference = answer.case.run(&fine, Keep::default(), &mut unwatched)?;
    Ok(Checked {
        index,
        claimed: answer.errors.time_step,
        truth: answer
            .results()
            .difference_percent(&answer.case.results(&reference)),
        folded: answer.flags.iter().any(|f| f.kind == FlagKind::MeshFolded),
    })
}

/// Stated and true error of a result, in %, scene by scene, of those that promise something.
fn promised(checked: &[Checked], of: Quantity) -> impl Iterator<Item = (u32, f64, f64)> {
    let promising = checked.iter().filter(|c| !c.folded);
    promising.filter_map(move |c| Some((c.index, c.claimed[of]?, c.truth[of]?)))
}

/// Coverage of each result over the scenes that promise something.
pub fn coverage(checked: &[Checked]) -> Vec<Coverage> {
    let of = |&quantity: &Quantity| {
        let all: Vec<_> = promised(checked, quantity).collect();
        let truths: Vec<f64> = all.iter().map(|&(.., truth)| truth).collect();
        let within = all.iter().filter(|(_, claimed, truth)| truth <= claimed);
        // A claim over no error at all is infinite, as no claim is zero.
        let ratios = all.iter().map(|(_, claimed, truth)| claimed / truth);
        Some(Coverage {
            quantity,
            within: 100.0 * within.count() as f64 / all.len() as f64,
            median_ratio: median(ratios.collect())?,
            largest_truth: truths.iter().copied().fold(0.0, f64::max),
            median_truth: median(truths)?,
        })
    };
    Quantity::ALL.iter().filter_map(of).collect()
}

/// Every stated error that did not hold, result by result. A true error that is not a number holds no
/// promise.
pub fn misses(checked: &[Checked]) -> Vec<Miss> {
    let of = |&quantity: &Quantity| {
        promised(checked, quantity)
            .filter(|(_, claimed, truth)| truth.is_nan() || truth > claimed)
            .map(move |(index, claimed, truth)| Miss {
                index,
                quantity,
                claimed,
                truth,
            })
    };
    Quantity::ALL.iter().flat_map(of).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn checked(index: u32, claimed: f64, truth: f64, folded: bool) -> Checked {
        Checked {
            index,
            claimed: Results::from_fn(|_| Some(claimed)),
            truth: Results::from_fn(|_| Some(truth)),
            folded,
        }
    }

    #[test]
    fn misses_and_folds_are_counted_apart() {
        let all = [
            checked(0, 4.0, 1.0, false),
            checked(1, 1.0, 2.0, false),
            checked(2, 1.0, 9.0, true),
            checked(3, 1.0, 0.0, false),
            checked(4, 1.0, f64::NAN, false),
        ];
        for row in coverage(&all) {
            assert_eq!(row.within, 50.0);
            assert_eq!(row.largest_truth, 2.0);
        }
        let missed: Vec<u32> = misses(&all).iter().map(|m| m.index).collect();
        assert_eq!(missed, [1, 4].repeat(Quantity::ALL.len()));
        assert_eq!(coverage(&all[..4])[0].median_ratio, 4.0);
    }

    #[test]
    fn every_scene_is_one_that_a_person_could_ask_for() {
        for seed in [0, 1, u32::MAX] {
            for index in (0..2000).chain([MAX_SCENES - 1]) {
                for drawn in [Drawn::Pulses, Drawn::Objects] {
                    let scene = drawn.scene(index, seed);
                    assert!(scene.check().is_ok(), "{scene:?}");
                }
            }
        }
    }
}
