//! The one calibration of the eye of revolution, so that anybody can repeat it.
//!
//! One number is free: the bulk modulus of orbital fat. Published is a Young's modulus of 47 kPa; with a
//! Poisson ratio of 0.49 that makes 0.78 `MPa`, but in so soft a material the last digit of the Poisson
//! ratio decides (0.48 would make 0.39). Fitted are the two tests of an impactor in the orbit: the first
//! wants it stiffer, the second softer. Of the values on a grid of [`STEP`] the one with most of the six
//! figures (two tests on three meshes) inside what was measured is taken, of several the one with the least
//! sum of squared misfits. The data tell no finer: [`Fit::nearly`] shows how wide the valley is.
//!
//! Left out: weights, and anything that was not fitted, which stays unseen here.

use crate::run::refusal::Refusal;
use crate::run::watch::Watch;
use crate::scenario::{Model, Scenario};
use crate::verify::experiments::{EXPERIMENTS, Experiment};
use crate::verify::validate::{Row, readings, rows_of, squared_misfit};
use rayon::prelude::*;
use std::ops::ControlFlow;

/// The field's path.
pub const PATH: &str = "model.fat_bulk_mpa";
/// Distance between the values that are tried, in `MPa`.
pub const STEP: f64 = 0.05;
/// How many are tried, from one step on.
const COUNT: u32 = 20;
/// A value fits nearly as well as the best if its misfit is no more than this above it: 95 % for one
/// number if misfits are normal.
const NEARLY: f64 = 3.84;

/// One value of the free number.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Tried {
    /// Bulk modulus of fat, `MPa`.
    pub mpa: f64,
    /// Sum of squared misfits.
    pub misfit: f64,
    /// How many figures lie inside what was measured.
    pub inside: usize,
}

/// What a calibration found.
#[derive(Debug, Clone)]
pub struct Fit {
    /// The best.
    pub best: Tried,
    /// The range of those that fit nearly as well by their misfit.
    pub nearly: (f64, f64),
    /// All that were tried.
    pub tried: Vec<Tried>,
    /// The fitted rows at the best.
    pub rows: Vec<Row>,
}

fn fitted() -> impl Iterator<Item = &'static Experiment> {
    EXPERIMENTS.iter().filter(|e| e.fitted)
}

fn with_fat(mut scenario: Scenario, mpa: f64) -> Scenario {
    if let Model::Physiological(model) = &mut scenario.model {
        model.fat_bulk_mpa = mpa;
    }
    scenario
}

/// How well a bulk modulus of fat, in `MPa`, fits.
pub fn tried(mpa: f64) -> Tried {
    let mut tried = Tried {
        mpa,
        misfit: 0.0,
        inside: 0,
    };
    let read = readings(fitted(), |scenario| with_fat(scenario, mpa));
    for (experiment, values) in fitted().zip(read) {
        for value in values {
            let measured = experiment.measured;
            tried.inside += usize::from(value.is_some_and(|value| measured.holds(value)));
            // What cannot be run does not fit.
            tried.misfit += value.map_or(f64::INFINITY, |value| squared_misfit(measured, value));
        }
    }
    tried
}

/// Fits the free number; `watch` hears the share done.
///
/// # Errors
/// [`Refusal::Cancelled`] if the watch stopped it.
pub fn calibrate(watch: Watch) -> Result<Fit, Refusal> {
    let grid: Vec<f64> = (1..=COUNT)
        // To the digits that are printed: what is printed is what was run.
        .map(|i| (f64::from(i) * STEP * 1e2).round() / 1e2)
        .collect();
    let mut all: Vec<Tried> = Vec::new();
    for chunk in grid.chunks(rayon::current_num_threads().max(1)) {
        all.par_extend(chunk.par_iter().map(|&mpa| tried(mpa)));
        if let ControlFlow::Break(()) = watch(all.len() as f64 / grid.len() as f64) {
            return Err(Refusal::Cancelled);
        }
    }
    let better = |a: &Tried, b: &Tried| {
        let most_inside = b.inside.cmp(&a.inside);
        most_inside.then(a.misfit.total_cmp(&b.misfit))
    };
    let best = *all
        .iter()
        .min_by(|a, b| better(a, b))
        .ok_or(Refusal::Cancelled)?;
    let least = all.iter().map(|t| t.misfit).fold(f64::INFINITY, f64::min);
    let near = all.iter().filter(|t| t.misfit <= least + NEARLY);
    let nearly = near.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), t| {
        (low.min(t.mpa), high.max(t.mpa))
    });
    Ok(Fit {
        best,
        nearly,
        rows: rows_of(fitted(), |scenario| with_fat(scenario, best.mpa)),
        tried: all,
    })
}
