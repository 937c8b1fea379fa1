//! Whether the stated step errors hold: many random scenes, each against a reference.
//!
//! A scene draws force, duration, angle, width, shape and filaments from a scrambled Sobol
//! sequence, so a seed names it for good. The reference takes steps a hundred times shorter. A
//! scene whose mesh folds promises nothing and is counted apart.

use super::case::{Case, Refusal, unwatched};
use super::flags::FlagKind;
use super::quantity::{PerQuantity, Quantity, difference_percent, values};
use super::solve::solve;
use crate::dynamics::{Integrator, Plan};
use crate::recording::Keep;
use crate::scenario::{EyeInput, ForcePulse, Impact, PulseShape, Scenario};
use rayon::prelude::*;

/// How much shorter the steps of the reference are.
pub const REFERENCE_FINENESS: f64 = 100.0;

/// A draw from 0 to 1: number `index`, dimension `dimension`.
fn draw(index: u32, dimension: u32, seed: u32) -> f64 {
    f64::from(sobol_burley::sample(index, dimension, seed))
}

/// Random scene number `index` of `seed`.
pub fn scene(index: u32, seed: u32) -> Scenario {
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
    pub claimed: PerQuantity,
    /// True error of each result, in %.
    pub truth: PerQuantity,
    /// Whether the mesh folded, so that nothing is promised.
    pub folded: bool,
}

/// What many scenes showed for one result.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Coverage {
    /// The result.
    pub quantity: Quantity,
    /// Scenes whose true error lies within the stated one, in %.
    pub within: f64,
    /// Median of stated over true error.
    pub median_ratio: f64,
    /// Median true error, in %.
    pub median_truth: f64,
    /// Largest true error, in %.
    pub largest_truth: f64,
}

/// Solves scenes 0 to `count` of `seed`, each with its reference.
///
/// # Errors
/// Whatever a scene refuses; none should.
pub fn check(count: u32, seed: u32) -> Result<Vec<Checked>, Refusal> {
    (0..count)
        .into_par_iter()
        .map(|index| {
            let scenario = scene(index, seed);
            let answer = solve(&scenario, Keep::default(), &mut unwatched)?;
            let case = Case::new(&scenario);
            let fine = Plan {
                integrator: Integrator::Srkn6b,
                step: answer.plan.step / REFERENCE_FINENESS,
                ..answer.plan
            };
            let reference = case.run(&fine, Keep::default(), &mut unwatched)?;
            let reference = values(&reference.recording.extremes);
            Ok(Checked {
                index,
                claimed: answer.errors.time_step,
                truth: difference_percent(&values(&answer.recording.extremes), &reference),
                folded: answer.flags.iter().any(|f| f.kind == FlagKind::MeshFolded),
            })
        })
        .collect()
}

fn median(mut of: Vec<f64>) -> f64 {
    of.sort_by(f64::total_cmp);
    of.get(of.len() / 2).copied().unwrap_or(f64::NAN)
}

/// Coverage of each result over the scenes that promise something.
pub fn coverage(checked: &[Checked]) -> Vec<Coverage> {
    let valid: Vec<&Checked> = checked.iter().filter(|c| !c.folded).collect();
    Quantity::ALL
        .iter()
        .enumerate()
        .map(|(q, &quantity)| {
            let within = valid.iter().filter(|c| c.truth[q] <= c.claimed[q]).count();
            let ratios = valid
                .iter()
                .filter(|c| c.truth[q] > 0.0)
                .map(|c| c.claimed[q] / c.truth[q])
                .collect();
            let truths: Vec<f64> = valid.iter().map(|c| c.truth[q]).collect();
            Coverage {
                quantity,
                within: 100.0 * within as f64 / valid.len().max(1) as f64,
                median_ratio: median(ratios),
                largest_truth: truths.iter().copied().fold(0.0, f64::max),
                median_truth: median(truths),
            }
        })
        .collect()
}
